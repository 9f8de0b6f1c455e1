// SPDX-License-Identifier: LGPL-3.0-or-later
// Rotations of supports: their line and their angle.
#include "rubato/study/fields.hpp"
#include "rubato/study/rules/rules.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace rubato::study {
namespace {

void check_line(Rules& rules, const Rotation& rotation, const std::string& path) {
  const auto physics = rules.study.physics;
  for (std::size_t axis = 0; axis < rotation.about.size(); ++axis) {
    const auto at = fmt::format("{}.about.{}", path, axis);
    rules.number(at, rotation.about.at(axis));
    if (rotation.about.at(axis) != 0)
      rules.axis(at, axis);
    rules.number(fmt::format("{}.axis.{}", path, axis), rotation.axis.at(axis));
  }
  if (std::ranges::all_of(rotation.axis, [](double number) { return number == 0; }))
    rules.broken({path + ".axis"}, "found a direction without length");
  else if (dimension_of(physics) == 2 && (rotation.axis[0] != 0 || rotation.axis[1] != 0))
    rules.broken({path + ".axis", "physics"},
                 fmt::format("found a direction in the plane, {} turns about z only",
                             word_of(physics_words, physics)));
}

} // namespace

void check_rotate(Rules& rules, const Rotation& rotation, const std::string& path) {
  check_line(rules, rotation, path);
  if (rules.study.physics == Physics::axisymmetric)
    rules.broken({path, "physics"},
                 "found a rotation in axisymmetric, whose sections cannot turn as rigid ones, expected none");
  rules.motion(path + ".angle", rotation.angle);
  if (varies_in_place(rotation.angle))
    rules.broken({path + ".angle"}, "found an angle that depends on the place, expected a number or an "
                                    "expression of t: the group turns as a whole");
}

} // namespace rubato::study
