// SPDX-License-Identifier: LGPL-3.0-or-later
// How the ground moves.
#include "rubato/study/damping.hpp"
#include "rubato/study/fields.hpp"
#include "rubato/study/rules/rules.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace rubato::study {
namespace {

void check_component(Rules& rules, const Field& motion, std::size_t axis) {
  const auto path = fmt::format("base_motion.{}", axis_words.at(axis));
  rules.axis(path, axis);
  rules.motion(path, motion);
  if (varies_in_place(motion))
    rules.broken({path}, "found a motion that depends on the place, expected a number or an expression of t: "
                         "the base moves as a whole");
  if (rules.study.physics == Physics::axisymmetric && axis == 0)
    rules.broken({path, "physics"},
                 "found a motion along x, axisymmetric bases move along their axis y only");
}

/// Displacements are counted from the base: only its acceleration acts.
void check_relative(Rules& rules) {
  const auto& base = *rules.study.base_motion;
  if (rules.study.time.scheme == SchemeKind::static_steps)
    rules.broken(
        {"base_motion.frame", "base_motion", "time.scheme"},
        "the scheme static has no masses that a base in the frame relative could accelerate, expected "
        "frame: absolute");
  for (std::size_t axis = 0; axis < base.components.size(); ++axis)
    if (const auto& motion = base.components.at(axis); motion && motion->given != Given::acceleration)
      rules.broken({fmt::format("base_motion.{}", axis_words.at(axis)), "base_motion.frame"},
                   fmt::format("found {}, but forces of inertia need the acceleration of the base, expected "
                               "'acceleration', or frame: absolute",
                               motion->given == Given::velocity ? "a velocity" : "a displacement"));
}

bool has_springs(const Study& study) {
  const auto is_grounded = [](const Connector& connector) {
    return connector.to.empty() && !connector.rotates && connector.stiffness > 0;
  };
  return !study.springs.empty() || std::ranges::any_of(study.connectors, is_grounded);
}

/// Against the ground, not within the bodies.
bool has_dampers(const Study& study) {
  const auto is_grounded = [](const Connector& connector) {
    return connector.to.empty() && !connector.rotates && connector.damping > 0;
  };
  const auto is_damped = [](const Material& material) { return rayleigh_coefficients(material).mass != 0; };
  return std::ranges::any_of(study.connectors, is_grounded) ||
         std::ranges::any_of(study.materials, is_damped);
}

/// What cannot follow the ground: forces by tables and the damping of modes are those of a ground at rest.
void check_fixed_ground(Rules& rules) {
  const auto& study = rules.study;
  if (std::ranges::any_of(study.connectors, [](const Connector& one) { return one.anchor.has_value(); }))
    rules.broken({"base_motion.frame", "connectors"},
                 "the anchor of a connector cannot move with a base in the frame absolute, expected frame: "
                 "relative");
  const auto by_table = [](const Connector& connector) {
    return connector.to.empty() && !connector.rotates &&
           (connector.force.has_value() || connector.damper.has_value());
  };
  if (std::ranges::any_of(study.connectors, by_table))
    rules.broken({"base_motion.frame", "connectors"},
                 "a connector by a table to the ground cannot move with a base in the frame absolute, "
                 "expected frame: relative");
  if (study.modal_damping)
    rules.broken({"base_motion.frame", "modal_damping"},
                 "modal damping would resist the motion of the base in the frame absolute, expected frame: "
                 "relative");
}

/// Springs to the ground need its displacement, dampers its velocity.
void check_absolute(Rules& rules) {
  const auto& study = rules.study;
  check_fixed_ground(rules);
  const bool dampers = has_dampers(study);
  if (is_explicit(study.time.scheme) && (dampers || has_springs(study)))
    rules.broken(
        {"base_motion.frame", "time.scheme"},
        fmt::format("the scheme {} has no springs and dashpots to a ground that moves, nor damping by the "
                    "mass against it, expected frame: relative",
                    word_of(scheme_words, study.time.scheme)));
  const auto& components = study.base_motion->components;
  for (std::size_t axis = 0; axis < components.size(); ++axis)
    if (const auto& motion = components.at(axis); motion && motion->given == Given::displacement &&
                                                  varies_in_time(*motion) && dampers &&
                                                  study.time.scheme != SchemeKind::static_steps)
      rules.broken(
          {fmt::format("base_motion.{}", axis_words.at(axis)), "base_motion.frame"},
          "found a displacement, but dashpots to the ground and damping by the mass need the velocity of the "
          "base, expected 'velocity' or 'acceleration'");
}

} // namespace

void check_base_motion(Rules& rules) {
  if (!rules.study.base_motion)
    return;
  const auto& base = *rules.study.base_motion;
  for (std::size_t axis = 0; axis < base.components.size(); ++axis)
    if (const auto& motion = base.components.at(axis))
      check_component(rules, *motion, axis);
  if (std::ranges::none_of(base.components, [](const auto& motion) { return motion.has_value(); }))
    rules.broken({"base_motion", "base_motion.x", "base_motion.y", "base_motion.z"},
                 "has no component, expected at least one of x, y, z");
  if (base.frame == BaseFrame::relative)
    check_relative(rules);
  else
    check_absolute(rules);
}

} // namespace rubato::study
