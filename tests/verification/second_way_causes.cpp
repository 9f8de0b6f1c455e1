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

constexpr const char* gaps_are_kept =
    "kind of study 49: the default scheme leaves gaps at closed points of a slave with long faces";

struct WarnedCause {
  std::string_view words; ///< of a warning
  const char* cause;
};

/// The first that fits is the cause.
constexpr WarnedCause warned_causes[] = {
    {"by nodes the master may bulge", "kind of study 306: a slave by nodes that is coarser than its master"},
    {"where two zones press on a node", "kind of study 15: two zones with friction press on one node"},
    {"bodies may buckle", "kind of study 117: a limit load is near"},
    {"closed_gaps", gaps_are_kept},
    {"contact pressures", "kind of study 23: contact gives energy"},
    {"the springs of contact", "penalty springs"},
    {"friction_gain", "kind of study 239: friction gives energy"},
    {"cell_in_wave", "kind of study 239: cells do not resolve the waves of an impact"},
};

} // namespace

std::string cause_of(const WayStudy& study, const Comparison& comparison) {
  if (comparison.way == "full" && study.family == "rollers")
    return "kind of study 4: nothing tells where a roller stands before it is pressed";
  if (comparison.way == "explicit" && study.family == "wedges")
    return "kind of study 305: nodes that come onto the master from beyond its end keep their depth";
  if (comparison.way == "nodes" && study.family == "punches")
    return "kind of study 178: by nodes the error of coarse quadratic faces halves with the edges, later";
  for (const auto& [words, cause] : warned_causes)
    if (warns_of(comparison, words))
      return cause;
  if (slides(study) && (comparison.way == "moreau_jean" || study.scheme == "moreau_jean"))
    return gaps_are_kept;
  return "";
}

} // namespace rubato::verification
