// SPDX-License-Identifier: LGPL-3.0-or-later
/// What a deck adds to the gaps of a zone: an interference, which takes away from them, and a gap.
#pragma once

#include "rubato/core/field_function.hpp"
#include "rubato/study/study.hpp"

#include <Eigen/Core>

#include <map>
#include <string>
#include <vector>

namespace rubato::contact {

/// gap(x, t) − interference(x, t) at the undeformed place x of a contact point.
struct GapOffset {
  enum class Sense { opens, overlaps };
  struct Term {
    Sense sense = Sense::opens;
    FieldFunction length; ///< [length]; ≥ 0 where it overlaps
  };
  std::vector<Term> terms; ///< none: nothing is added

  /// Added to the gap that the surfaces have [length]; > 0 opens. Throws InputError at the value in the study
  /// when that is no finite number there, or an interference < 0.
  double at(const Eigen::Vector3d& place, double t) const { return terms.empty() ? 0.0 : sum_at(place, t); }
  /// How much it opens between two instants.
  double change(const Eigen::Vector3d& place, double from, double to) const {
    return moves() ? at(place, to) - at(place, from) : 0.0;
  }
  /// Whether it depends on time.
  bool moves() const;
  /// The part of it that is an interference, ≥ 0.
  double overlap_at(const Eigen::Vector3d& place, double t) const;

private:
  double sum_at(const Eigen::Vector3d& place, double t) const;
};

/// `functions` are the deck's; those that the zone names are among them. `path`: of the zone in the study.
GapOffset make_gap_offset(const study::ContactZone& settings,
                          const std::map<std::string, Function>& functions, const std::string& path);

} // namespace rubato::contact
