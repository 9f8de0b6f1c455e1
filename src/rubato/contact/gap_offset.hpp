// SPDX-License-Identifier: LGPL-3.0-or-later
/// What a deck adds to the gaps of a zone: an interference, which takes away from them, and a gap.
#pragma once

#include "rubato/core/function.hpp"
#include "rubato/study/study.hpp"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace rubato::contact {

/// gap(t) − interference(t), the same at every point of a zone.
struct GapOffset {
  struct Term {
    double value = 0; ///< [length]
    std::optional<Function> function;
  };
  std::vector<Term> terms;

  /// Added to the gap that the surfaces have [length]; > 0 opens.
  double at(double t) const;
  /// How much it opens between two instants.
  double change(double from, double to) const { return moves() ? at(to) - at(from) : 0.0; }
  bool moves() const;
};

/// `functions` are the deck's; those that the zone names are among them.
GapOffset make_gap_offset(const study::ContactZone& settings,
                          const std::map<std::string, Function>& functions);

} // namespace rubato::contact
