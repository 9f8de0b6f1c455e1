// SPDX-License-Identifier: LGPL-3.0-or-later
// Functions of time, and values that vary in place or in time.
#include "rubato/core/naming.hpp"
#include "rubato/deck/csv_table.hpp"
#include "rubato/deck/parts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>
#include <utility>

namespace rubato::deck {
namespace {

/// Keys that say what a function is; without one of them it is a table of `times` and `values`.
constexpr std::array<std::string_view, 5> simple_kinds{"times", "csv", "ramp", "sine", "expression"};

/// Where the deck names a file: beside itself; in a setting: from the current folder.
std::filesystem::path path_of_file(const Value& value, const std::string& name, const Context& context) {
  return value.tree().from_setting ? std::filesystem::path(name) : context.folder / name;
}

/// The columns of the file that `csv` names; what is wrong with the file is told there.
bool read_csv(const Value& csv, const Context& context, const std::string& at, const std::string& values,
              LinearTable& table) {
  std::string name;
  if (!read_name(csv, name))
    return false;
  try {
    const auto outside = table.outside;
    table = read_csv_table(path_of_file(csv, name, context), at, values);
    table.outside = outside;
    return true;
  } catch (const InputError& error) {
    const auto& fault = error.faults().front();
    csv.fault(fault.text, fault.at.line > 0 ? fault.at : csv.at());
    return false;
  }
}

bool read_csv_function(MapReader& map, const Value& csv, const Context& context, LinearTable& table) {
  std::string time;
  std::string value;
  read_name(map.find("time"), time);
  read(map.find("outside"), table.outside, study::outside_words);
  return read_name(map.require("value"), value) && read_csv(csv, context, time, value, table);
}

bool read_ramp(const Value& value, Ramp& ramp) {
  if (value.tree().is(Tree::Kind::list)) {
    std::vector<double> instants;
    if (!read(value, instants))
      return false;
    if (instants.size() != 2) {
      value.fault(fmt::format("found {} numbers, expected the two instants of a ramp", instants.size()));
      return false;
    }
    ramp.begin = instants[0];
    ramp.end = instants[1];
    return true;
  }
  MapReader map(value);
  read(map.find("begin"), ramp.begin);
  const bool good = read(map.require("end"), ramp.end);
  read(map.find("from"), ramp.from);
  read(map.find("to"), ramp.to);
  map.finish();
  return good;
}

bool read_sine(const Value& value, Sine& sine) {
  MapReader map(value);
  const bool good = read(map.require("frequency"), sine.frequency);
  read(map.find("amplitude"), sine.amplitude);
  read(map.find("phase"), sine.phase);
  read(map.find("mean"), sine.mean);
  map.finish();
  return good;
}

bool read_expression(const Value& value, Function& function) {
  std::string text;
  if (!read(value, text))
    return false;
  try {
    function = Function(Expression(text));
    return true;
  } catch (const InputError& error) {
    value.fault(error.faults().front().text);
    return false;
  }
}

template <class Kind, class Read> bool read_as(const Value& value, Read read, Function& function) {
  Kind kind;
  const bool good = read(value, kind);
  function = Function(kind);
  return good;
}

/// Keys of a table have no meaning beside another kind.
void refuse_of_tables(MapReader& map, std::string_view kind) {
  const auto refuse = [&](std::string_view key, std::string_view takers) {
    map.refuse(key, fmt::format("'{}' takes no '{}', {} does", kind, key, takers));
  };
  if (kind != "times")
    refuse("values", "a table of times");
  if (kind != "csv")
    for (const auto* key : {"time", "value"})
      refuse(key, "csv");
  if (kind != "times" && kind != "csv")
    refuse("outside", "a table");
}

void read_table(MapReader& map, LinearTable& table) {
  read(map.require("times"), table.at);
  read(map.require("values"), table.values);
  read(map.find("outside"), table.outside, study::outside_words);
}

/// What says which kind it is; `given` has what was found before. Empty: a table.
std::vector<std::string> kinds_given(MapReader& map, std::vector<std::string> given) {
  for (const auto kind : simple_kinds)
    if (map.find(kind))
      given.emplace_back(kind);
  return given;
}

bool read_kind(MapReader& map, std::string_view kind, const Context& context, Function& function) {
  if (kind == "times") {
    LinearTable table;
    read_table(map, table);
    function = Function(std::move(table));
    return true;
  }
  const auto value = *map.find(kind);
  if (kind == "csv") {
    LinearTable table;
    const bool good = read_csv_function(map, value, context, table);
    function = Function(std::move(table));
    return good;
  }
  if (kind == "ramp")
    return read_as<Ramp>(value, read_ramp, function);
  if (kind == "sine")
    return read_as<Sine>(value, read_sine, function);
  return read_expression(value, function);
}

void pass_keys(MapReader& map) {
  for (const auto* key : {"values", "outside", "time", "value"})
    map.find(key);
  map.value().spoil();
}

/// Whether it has a key that no function has: that is told, rather than what is missing then.
bool has_unknown_key(const Tree& tree) {
  return std::ranges::any_of(tree.entries, [](const Tree::Entry& entry) {
    constexpr std::array<std::string_view, 5> others{"values", "outside", "time", "value", "product"};
    return std::ranges::find(simple_kinds, entry.key) == simple_kinds.end() &&
           std::ranges::find(others, entry.key) == others.end();
  });
}

/// A function that is no product. One that could not be read is spoiled.
Function read_simple(MapReader& map, const std::vector<std::string>& given, const Context& context) {
  Function function;
  if (given.size() > 1) {
    pass_keys(map);
    map.value().fault(fmt::format("found {} together, expected one of them", fmt::join(given, " and ")));
    return function;
  }
  if (given.empty() && has_unknown_key(map.value().tree())) {
    pass_keys(map);
    return function;
  }
  const auto kind = given.empty() ? std::string("times") : given.front();
  refuse_of_tables(map, kind);
  if (!read_kind(map, kind, context, function))
    map.value().spoil();
  return function;
}

class FunctionsReader {
public:
  FunctionsReader(const Context& context, std::map<std::string, Function>& functions)
      : context_(context), functions_(functions) {}

  void read(const Found& value) {
    for (const auto& [name, function] : named_entries(value))
      read_entry(name.text, function);
    for (const auto& entry : products_)
      if (!functions_.contains(entry.first))
        multiply(entry.first, entry.second);
  }

private:
  static constexpr std::size_t most_factors = 100;
  static constexpr std::size_t most_nested = 100;

  void read_entry(const std::string& name, const Value& value) {
    MapReader map(value);
    std::vector<std::string> given;
    const auto product = map.find("product");
    if (product)
      given.emplace_back("product");
    given = kinds_given(map, std::move(given));
    if (product && given.size() == 1) {
      refuse_of_tables(map, "product");
      products_.emplace(name, *product);
    } else {
      functions_[name] = read_simple(map, given, context_);
    }
    map.finish();
  }

  /// Factors that are products themselves give their factors.
  void multiply(const std::string& name, const Value& list) {
    open_.insert(name);
    Product product;
    for (const auto& item : items(list)) {
      const auto factor = factor_of(item);
      if (!factor) {
        list.spoil();
        continue;
      }
      if (const auto* inner = std::get_if<Product>(&factor->is))
        product.factors.insert(product.factors.end(), inner->factors.begin(), inner->factors.end());
      else
        product.factors.push_back(*factor);
      if (product.factors.size() > most_factors) {
        list.fault(fmt::format("found more than {} factors", most_factors));
        break;
      }
    }
    open_.erase(name);
    functions_[name] = Function(std::move(product));
  }

  std::optional<Function> factor_of(const Value& item) {
    if (item.tree().is(Tree::Kind::map)) {
      MapReader map(item);
      auto function = read_simple(map, kinds_given(map, {}), context_);
      map.finish();
      return function;
    }
    std::string name;
    if (!read_name(item, name))
      return std::nullopt;
    if (open_.size() > most_nested) {
      item.fault(fmt::format("found more than {} products of products", most_nested));
      return std::nullopt;
    }
    if (open_.contains(name)) {
      item.fault(fmt::format("found {}, which is a product of itself", shown(name)));
      return std::nullopt;
    }
    if (const auto product = products_.find(name); product != products_.end() && !functions_.contains(name))
      multiply(name, product->second);
    if (const auto known = functions_.find(name); known != functions_.end())
      return known->second;
    item.fault(fmt::format("no function is called {}{}", shown(name), suggestion(name, names())));
    return std::nullopt;
  }

  std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const auto& entry : functions_)
      names.push_back(entry.first);
    for (const auto& entry : products_)
      names.push_back(entry.first);
    return names;
  }

  const Context& context_;
  std::map<std::string, Function>& functions_;
  std::map<std::string, Value> products_;
  std::set<std::string> open_; ///< products that are being made
};

bool read_axis(const Found& value, std::size_t& axis) {
  const auto choice = read_choice(value, {study::axis_words.begin(), study::axis_words.end()});
  if (choice)
    axis = *choice;
  return choice.has_value();
}

bool read_columns(MapReader& map, const Value& csv, const Context& context, LinearTable& table) {
  std::string coordinate;
  std::string column;
  read_name(map.find("coordinate"), coordinate);
  return read_name(map.require("column"), column) && read_csv(csv, context, coordinate, column, table);
}

bool read_profile(const Value& value, const Context& context, Profile& profile) {
  MapReader map(value);
  bool good = read_axis(map.require("along"), profile.axis);
  auto& table = profile.table;
  read(map.find("outside"), table.outside, study::outside_words);
  if (const auto csv = map.find("csv")) {
    for (const auto* key : {"at", "values"})
      map.refuse(key, "found beside 'csv', expected one of them");
    good = read_columns(map, *csv, context, table) && good;
  } else {
    for (const auto* key : {"coordinate", "column"})
      map.refuse(key, "only a table of a file has columns, expected 'csv' beside it");
    const bool has_places = read(map.require("at"), table.at);
    good = read(map.require("values"), table.values) && has_places && good;
  }
  map.finish();
  if (!good)
    value.spoil();
  return good;
}

bool is_given(const Tree& tree, std::string_view key) {
  const auto* given = tree.find(key);
  return given != nullptr && !given->is(Tree::Kind::removed);
}

/// What an echo has for the field of a program.
constexpr std::string_view given_key = "given";

/// Whether it is a table or a field, not a value beside a function of time.
bool is_field_value(const Tree& tree) {
  constexpr std::array<std::string_view, 6> keys{"along", "at", "csv", "column", "field", given_key};
  return tree.is(Tree::Kind::map) &&
         std::ranges::any_of(keys, [&](std::string_view key) { return is_given(tree, key); });
}

/// Nothing when it cannot be read.
std::optional<study::FileField> read_file_field(const Value& value, const Context& context) {
  MapReader map(value);
  study::FileField field;
  const auto file = map.require("field");
  bool good = read_name(file, field.file);
  if (good)
    field.file = path_of_file(*file, field.file, context).string();
  good = read_name(map.require("name"), field.name) && good;
  read_name(map.find("component"), field.component);
  read(map.find("at"), field.at);
  map.finish();
  if (good)
    return field;
  value.spoil();
  return std::nullopt;
}

} // namespace

void read_functions(const Found& value, const Context& context, std::map<std::string, Function>& functions) {
  FunctionsReader(context, functions).read(value);
}

study::Amplitude read_amplitude(const Value& value) {
  study::Amplitude amplitude;
  if (!value.tree().is(Tree::Kind::map)) {
    read(Found(value), amplitude.value);
    return amplitude;
  }
  MapReader map(value);
  read(map.require("value"), amplitude.value);
  read_name(map.find("function"), amplitude.function);
  map.finish();
  return amplitude;
}

bool read_field_value(const Found& value, const Context& context, study::FieldValue& target) {
  if (!value || !value->tree().is(Tree::Kind::map))
    return read(value, target);
  if (is_given(value->tree(), given_key)) {
    value->fault("found a field that a program gave to the study, expected a number, an expression, a table "
                 "or a field of a file: no deck has the function that computes it");
    value->spoil();
    return false;
  }
  if (is_given(value->tree(), "field")) {
    const auto field = read_file_field(*value, context);
    if (field)
      target = *field;
    return field.has_value();
  }
  Profile profile;
  const bool good = read_profile(*value, context, profile);
  if (good)
    target = std::move(profile);
  return good;
}

study::Field read_field(const Value& value, const Context& context) {
  study::Field field;
  if (!value.tree().is(Tree::Kind::map) || is_field_value(value.tree())) {
    read_field_value(value, context, field.value);
    return field;
  }
  MapReader map(value);
  read_field_value(map.require("value"), context, field.value);
  read_name(map.find("function"), field.function);
  map.finish();
  return field;
}

study::Field read_motion(const Value& value, const Context& context) {
  study::Field field;
  if (!value.tree().is(Tree::Kind::map) || is_field_value(value.tree())) {
    read_field_value(value, context, field.value);
    return field;
  }
  MapReader map(value);
  std::vector<std::string> given;
  for (const auto& word : study::given_words)
    if (const auto found = map.find(word.text)) {
      read_field_value(found, context, field.value);
      field.given = word.value;
      given.emplace_back(word.text);
    }
  read_name(map.find("function"), field.function);
  map.finish();
  if (given.size() > 1)
    value.fault(fmt::format("found {} together, expected one of them", fmt::join(given, " and ")));
  else if (given.empty() && map.is_map() && std::ranges::all_of(value.tree().entries, [](const auto& entry) {
             return entry.key == "function";
           }))
    value.miss("value"); // else an unknown key is told
  return field;
}

} // namespace rubato::deck
