// SPDX-License-Identifier: LGPL-3.0-or-later
/// Records: what the classes of Python know of the structs of a study. A source that includes this gives a
/// Description of each of its structs and instantiates its RecordCodec.
#pragma once

#include "values.hpp"
#include <functional>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

namespace rubato::python {

/// A member of a struct, as Python shows it.
template <class T, class Value> struct Member {
  std::string_view name;
  Value T::*place;
  std::string_view meaning; ///< with the unit in brackets
};
template <class T, class Value> Member(std::string_view, Value T::*, std::string_view) -> Member<T, Value>;

/// `name`, `meaning`, and `members`, a tuple of Member; it may have `other`, which makes a record of another
/// value that stands for one, or gives nothing: py::object other(py::handle, const Path&); and `hidden`, the
/// number of members that Python does not see.
template <class T> struct Description;

/// Stands for a value of whatever type a member has.
struct AnyValue {
  template <class T> operator T() const; // never called
};
template <class T, std::size_t... I> consteval bool takes(std::index_sequence<I...>) {
  return requires {
    T{(static_cast<void>(I), AnyValue{})...};
  };
}
/// Members of a struct without constructors: as many as an initialisation takes.
template <class T, std::size_t count = 64> consteval std::size_t member_count() {
  if constexpr (takes<T>(std::make_index_sequence<count>()))
    return count;
  else
    return member_count<T, count - 1>();
}
template <class T> consteval std::size_t hidden_count() {
  if constexpr (requires { Description<T>::hidden; })
    return Description<T>::hidden;
  else
    return 0;
}

/// A member without its type.
struct MemberEntry {
  std::string_view name;
  std::string type;
  std::string_view meaning;
  std::function<py::object(py::handle, const Path&)> tidy;
};
struct RecordEntry {
  std::string_view name;
  std::string_view meaning;
  std::vector<MemberEntry> members;
  std::function<py::tuple()> defaults;
};

/// Every record, each source's own.
std::vector<RecordEntry> mesh_records();
std::vector<RecordEntry> value_records();
std::vector<RecordEntry> solid_records();
std::vector<RecordEntry> contact_records();
std::vector<RecordEntry> run_records();
std::vector<RecordEntry> result_records();

/// Calls visit(member) for each.
template <class T, class Visit> void for_each_member(const Visit& visit) {
  std::apply([&](const auto&... member) { (visit(member), ...); }, Description<T>::members);
}

inline bool is_record(py::handle value, std::string_view name) {
  return py::isinstance(value, class_named(name));
}

/// A record without values.
inline py::object bare_record(std::string_view name) {
  auto type = class_named(name);
  return type.attr("__new__")(type);
}
/// Past the checks of assignments.
inline void put(const py::object& record, std::string_view name, const py::object& value) {
  if (PyObject_GenericSetAttr(record.ptr(), py::str(name.data(), name.size()).ptr(), value.ptr()) != 0)
    throw py::error_already_set();
}

template <class T> py::object RecordCodec<T>::tidy(py::handle value, const Path& path) {
  using Of = Description<T>;
  if (is_record(value, Of::name))
    return py::reinterpret_borrow<py::object>(value);
  if constexpr (requires { Of::other(value, path); })
    if (auto record = Of::other(value, path))
      return record;
  refuse(path, value, Of::name);
}

template <class T> T RecordCodec<T>::from(py::handle value, const Path& path) {
  const auto record = tidy(value, path);
  T result;
  for_each_member<T>([&]<class Value>(const Member<T, Value>& member) {
    const auto name = py::str(member.name.data(), member.name.size());
    result.*member.place = Codec<Value>::from(record.attr(name), step_into(path, member.name));
  });
  return result;
}

template <class T> py::object RecordCodec<T>::to(const T& value) {
  auto record = bare_record(Description<T>::name);
  for_each_member<T>([&]<class Value>(const Member<T, Value>& member) {
    put(record, member.name, Codec<Value>::to(value.*member.place));
  });
  return record;
}

template <class T> std::string RecordCodec<T>::type() {
  return std::string(Description<T>::name);
}

template <class T> RecordEntry record_entry() {
  if constexpr (std::is_aggregate_v<T>)
    static_assert(std::tuple_size_v<decltype(Description<T>::members)> + hidden_count<T>() ==
                      member_count<T>(),
                  "Python has every member of the struct");
  RecordEntry entry{Description<T>::name, Description<T>::meaning, {}, [] {
                      py::list values;
                      const T value;
                      for_each_member<T>([&]<class Value>(const Member<T, Value>& member) {
                        values.append(Codec<Value>::to(value.*member.place));
                      });
                      return py::tuple(values);
                    }};
  for_each_member<T>([&]<class Value>(const Member<T, Value>& member) {
    entry.members.push_back({member.name, Codec<Value>::type(), member.meaning, Codec<Value>::tidy});
  });
  return entry;
}

} // namespace rubato::python
