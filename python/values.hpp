// SPDX-License-Identifier: LGPL-3.0-or-later
/// Values of a study between C++ and Python. In Python a study is made of Python's own objects: numbers,
/// words, tuples, lists, dictionaries and records, classes that have the members of the C++ structs. So
/// nothing that Python holds is memory of a study that may move. C++ gets a copy when it is to work.
#pragma once

#include "rubato/study/study.hpp"

#include <array>
#include <map>
#include <optional>
#include <pybind11/pybind11.h>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace rubato::python {

namespace py = pybind11;

/// Where a value stands, for messages: "materials.0.young"; empty: nowhere.
using Path = std::string;

Path step_into(const Path& path, std::string_view name);

/// Throws TypeError: "materials.0.young: found 'abc' (str), expected a number".
[[noreturn]] void refuse(const Path& path, py::handle found, std::string_view expected);

/// A class of the records or words, by its name.
py::object class_named(std::string_view name);

/// How values of a type are read from Python, shown to it and called:
///   T from(handle, path)        throws TypeError, for words InputError
///   py::object to(const T&)
///   py::object tidy(handle, path)  what a record keeps of an assigned value: itself or its usual form
///   std::string type()          as annotations write it
/// The primary template is that of records; RecordCodec is defined in record.hpp.
template <class T> struct RecordCodec {
  static T from(py::handle value, const Path& path);
  static py::object to(const T& value);
  static py::object tidy(py::handle value, const Path& path);
  static std::string type();
};
template <class T> struct Codec : RecordCodec<T> {};

// Each in the source that describes the struct.
extern template struct RecordCodec<study::ArcLength>;
extern template struct RecordCodec<study::Amplitude>;
extern template struct RecordCodec<study::BackStress>;
extern template struct RecordCodec<study::BaseMotion>;
extern template struct RecordCodec<study::Body>;
extern template struct RecordCodec<study::Check>;
extern template struct RecordCodec<study::CheckedField>;
extern template struct RecordCodec<study::CheckedResultant>;
extern template struct RecordCodec<study::CheckpointOutput>;
extern template struct RecordCodec<study::Connector>;
extern template struct RecordCodec<study::ContactForce>;
extern template struct RecordCodec<study::ContactRule>;
extern template struct RecordCodec<study::ContactZone>;
extern template struct RecordCodec<study::Cut>;
extern template struct RecordCodec<study::CylindricalAxes>;
extern template struct RecordCodec<study::DampingRatios>;
extern template struct RecordCodec<study::Field>;
extern template struct RecordCodec<study::FieldOutput>;
extern template struct RecordCodec<study::FileField>;
extern template struct RecordCodec<study::Formula>;
extern template struct RecordCodec<study::Hyperelasticity>;
extern template struct RecordCodec<study::InitialMotion>;
extern template struct RecordCodec<study::Level>;
extern template struct RecordCodec<study::Load>;
extern template struct RecordCodec<study::MadeGroup>;
extern template struct RecordCodec<study::Material>;
extern template struct RecordCodec<study::MeshSource>;
extern template struct RecordCodec<study::ModalDamping>;
extern template struct RecordCodec<study::NewtonSettings>;
extern template struct RecordCodec<study::ObliqueSupport>;
extern template struct RecordCodec<study::Obstacle>;
extern template struct RecordCodec<study::OgdenTerm>;
extern template struct RecordCodec<study::Orthotropy>;
extern template struct RecordCodec<study::Plasticity>;
extern template struct RecordCodec<study::PointMasses>;
extern template struct RecordCodec<study::Preload>;
extern template struct RecordCodec<study::PrintedTable>;
extern template struct RecordCodec<study::Probe>;
extern template struct RecordCodec<study::PronyTerm>;
extern template struct RecordCodec<study::Relation>;
extern template struct RecordCodec<study::RelationTerm>;
extern template struct RecordCodec<study::Rotation>;
extern template struct RecordCodec<study::Springs>;
extern template struct RecordCodec<study::Study>;
extern template struct RecordCodec<study::Support>;
extern template struct RecordCodec<study::Temperature>;
extern template struct RecordCodec<study::ThermalExpansion>;
extern template struct RecordCodec<study::TimeStepping>;
extern template struct RecordCodec<LinearTable>;
extern template struct RecordCodec<Product>;
extern template struct RecordCodec<Profile>;
extern template struct RecordCodec<Ramp>;
extern template struct RecordCodec<Sine>;

/// What is read as a number, a text …, and shown again, is tidy.
template <class T> struct PlainCodec {
  static py::object tidy(py::handle value, const Path& path) {
    return Codec<T>::to(Codec<T>::from(value, path));
  }
};

template <> struct Codec<double> : PlainCodec<double> {
  static double from(py::handle value, const Path& path);
  static py::object to(double value) { return py::float_(value); }
  static std::string type() { return "float"; }
};

template <> struct Codec<int> : PlainCodec<int> {
  static int from(py::handle value, const Path& path);
  static py::object to(int value) { return py::int_(value); }
  static std::string type() { return "int"; }
};

template <> struct Codec<bool> : PlainCodec<bool> {
  static bool from(py::handle value, const Path& path);
  static py::object to(bool value) { return py::bool_(value); }
  static std::string type() { return "bool"; }
};

/// Also of a path of the file system.
template <> struct Codec<std::string> : PlainCodec<std::string> {
  static std::string from(py::handle value, const Path& path);
  static py::object to(const std::string& value) { return py::str(value); }
  static std::string type() { return "str"; }
};

/// The words of an enumeration, and what Python's class of them is called.
struct WordList {
  std::string_view class_name;
  std::string_view meaning;
  std::vector<std::string> words; ///< in the order of the enumerators
};

/// Of every enumeration: defined in words.cpp.
template <class E> const WordList& words_of();
std::vector<const WordList*> all_words();

/// The place of a word in its list. Throws InputError with the nearest one, TypeError for what is no text.
std::size_t place_of_word(const WordList& list, py::handle value, const Path& path);
py::object shown_word(const WordList& list, std::size_t place);

template <class E>
requires std::is_enum_v<E>
struct Codec<E> : PlainCodec<E> {
  static E from(py::handle value, const Path& path) {
    return static_cast<E>(place_of_word(words_of<E>(), value, path));
  }
  static py::object to(E value) { return shown_word(words_of<E>(), static_cast<std::size_t>(value)); }
  static std::string type() { return std::string(words_of<E>().class_name); }
};

/// Of a table along it.
enum class Axis { x, y, z };
template <> struct Codec<std::size_t> : PlainCodec<std::size_t> {
  static std::size_t from(py::handle value, const Path& path) {
    return static_cast<std::size_t>(Codec<Axis>::from(value, path));
  }
  static py::object to(std::size_t value) { return Codec<Axis>::to(static_cast<Axis>(value)); }
  static std::string type() { return Codec<Axis>::type(); }
};

template <class T> struct Codec<std::optional<T>> {
  static std::optional<T> from(py::handle value, const Path& path) {
    return value.is_none() ? std::optional<T>() : Codec<T>::from(value, path);
  }
  static py::object to(const std::optional<T>& value) {
    return value ? Codec<T>::to(*value) : py::object(py::none());
  }
  static py::object tidy(py::handle value, const Path& path) {
    return value.is_none() ? py::object(py::none()) : Codec<T>::tidy(value, path);
  }
  static std::string type() { return Codec<T>::type() + " | None"; }
};

/// The items of a list, a tuple or an array. Throws TypeError for anything else, texts too.
py::tuple items_of(py::handle value, const Path& path);

template <class T> struct Codec<std::vector<T>> {
  static std::vector<T> from(py::handle value, const Path& path) {
    const auto items = items_of(value, path);
    std::vector<T> result;
    result.reserve(items.size());
    for (std::size_t i = 0; i < items.size(); ++i)
      result.push_back(Codec<T>::from(items[i], step_into(path, std::to_string(i))));
    return result;
  }
  static py::object to(const std::vector<T>& values) {
    py::list result;
    for (const auto& value : values)
      result.append(Codec<T>::to(value));
    return result;
  }
  static py::object tidy(py::handle value, const Path& path) {
    const auto items = items_of(value, path);
    py::list result;
    for (std::size_t i = 0; i < items.size(); ++i)
      result.append(Codec<T>::tidy(items[i], step_into(path, std::to_string(i))));
    return result;
  }
  static std::string type() { return "list[" + Codec<T>::type() + "]"; }
};

/// As many items as the array has; in the plane the third may be missing.
py::tuple items_of_array(py::handle value, std::size_t size, const Path& path);

template <class T, std::size_t N> struct Codec<std::array<T, N>> {
  static std::array<T, N> from(py::handle value, const Path& path) {
    const auto items = items_of_array(value, N, path);
    std::array<T, N> result{};
    for (std::size_t i = 0; i < items.size(); ++i)
      result[i] = Codec<T>::from(items[i], step_into(path, std::to_string(i)));
    return result;
  }
  static py::object to(const std::array<T, N>& values) {
    py::tuple result(N);
    for (std::size_t i = 0; i < N; ++i)
      result[i] = Codec<T>::to(values[i]);
    return result;
  }
  static py::object tidy(py::handle value, const Path& path) {
    const auto items = items_of_array(value, N, path);
    py::tuple result(N);
    for (std::size_t i = 0; i < N; ++i)
      result[i] =
          i < items.size() ? Codec<T>::tidy(items[i], step_into(path, std::to_string(i))) : Codec<T>::to(T{});
    return result;
  }
  static std::string type() {
    std::string items = Codec<T>::type();
    for (std::size_t i = 1; i < N; ++i)
      items += ", " + Codec<T>::type();
    return "tuple[" + items + "]";
  }
};

/// A dictionary from texts. Throws TypeError for anything else.
py::dict entries_of(py::handle value, const Path& path);

template <class T> struct Codec<std::map<std::string, T>> {
  static std::map<std::string, T> from(py::handle value, const Path& path) {
    std::map<std::string, T> result;
    for (const auto& [key, item] : entries_of(value, path)) {
      const auto name = Codec<std::string>::from(key, path);
      result.emplace(name, Codec<T>::from(item, step_into(path, name)));
    }
    return result;
  }
  static py::object to(const std::map<std::string, T>& values) {
    py::dict result;
    for (const auto& [name, value] : values)
      result[py::str(name)] = Codec<T>::to(value);
    return result;
  }
  static py::object tidy(py::handle value, const Path& path) {
    py::dict result;
    for (const auto& [key, item] : entries_of(value, path)) {
      const auto name = Codec<std::string>::from(key, path);
      result[py::str(name)] = Codec<T>::tidy(item, step_into(path, name));
    }
    return result;
  }
  static std::string type() { return "dict[str, " + Codec<T>::type() + "]"; }
};

/// A number, an expression (also as text), a table along an axis, a field of a file or of a function.
template <> struct Codec<study::FieldValue> {
  static study::FieldValue from(py::handle value, const Path& path);
  static py::object to(const study::FieldValue& value);
  static py::object tidy(py::handle value, const Path& path);
  static std::string type() { return "FieldValue"; }
};

/// A table, also as a pair of lists, a ramp, a sine, a product, an expression of t, also as text.
template <> struct Codec<Function> {
  static Function from(py::handle value, const Path& path);
  static py::object to(const Function& value);
  static py::object tidy(py::handle value, const Path& path);
  static std::string type() { return "Function"; }
};

/// The field of a function of the program, which pybind11 has as a class.
template <> struct Codec<study::GivenField> {
  static study::GivenField from(py::handle value, const Path& path);
  static py::object to(const study::GivenField& value);
  static py::object tidy(py::handle value, const Path& path);
  static std::string type() { return "GivenField"; }
};

} // namespace rubato::python
