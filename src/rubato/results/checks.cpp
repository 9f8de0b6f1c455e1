// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/results/checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rubato::results {
namespace {

/// Instants nearer than this part of the run's length are the same.
constexpr double same_instant = 1e-9;

std::optional<double> value_at(const Table& table, int column, double t) {
  if (column < 0 || table.rows.empty())
    return std::nullopt;
  const auto c = static_cast<std::size_t>(column);
  const double slack = same_instant * (table.rows.back()[0] - table.rows.front()[0]);
  const auto after = std::ranges::find_if(table.rows, [&](const auto& row) { return row[0] >= t - slack; });
  if (after == table.rows.end())
    return std::nullopt;
  if (std::abs((*after)[0] - t) <= slack)
    return (*after)[c];
  if (after == table.rows.begin())
    return std::nullopt;
  const auto& before = *(after - 1);
  const double part = (t - before[0]) / ((*after)[0] - before[0]);
  return before[c] + part * ((*after)[c] - before[c]);
}

CheckResult evaluate(const deck::Check& check, const Table& probes) {
  CheckResult result;
  result.quantity = fmt::format("{}.{}", check.probe.text, "xyz"[check.component]);
  result.at = check.at;
  result.reference = check.reference;
  result.tolerance = check.tolerance;
  result.relative = check.relative;
  result.source = to_string(check.source);
  result.note = check.note;
  result.value = value_at(probes, probes.column(result.quantity), check.at);
  if (!result.value)
    return result;
  result.deviation =
      std::abs(*result.value - check.reference) / (check.relative ? std::abs(check.reference) : 1.0);
  result.holds = result.deviation <= check.tolerance;
  return result;
}

} // namespace

std::vector<CheckResult> evaluate_checks(std::span<const deck::Check> checks, const Table& probes) {
  std::vector<CheckResult> results;
  for (const auto& check : checks)
    results.push_back(evaluate(check, probes));
  return results;
}

std::string to_text(std::span<const CheckResult> results) {
  std::string text = fmt::format("{:<12} {:>10} {:>20} {:>20} {:>10} {:>10}  {:<6} {}\n", "quantity", "t",
                                 "reference", "value", "deviation", "tolerance", "", "source");
  for (const auto& r : results)
    text += fmt::format("{:<12} {:>10.6g} {:>20.12g} {:>20} {:>10} {:>10}  {:<6} {}{}{}\n", r.quantity, r.at,
                        r.reference, r.value ? fmt::format("{:.12g}", *r.value) : "not reached",
                        r.value ? fmt::format("{:.2e}", r.deviation) : "",
                        fmt::format("{:.1e}{}", r.tolerance, r.relative ? "" : " abs"),
                        r.holds ? "ok" : "FAILS", r.source, r.note.empty() ? "" : ": ", r.note);
  return text;
}

std::string_view to_string(deck::CheckSource source) {
  switch (source) {
  case deck::CheckSource::external:
    return "external";
  case deck::CheckSource::analytic:
    return "analytic";
  case deck::CheckSource::other_code:
    return "other_code";
  case deck::CheckSource::other_run:
    return "other_run";
  }
  return "";
}

} // namespace rubato::results
