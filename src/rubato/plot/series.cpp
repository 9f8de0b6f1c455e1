// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/plot/series.hpp"

#include "rubato/plot/plotted_run.hpp"
#include "rubato/results/csv.hpp"
#include "rubato/results/run_folder.hpp"
#include "rubato/study/words.hpp"

#include <algorithm>

namespace rubato::plot {
namespace {

namespace fs = std::filesystem;

std::vector<double> column_of(const results::Table& table, std::size_t column) {
  std::vector<double> values(table.rows.size());
  std::ranges::transform(table.rows, values.begin(), [&](const auto& row) { return row[column]; });
  return values;
}

Series series_of(const results::Table& table, std::size_t column, const std::string& before) {
  return {
      .name = before + table.columns[column], .t = column_of(table, 0), .values = column_of(table, column)};
}

std::string kind_of_probe(const study::Study& study, const std::string& name) {
  const auto probe = std::ranges::find(study.probes, name, &study::Probe::name);
  if (probe == study.probes.end())
    return name;
  const auto field = study::word_of(study::probe_field_words, probe->field);
  return with_dimension(field, dimension_of(field));
}

void add_probes(const fs::path& run, const study::Study& study, std::vector<Series>& all) {
  const auto table = results::read_csv(run / results::probes_file);
  for (std::size_t c = 1; c < table.columns.size(); ++c) {
    auto& series = all.emplace_back(series_of(table, c, ""));
    const auto dot = series.name.find('.');
    const auto probe = series.name.substr(0, dot);
    series.group = dot == std::string::npos ? "" : probe;
    series.kind = kind_of_probe(study, probe);
    series.is_probe = true;
  }
}

void add_energies(const fs::path& run, std::vector<Series>& all) {
  const auto path = run / results::energy_file;
  if (!fs::exists(path))
    return;
  const auto table = results::read_csv(path);
  for (std::size_t c = 1; c < table.columns.size(); ++c)
    all.emplace_back(series_of(table, c, "energy.")).kind = with_dimension("energy", dimension_of("energy"));
}

std::string kind_of_resultant(const std::string& column) {
  if (column.starts_with("force.") || column == "normal" || column == "friction")
    return with_dimension("contact force", dimension_of("force"));
  if (column == "in_contact" || column == "sticking")
    return "contact points";
  return with_dimension(column, dimension_of(column));
}

void add_resultants(const fs::path& run, std::vector<Series>& all) {
  for (const auto& zone : results::contact_zones(run)) {
    const auto table = results::read_csv(run / results::resultants_file(zone));
    for (std::size_t c = 1; c < table.columns.size(); ++c)
      all.emplace_back(series_of(table, c, zone + ".")).kind = kind_of_resultant(table.columns[c]);
  }
}

} // namespace

std::vector<Series> all_series(const fs::path& run, const study::Study& study) {
  std::vector<Series> all;
  add_probes(run, study, all);
  add_energies(run, all);
  add_resultants(run, all);
  return all;
}

} // namespace rubato::plot
