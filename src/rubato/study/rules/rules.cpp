// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/study/rules/rules.hpp"

#include "rubato/core/error.hpp"
#include "rubato/core/expression.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace rubato::study {

void Rules::broken(std::vector<std::string> paths, std::string text) {
  judgement_.broken.push_back({std::move(paths), std::move(text)});
}

void Rules::note_bounds(const std::string& path, const Range& range) {
  if (auto text = bounds_text(range); !text.empty())
    judgement_.bounds[path] = std::move(text);
}

void Rules::number(const std::string& path, double value, const Range& range, std::string_view reason) {
  note_bounds(path, range);
  if (!range.contains(value))
    broken({path}, fmt::format("found '{}', expected a number{}{}{}", value, bounds_text(range),
                               reason.empty() ? "" : ": ", reason));
}

void Rules::whole_number(const std::string& path, int value, const Range& range) {
  note_bounds(path, range);
  if (!range.contains(value))
    broken({path}, fmt::format("found '{}', expected a whole number{}", value, bounds_text(range)));
}

void Rules::numbers(const std::string& path, std::span<const double> values) {
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!Range{}.contains(values[i]))
      number(fmt::format("{}.{}", path, i), values[i]);
}

void Rules::ascending(const std::string& path, std::span<const double> values) {
  numbers(path, values);
  const auto pair = std::ranges::adjacent_find(values, [](double a, double b) { return a >= b; });
  if (pair == values.end())
    return;
  const auto index = static_cast<std::size_t>(pair - values.begin()) + 1;
  broken({fmt::format("{}.{}", path, index), path},
         fmt::format("found {} after {}, expected numbers that ascend", values[index], *pair));
}

void Rules::instant(const std::string& path, double instant) {
  if (has_time() && !(instant >= study.time.begin && instant <= study.time.end))
    broken({path, "time.begin", "time.end", "time.instants"},
           fmt::format("found {}, expected an instant of the run, {} to {}", instant, study.time.begin,
                       study.time.end));
}

void Rules::name(const std::string& path, const std::string& name) {
  if (name.empty())
    broken({path}, "found no name, expected one");
}

void Rules::names(const std::string& path, std::span<const std::string> names) {
  std::set<std::string> known;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto at = fmt::format("{}.{}", path, i);
    name(at, names[i]);
    if (!names[i].empty() && !known.insert(names[i]).second)
      broken({at}, fmt::format("found {} a second time", shown(names[i])));
  }
}

void Rules::chosen_name(const std::string& path, const std::string& name,
                        std::span<const std::string> before) {
  if (!is_name(name))
    broken({path},
           fmt::format("found the name {}, expected up to 100 letters, digits, '_' or '-'", shown(name)));
  else if (std::ranges::find(before, name) != before.end())
    broken({path}, fmt::format("found a second entry named {}", shown(name)));
}

void Rules::function(const std::string& path, const std::string& name) {
  if (name.empty() || study.functions.contains(name))
    return;
  std::vector<std::string> known;
  for (const auto& entry : study.functions)
    known.push_back(entry.first);
  broken({path, "functions"},
         fmt::format("no function is called {}{}", shown(name), suggestion(name, known)));
}

void Rules::field_value(const std::string& path, const FieldValue& value) {
  if (const auto* number_given = value.number())
    return number(path, *number_given);
  if (const auto* profile = value.profile()) {
    axis(path + ".along", profile->axis);
    return table(profile->table, path, "at");
  }
  if (const auto* of_file = value.of_file())
    return file_field(path, *of_file);
  if (const auto* of_program = value.of_program())
    return given_field(path, *of_program);
  const auto& text = value.formula()->text;
  try {
    if (Expression(text).has('z') && dimension_of(study.physics) < 3)
      broken({path, "physics"}, fmt::format("found z in {}, {} has x and y only", shown(text),
                                            word_of(physics_words, study.physics)));
  } catch (const InputError& error) {
    broken({path}, study.functions.contains(text)
                       ? fmt::format("found {}, a function of time, expected {{value: 1, function: {}}}",
                                     shown(text), text)
                       : error.faults().front().text);
  }
}

void Rules::file_field(const std::string& path, const FileField& field) {
  name(path + ".field", field.file);
  name(path + ".name", field.name);
  if (field.at)
    number(path + ".at", *field.at);
}

void Rules::given_field(const std::string& path, const GivenField& field) {
  name(path + ".given", field.name);
  if (!field.values)
    broken({path}, fmt::format("the field {} has no values, expected those that a program gives it",
                               shown(field.name)));
}

void Rules::field(const std::string& path, const Field& field) {
  if (field.given != Given::displacement)
    broken({path},
           fmt::format("found '{}', expected 'value': only supports and the base take their motion by it",
                       word_of(given_words, field.given)));
  motion(path, field);
}

void Rules::motion(const std::string& path, const Field& field) {
  const bool in_map = !field.function.empty() || field.given != Given::displacement;
  const auto value = path + "." + std::string(word_of(given_words, field.given));
  field_value(in_map ? value : path, field.value);
  function(path + ".function", field.function);
}

void Rules::axis(const std::string& path, std::size_t axis) {
  if (axis >= static_cast<std::size_t>(dimension_of(study.physics)))
    broken({path, "physics"}, fmt::format("{} has no {}, expected x or y",
                                          word_of(physics_words, study.physics), axis_words.at(axis)));
}

} // namespace rubato::study
