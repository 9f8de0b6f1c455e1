// SPDX-License-Identifier: LGPL-3.0-or-later
// Two beams as in SDNL140 whose bodies yield or stretch.
#include <fmt/format.h>

#include "verification/solids_sweep.hpp"
#include "verification/sweep_draws.hpp"
#include <algorithm>
#include <cmath>

namespace rubato::verification {
namespace {

constexpr double height = 0.1; ///< length 1, both in m
/// Period of the first bending mode of one beam of that length and height, times the speed of sound.
constexpr double period_by_speed = 61.9;

struct BeamDraw {
  std::string cells;
  bool plane = false;
  bool plane_stress = false;
  int along = 0;
  int along_lower = 0;
  int across = 1;
  double gap = 0;
  DrawnMaterial material;
  DrawnContact contact;
  std::string scheme; ///< empty: static
  double step = 0;
  int steps = 0;
  double force = 0;  ///< at the tip, of a unit of thickness [force/length]
  double travel = 0; ///< of the tip in static variants [length]
  bool turns_back = false;
};

void draw_cells(Dice& dice, BeamDraw& draw) {
  draw.plane = dice.chance(0.65);
  draw.cells = draw.plane ? dice.one_of({"quad4", "quad4", "quad8", "tria6"})
                          : dice.one_of({"hexa8", "hexa8", "hexa20", "penta6", "tetra10"});
  draw.plane_stress = draw.plane && dice.chance(0.5);
  draw.along = draw.plane ? dice.whole(10, 24) : dice.whole(6, 10);
  draw.along_lower = dice.chance(0.5) ? draw.along : dice.whole(draw.along - 3, draw.along + 3);
  draw.across = draw.plane || draw.cells == "hexa8" ? 2 : 1;
  const double place = dice.uniform(0, 1);
  if (place < 0.2)
    draw.gap = dice.magnitude(1e-6, 5e-3);
}

/// Steps from a hundredth to a tenth of the period of one beam.
void draw_time(Dice& dice, BeamDraw& draw) {
  draw.steps = dice.whole(12, 24);
  draw.turns_back = dice.chance(0.5);
  const bool dynamic = dice.chance(0.7);
  const double part = dice.magnitude(0.01, 0.1);
  if (!dynamic) {
    draw.step = 1. / draw.steps;
    return;
  }
  draw.scheme = drawn_scheme(dice, draw.contact.exact);
  draw.step = part * period_by_speed * std::sqrt(draw.material.density / draw.material.young);
}

std::string body(const BeamDraw& draw, const std::string& name, double bottom, int along,
                 const std::string& groups) {
  const double top = bottom + height;
  if (draw.plane)
    return fmt::format("    - {{name: {}, rectangle: {{from: [0, {:.9g}], to: [1, {:.9g}]}}, divisions: "
                       "[{}, {}], cells: {}, {}}}\n",
                       name, bottom, top, along, draw.across, draw.cells, groups);
  return fmt::format("    - {{name: {}, box: {{from: [0, {:.9g}, 0], to: [1, {:.9g}, 0.1]}}, divisions: "
                     "[{}, {}, 1], cells: {}, {}}}\n",
                     name, bottom, top, along, draw.across, draw.cells, groups);
}

/// Static variants move the tip, whatever force that takes.
std::string loading_of(const BeamDraw& draw) {
  const auto* fixed = draw.plane ? "[x, y]" : "[x, y, z]";
  const auto held =
      fmt::format("supports: [{{on: upper_clamp, fix: {0}}}, {{on: lower_clamp, fix: {0}}}", fixed);
  if (draw.scheme.empty())
    return fmt::format("{}, {{on: loaded, y: {{value: {:.5g}, function: history}}}}]\n", held, -draw.travel);
  return fmt::format("{}]\nloads: [{{{}: {{on: loaded, y: {:.5g}, function: history}}}}]\n", held,
                     draw.plane ? "nodal_force" : "line_force", -draw.force);
}

std::string history_of(const BeamDraw& draw) {
  const double end = draw.steps * draw.step;
  if (!draw.scheme.empty() && !draw.turns_back)
    return fmt::format("{{times: [0, {:.5g}], values: [1, 1]}}", end);
  if (!draw.scheme.empty())
    return fmt::format("{{times: [0, {:.5g}, {:.5g}], values: [1, 1, -0.3]}}", 0.5 * end, end);
  return draw.turns_back ? fmt::format("{{times: [0, {:.5g}, {:.5g}], values: [0, 1, 0.2]}}", 0.6 * end, end)
                         : fmt::format("{{times: [0, {:.5g}], values: [0, 1]}}", end);
}

std::string deck_of(const BeamDraw& draw) {
  const auto* loaded = draw.plane ? "points: {right_top: loaded}" : "edges: {right_top: loaded}";
  return fmt::format(
      "mesh:\n  generate:\n{}{}physics: {}\nmaterials:\n{}{}functions: {{history: {}}}\ncontact:\n"
      "  interface: {{master: upper_face, slave: lower_face, exclude_nodes: [lower_clamp]{}}}\n"
      "time: {{{}, step: {:.6g}, end: {:.9g}}}\nprobes: {{tip: {{on: loaded, take: mean}}}}\n",
      body(draw, "upper", 0, draw.along,
           fmt::format("sides: {{left: upper_clamp, bottom: upper_face}}, {}", loaded)),
      body(draw, "lower", -height - draw.gap, draw.along_lower,
           "sides: {left: lower_clamp, top: lower_face}"),
      !draw.plane         ? "solid"
      : draw.plane_stress ? "plane_stress"
                          : "plane_strain",
      material_entry("metal", draw.material), loading_of(draw), history_of(draw), draw.contact.keys,
      draw.scheme.empty() ? "scheme: static" : draw.scheme, draw.step, draw.steps * draw.step);
}

std::string words_of(const BeamDraw& draw) {
  const auto* physics = !draw.plane ? "" : draw.plane_stress ? " plane stress" : " plane strain";
  const auto load = draw.scheme.empty()
                        ? fmt::format("static to {:.2g}", draw.travel)
                        : fmt::format("{}, {:.2g}, h {:.1e}", draw.scheme, draw.force, draw.step);
  return fmt::format("{}{} {}/{}{}, {}, {}, {}{}, {} steps", draw.cells, physics, draw.along,
                     draw.along_lower, draw.gap > 0 ? fmt::format(", gap {:.1e}", draw.gap) : "",
                     draw.material.words, draw.contact.words, load, draw.turns_back ? " and back" : "",
                     draw.steps);
}

SolidVariant variant_of(const BeamDraw& draw) {
  SolidVariant variant;
  variant.words = words_of(draw);
  variant.steps = draw.steps;
  variant.deck = deck_of(draw);
  return variant;
}

/// Of one beam that moves its tip so far, were it elastic and straight [force/length].
double bending_force(const DrawnMaterial& material, double travel) {
  return material.young * height * height * height / 4 * travel;
}

/// That turns both beams, rigid but for hinges at their clamps, until their tips have gone by a third of
/// their length [force/length].
double force_of_hinges(const BeamDraw& draw) {
  const double duration = draw.steps * draw.step;
  return 2. / 3 * draw.material.density * height * 2. / 3 / (duration * duration);
}

DrawnMaterial stretched_material(Dice& dice, const BeamDraw& draw) {
  const auto kind = dice.one_of({"elastic", "rubber", "rubber", "metal"});
  if (kind == "rubber")
    return drawn_rubber(dice, 0.3e6, 3e6, 1100);
  if (kind == "metal")
    return drawn_metal(dice, 70e9, 70e6, 350e6, "logarithmic", 2700);
  const bool enhanced = dice.chance(0.4) && (draw.cells == "quad4" || draw.cells == "hexa8");
  return drawn_elastic(200e9, 0.3,
                       std::string(", strain: green_lagrange") + (enhanced ? ", formulation: enhanced" : ""),
                       7800);
}

} // namespace

/// Loads from a twentieth of what both beams carry to five times that. Static tips go from a third of their
/// elastic travel to thirty times that.
SolidVariant plastic_beams(Dice& dice) {
  BeamDraw draw;
  draw_cells(dice, draw);
  const auto strain = dice.one_of({"small", "logarithmic"});
  draw.material = drawn_metal(dice, 200e9, 200e6, 800e6, strain, 7800);
  draw.contact = drawn_contact(dice, 0.8);
  draw_time(dice, draw);
  const double carried = 2 * draw.material.yield * height * height / 4;
  draw.force = std::min(carried * dice.magnitude(0.05, 5), carried + force_of_hinges(draw));
  const double elastic = draw.material.yield / (1.5 * draw.material.young * height);
  draw.travel = std::min(0.2, elastic * dice.magnitude(0.3, 30));
  return variant_of(draw);
}

/// Tips that go by a two-hundredth to a half of the length.
SolidVariant stretched_beams(Dice& dice) {
  BeamDraw draw;
  draw_cells(dice, draw);
  draw.material = stretched_material(dice, draw);
  draw.contact = drawn_contact(dice, 0.8);
  draw_time(dice, draw);
  draw.travel = dice.magnitude(0.005, 0.5);
  draw.force = bending_force(draw.material, draw.travel);
  if (draw.material.yield > 0)
    draw.force = std::min(draw.force, draw.material.yield * height * height);
  return variant_of(draw);
}

} // namespace rubato::verification
