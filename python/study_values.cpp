// SPDX-License-Identifier: LGPL-3.0-or-later
// Values that change with place and time.
#include "rubato/core/error.hpp"

#include <fmt/format.h>

#include "record.hpp"
#include <variant>

namespace rubato::python {

using namespace study;

namespace {

/// Whether Python takes it for a number.
bool is_number(py::handle value) {
  return PyBool_Check(value.ptr()) == 0 &&
         (PyFloat_Check(value.ptr()) != 0 || PyIndex_Check(value.ptr()) != 0 ||
          (PyUnicode_Check(value.ptr()) == 0 && py::hasattr(value, "__float__")));
}
bool is_text(py::handle value) {
  return PyUnicode_Check(value.ptr()) != 0;
}

py::object formula_of(py::handle text) {
  return Codec<Formula>::to({text.cast<std::string>()});
}

} // namespace

template <> struct Description<Formula> {
  static constexpr std::string_view name = "Formula";
  static constexpr std::string_view meaning = "An expression of x, y, z, the undeformed place, and t, the "
                                              "instant, as decks have them. A text stands for "
                                              "one.";
  static constexpr auto members = std::tuple(Member{"text", &Formula::text, "\"1e-4*(x-0.5)^2\""});
  static py::object other(py::handle value, const Path&) {
    return is_text(value) ? formula_of(value) : py::object();
  }
};
template struct RecordCodec<Formula>;

template <> struct Description<LinearTable> {
  static constexpr std::string_view name = "LinearTable";
  static constexpr std::string_view meaning =
      "Numbers at some places of a line, in between by straight lines; of a function of time the places are "
      "instants. A pair of lists stands for one: ([0, 1], [0, 5]).";
  static constexpr auto members = std::tuple(
      Member{"at", &LinearTable::at, "abscissae, ascending; of one that stands twice the later value counts"},
      Member{"values", &LinearTable::values, "one for each"},
      Member{"outside", &LinearTable::outside, "keeps the end values, goes on linearly, or is 0"});
  static py::object other(py::handle value, const Path& path) {
    if (!py::isinstance<py::tuple>(value) && !py::isinstance<py::list>(value))
      return {};
    const auto pair = items_of(value, path);
    if (pair.size() != 2)
      return {};
    return Codec<LinearTable>::to({Codec<std::vector<double>>::from(pair[0], step_into(path, "at")),
                                   Codec<std::vector<double>>::from(pair[1], step_into(path, "values"))});
  }
};
template struct RecordCodec<LinearTable>;

template <> struct Description<Profile> {
  static constexpr std::string_view name = "Profile";
  static constexpr std::string_view meaning = "A table along an axis.";
  static constexpr auto members =
      std::tuple(Member{"axis", &Profile::axis, "of the coordinates"},
                 Member{"table", &Profile::table, "of undeformed coordinates [length]"});
};
template struct RecordCodec<Profile>;

template <> struct Description<FileField> {
  static constexpr std::string_view name = "FileField";
  static constexpr std::size_t hidden = 1; // what the model has read
  static constexpr std::string_view meaning = "A field at the nodes of a file (.med, .rmed, .vtu, .pvd) with "
                                              "the mesh of the study; between nodes it has "
                                              "the shape functions of the study's cells.";
  static constexpr auto members =
      std::tuple(Member{"file", &FileField::file, "from the current folder"},
                 Member{"name", &FileField::name, "of the field"},
                 Member{"component", &FileField::component, "empty: the field is a scalar"},
                 Member{"at", &FileField::at, "instant [time]; None: it runs through those of the file"});
};
template struct RecordCodec<FileField>;

template <> struct Description<Amplitude> {
  static constexpr std::string_view name = "Amplitude";
  static constexpr std::string_view meaning = "A number times a function of time. A number stands for one.";
  static constexpr auto members =
      std::tuple(Member{"value", &Amplitude::value, "number"},
                 Member{"function", &Amplitude::function, "name of a function of the study; empty: 1"});
  static py::object other(py::handle value, const Path& path) {
    return is_number(value) ? Codec<Amplitude>::to({Codec<double>::from(value, path), ""}) : py::object();
  }
};
template struct RecordCodec<Amplitude>;

template <> struct Description<Field> {
  static constexpr std::string_view name = "Field";
  static constexpr std::string_view meaning =
      "A number, an expression, a table along an axis, a field of a file or of a function, times a function "
      "of "
      "time. What stands for the value stands for the field, too: 1.5, \"2*x\".";
  static constexpr auto members = std::tuple(
      Member{"value", &Field::value, "float, text or Formula, Profile, FileField or GivenField"},
      Member{"function", &Field::function, "name of a function of the study; empty: 1"},
      Member{"given", &Field::given, "of supports and of the base: what of the motion the value is"});
  static py::object other(py::handle value, const Path& path) {
    auto field = Codec<Field>::to({});
    put(field, "value", Codec<FieldValue>::tidy(value, path));
    return field;
  }
};
template struct RecordCodec<Field>;

template <> struct Description<Ramp> {
  static constexpr std::string_view name = "Ramp";
  static constexpr std::string_view meaning =
      "A straight line between two instants, constant before and after.";
  static constexpr auto members =
      std::tuple(Member{"begin", &Ramp::begin, "instant [time]"},
                 Member{"end", &Ramp::end, "instant, after begin [time]"},
                 Member{"from_", &Ramp::from, "value before"}, Member{"to", &Ramp::to, "value after"});
};
template struct RecordCodec<Ramp>;

template <> struct Description<Sine> {
  static constexpr std::string_view name = "Sine";
  static constexpr std::string_view meaning = "mean + amplitude sin(2 pi frequency t + phase).";
  static constexpr auto members = std::tuple(
      Member{"amplitude", &Sine::amplitude, "factor"}, Member{"frequency", &Sine::frequency, "> 0 [1/time]"},
      Member{"phase", &Sine::phase, "[degrees]"}, Member{"mean", &Sine::mean, "added"});
};
template struct RecordCodec<Sine>;

template <> struct Description<Product> {
  static constexpr std::string_view name = "Product";
  static constexpr std::string_view meaning = "A product of functions of time.";
  static constexpr auto members = std::tuple(Member{"factors", &Product::factors, "at least one"});
};
template struct RecordCodec<Product>;

py::object Codec<FieldValue>::tidy(py::handle value, const Path& path) {
  if (is_number(value))
    return Codec<double>::tidy(value, path);
  if (is_text(value))
    return formula_of(value);
  if (is_record(value, "Formula") || is_record(value, "Profile") || is_record(value, "FileField") ||
      py::isinstance<GivenField>(value))
    return py::reinterpret_borrow<py::object>(value);
  refuse(path, value, "a number, an expression, Profile, FileField or GivenField");
}

FieldValue Codec<FieldValue>::from(py::handle value, const Path& path) {
  const auto tidied = tidy(value, path);
  if (py::isinstance<py::float_>(tidied))
    return Codec<double>::from(tidied, path);
  if (py::isinstance<GivenField>(tidied))
    return Codec<GivenField>::from(tidied, path);
  if (is_record(tidied, "Formula"))
    return Codec<Formula>::from(tidied, path);
  if (is_record(tidied, "Profile"))
    return Codec<Profile>::from(tidied, path);
  return Codec<FileField>::from(tidied, path);
}

py::object Codec<FieldValue>::to(const FieldValue& value) {
  return std::visit([]<class Value>(const Value& is) { return Codec<Value>::to(is); }, value.is);
}

py::object Codec<Function>::tidy(py::handle value, const Path& path) {
  if (is_text(value))
    return formula_of(value);
  for (const auto* name : {"LinearTable", "Ramp", "Sine", "Product", "Formula"})
    if (is_record(value, name))
      return py::reinterpret_borrow<py::object>(value);
  if (auto table = Description<LinearTable>::other(value, path))
    return table;
  refuse(path, value, "LinearTable, a pair of lists, Ramp, Sine, Product or an expression of t");
}

Function Codec<Function>::from(py::handle value, const Path& path) {
  const auto tidied = tidy(value, path);
  if (is_record(tidied, "LinearTable"))
    return Function(Codec<LinearTable>::from(tidied, path));
  if (is_record(tidied, "Ramp"))
    return Function(Codec<Ramp>::from(tidied, path));
  if (is_record(tidied, "Sine"))
    return Function(Codec<Sine>::from(tidied, path));
  if (is_record(tidied, "Product"))
    return Function(Codec<Product>::from(tidied, path));
  try {
    return Function(Expression(Codec<Formula>::from(tidied, path).text));
  } catch (const InputError& error) {
    throw InputError({fault_at(path, fmt::format("{}: {}", path, error.faults().front().text))});
  }
}

namespace {

template <class Kind> py::object shown_kind(const Kind& kind) {
  return Codec<Kind>::to(kind);
}
py::object shown_kind(const Expression& expression) {
  return Codec<Formula>::to({expression.text()});
}
/// Models have it, no study does.
py::object shown_kind(const Integral&) {
  throw py::type_error("an integral of a function cannot be shown");
}

} // namespace

py::object Codec<Function>::to(const Function& value) {
  return std::visit([](const auto& kind) { return shown_kind(kind); }, value.is);
}

std::vector<RecordEntry> value_records() {
  return {record_entry<Formula>(),   record_entry<LinearTable>(), record_entry<Profile>(),
          record_entry<FileField>(), record_entry<Amplitude>(),   record_entry<Field>(),
          record_entry<Ramp>(),      record_entry<Sine>(),        record_entry<Product>()};
}

} // namespace rubato::python
