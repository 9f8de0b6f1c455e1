// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/report/run_record.hpp"

#include "rubato/core/error.hpp"
#include "rubato/report/study_words.hpp"
#include "rubato/results/csv.hpp"
#include "rubato/results/run_folder.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

namespace rubato::report {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// Lines of a table that a curve is drawn of; longer ones are thinned.
constexpr std::size_t most_lines = 10000;
/// Failed attempts that are shown in full.
constexpr std::size_t most_failures = 100;

Json parsed_summary(const fs::path& path) {
  std::ifstream file(path);
  if (!file)
    throw InputError(
        fmt::format("{}: cannot be read, expected the {} of a run", path.string(), results::summary_file));
  try {
    auto json = Json::parse(file);
    for (const auto* key : {"run", "status", "study"})
      static_cast<void>(json.at(key));
    return json;
  } catch (const Json::exception& error) {
    throw InputError(fmt::format("{}: not the summary of a run ({})", path.string(), error.what()));
  }
}

std::size_t stride_of(std::size_t lines) {
  return std::max<std::size_t>(1, (lines + most_lines - 1) / most_lines);
}

Json columns_of(const results::Table& table) {
  const auto stride = stride_of(table.rows.size());
  auto columns = Json::array();
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    auto column = Json::array();
    for (std::size_t i = 0; i < table.rows.size(); ++i)
      if (i % stride == 0 || i + 1 == table.rows.size())
        column.push_back(std::isfinite(table.rows[i][c]) ? Json(table.rows[i][c]) : Json(nullptr));
    columns.push_back(std::move(column));
  }
  return columns;
}

/// Adds a table, or a warning when it cannot be read; nothing when there is none.
void add_table(const fs::path& folder, const std::string& name, std::string_view kind,
               const std::string& zone, Json& record) {
  if (!fs::exists(folder / name))
    return;
  try {
    const auto table = results::read_csv(folder / name);
    Json json{{"file", name}, {"kind", kind}, {"columns", table.columns}, {"values", columns_of(table)}};
    if (!zone.empty())
      json["zone"] = zone;
    if (const auto stride = stride_of(table.rows.size()); stride > 1)
      record["warnings"].push_back(fmt::format("{} has {} lines, of which the curves here show one in {}",
                                               name, table.rows.size(), stride));
    record["tables"].push_back(std::move(json));
  } catch (const InputError& error) {
    record["warnings"].push_back(fmt::format("{} is not shown: {}", name, error.what()));
  }
}

/// The zones of the study, in its order; with `all: true` those that have a file.
std::vector<std::string> zones_of(const fs::path& folder, const Json& study) {
  std::vector<std::string> zones;
  if (study.contains("contact"))
    for (const auto& [name, zone] : study.at("contact").items())
      zones.push_back(name);
  for (auto& zone : results::contact_zones(folder))
    if (std::ranges::find(zones, zone) == zones.end())
      zones.push_back(std::move(zone));
  return zones;
}

/// The lines of steps.jsonl. A last line that was not written to its end is left out.
std::vector<Json> read_attempts(const fs::path& path) {
  std::vector<Json> attempts;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);)
    if (auto json = Json::parse(line, nullptr, false); json.is_object())
      attempts.push_back(std::move(json));
  return attempts;
}

Json attempts_of(const fs::path& folder) {
  constexpr std::array keys{"begin",      "end",      "cut_level",      "accepted", "outcome",
                            "iterations", "residual", "status_changes", "seconds"};
  const auto attempts = read_attempts(folder / results::steps_file);
  const auto stride = stride_of(attempts.size());
  Json columns{{"count", attempts.size()}, {"failed", Json::array()}};
  for (const auto* key : keys)
    columns[key] = Json::array();
  for (std::size_t i = 0; i < attempts.size(); ++i) {
    const bool accepted = attempts[i].value("accepted", true);
    if (!accepted && columns["failed"].size() < most_failures)
      columns["failed"].push_back(attempts[i]);
    if (accepted && i % stride != 0 && i + 1 < attempts.size())
      continue;
    for (const auto* key : keys)
      columns[key].push_back(attempts[i].contains(key) ? attempts[i].at(key) : Json(nullptr));
  }
  return columns;
}

Json topics_of(const Json& study) {
  auto topics = Json::array();
  for (const auto& topic : study_in_words(study))
    topics.push_back({{"name", topic.name}, {"sentences", topic.sentences}});
  return topics;
}

} // namespace

Json run_record(const fs::path& folder) {
  auto summary = parsed_summary(folder / results::summary_file);
  Json record{{"folder", folder.string()}, {"summary", Json::object()}};
  record["study"] = summary.at("study");
  record["topics"] = topics_of(summary.at("study"));
  record["tolerances"] = summary.value("tolerances", Json::object());
  record["warnings"] = summary.value("warnings", Json::array());
  summary.erase("study");
  summary.erase("tolerances");
  summary.erase("warnings");
  record["summary"] = summary;
  record["tables"] = Json::array();
  add_table(folder, std::string(results::probes_file), "probes", "", record);
  for (const auto& zone : zones_of(folder, record["study"]))
    add_table(folder, results::resultants_file(zone), "resultants", zone, record);
  add_table(folder, std::string(results::energy_file), "energy", "", record);
  record["attempts"] = attempts_of(folder);
  return record;
}

} // namespace rubato::report
