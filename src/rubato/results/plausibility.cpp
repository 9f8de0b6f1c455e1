// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/results/plausibility.hpp"

#include "rubato/core/naming.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace rubato::results {

using nlohmann::ordered_json;

void keep_larger(std::vector<Plausibility>& all, std::span<const Plausibility> added) {
  for (const auto& check : added) {
    const auto former = std::ranges::find(all, check.name, &Plausibility::name);
    if (former == all.end())
      all.push_back(check);
    else if (!(check.value <= former->value))
      *former = check;
  }
}

std::string summary_of(std::span<const Plausibility> checks) {
  std::vector<std::string> failed;
  for (const auto& check : checks)
    if (!check.passes())
      failed.push_back(fmt::format("{} ({:.2g}, at most {:g})", check.name, check.value, check.limit));
  return fmt::format("{} of {} checks passed{}", checks.size() - failed.size(), checks.size(),
                     failed.empty() ? "" : ", not " + joined(failed, " and "));
}

std::string warning_of(const Plausibility& check) {
  return fmt::format("{} is {:.3g}, expected at most {:g}{}, at t = {:g}; {}", check.name, check.value,
                     check.limit, check.where.empty() ? "" : ", of " + check.where, check.t, check.advice);
}

ordered_json plausibility_json(std::span<const Plausibility> checks) {
  auto list = ordered_json::array();
  for (const auto& check : checks)
    list.push_back({{"check", check.name},
                    {"value", std::isfinite(check.value) ? ordered_json(check.value) : ordered_json(nullptr)},
                    {"limit", check.limit},
                    {"passes", check.passes()},
                    {"t", check.t},
                    {"where", check.where},
                    {"advice", check.advice},
                    {"warned", check.warned}});
  return list;
}

std::string plausibility_text(std::span<const Plausibility> checks) {
  return checks.empty() ? "" : plausibility_json(checks).dump();
}

std::vector<Plausibility> plausibility_of(const std::string& text) {
  std::vector<Plausibility> checks;
  if (text.empty())
    return checks;
  for (const auto& json : ordered_json::parse(text))
    checks.push_back({json.at("check").get<std::string>(),
                      json.at("value").is_null() ? NAN : json.at("value").get<double>(),
                      json.at("limit").get<double>(), json.at("t").get<double>(),
                      json.at("where").get<std::string>(), json.at("advice").get<std::string>(),
                      json.at("warned").get<bool>()});
  return checks;
}

} // namespace rubato::results
