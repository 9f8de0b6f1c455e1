// SPDX-License-Identifier: LGPL-3.0-or-later
// A block of rubber or metal between plates: squeezed, moved sideways and back. In mm, N, t, s.
#include <fmt/format.h>

#include "verification/solids_sweep.hpp"
#include "verification/sweep_draws.hpp"
#include <algorithm>
#include <cmath>

namespace rubato::verification {
namespace {

constexpr double width = 20;
constexpr double plate = 4;  ///< thickness
constexpr double beyond = 8; ///< that plates reach out of the block on each side

struct BlockDraw {
  std::string cells;
  bool plane = false;
  double height = 0;
  int along = 0;
  int high = 0;
  DrawnMaterial material;
  DrawnContact contact;
  bool rigid = false;  ///< plates
  bool bonded = false; ///< to the lower one
  double squeeze = 0;  ///< of the height
  double slide = 0;    ///< [length]
  int squeezing = 0;   ///< steps
  int sliding = 0;     ///< steps, there and likewise back
  std::string scheme;  ///< empty: static
  double phase = 1;    ///< how long each of the three takes [time]
};

void draw_cells(Dice& dice, BlockDraw& draw) {
  draw.plane = dice.chance(0.7);
  draw.cells = draw.plane ? dice.one_of({"quad4", "quad4", "quad8", "tria6"})
                          : dice.one_of({"hexa8", "hexa8", "hexa20", "penta6", "tetra10"});
  draw.height = dice.uniform(8, 16);
  const bool linear = draw.cells == "quad4" || draw.cells == "hexa8" || draw.cells == "penta6";
  draw.along = draw.plane ? dice.whole(6, 12) : dice.whole(3, 5);
  if (draw.plane && !linear)
    draw.along = dice.whole(4, 8);
  if (!draw.plane && !linear)
    draw.along = dice.whole(2, 3);
  draw.high = std::max(2, static_cast<int>(std::lround(draw.along * draw.height / width)));
}

/// Corners of a block that sticks roll onto the plates; quadratic cells there bear less.
void draw_motion(Dice& dice, BlockDraw& draw) {
  const bool linear = draw.cells == "quad4" || draw.cells == "hexa8" || draw.cells == "penta6";
  const double most = draw.contact.friction < 0.15 && !draw.bonded ? 0.5 : linear ? 0.35 : 0.25;
  draw.squeeze = dice.uniform(0.1, most);
  draw.slide = dice.uniform(0.1, 0.4) * draw.height;
  draw.squeezing = static_cast<int>(std::ceil(draw.squeeze / dice.magnitude(0.01, 0.04)));
  draw.sliding = dice.whole(5, 10);
}

/// Slow beside the sound through the block.
void draw_scheme(Dice& dice, BlockDraw& draw) {
  if (dice.chance(0.7))
    return;
  draw.scheme = drawn_scheme(dice, draw.contact.exact);
  draw.phase = draw.height * std::sqrt(draw.material.density / draw.material.young) * dice.magnitude(20, 200);
}

std::string grid(const BlockDraw& draw, const std::string& name, double from, double to, double bottom,
                 double top, int along, int high, const std::string& sides) {
  if (draw.plane)
    return fmt::format("    - {{name: {}, rectangle: {{from: [{:.6g}, {:.6g}], to: [{:.6g}, {:.6g}]}}, "
                       "divisions: [{}, {}], cells: {}, sides: {{{}}}}}\n",
                       name, from, bottom, to, top, along, high, draw.cells, sides);
  const int deep = std::max(2, along / 2);
  return fmt::format(
      "    - {{name: {}, box: {{from: [{:.6g}, {:.6g}, {:.6g}], to: [{:.6g}, {:.6g}, {:.6g}]}}, "
      "divisions: [{}, {}, {}], cells: {}, sides: {{{}}}}}\n",
      name, from, bottom, 0.5 * from, to, top, 0.5 * to, along, high, deep, draw.cells, sides);
}

std::string mesh_of(const BlockDraw& draw) {
  const double half = width / 2;
  auto mesh = "mesh:\n  generate:\n" + grid(draw, "block", -half, half, 0, draw.height, draw.along, draw.high,
                                            "bottom: foot, top: head");
  if (draw.rigid)
    return mesh;
  const int wide = std::max(3, draw.along + 1);
  mesh += grid(draw, "upper", -half - beyond, half + beyond, draw.height, draw.height + plate, wide, 1,
               "bottom: upper_face, top: driven");
  if (!draw.bonded)
    mesh += grid(draw, "lower", -half - beyond, half + beyond, -plate, 0, wide, 1,
                 "top: lower_face, bottom: ground");
  return mesh;
}

std::string motion_of(const BlockDraw& draw) {
  return fmt::format("x: {{value: {:.5g}, function: slides}}, y: {{value: {:.5g}, function: presses}}",
                     draw.slide, -draw.squeeze * draw.height);
}

std::string supports_of(const BlockDraw& draw) {
  const auto* fixed = draw.plane ? "[x, y]" : "[x, y, z]";
  std::string entries;
  if (draw.bonded)
    entries += fmt::format("  - {{on: foot, fix: {}}}\n", fixed);
  else if (!draw.rigid)
    entries += fmt::format("  - {{on: ground, fix: {}}}\n", fixed);
  if (!draw.rigid)
    entries += fmt::format("  - {{on: driven, {}{}}}\n", motion_of(draw), draw.plane ? "" : ", fix: z");
  return entries.empty() ? "" : "supports:\n" + entries;
}

std::string contact_of(const BlockDraw& draw) {
  const auto* keys = draw.contact.keys.c_str();
  const auto place = [&](double y) {
    return draw.plane ? fmt::format("[0, {:.6g}]", y) : fmt::format("[0, {:.6g}, 0]", y);
  };
  const auto up = [&](int y) {
    return draw.plane ? fmt::format("[0, {}]", y) : fmt::format("[0, {}, 0]", y);
  };
  std::string zones = "contact:\n";
  if (!draw.rigid) {
    zones += fmt::format("  above: {{master: upper_face, slave: head{}}}\n", keys);
    if (!draw.bonded)
      zones += fmt::format("  below: {{master: lower_face, slave: foot{}}}\n", keys);
    return zones;
  }
  zones += fmt::format(
      "  above: {{slave: head, obstacle: {{plane: {{point: {}, normal: {}}}, move: {{{}}}}}{}}}\n",
      place(draw.height), up(-1), motion_of(draw), keys);
  if (!draw.bonded)
    zones += fmt::format("  below: {{slave: foot, obstacle: {{plane: {{point: {}, normal: {}}}}}{}}}\n",
                         place(0), up(1), keys);
  return zones;
}

/// Uneven steps: those of squeezing are not those of sliding.
std::string time_of(const BlockDraw& draw) {
  std::string instants;
  const auto add = [&](double begin, int steps) {
    for (int i = 1; i <= steps; ++i)
      instants += fmt::format("{}{:.9g}", instants.empty() ? "" : ", ",
                              draw.phase * (begin + static_cast<double>(i) / steps));
  };
  add(0, draw.squeezing);
  add(1, draw.sliding);
  add(2, draw.sliding);
  return fmt::format("time: {{{}, instants: [{}]}}\n", draw.scheme.empty() ? "scheme: static" : draw.scheme,
                     instants);
}

std::string deck_of(const BlockDraw& draw) {
  const double phase = draw.phase;
  return fmt::format(
      "{}physics: {}\nmaterials:\n{}{}functions:\n  presses: {{times: [0, {:.6g}], values: [0, 1]}}\n"
      "  slides: {{times: [{:.6g}, {:.6g}, {:.6g}], values: [0, 1, 0]}}\n{}{}{}probes: {{middle: {{point: "
      "{}}}}}\n",
      mesh_of(draw), draw.plane ? "plane_strain" : "solid",
      material_entry("core", draw.material, draw.rigid ? "" : "block"),
      draw.rigid
          ? ""
          : material_entry("hard", drawn_elastic(50 * draw.material.young, 0.3, "", draw.material.density),
                           draw.bonded ? "upper" : "[upper, lower]"),
      phase, phase, 2 * phase, 3 * phase, supports_of(draw), contact_of(draw), time_of(draw),
      draw.plane ? fmt::format("[{}, {:.6g}]", width / 2, draw.height / 2)
                 : fmt::format("[{}, {:.6g}, 0]", width / 2, draw.height / 2));
}

std::string words_of(const BlockDraw& draw) {
  return fmt::format(
      "{} {} × {}, height {:.3g}, {}, {} plates{}, {}, by {:.0f} %, slides {:.2g}, {}, {} + 2 × {} steps",
      draw.cells, draw.along, draw.high, draw.height, draw.material.words, draw.rigid ? "rigid" : "elastic",
      draw.bonded ? ", bonded" : "", draw.contact.words, 100 * draw.squeeze, draw.slide,
      draw.scheme.empty() ? "static" : draw.scheme, draw.squeezing, draw.sliding);
}

} // namespace

SolidVariant squeezed_block(Dice& dice) {
  BlockDraw draw;
  draw_cells(dice, draw);
  draw.material = dice.chance(0.55) ? drawn_rubber(dice, 0.3, 3, 1.1e-9)
                                    : drawn_metal(dice, 70e3, 70, 350, "logarithmic", 2.7e-9);
  draw.rigid = dice.chance(0.6);
  draw.contact = drawn_contact(dice, 0.8, draw.rigid);
  // What nothing but friction holds must be able to be held by it.
  draw.bonded = dice.chance(0.6) || draw.contact.friction < 0.1;
  draw_motion(dice, draw);
  draw_scheme(dice, draw);
  SolidVariant variant;
  variant.words = words_of(draw);
  variant.steps = draw.squeezing + 2 * draw.sliding;
  variant.deck = deck_of(draw);
  return variant;
}

} // namespace rubato::verification
