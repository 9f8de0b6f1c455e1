// SPDX-License-Identifier: LGPL-3.0-or-later
// Functions of time as tables of the total time.
#include "rubato/ccx/draft.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace rubato::ccx {
namespace {

/// Parts of a step by which its length may differ from that of others.
constexpr double equal_steps = 1e-9;

/// The table where straight lines between its points are the function itself, and constant outside.
std::optional<LinearTable> exact_table(const Function& function) {
  if (const auto* ramp = std::get_if<Ramp>(&function.is))
    return LinearTable{{ramp->begin, ramp->end}, {ramp->from, ramp->to}, LinearTable::Outside::constant};
  const auto* table = function.table();
  if (table == nullptr || table->outside != LinearTable::Outside::constant ||
      std::ranges::adjacent_find(table->at, std::greater_equal<>()) != table->at.end())
    return std::nullopt;
  return *table;
}

/// The label of an amplitude with these points, the only one.
std::string amplitude_of(Run& run, const LinearTable& table, std::string_view name) {
  std::vector<std::string> numbers;
  for (std::size_t i = 0; i < table.at.size(); ++i) {
    numbers.push_back(shown_number(table.at[i] - run.draft.begin));
    numbers.push_back(shown_number(table.values[i]));
  }
  auto text = rows_of(numbers, 8);
  const auto [entry, is_new] = run.draft.amplitude_of_table.try_emplace(text);
  if (is_new) {
    entry->second = run.draft.labels.chosen("AMPLITUDE", name);
    run.draft.amplitudes += fmt::format("*AMPLITUDE, NAME={}, TIME=TOTAL TIME\n{}", entry->second, text);
  }
  return entry->second;
}

} // namespace

std::vector<double> instants_of(const study::TimeStepping& time) {
  std::vector<double> instants{time.begin};
  if (!time.instants.empty()) {
    instants.insert(instants.end(), time.instants.begin(), time.instants.end());
    return instants;
  }
  const double count = std::max(1.0, std::ceil((time.end - time.begin) / time.step - equal_steps));
  for (double i = 1; i < count; ++i)
    instants.push_back(time.begin + i * time.step);
  instants.push_back(time.end);
  return instants;
}

bool has_equal_steps(const study::TimeStepping& time) {
  const auto instants = instants_of(time);
  const double first = instants[1] - instants[0];
  for (std::size_t i = 1; i + 1 < instants.size(); ++i)
    if (std::abs(instants[i + 1] - instants[i] - first) >
        equal_steps * static_cast<double>(instants.size()) * first)
      return false;
  return true;
}

Course sampled_course(Run& run, const std::function<double(double)>& value_at, std::string_view name) {
  LinearTable table;
  table.at = instants_of(run.study().time);
  double largest = 0;
  for (const double t : table.at) {
    table.values.push_back(value_at(t));
    if (std::abs(table.values.back()) > std::abs(largest))
      largest = table.values.back();
  }
  const bool is_constant =
      std::ranges::all_of(table.values, [&](double value) { return value == table.values.front(); });
  if (is_constant)
    return {table.values.front(), {}};
  for (auto& value : table.values)
    value /= largest;
  return {largest, amplitude_of(run, table, name)};
}

Course course_of(Run& run, double value, const std::optional<Function>& function, std::string_view name) {
  if (!function || value == 0)
    return {value, {}};
  if (const auto table = exact_table(*function))
    return {value, amplitude_of(run, *table, name)};
  const auto sampled = sampled_course(
      run, [&](double t) { return rubato::value_at(*function, t); }, name);
  return {value * sampled.factor, sampled.amplitude};
}

} // namespace rubato::ccx
