// SPDX-License-Identifier: LGPL-3.0-or-later
// A program of its own against the installed package: two blocks pressed onto each other, step by step.
#include <cmath>
#include <cstdio>
#include <rubato/simulation/simulation.hpp>

namespace {

using namespace rubato;

constexpr double young = 200;      // [pressure]
constexpr double pressure = 3;     // at t = 1
constexpr double tolerance = 1e-9; // what iterations leave unbalanced

study::Body block(const char* name, double bottom) {
  study::Body body;
  body.name = name;
  body.dimension = 2;
  body.from = {0, bottom, 0};
  body.to = {1, bottom + 1, 0};
  body.divisions = {4, 2, 1};
  body.cells = CellType::quad4;
  return body;
}

study::Study pressed_blocks() {
  study::Study study;
  study.name = "blocks";
  study.physics = study::Physics::plane_stress;
  study.mesh.bodies = {block("lower", 0), block("upper", 1)};
  study.mesh.bodies[0].sides = {{"left", "left"}, {"bottom", "ground"}, {"top", "over"}};
  study.mesh.bodies[1].sides = {{"left", "left"}, {"bottom", "under"}, {"top", "roof"}};
  auto& rubber = study.materials.emplace_back();
  rubber.name = "rubber";
  rubber.young = young;
  study.supports = {{"ground", {std::nullopt, study::Amplitude{}, {}}},
                    {"left", {study::Amplitude{}, {}, {}}}};
  study.functions["ramp"] = {{0, 1}, {0, 1}};
  study.loads = {{study::LoadKind::pressure, "roof", {pressure}, "ramp"}};
  auto& zone = study.contact.emplace_back();
  zone.name = "between";
  zone.master = "over";
  zone.slave = "under";
  study.time.scheme = study::SchemeKind::static_steps;
  study.time.contact_mass = study::ContactMass::consistent;
  study.time.step = 0.25;
  study.time.end = 1;
  return study;
}

bool near(double value, double expected) {
  return std::abs(value - expected) <= tolerance * std::abs(expected);
}

/// Both blocks have the height and the area 1: under p the roof sinks by 2 p / E, and p²/E is stored.
bool is_right(const simulation::Simulation& blocks) {
  const double p = pressure * blocks.state().t;
  bool right = near(blocks.state().motion.u.minCoeff(), -2 * p / young) &&
               near(blocks.energy().strain, p * p / young) &&
               near(blocks.energy().external_work, p * p / young);
  for (const auto& point : blocks.state().zones[0].outcomes)
    right = right && near(point.pressure, p);
  return right;
}

} // namespace

int main() {
  simulation::Simulation blocks(pressed_blocks());
  bool right = true;
  while (right && !blocks.finished()) {
    const auto step = blocks.advance();
    right = step.accepted() && is_right(blocks);
    std::printf("t = %g: %d iterations, roof at %g, strain energy %g\n", blocks.state().t,
                step.report.iterations, blocks.state().motion.u.minCoeff(), blocks.energy().strain);
  }
  right = right && blocks.counters().steps == 4;
  std::puts(right ? "the installed simulation is right" : "the installed simulation is wrong");
  return right ? 0 : 1;
}
