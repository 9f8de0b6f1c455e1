// SPDX-License-Identifier: LGPL-3.0-or-later
/// Values of a run held against references.
#pragma once

#include "rubato/deck/study.hpp"
#include "rubato/results/csv.hpp"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace rubato::results {

struct CheckResult {
  std::string quantity; ///< "tip.y"
  double at = 0;
  double reference = 0;
  std::optional<double> value; ///< nothing when the run did not reach the instant
  double deviation = 0;        ///< relative to the reference or absolute, as the check says
  double tolerance = 0;
  bool relative = true;
  bool holds = false;
  std::string source;
  std::string note;
};

/// Looks the checks' instants up in a table of probes (first column t), between two rows linearly.
std::vector<CheckResult> evaluate_checks(std::span<const deck::Check> checks, const Table& probes);

/// The comparison as a table for people.
std::string to_text(std::span<const CheckResult> results);

std::string_view to_string(deck::CheckSource source);

} // namespace rubato::results
