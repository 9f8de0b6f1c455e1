// SPDX-License-Identifier: LGPL-3.0-or-later
// Seals in grooves, rings that are squeezed, press fits and snap fits. In mm, N, t, s.
#include <fmt/format.h>

#include "verification/solids_sweep.hpp"
#include "verification/sweep_draws.hpp"
#include <algorithm>
#include <cmath>
#include <numbers>

namespace rubato::verification {
namespace {

std::string any_plane_cells(Dice& dice) {
  return dice.one_of({"quad4", "quad4", "quad8", "tria6"});
}

bool is_linear(const std::string& cells) {
  return cells == "quad4";
}

std::string rectangle(const std::string& name, std::array<double, 2> from, std::array<double, 2> to,
                      std::array<int, 2> divisions, const std::string& cells, const std::string& sides) {
  return fmt::format("    - {{name: {}, rectangle: {{from: [{:.12g}, {:.12g}], to: [{:.12g}, {:.12g}]}}, "
                     "divisions: [{}, {}], cells: {}, sides: {{{}}}}}\n",
                     name, from[0], from[1], to[0], to[1], divisions[0], divisions[1], cells, sides);
}

/// Static three times of four; else slow beside the sound through `length`.
struct Pace {
  std::string scheme = "scheme: static";
  double phase = 1;
};

Pace drawn_pace(Dice& dice, const DrawnMaterial& material, const DrawnContact& contact, double length) {
  Pace pace;
  if (dice.chance(0.75))
    return pace;
  pace.scheme = drawn_scheme(dice, contact.exact);
  pace.phase = length * std::sqrt(material.density / material.young) * dice.magnitude(20, 200);
  return pace;
}

std::string even_time(const Pace& pace, int phases, int steps) {
  return fmt::format("time: {{{}, step: {:.9g}, end: {:.9g}}}\n", pace.scheme, pace.phase * phases / steps,
                     pace.phase * phases);
}

std::string mesh_with(const std::string& bodies) {
  return "mesh:\n  generate:\n" + bodies;
}

} // namespace

/// Pressed by the lid, then by a fluid from within against the wall of the groove. What the squeeze displaces
/// has room within.
SolidVariant seal_in_groove(Dice& dice) {
  constexpr double half = 2.5, radius = 20;
  const auto cells = any_plane_cells(dice);
  const int n = is_linear(cells) ? dice.whole(6, 10) : dice.whole(4, 6);
  const bool rounded = dice.chance(0.6);
  const auto material = drawn_rubber(dice, 0.5, 5, 1.1e-9);
  const auto contact = drawn_contact(dice, 0.5, true);
  const double squeeze = dice.uniform(0.08, is_linear(cells) ? 0.3 : 0.2);
  const double pressure = material.young / 3 * dice.magnitude(0.05, 1.5);
  const auto pace = drawn_pace(dice, material, contact, 2 * half);
  const int steps = 2 * dice.whole(8, 16);
  const auto* keys = contact.keys.c_str();
  SolidVariant variant;
  variant.steps = steps;
  if (rounded)
    variant.shape = {Mapping::rounded, radius, half};
  variant.words = fmt::format("{} seal, {} {} × {}, {}, {}, by {:.0f} %, pressure {:.2g}, {}, {} steps",
                              rounded ? "rounded" : "square", cells, n, n, material.words, contact.words,
                              100 * squeeze, pressure, pace.scheme, steps);
  variant.deck = fmt::format(
      "{}  groups: {{skin: {{skin: seal}}}}\nphysics: axisymmetric\nmaterials:\n{}functions:\n"
      "  presses: {{times: [0, {:.6g}], values: [0, 1]}}\n  fills: {{times: [{:.6g}, {:.6g}], values: [0, "
      "1]}}\n"
      "loads: [{{pressure: {{on: inside, value: {:.5g}, function: fills, follower: true}}}}]\ncontact:\n"
      "  floor: {{slave: skin, obstacle: {{plane: {{point: [0, {:.6g}], normal: [0, 1]}}}}{}}}\n"
      "  lid: {{slave: skin, obstacle: {{plane: {{point: [0, {:.6g}], normal: [0, -1]}}, move: {{y: {{value: "
      "{:.6g}, "
      "function: presses}}}}}}{}}}\n"
      "  wall: {{slave: skin, obstacle: {{cylinder: {{radius: {:.6g}, side: inside}}}}{}}}\n{}"
      "probes: {{middle: {{point: [{}, 0]}}}}\n",
      mesh_with(
          rectangle("seal", {radius - half, -half}, {radius + half, half}, {n, n}, cells, "left: inside")),
      material_entry("rubber", material), pace.phase, pace.phase, 2 * pace.phase, pressure, -half, keys, half,
      -2 * half * squeeze, keys, radius + half, keys, even_time(pace, 2, steps), radius);
  return variant;
}

/// Half a ring between plates that nothing else holds up.
SolidVariant squeezed_ring(Dice& dice) {
  constexpr double radius = 20;
  const auto cells = any_plane_cells(dice);
  const auto kind = dice.one_of({"rubber", "metal", "elastic"});
  const double part = kind == "rubber" ? dice.uniform(0.1, 0.4) : dice.uniform(0.04, 0.2);
  const int around = is_linear(cells) ? dice.whole(16, 32) : dice.whole(10, 20);
  const int across = is_linear(cells) ? dice.whole(2, 4) : dice.whole(1, 2);
  const auto material = kind == "rubber"  ? drawn_rubber(dice, 0.5, 5, 1.1e-9)
                        : kind == "metal" ? drawn_metal(dice, 70e3, 70, 350, "logarithmic", 2.7e-9)
                                          : drawn_elastic(2000, 0.35, ", strain: green_lagrange", 1.1e-9);
  const auto contact = drawn_contact(dice, 0.6, true);
  const double most = kind == "rubber" ? 0.6 * (1 - part) : 0.5;
  const double squeeze = dice.uniform(0.1, most);
  const auto pace = drawn_pace(dice, material, contact, 60 * radius / (20 * part));
  const int steps = dice.whole(16, 32);
  constexpr double quarter = std::numbers::pi / 2;
  SolidVariant variant;
  variant.steps = steps;
  variant.shape.mapping = Mapping::polar;
  variant.words =
      fmt::format("ring {:.2g} thick, {} {} × {}, {}, {}, by {:.0f} %, {}, {} steps", part * radius, cells,
                  around, across, material.words, contact.words, 100 * squeeze, pace.scheme, steps);
  variant.deck = fmt::format(
      "{}physics: plane_strain\nmaterials:\n{}supports: [{{on: foot, fix: x}}, {{on: head, fix: "
      "x}}]\nfunctions:\n"
      "  presses: {{times: [0, {:.6g}, {:.6g}], values: [0, 1, 0.3]}}\ncontact:\n"
      "  floor: {{slave: outside, obstacle: {{plane: {{point: [0, {:.6g}], normal: [0, 1]}}}}{}}}\n"
      "  lid: {{slave: outside, obstacle: {{plane: {{point: [0, {:.6g}], normal: [0, -1]}}, move: {{y: "
      "{{value: {:.6g}, "
      "function: presses}}}}}}{}}}\n{}probes: {{side: {{point: [{}, 0]}}}}\n",
      mesh_with(rectangle("ring", {-quarter, (1 - part) * radius}, {quarter, radius}, {around, across}, cells,
                          "left: foot, right: head, top: outside")),
      material_entry("stuff", material), 1.2 * pace.phase, 2 * pace.phase, -radius, contact.keys, radius,
      -2 * squeeze * radius, contact.keys, even_time(pace, 2, steps), radius);
  return variant;
}

namespace {

struct FitDraw {
  std::string cells;
  int along = 0;
  double wall = 0; ///< of the hub
  DrawnMaterial shaft;
  DrawnMaterial hub;
  DrawnContact contact;
  double interference = 0;
  Pace pace;
  int steps = 0;
};

constexpr double shaft_radius = 10;

FitDraw drawn_fit(Dice& dice) {
  FitDraw draw;
  draw.cells = any_plane_cells(dice);
  draw.along = is_linear(draw.cells) ? dice.whole(8, 16) : dice.whole(5, 9);
  draw.wall = dice.uniform(3, 12);
  draw.hub = drawn_metal(dice, 70e3, 70, 350, dice.one_of({"small", "logarithmic"}), 2.7e-9);
  draw.shaft = dice.chance(0.5) ? drawn_elastic(210e3, 0.3, "", 7.8e-9)
                                : drawn_metal(dice, 210e3, 300, 600, "logarithmic", 7.8e-9);
  draw.contact = drawn_contact(dice, 0.4);
  draw.interference = draw.hub.yield / draw.hub.young * shaft_radius * dice.magnitude(0.3, 10);
  draw.pace = drawn_pace(dice, draw.hub, draw.contact, 4 * shaft_radius);
  draw.steps = 3 * dice.whole(6, 12);
  return draw;
}

std::string fit_materials(const FitDraw& draw) {
  return "materials:\n" + material_entry("steel", draw.shaft, "shaft") +
         material_entry("alloy", draw.hub, "hub");
}

/// A hub on a shaft that is pulled out of it and pushed back.
std::string axial_fit(const FitDraw& draw, double travel) {
  const int high = std::max(1, static_cast<int>(std::lround(draw.along * draw.wall / 12)));
  const double phase = draw.pace.phase;
  return fmt::format(
      "{}physics: axisymmetric\n{}supports:\n  - {{on: core, fix: x}}\n  - {{on: end, y: {{value: {:.5g}, "
      "function: pulls}}}}\n"
      "  - {{on: stop, fix: y}}\nfunctions:\n  fits: {{times: [0, {:.6g}], values: [0, 1]}}\n"
      "  pulls: {{times: [{:.6g}, {:.6g}, {:.6g}], values: [0, 1, 0]}}\ncontact:\n"
      "  joint: {{master: face, slave: bore, interference: {{value: {:.5g}, function: fits}}{}}}\n{}"
      "probes: {{grip: {{on: end, field: reaction}}}}\n",
      mesh_with(rectangle("shaft", {0, 0}, {shaft_radius, 40}, {3, 2 * draw.along}, draw.cells,
                          "left: core, bottom: end, right: face") +
                rectangle("hub", {shaft_radius, 14}, {shaft_radius + draw.wall, 26}, {high, draw.along},
                          draw.cells, "left: bore, top: stop")),
      fit_materials(draw), -travel, phase, phase, 2 * phase, 3 * phase, draw.interference, draw.contact.keys,
      even_time(draw.pace, 3, draw.steps));
}

/// A quarter of a disc in a quarter of a hub, fitted, loosened and fitted again.
std::string plane_fit(const FitDraw& draw) {
  const int high = std::max(2, static_cast<int>(std::lround(draw.along * draw.wall / 18)));
  const double phase = draw.pace.phase;
  constexpr double quarter = std::numbers::pi / 2;
  return fmt::format(
      "{}physics: plane_strain\n{}supports:\n  - {{on: across_shaft, fix: y}}\n  - {{on: across_hub, fix: "
      "y}}\n"
      "  - {{on: up_shaft, fix: x}}\n  - {{on: up_hub, fix: x}}\nfunctions:\n"
      "  fits: {{times: [0, {:.6g}, {:.6g}, {:.6g}], values: [0, 1, 0.2, 1.2]}}\ncontact:\n"
      "  joint: {{master: face, slave: bore, interference: {{value: {:.5g}, function: fits}}{}}}\n{}"
      "probes: {{rim: {{point: [{:.6g}, 0]}}}}\n",
      mesh_with(rectangle("shaft", {0, 0.4 * shaft_radius}, {quarter, shaft_radius}, {draw.along, 3},
                          draw.cells, "left: across_shaft, right: up_shaft, top: face") +
                rectangle("hub", {0, shaft_radius}, {quarter, shaft_radius + draw.wall}, {draw.along, high},
                          draw.cells, "left: across_hub, right: up_hub, bottom: bore")),
      fit_materials(draw), phase, 2 * phase, 3 * phase, draw.interference, draw.contact.keys,
      even_time(draw.pace, 3, draw.steps), shaft_radius + draw.wall);
}

} // namespace

/// Interferences from a third to ten times of that which yields.
SolidVariant press_fit(Dice& dice) {
  const auto draw = drawn_fit(dice);
  const bool axial = dice.chance(0.5);
  const double travel = dice.uniform(0.5, 6);
  SolidVariant variant;
  variant.steps = draw.steps;
  variant.shape.mapping = axial ? Mapping::none : Mapping::polar;
  variant.words =
      fmt::format("{} fit, {} {}, wall {:.2g}, hub {}, shaft {}, {}, interference {:.2g}{}, {}, {} steps",
                  axial ? "axial" : "plane", draw.cells, draw.along, draw.wall, draw.hub.words,
                  draw.shaft.words, draw.contact.words, draw.interference,
                  axial ? fmt::format(", travel {:.2g}", travel) : "", draw.pace.scheme, draw.steps);
  variant.deck = axial ? axial_fit(draw, travel) : plane_fit(draw);
  return variant;
}

namespace {

/// A rigid round bump slides under a cantilever, from before its tip, and back.
SolidVariant snap_hook(Dice& dice) {
  constexpr double length = 10;
  const auto cells = any_plane_cells(dice);
  const double thick = dice.uniform(0.8, 1.3);
  const int along = is_linear(cells) ? dice.whole(16, 30) : dice.whole(10, 18);
  const int across = is_linear(cells) ? dice.whole(2, 4) : dice.whole(1, 2);
  const auto kind = dice.one_of({"elastic", "metal", "rubber"});
  const auto material = kind == "rubber"  ? drawn_rubber(dice, 0.5, 5, 1.1e-9)
                        : kind == "metal" ? drawn_metal(dice, 70e3, 70, 350, "logarithmic", 2.7e-9)
                                          : drawn_elastic(2000, 0.35, ", strain: green_lagrange", 1.1e-9);
  const auto contact = drawn_contact(dice, 0.5, true);
  const double bump = dice.uniform(1, 2);
  const double height = bump * dice.uniform(0.1, 0.6);
  const double travel = bump + dice.uniform(0.2, 0.4) * length;
  const auto pace = drawn_pace(dice, material, contact, 60 * length);
  const int steps = 2 * dice.whole(16, 32);
  SolidVariant variant;
  variant.steps = steps;
  variant.words = fmt::format(
      "hook {:.2g} thick, {} {} × {}, {}, {}, bump {:.2g} over {:.2g}, travel {:.2g}, {}, {} steps", thick,
      cells, along, across, material.words, contact.words, bump, height, travel, pace.scheme, steps);
  variant.deck = fmt::format(
      "{}  groups: {{face: {{union: [under, nose]}}}}\nphysics: plane_strain\nmaterials:\n{}"
      "supports: [{{on: root, fix: [x, y]}}]\nfunctions:\n"
      "  moves: {{times: [0, {:.6g}, {:.6g}], values: [0, 1, 0]}}\ncontact:\n  bump: {{slave: face, "
      "obstacle: {{cylinder: "
      "{{point: [{:.6g}, {:.6g}], radius: {:.6g}}}, move: {{x: {{value: {:.6g}, function: moves}}}}}}{}}}\n{}"
      "probes: {{tip: {{point: [{}, 0]}}}}\n",
      mesh_with(rectangle("hook", {0, 0}, {length, thick}, {along, across}, cells,
                          "left: root, bottom: under, right: nose")),
      material_entry("stuff", material), pace.phase, 2 * pace.phase, length + bump + 0.1, height - bump, bump,
      -travel, contact.keys, even_time(pace, 2, steps), length);
  return variant;
}

/// A rigid ball goes through a ring that is too narrow for it, and back.
SolidVariant ball_through_ring(Dice& dice) {
  constexpr double ball = 10;
  const auto cells = any_plane_cells(dice);
  const int high = is_linear(cells) ? dice.whole(6, 12) : dice.whole(4, 7);
  const bool rubber = dice.chance(0.6);
  const auto material =
      rubber ? drawn_rubber(dice, 0.5, 5, 1.1e-9) : drawn_metal(dice, 70e3, 70, 350, "logarithmic", 2.7e-9);
  const auto contact = drawn_contact(dice, 0.4, true);
  const double narrow = rubber ? dice.uniform(0.03, 0.2) : dice.magnitude(0.001, 0.06);
  const double bore = ball * (1 - narrow);
  const double tall = dice.uniform(4, 8), wall = dice.uniform(3, 8);
  const auto pace = drawn_pace(dice, material, contact, 4 * ball);
  const int steps = 2 * dice.whole(20, 40);
  const double begin = -std::sqrt(ball * ball - bore * bore) - 0.2;
  const double travel = tall - 2 * begin;
  const int thick = std::max(2, static_cast<int>(std::lround(high * wall / tall)));
  SolidVariant variant;
  variant.steps = steps;
  variant.words = fmt::format(
      "ball through ring {:.2g} × {:.2g}, {} {} × {}, {}, {}, narrower by {:.2g} %, {}, {} steps", wall, tall,
      cells, thick, high, material.words, contact.words, 100 * narrow, pace.scheme, steps);
  variant.deck = fmt::format(
      "{}  groups: {{face: {{union: [under, bore, above]}}}}\nphysics: axisymmetric\nmaterials:\n{}"
      "supports: [{{on: rim, fix: y}}]\nfunctions:\n"
      "  moves: {{times: [0, {:.6g}, {:.6g}], values: [0, 1, 0]}}\ncontact:\n  ball: {{slave: face, "
      "obstacle: {{sphere: "
      "{{point: [0, {:.6g}], radius: {}}}, move: {{y: {{value: {:.6g}, function: moves}}}}}}{}}}\n{}"
      "probes: {{grip: {{on: rim, field: reaction}}}}\n",
      mesh_with(rectangle("ring", {bore, 0}, {bore + wall, tall}, {thick, high}, cells,
                          "left: bore, bottom: under, top: above, right: rim")),
      material_entry("stuff", material), pace.phase, 2 * pace.phase, begin, ball, travel, contact.keys,
      even_time(pace, 2, steps));
  return variant;
}

} // namespace

SolidVariant snap_fit(Dice& dice) {
  return dice.chance(0.5) ? snap_hook(dice) : ball_through_ring(dice);
}

} // namespace rubato::verification
