// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/plot/contact_lines.hpp"

#include "rubato/core/error.hpp"
#include "rubato/core/naming.hpp"
#include "rubato/plot/contact_points.hpp"
#include "rubato/plot/instants.hpp"
#include "rubato/plot/ticks.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace rubato::plot {
namespace {

/// "fit.traction.x": names of zones have no dot.
struct ZoneColumn {
  std::string zone;
  std::string column;
};

ZoneColumn parsed(const std::string& what) {
  const auto dot = what.find('.');
  if (dot == std::string::npos)
    return {what, "pressure"};
  return {what.substr(0, dot), what.substr(dot + 1)};
}

const std::vector<double>& column_named(const PlottedRun& run, const ContactPoints& points,
                                        const std::string& option, const std::string& name) {
  const auto found = std::ranges::find(points.names, name);
  if (found == points.names.end())
    throw InputError(fmt::format("{}: {}: a contact zone has no column {}{}", run.folder.string(), option,
                                 shown(name), suggestion(name, points.names)));
  return points.columns[static_cast<std::size_t>(found - points.names.begin())];
}

const std::vector<double>* find_column(const ContactPoints& points, std::string_view name) {
  const auto found = std::ranges::find(points.names, name);
  return found == points.names.end()
             ? nullptr
             : &points.columns[static_cast<std::size_t>(found - points.names.begin())];
}

std::string longest_axis(const ContactPoints& points) {
  std::string longest;
  double length = -1;
  for (const auto* axis : {"x", "y", "z"})
    if (const auto* column = find_column(points, axis))
      if (const auto [low, high] = std::ranges::minmax(*column); high - low > length) {
        length = high - low;
        longest = axis;
      }
  return longest;
}

std::string usual_abscissa(const ContactPoints& points) {
  return find_column(points, "s") != nullptr ? "s" : longest_axis(points);
}

/// The rows of an instant; along the line where there is one.
std::vector<std::size_t> rows_at(const ContactPoints& points, double t) {
  std::vector<std::size_t> rows;
  for (std::size_t row = 0; row < points.t.size(); ++row)
    if (points.t[row] == t)
      rows.push_back(row);
  if (const auto* s = find_column(points, "s"))
    std::ranges::stable_sort(rows, {}, [&](std::size_t row) { return (*s)[row]; });
  return rows;
}

std::vector<double> chosen_instants(const PlottedRun& run, const ContactPoints& points,
                                    const std::vector<double>& wanted) {
  auto stored = points.t;
  stored.erase(std::unique(stored.begin(), stored.end()), stored.end());
  if (wanted.empty())
    return {stored.back()};
  std::vector<double> found(wanted.size());
  std::ranges::transform(wanted, found.begin(),
                         [&](double at) { return stored_instant(run.folder, stored, at); });
  return found;
}

std::string label_of(std::span<const PlottedRun> runs, const PlottedRun& run, double t) {
  return runs.size() == 1 ? fmt::format("t = {:.6g}", t) : fmt::format("{}, t = {:.6g}", run.label, t);
}

} // namespace

Figure contact_lines(std::span<const PlottedRun> runs, const LineChoice& choice) {
  const auto [zone, column] = parsed(choice.what);
  Figure figure{.title = title_of(runs), .note = units_of(runs), .time_axis = false};
  auto& panel = figure.panels.emplace_back(
      Panel{fmt::format("{}: {}", zone, with_dimension(column, dimension_of(column))), {}});
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const auto points = read_contact_points(runs[r].folder, zone);
    const auto along = choice.along.empty() ? usual_abscissa(points) : choice.along;
    const auto& x = column_named(runs[r], points, "--along", along);
    const auto& y = column_named(runs[r], points, "--line", column);
    const bool is_line = find_column(points, "s") != nullptr;
    const auto instants = chosen_instants(runs[r], points, choice.at);
    for (std::size_t i = 0; i < instants.size(); ++i) {
      const auto style = runs.size() == 1 ? line_style(static_cast<int>(i))
                                          : line_style(static_cast<int>(r), static_cast<int>(i));
      Curve curve{.label = label_of(runs, runs[r], instants[i]), .style = style};
      curve.mark = is_line ? Mark::line : Mark::dots;
      for (const auto row : rows_at(points, instants[i])) {
        curve.x.push_back(x[row]);
        curve.y.push_back(y[row]);
      }
      panel.curves.push_back(std::move(curve));
    }
    figure.x_label = with_dimension(along == "s" ? "arc length s" : along, dimension_of(along));
  }
  return figure;
}

} // namespace rubato::plot
