// SPDX-License-Identifier: LGPL-3.0-or-later
/// Checks that every run makes of itself: how far its results may be trusted.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <span>
#include <string>
#include <vector>

namespace rubato::results {

/// A number of a whole run and the largest that passes.
struct Plausibility {
  std::string name;    ///< "contact_moment"; docs/guide/results.md lists all
  double value = 0;    ///< the largest of the run, without unit
  double limit = 0;    ///< the largest that passes
  double t = 0;        ///< when it was largest
  std::string where;   ///< zone, body, cell or node; empty of the whole run
  std::string advice;  ///< what the number means and what to write instead
  bool warned = false; ///< whether the run has a warning of it already

  /// A value that is not a number does not pass.
  bool passes() const { return value <= limit; }
  bool operator==(const Plausibility&) const = default;
};

/// Adds checks to those of an earlier part of the run: of two of one name the larger value stays.
void keep_larger(std::vector<Plausibility>& all, std::span<const Plausibility> added);

/// "14 of 14 checks passed", or "12 of 14 checks passed, not rotation (0.069, at most 0.05) and strain (…)".
std::string summary_of(std::span<const Plausibility> checks);

/// The sentence that warns of a check that does not pass.
std::string warning_of(const Plausibility& check);

/// The list in run.json; a value that is not finite is null.
nlohmann::ordered_json plausibility_json(std::span<const Plausibility> checks);
/// The same as text; empty of no checks.
std::string plausibility_text(std::span<const Plausibility> checks);
/// The checks of such a text.
std::vector<Plausibility> plausibility_of(const std::string& text);

} // namespace rubato::results
