// SPDX-License-Identifier: LGPL-3.0-or-later
/// Values of a run held against references and against other runs.
#pragma once

#include "rubato/results/csv.hpp"
#include "rubato/study/study.hpp"

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace rubato::results {

struct CheckResult {
  std::string quantity; ///< "tip.y", "interface.normal", "energy friction", "displacement.y on Haut_Contact"
  std::string over;     ///< "max" and the like of the whole history; empty at an instant
  double at = 0;
  double reference = 0;
  /// The difference when another run is subtracted; nothing when one of them did not reach the instant.
  std::optional<double> value;
  double deviation =
      0; ///< relative to the reference (to the other run's value) or absolute, as the check says
  double tolerance = 0;
  bool relative = true;
  bool holds = false;
  std::string source;
  std::string run;     ///< the one that is subtracted
  std::string where;   ///< the node of a field's largest difference
  std::string failure; ///< why the other run has nothing to compare with
  std::string note;
};

/// Looks the checks' instants up in a run's table of probes (first column t) and in the tables of its folder,
/// between two rows linearly. Of checks against another run the value is the difference, this run's minus the
/// other's; the other's folder stands beside `folder`, this run's own.
std::vector<CheckResult> evaluate_checks(std::span<const study::Check> checks, const Table& probes,
                                         const std::filesystem::path& folder = {});

/// The comparison as a table for people.
std::string to_text(std::span<const CheckResult> results);

/// The same in Markdown: quantity, instant, value, reference, difference, deviation, tolerance, verdict,
/// source.
std::string to_markdown(std::span<const CheckResult> results);

std::string_view to_string(study::CheckSource source);

} // namespace rubato::results
