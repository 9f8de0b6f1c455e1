// SPDX-License-Identifier: LGPL-3.0-or-later
// Causes of differences of the comparison sweep. Each kind was found by looking at the studies that are
// named; docs/verification/notes.md has the numbers.
#include "verification/second_way_page.hpp"
#include <algorithm>
#include <string_view>

namespace rubato::verification {
namespace {

bool warns_of(const Comparison& comparison, std::string_view words) {
  return std::ranges::any_of(comparison.warnings,
                             [&](const auto& warning) { return warning.find(words) != std::string::npos; });
}

/// Bodies that slide along one another by more than they are squeezed.
bool slides(const WayStudy& study) {
  return study.family == "edges" || study.family == "noses" || study.family == "hooks";
}

} // namespace

std::string cause_of(const WayStudy& study, const Comparison& comparison) {
  if (comparison.way == "full" && study.scheme == "static")
    return "kind of study 4: the whole system throws aside a body that only contact holds";
  if (comparison.way == "explicit" && warns_of(comparison, "the springs of contact"))
    return "penalty springs";
  if (warns_of(comparison, "contact pressures gave"))
    return "kind of study 23: contact gives energy";
  if (slides(study) && (comparison.way == "moreau_jean" || study.scheme == "moreau_jean"))
    return "kind of study 49: the default scheme leaves gaps at closed points of a slave with long faces";
  return "";
}

} // namespace rubato::verification
