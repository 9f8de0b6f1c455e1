// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/common/move_search.hpp"

#include <array>
#include <limits>

namespace rubato::step {
namespace {

/// Of the way to an iterate that are tried one after the other.
constexpr std::array<double, 4> parts_of_move{0.5, 0.25, 0.125, 0.0625};
/// What part of a move takes of the unbalanced force, at least, in parts of what its length promises.
constexpr double kept_promise = 0.1;

} // namespace

SearchedPart search_along_move(double before, std::optional<double> whole,
                               const std::function<std::optional<double>(double part)>& unbalanced_at) {
  SearchedPart found;
  double least = whole.value_or(std::numeric_limits<double>::infinity());
  auto now = whole;
  for (const double part : parts_of_move) {
    if (now && *now <= (1 - kept_promise * found.tried) * before)
      break;
    now = unbalanced_at(found.tried = part);
    if (now && *now < least) {
      least = *now;
      found.best = part;
    }
  }
  return found;
}

} // namespace rubato::step
