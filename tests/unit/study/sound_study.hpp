// SPDX-License-Identifier: LGPL-3.0-or-later
/// A study without a fault, and what makes its material another one.
#pragma once

#include "rubato/study/study.hpp"

#include <optional>

namespace rubato::study {

/// Two plates of steel that touch, a sound study.
inline Study sound_study() {
  Study study;
  study.physics = Physics::plane_strain;
  Body lower;
  lower.name = "lower";
  lower.dimension = 2;
  lower.to = {4, 1, 0};
  lower.divisions = {4, 1, 1};
  lower.cells = CellType::quad4;
  lower.sides = {{"top", "roof"}, {"bottom", "ground"}};
  Body upper = lower;
  upper.name = "upper";
  upper.from = {0, 1, 0};
  upper.to = {4, 2, 0};
  upper.sides = {{"bottom", "under"}, {"top", "above"}};
  study.mesh.bodies = {lower, upper};
  Material& steel = study.materials.emplace_back();
  steel.name = "steel";
  steel.young = 2e11;
  steel.poisson = 0.3;
  steel.density = 7800;
  study.functions["ramp"] = {{0, 1}, {0, 1}, Function::Outside::constant};
  study.supports = {{"ground", {Amplitude{}, Amplitude{}, std::nullopt}}};
  study.springs = {{"above", {1e3, 0, 0}}};
  study.loads = {{LoadKind::pressure, "above", {1e6, 0, 0}, "ramp"}};
  ContactZone zone;
  zone.name = "joint";
  zone.master = "roof";
  zone.slave = "under";
  study.contact = {zone};
  study.time.step = 0.1;
  study.time.end = 1;
  Probe& tip = study.probes.emplace_back();
  tip.name = "tip";
  tip.node = "N1";
  Check& check = study.checks.emplace_back();
  check.probe = "tip";
  check.component = "y";
  check.at = 1;
  check.reference = 0.5;
  check.tolerance = 0.1;
  return study;
}

inline MadeGroup& add_group(Study& study, GroupKind kind) {
  auto& group = study.mesh.groups.emplace_back();
  group.name = "a";
  group.kind = kind;
  return group;
}

/// E_x = 9, E_y = 4, E_z = 1.
inline Orthotropy& make_timber(Material& material) {
  material.law = LawKind::orthotropic;
  auto& o = material.orthotropy;
  o.young_x = 9, o.young_y = 4, o.young_z = 1;
  o.poisson_xy = 0.3, o.poisson_yz = 0.2, o.poisson_xz = 0.1;
  o.shear_xy = 3, o.shear_yz = 2, o.shear_xz = 1;
  return o;
}

inline Plasticity& make_plastic(Material& material) {
  material.law = LawKind::plastic;
  material.plasticity.yield_stress = 1e8;
  return material.plasticity;
}

inline void statically(Study& study) {
  study.time.scheme = SchemeKind::static_steps;
  study.time.contact_mass = ContactMass::consistent;
}

inline void make_rubber(Material& material) {
  material.law = LawKind::hyperelastic;
  material.poisson = 0;
  material.hyperelasticity.c10 = 1;
  material.hyperelasticity.bulk = 100;
}

} // namespace rubato::study
