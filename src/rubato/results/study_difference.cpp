// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/results/study_difference.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <span>

namespace rubato::results {
namespace {

using nlohmann::json;

constexpr std::array free_to_change{"/title",         "/mesh/file",       "/time/end",
                                    "/time/instants", "/time/on_failure", "/newton",
                                    "/checkpoint",    "/checks",          "/runs"};

/// What has no say in results.
constexpr std::array without_effect{"/title", "/mesh/file", "/checkpoint", "/checks", "/runs"};

json without(std::span<const char* const> parts, const std::string& text) {
  auto study = json::parse(text);
  for (const auto* path : parts)
    if (const json::json_pointer at(path); study.contains(at))
      study.at(at.parent_pointer()).erase(at.back());
  return study;
}

/// What is added at the end of a list has no index there but "-".
json::json_pointer place_of(const json& difference, const json& old_study) {
  json::json_pointer at(difference.at("path").get<std::string>());
  if (at.back() == "-") {
    at.pop_back();
    at /= old_study.at(at).size();
  }
  return at;
}

std::string value_at(const json& study, const json::json_pointer& at) {
  return study.contains(at) ? study.at(at).dump() : "not there";
}

} // namespace

std::optional<std::string> study_difference(const std::string& before, const std::string& now) {
  const auto old_study = without(free_to_change, before);
  const auto new_study = without(free_to_change, now);
  const auto differences = json::diff(old_study, new_study);
  if (differences.empty())
    return std::nullopt;
  const auto at = place_of(differences.front(), old_study);
  auto path = at.to_string().substr(1);
  std::ranges::replace(path, '/', '.');
  return fmt::format("{} was {} and is {} now", path, value_at(old_study, at), value_at(new_study, at));
}

bool same_results_expected(const std::string& before, const std::string& now) {
  return without(without_effect, before) == without(without_effect, now);
}

} // namespace rubato::results
