// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/plot/contact_points.hpp"

#include "rubato/core/error.hpp"
#include "rubato/core/naming.hpp"
#include "rubato/results/csv.hpp"
#include "rubato/results/run_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>

namespace rubato::plot {
namespace {

namespace fs = std::filesystem;

/// Names of nodes and statuses are words.
bool is_number_column(std::string_view name) {
  return name != "t" && name != "node" && name != "status";
}

double number(std::string_view text, const Location& at) {
  if (text.empty())
    return NAN;
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size())
    throw InputError(fmt::format("found {}, expected a number", shown(std::string(text))), at);
  return value;
}

fs::path table_of(const fs::path& run, const std::string& zone) {
  const auto zones = results::contact_zones(run);
  if (zones.empty())
    throw InputError(fmt::format("{}: the run has no contact zone", run.string()));
  if (std::ranges::find(zones, zone) == zones.end())
    throw InputError(fmt::format("{}: no contact zone is called {}{}", run.string(), shown(zone),
                                 suggestion(zone, zones)));
  return run / results::contact_file(zone);
}

} // namespace

ContactPoints read_contact_points(const fs::path& run, const std::string& zone) {
  const auto path = table_of(run, zone);
  ContactPoints points;
  std::vector<std::size_t> places;
  std::vector<std::string> header;
  const auto add_header = [&](std::span<const std::string_view> words) {
    header.assign(words.begin(), words.end());
    for (std::size_t i = 0; i < header.size(); ++i)
      if (is_number_column(header[i])) {
        places.push_back(i);
        points.names.push_back(header[i]);
      }
    points.columns.resize(places.size());
  };
  results::read_csv_lines(path, [&](std::span<const std::string_view> words, const Location& at) {
    if (at.line == 1)
      return add_header(words);
    points.t.push_back(number(words.front(), at));
    for (std::size_t i = 0; i < places.size(); ++i)
      points.columns[i].push_back(number(words[places[i]], at));
  });
  if (points.t.empty())
    throw InputError(fmt::format("{}: the table has no line yet", path.string()));
  return points;
}

} // namespace rubato::plot
