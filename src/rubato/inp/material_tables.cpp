// SPDX-License-Identifier: LGPL-3.0-or-later
// Numbers of materials that depend on the temperature.
#include "rubato/inp/reading.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace rubato::inp {
namespace {

using mesh::inp::field;

constexpr std::size_t numbers_of_a_line = 8;

/// Position of a temperature in a table: the entry below it and the part of the way to the next one.
struct Position {
  std::size_t below = 0;
  double part = 0;
};

Position position_of(std::span<const double> temperatures, double temperature) {
  if (temperatures.size() < 2 || temperature <= temperatures.front())
    return {};
  if (temperature >= temperatures.back())
    return {temperatures.size() - 2, 1};
  const auto above = std::ranges::upper_bound(temperatures, temperature);
  const auto below = static_cast<std::size_t>(above - temperatures.begin()) - 1;
  return {below, (temperature - temperatures[below]) / (temperatures[below + 1] - temperatures[below])};
}

double between(double a, double b, double part) {
  return part == 0 ? a : part == 1 ? b : a + part * (b - a);
}

/// Stress at a plastic strain, constant beyond the ends.
double stress_at(const StressCurve& curve, double strain) {
  if (strain <= curve.front()[0])
    return curve.front()[1];
  for (std::size_t i = 1; i < curve.size(); ++i)
    if (strain <= curve[i][0])
      return between(curve[i - 1][1], curve[i][1],
                     (strain - curve[i - 1][0]) / (curve[i][0] - curve[i - 1][0]));
  return curve.back()[1];
}

bool has_equal_rows(const HeatTable& table) {
  return std::ranges::all_of(table.numbers, [&](const auto& row) { return row == table.numbers.front(); });
}

bool spans(std::span<const double> temperatures, double lowest, double highest) {
  return lowest < highest && temperatures.size() > 1 && highest > temperatures.front() &&
         lowest < temperatures.back();
}

} // namespace

HeatTable heat_table(Reading& reading, const Block& block, std::size_t least, std::size_t count,
                     std::string_view expected) {
  HeatTable table;
  const std::size_t lines_of_a_set = count / numbers_of_a_line + 1; // a temperature comes behind
  std::vector<Word> words;
  std::size_t lines = 0;
  const auto add = [&] {
    std::vector<double> numbers;
    for (const auto& word : words) {
      const auto number = mesh::inp::require_number(word, expected, reading.faults, 0);
      if (!number)
        return false;
      numbers.push_back(*number);
    }
    if (numbers.size() < least || numbers.size() > count + 1) {
      reading.faults.add(words.empty() ? block.at : words.front(),
                         fmt::format("found {} numbers of {}, expected {}, and perhaps a temperature",
                                     numbers.size(), block.at.text, expected));
      return false;
    }
    const double temperature = numbers.size() > count ? numbers.back() : 0;
    numbers.resize(count);
    if (!table.temperatures.empty() && temperature <= table.temperatures.back()) {
      reading.faults.add(words.front(),
                         fmt::format("found numbers for the temperature {} after those for {}, "
                                     "expected temperatures that ascend",
                                     temperature, table.temperatures.back()));
      return false;
    }
    table.temperatures.push_back(temperature);
    table.numbers.push_back(std::move(numbers));
    words.clear();
    lines = 0;
    return true;
  };
  for (const auto& line : block.lines) {
    if (mesh::inp::is_blank(line))
      continue;
    const auto fields = mesh::inp::fields_of(line);
    words.insert(words.end(), fields.begin(), fields.end());
    if (++lines == lines_of_a_set && !add())
      return {};
  }
  if ((!words.empty() || table.numbers.empty()) && !add())
    return {};
  return table;
}

HeatCurves heat_curves(Reading& reading, const Block& block) {
  HeatCurves curves;
  for (const auto& line : block.lines) {
    const auto fields = mesh::inp::fields_of(line);
    if (fields.empty())
      continue;
    constexpr std::size_t most = 3;
    const auto stress = mesh::inp::require_number(fields[0], "a stress", reading.faults);
    const auto strain =
        mesh::inp::require_number(field(fields, 1, Word{}), "a plastic strain", reading.faults, 0);
    const auto temperature =
        mesh::inp::require_number(field(fields, 2, Word{}), "a temperature", reading.faults, 0);
    if (!stress || !strain || !temperature)
      return {};
    if (fields.size() > most) {
      reading.faults.add(fields[most], "found a fourth number of a line, expected stress, plastic strain and "
                                       "temperature");
      return {};
    }
    const bool begins = curves.temperatures.empty() || *temperature != curves.temperatures.back();
    if (begins && !curves.temperatures.empty() && *temperature < curves.temperatures.back()) {
      reading.faults.add(fields[2], fmt::format("found the temperature {} after {}, expected temperatures "
                                                "that ascend",
                                                *temperature, curves.temperatures.back()));
      return {};
    }
    if (begins) {
      curves.temperatures.push_back(*temperature);
      // Yielding begins at the first stress whatever its strain, as in CalculiX.
      curves.curves.emplace_back(StressCurve{{0, *stress}});
      if (*strain <= 0)
        continue;
    }
    auto& curve = curves.curves.back();
    if (*strain <= curve.back()[0]) {
      reading.faults.add(fields[1], fmt::format("found the plastic strain {} after {}, expected strains that "
                                                "ascend",
                                                *strain, curve.back()[0]));
      return {};
    }
    curve.push_back({*strain, *stress});
  }
  if (curves.curves.empty())
    reading.faults.add(block.at, fmt::format("found {} without a line, expected stresses and plastic strains",
                                             block.at.text));
  return curves;
}

std::vector<double> numbers_at(const HeatTable& table, double temperature) {
  const auto [below, part] = position_of(table.temperatures, temperature);
  auto numbers = table.numbers[below];
  if (part > 0)
    for (std::size_t i = 0; i < numbers.size(); ++i)
      numbers[i] = between(numbers[i], table.numbers[below + 1][i], part);
  return numbers;
}

StressCurve curve_at(const HeatCurves& curves, double temperature) {
  const auto [below, part] = position_of(curves.temperatures, temperature);
  const auto& first = curves.curves[below];
  if (part == 0)
    return first;
  const auto& second = curves.curves[below + 1];
  std::set<double> strains;
  for (const auto* curve : {&first, &second})
    for (const auto& point : *curve)
      strains.insert(point[0]);
  StressCurve curve;
  for (const double strain : strains)
    curve.push_back({strain, between(stress_at(first, strain), stress_at(second, strain), part)});
  return curve;
}

bool varies_between(const MaterialData& data, double lowest, double highest) {
  const auto differs = [&](const HeatTable& table) {
    return !has_equal_rows(table) && spans(table.temperatures, lowest, highest);
  };
  const auto curves_differ = [&](const HeatCurves& curves) {
    return spans(curves.temperatures, lowest, highest);
  };
  if ((data.law && differs(data.law->table)) || (data.density && differs(data.density->table)) ||
      (data.expansion && differs(data.expansion->table)))
    return true;
  if (!data.hardening)
    return false;
  const auto& hardening = *data.hardening;
  const bool softens = hardening.rule == HardeningRule::johnson_cook && highest > lowest &&
                       highest > hardening.parameters.numbers.front().back();
  return softens || curves_differ(hardening.curves) || curves_differ(hardening.cyclic) ||
         differs(hardening.parameters) || differs(hardening.cyclic_parameters);
}

} // namespace rubato::inp
