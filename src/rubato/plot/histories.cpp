// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/plot/histories.hpp"

#include "rubato/core/error.hpp"
#include "rubato/core/naming.hpp"
#include "rubato/plot/series.hpp"
#include "rubato/results/history.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

namespace rubato::plot {
namespace {

bool is_named(const Series& series, const std::string& name) {
  return series.name == name || series.group == name;
}

/// Names as a user may give them: those of groups of columns too.
std::vector<std::string> names_of(const std::vector<Series>& all) {
  std::vector<std::string> names;
  for (const auto& series : all) {
    if (!series.group.empty() && std::ranges::find(names, series.group) == names.end())
      names.push_back(series.group);
    names.push_back(series.name);
  }
  return names;
}

std::vector<Series> series_named(const PlottedRun& run, const std::vector<Series>& all,
                                 const std::string& name) {
  std::vector<Series> found;
  std::ranges::copy_if(all, std::back_inserter(found),
                       [&](const Series& series) { return is_named(series, name); });
  if (found.empty())
    throw InputError(fmt::format("{}: no quantity is called {}{}", run.folder.string(), shown(name),
                                 suggestion(name, names_of(all))));
  return found;
}

std::vector<Series> chosen(const PlottedRun& run, const std::vector<Series>& all,
                           const std::vector<std::string>& names) {
  std::vector<Series> found;
  for (const auto& name : names)
    for (auto& series : series_named(run, all, name))
      found.push_back(std::move(series));
  if (!names.empty())
    return found;
  std::ranges::copy_if(all, std::back_inserter(found), &Series::is_probe);
  if (found.empty())
    throw InputError(fmt::format("{}: found no probes, expected --history with one of {}",
                                 run.folder.string(), fmt::join(names_of(all), ", ")));
  return found;
}

Series abscissa(const PlottedRun& run, const std::vector<Series>& all, const std::string& name) {
  auto found = series_named(run, all, name);
  if (found.size() == 1)
    return found.front();
  std::vector<std::string> names;
  std::ranges::transform(found, std::back_inserter(names), &Series::name);
  throw InputError(
      fmt::format("--against: found {}, expected one of {}", shown(name), fmt::join(names, ", ")));
}

/// The values of both where both have an instant.
Curve over(const Series& x, const Series& y) {
  Curve curve;
  const double length = y.t.empty() ? 0 : y.t.back() - y.t.front();
  std::size_t i = 0;
  for (std::size_t j = 0; j < y.t.size(); ++j) {
    while (i < x.t.size() && x.t[i] < y.t[j] && !results::is_same_instant(x.t[i], y.t[j], length))
      ++i;
    if (i < x.t.size() && results::is_same_instant(x.t[i], y.t[j], length)) {
      curve.x.push_back(x.values[i]);
      curve.y.push_back(y.values[j]);
    }
  }
  return curve;
}

Panel& panel_of(Figure& figure, const std::string& kind) {
  const auto found = std::ranges::find(figure.panels, kind, &Panel::label);
  if (found != figure.panels.end())
    return *found;
  return figure.panels.emplace_back(Panel{kind, {}});
}

/// The name of what a check looks at, as series have it.
std::string checked_name(const study::Check& check) {
  if (check.resultant)
    return fmt::format("{}.{}", check.resultant->zone, check.resultant->quantity);
  if (!check.energy.empty())
    return fmt::format("energy.{}", check.energy);
  return check.component.empty() ? check.probe : fmt::format("{}.{}", check.probe, check.component);
}

Curve references(const study::Study& study, const Series& series, const LineStyle& style) {
  Curve curve{.label = "reference of a check", .style = style, .mark = Mark::rings};
  for (const auto& check : study.checks)
    if (check.run.empty() && !check.field && check.when == study::CheckedTime::instant &&
        checked_name(check) == series.name) {
      curve.x.push_back(check.at);
      curve.y.push_back(check.reference);
    }
  return curve;
}

void require_rows(const PlottedRun& run, const std::vector<Series>& all) {
  const auto is_empty = [](const Series& series) { return series.t.empty(); };
  if (std::ranges::all_of(all, is_empty))
    throw InputError(fmt::format("{}: the run has stored no step yet", run.folder.string()));
}

/// A curve's label and style: runs have colours and their quantities in a panel dashes; the quantities of a
/// single run have colours. `number`: of the quantity in its panel, from 0.
void give_style(Curve& curve, const std::string& name, std::span<const PlottedRun> runs, std::size_t run,
                int number) {
  const bool several = runs.size() > 1;
  curve.label = several ? fmt::format("{}, {}", runs[run].label, name) : name;
  curve.style = several ? line_style(static_cast<int>(run), number) : line_style(number);
}

} // namespace

Figure histories(std::span<const PlottedRun> runs, const HistoryChoice& choice) {
  Figure figure{.title = title_of(runs),
                .note = units_of(runs),
                .x_label = with_dimension("t", dimension_of("t")),
                .time_axis = choice.against.empty()};
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const auto all = all_series(runs[r].folder, runs[r].study);
    require_rows(runs[r], all);
    std::map<std::string, int> drawn; // curves in each panel
    for (const auto& series : chosen(runs[r], all, choice.quantities)) {
      Curve curve{.x = series.t, .y = series.values};
      if (!choice.against.empty()) {
        const auto x = abscissa(runs[r], all, choice.against);
        curve = over(x, series);
        figure.x_label = fmt::format("{}: {}", x.name, x.kind);
      }
      auto& panel = panel_of(figure, series.kind);
      give_style(curve, series.name, runs, r, drawn[series.kind]++);
      auto expected = references(runs[r].study, series, curve.style);
      panel.curves.push_back(std::move(curve));
      if (choice.against.empty() && !expected.x.empty())
        panel.curves.push_back(std::move(expected));
    }
  }
  return figure;
}

std::vector<std::string> quantity_names(const PlottedRun& run) {
  return names_of(all_series(run.folder, run.study));
}

} // namespace rubato::plot
