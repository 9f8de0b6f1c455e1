// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/plot/plotted_run.hpp"

#include "rubato/core/error.hpp"
#include "rubato/core/expression.hpp"
#include "rubato/plot/ticks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace rubato::plot {
namespace {

struct Dimension {
  std::string_view quantity;
  std::string_view text;
};

constexpr std::array<Dimension, 33> dimensions{{
    {"displacement", "length"},
    {"velocity", "length/time"},
    {"acceleration", "length/time²"},
    {"reaction", "force"},
    {"stress", "force/length²"},
    {"von_mises", "force/length²"},
    {"tresca", "force/length²"},
    {"mean_stress", "force/length²"},
    {"principal_stress", "force/length²"},
    {"contact_pressure", "force/length²"},
    {"contact_gap", "length"},
    {"contact_slip", "length"},
    {"contact_cumulated_slip", "length"},
    {"contact_friction_work", "force·length"},
    {"energy", "force·length"},
    {"t", "time"},
    {"s", "length"},
    {"x", "length"},
    {"y", "length"},
    {"z", "length"},
    {"pressure", "force/length²"},
    {"traction.x", "force/length²"},
    {"traction.y", "force/length²"},
    {"traction.z", "force/length²"},
    {"gap", "length"},
    {"slip", "length"},
    {"friction_work", "force·length"},
    {"area", "length²"},
    {"force", "force"},
    {"normal", "force"},
    {"friction", "force"},
    {"largest_pressure", "force/length²"},
    {"smallest_gap", "length"},
}};

} // namespace

std::string_view dimension_of(std::string_view quantity) {
  const auto* const found = std::ranges::find(dimensions, quantity, &Dimension::quantity);
  return found == dimensions.end() ? std::string_view() : found->text;
}

std::string with_dimension(std::string_view quantity, std::string_view dimension) {
  return dimension.empty() ? std::string(quantity) : fmt::format("{} [{}]", quantity, dimension);
}

std::string title_of(std::span<const PlottedRun> runs) {
  const auto& title = runs.front().study.title;
  if (runs.size() == 1)
    return title.empty() ? runs.front().label : fmt::format("{} ({})", title, runs.front().label);
  const auto has_it = [&](const PlottedRun& run) { return run.study.title == title; };
  return std::ranges::all_of(runs, has_it) ? title : "";
}

std::string units_of(std::span<const PlottedRun> runs) {
  std::string text;
  for (const auto& run : runs)
    if (text.find(run.study.units) == std::string::npos)
      text += (text.empty() ? "units: " : "; ") + run.study.units;
  return text;
}

void add_reference(Figure& figure, const std::string& expression) {
  auto& curves = figure.panels.front().curves;
  std::vector<double> shown;
  for (const auto& curve : curves)
    shown.insert(shown.end(), curve.x.begin(), curve.x.end());
  const auto range = range_of(shown);
  Curve reference{.label = expression, .style = {"#222222", "6 3"}};
  try {
    const Expression value(expression);
    constexpr int parts = 400;
    for (int i = 0; i <= parts; ++i) {
      const double x = range.low + range.length() * i / parts;
      reference.x.push_back(x);
      reference.y.push_back(value.at(std::array{x, 0.0, 0.0}, x));
    }
  } catch (const InputError& error) {
    throw InputError(fmt::format("--reference: {}", error.what()));
  }
  curves.push_back(std::move(reference));
}

} // namespace rubato::plot
