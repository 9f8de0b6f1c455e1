// SPDX-License-Identifier: LGPL-3.0-or-later
// Causes of differences of the comparison sweep, as they were found by looking at each study. They belong to
// the studies of seed 2900: whoever changes what is drawn looks at the remaining differences again.
#include "verification/second_way_page.hpp"
#include <algorithm>
#include <array>
#include <string_view>

namespace rubato::verification {
namespace {

struct WayCause {
  int number;
  std::string_view way;
  std::string_view cause;
};

constexpr std::string_view thrown_aside = "`solver: full`, a body that only contact holds: the first step "
                                          "throws it aside, contact is lost, friction "
                                          "gives energy";

constexpr std::array<WayCause, 2> way_causes{{{4, "full", thrown_aside}, {16, "full", thrown_aside}}};

} // namespace

std::string cause_of(int number, const std::string& way) {
  const auto found = std::ranges::find_if(
      way_causes, [&](const auto& entry) { return entry.number == number && entry.way == way; });
  return found == way_causes.end() ? "" : std::string(found->cause);
}

} // namespace rubato::verification
