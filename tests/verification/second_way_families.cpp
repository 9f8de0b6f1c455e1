// SPDX-License-Identifier: LGPL-3.0-or-later
#include "verification/second_way_families.hpp"

#include <fmt/format.h>

#include "verification/second_way_scene.hpp"
#include <array>
#include <numbers>

namespace rubato::verification {
namespace {

/// A zone of two surfaces, either of which is the slave.
void pair_either(Scene& scene, const std::string& name, const std::string& a, const std::string& b) {
  const bool first = scene.dice().chance(0.5);
  scene.pair(name, first ? a : b, first ? b : a);
}

/// A rail that is held from below.
void add_rail(Scene& scene, double stiffness) {
  auto& dice = scene.dice();
  scene.add({.name = "rail",
             .from = {-3, -2},
             .to = {9, 0},
             .divisions = {dice.whole(12, 20), dice.whole(2, 3)},
             .sides = "top: above, bottom: ground",
             .stiffness = stiffness});
  scene.hold("ground");
  scene.probe("r_ground", "on: ground, field: reaction");
}

/// A block on the rail whose top is pressed down and moved along.
void add_dragged_block(Scene& scene, double squeeze, double travel) {
  auto& dice = scene.dice();
  scene.add({.name = "block",
             .from = {0, 0},
             .to = {4, 2},
             .divisions = {dice.whole(4, 8), dice.whole(2, 3)},
             .sides = "bottom: sole, top: held",
             .inset = dice.chance(0.5) ? 0.3 : 0});
  scene.hold("held", scene.moved(travel, "go"), scene.moved(-squeeze, "press"));
  scene.probe("r_held", "on: held, field: reaction");
  scene.probe("d_held", "on: held, take: mean");
  pair_either(scene, "joint", "sole", "above");
}

double drawn_squeeze(Scene& scene) {
  return scene.draw().strain == "small" ? scene.dice().magnitude(0.002, 0.02)
                                        : scene.dice().magnitude(0.01, 0.15);
}

} // namespace

WayStudy edged_block(Dice& dice) {
  Scene scene(dice, {});
  add_rail(scene, dice.magnitude(0.1, 10));
  const double squeeze = drawn_squeeze(scene);
  add_dragged_block(scene, squeeze, dice.chance(0.7) ? dice.uniform(0.1, 2) : 0);
  if (dice.chance(0.5))
    scene.form("block", Form::tilt, squeeze * dice.uniform(-4, 4));
  return scene.study(2, 2 * dice.whole(6, 11), {2, 0}, 2);
}

WayStudy nosed_block(Dice& dice) {
  Scene scene(dice, {});
  add_rail(scene, dice.magnitude(0.3, 10));
  const double squeeze = drawn_squeeze(scene);
  add_dragged_block(scene, squeeze, dice.uniform(0.1, 2));
  if (dice.chance(0.5))
    scene.form("block", Form::ski, dice.magnitude(0.02, 0.3));
  else
    scene.form("block", Form::wedge, squeeze * dice.magnitude(0.5, 4)); // a nose that faces resolve
  return scene.study(2, 2 * dice.whole(6, 11), {2, 0}, 2);
}

/// A cantilever that a crowned nose lifts and rubs along.
WayStudy hook(Dice& dice) {
  Scene scene(dice, {.solid = false, .turns = true});
  scene.add({.name = "beam",
             .from = {0, 0},
             .to = {10, 1},
             .divisions = {dice.whole(16, 24), 2},
             .sides = "left: root, bottom: under, right: tip"});
  scene.add({.name = "nose",
             .from = {6.5, -1.5},
             .to = {8.5, 0},
             .divisions = {dice.whole(6, 10), 3},
             .sides = "top: crest, bottom: foot",
             .stiffness = dice.magnitude(1, 10),
             .inset = dice.chance(0.5) ? 0.3 : 0});
  scene.form("nose", Form::crown_top, dice.uniform(0.1, 0.5));
  scene.hold("root");
  scene.hold("foot", scene.moved(-dice.uniform(0.5, 2), "go"), scene.moved(dice.uniform(0.2, 1), "press"));
  scene.probe("r_root", "on: root, field: reaction");
  scene.probe("d_tip", "on: tip, take: mean");
  scene.probe("d_foot", "on: foot, take: mean");
  pair_either(scene, "joint", "under", "crest");
  return scene.study(2, 2 * dice.whole(6, 11), {7.5, 0}, 2);
}

/// Half a ring between two plates.
WayStudy ring(Dice& dice) {
  Scene scene(dice, {.solid = false, .turns = true});
  constexpr double quarter = std::numbers::pi / 2;
  const double thick = dice.uniform(0.8, 2.5);
  scene.add({.name = "ring",
             .from = {-quarter, 5 - thick},
             .to = {quarter, 5},
             .divisions = {dice.whole(16, 24), 2},
             .sides = "left: head, right: heel, top: outside"});
  scene.form("ring", Form::polar, 1);
  for (const bool above : {false, true})
    scene.add({.name = above ? "lid" : "floor",
               .from = {0, above ? 5. : -6.},
               .to = {5, above ? 6. : -5.},
               .divisions = {dice.whole(8, 14), 1},
               .sides = above ? "bottom: lid_face, top: lid_held" : "top: floor_face, bottom: floor_held",
               .stiffness = dice.magnitude(1, 100)});
  scene.support("on: head, fix: x");
  scene.support("on: heel, fix: x");
  if (scene.draw().solid)
    scene.support("on: heel, fix: z");
  scene.hold("floor_held");
  scene.hold("lid_held", "0", scene.moved(-dice.uniform(0.3, 2), "press"));
  scene.probe("r_lid", "on: lid_held, field: reaction");
  scene.probe("d_lid", "on: lid_held, take: mean");
  scene.probe("d_head", "on: head, take: mean");
  scene.pair("below", "outside", "floor_face");
  scene.pair("above", "outside", "lid_face");
  return scene.study(1, dice.whole(10, 16), {0, 0}, 5);
}

/// A rounded block that a plate presses on a rail and rolls along.
WayStudy roller(Dice& dice) {
  Scene scene(dice, {.solid = false, .turns = true, .least_friction = 0.2});
  const int n = dice.whole(5, 8);
  add_rail(scene, dice.magnitude(1, 10));
  scene.add(
      {.name = "roll", .from = {1, 0}, .to = {5, 4}, .divisions = {n, n}, .sides = "bottom: low, top: high"});
  scene.form("roll", Form::crown, dice.uniform(0.05, 0.3));
  scene.form("roll", Form::crown_top, dice.uniform(0.05, 0.3));
  scene.add({.name = "plate",
             .from = {-1, 4},
             .to = {7, 5},
             .divisions = {dice.whole(10, 14), 1},
             .sides = "bottom: under, top: held",
             .stiffness = dice.magnitude(1, 10)});
  scene.hold("held", scene.moved(dice.uniform(0.05, 0.4), "go"),
             scene.moved(-dice.uniform(0.03, 0.2), "press"));
  scene.probe("r_held", "on: held, field: reaction");
  scene.probe("d_held", "on: held, take: mean");
  scene.probe("d_high", "on: high, take: mean");
  scene.pair("below", "low", "above");
  scene.pair("above", "high", "under");
  return scene.study(2, 2 * dice.whole(6, 11), {3, 2}, 2);
}

/// Half a wedge that is driven down beside a block.
WayStudy wedge(Dice& dice) {
  Scene scene(dice, {});
  const double slope = dice.uniform(0.1, 0.5);
  scene.add({.name = "wedge",
             .from = {0, 0},
             .to = {2, 4},
             .divisions = {2, dice.whole(6, 10)},
             .sides = "left: middle, right: flank, top: held"});
  scene.form("wedge", Form::slant, slope);
  scene.add({.name = "block",
             .from = {2 - slope, -1},
             .to = {6, 3},
             .divisions = {4, dice.whole(5, 9)},
             .sides = "left: face, right: wall",
             .stiffness = dice.magnitude(0.3, 10),
             .inset = dice.chance(0.5) ? 0.3 : 0});
  scene.form("block", Form::slant_back, slope);
  scene.support("on: middle, fix: x");
  scene.support(fmt::format("on: held, y: {}{}", scene.moved(-drawn_squeeze(scene) * 3, "press"),
                            scene.draw().solid ? ", z: 0" : ""));
  scene.hold("wall");
  scene.probe("r_held", "on: held, field: reaction");
  scene.probe("d_held", "on: held, take: mean");
  scene.probe("r_wall", "on: wall, field: reaction");
  pair_either(scene, "joint", "flank", "face");
  return scene.study(1, dice.whole(10, 16), {2, 1}, 2);
}

/// A thin soft lining between a block and a grip that squeezes and then moves along.
WayStudy lining(Dice& dice) {
  Scene scene(dice, {.least_friction = dice.chance(0.8) ? 0.2 : 0});
  scene.add({.name = "block",
             .from = {0, 0},
             .to = {5, 3},
             .divisions = {dice.whole(2, 4), dice.whole(2, 5)},
             .sides = "left: sym, right: face"});
  const double thick = dice.uniform(0.2, 1);
  scene.add({.name = "pad",
             .from = {5, 0},
             .to = {5 + thick, 3},
             .divisions = {dice.whole(1, 2), dice.whole(3, 8)},
             .sides = "left: lining, right: grip",
             .stiffness = dice.magnitude(0.005, 0.2)});
  scene.hold("sym");
  scene.hold("grip", scene.moved(-thick * drawn_squeeze(scene), "press"),
             scene.moved(thick * dice.magnitude(0.002, 0.1), "go"));
  scene.probe("r_grip", "on: grip, field: reaction");
  scene.probe("d_grip", "on: grip, take: mean");
  pair_either(scene, "joint", "lining", "face");
  return scene.study(2, 2 * dice.whole(6, 11), {5, 1.5}, 1.5);
}

/// A rounded rubber block in a groove under a lid.
WayStudy seal(Dice& dice) {
  Scene scene(dice, {.solid = false, .axisymmetric = true, .turns = true, .least_friction = 0.1});
  const int n = dice.whole(6, 10);
  const double young = scene.draw().young, bulk = young * dice.magnitude(3, 100);
  scene.add(
      {.name = "seal",
       .from = {20, 0},
       .to = {24, 4},
       .divisions = {n, n},
       .sides = "bottom: low, top: high, right: outer"},
      fmt::format("law: hyperelastic, c10: {:.6g}, c01: {:.6g}, bulk: {:.6g}", young / 8, young / 24, bulk));
  scene.form("seal", Form::rounded, dice.uniform(0.1, 0.6));
  scene.text().groups = "    skin: {union: [low, high, outer]}\n";
  const auto wall = [&](const std::string& name, std::array<double, 2> from, std::array<double, 2> to,
                        std::array<int, 2> divisions, const std::string& sides) {
    scene.add({.name = name, .from = from, .to = to, .divisions = divisions, .sides = sides},
              fmt::format("young: {:.6g}, poisson: 0.3", 50 * young));
  };
  wall("floor", {18, -1}, {26, 0}, {dice.whole(10, 16), 1}, "top: floor_face, bottom: floor_held");
  wall("lid", {18, 4}, {26, 5}, {dice.whole(10, 16), 1}, "bottom: lid_face, top: lid_held");
  scene.hold("floor_held");
  scene.hold("lid_held", "0", scene.moved(-dice.uniform(0.2, 0.7), "press"));
  scene.probe("r_lid", "on: lid_held, field: reaction");
  scene.probe("d_lid", "on: lid_held, take: mean");
  scene.pair("below", "skin", "floor_face");
  scene.pair("above", "skin", "lid_face");
  return scene.study(1, dice.whole(10, 16), {22, 2}, 2);
}

/// Two plates that washers clamp; one is pulled.
WayStudy bolted_plates(Dice& dice) {
  Scene scene(dice, {.least_friction = 0.1});
  const double young = scene.draw().young, l = scene.draw().length;
  scene.add({.name = "lower",
             .from = {0, 0},
             .to = {8, 1},
             .divisions = {8, 2},
             .sides = "left: wall, top: lower_face, bottom: nut_side"});
  scene.add({.name = "upper",
             .from = {4, 1},
             .to = {12, 2},
             .divisions = {12, 2},
             .sides = "right: pulled, bottom: upper_face, top: head_side",
             .stiffness = dice.magnitude(0.3, 3)});
  for (const auto* side : {"nut", "head"})
    scene.text().groups +=
        fmt::format("    {0}: {{box: {{from: [{1:.9g}, {2:.9g}{3}], to: [{4:.9g}, {5:.9g}{6}]}}, of: "
                    "{0}_side, take: faces}}\n",
                    side, 3.99 * l, -0.01 * l, scene.draw().solid ? fmt::format(", {:.9g}", -l) : "",
                    8.01 * l, 2.01 * l, scene.draw().solid ? fmt::format(", {:.9g}", 3 * l) : "");
  const double pressure = young * drawn_squeeze(scene) / 3;
  scene.load(fmt::format("surface_force: {{on: nut, y: {:.9g}, function: press}}", pressure));
  scene.load(fmt::format("surface_force: {{on: head, y: {:.9g}, function: press}}", -pressure));
  scene.hold("wall");
  scene.hold("pulled", scene.moved(dice.uniform(0.1, 3) * 8 * pressure / young, "go"));
  scene.probe("r_wall", "on: wall, field: reaction");
  scene.probe("d_head", "on: head, take: mean");
  pair_either(scene, "joint", "lower_face", "upper_face");
  return scene.study(2, 2 * dice.whole(6, 11), {6, 1}, 2);
}

/// Three blocks on each other, pressed and bent.
WayStudy stack(Dice& dice) {
  Scene scene(dice, {.axisymmetric = true, .least_friction = 0.1});
  const double young = scene.draw().young;
  const std::array names{"low", "mid", "top"};
  for (std::size_t i = 0; i < names.size(); ++i)
    scene.add({.name = names[i],
               .from = {3, 2. * static_cast<double>(i)},
               .to = {7 + (i == 1 ? 0 : dice.uniform(-0.5, 0.5)), 2. * static_cast<double>(i) + 2},
               .divisions = {dice.whole(3, 7), dice.whole(2, 3)},
               .sides = fmt::format("bottom: under_{0}, top: over_{0}", names[i]),
               .stiffness = dice.magnitude(0.3, 3)});
  scene.hold("under_low");
  const double pressure = young * drawn_squeeze(scene) / 3;
  scene.load(fmt::format("surface_force: {{on: over_top, x: {:.9g}, y: {:.9g}, function: press}}",
                         scene.draw().axisymmetric ? 0 : pressure * scene.draw().friction / 4, -pressure));
  scene.probe("r_ground", "on: under_low, field: reaction");
  scene.probe("d_roof", "on: over_top, take: mean");
  pair_either(scene, "first", "over_low", "under_mid");
  pair_either(scene, "second", "over_mid", "under_top");
  return scene.study(1, dice.whole(8, 14), {5, 2}, 2);
}

/// A crowned punch on a block.
WayStudy punch(Dice& dice) {
  Scene scene(dice, {});
  add_rail(scene, dice.magnitude(0.1, 10));
  const double squeeze = drawn_squeeze(scene);
  add_dragged_block(scene, squeeze, 0);
  scene.form("block", Form::crown, squeeze * dice.magnitude(0.3, 4));
  return scene.study(1, dice.whole(10, 16), {2, 0}, 2);
}

/// A free block that flies against one that is held.
WayStudy impact(Dice& dice) {
  Scene scene(dice, {.dynamic_only = true});
  add_rail(scene, dice.magnitude(0.3, 10));
  const double mach = dice.magnitude(0.001, 0.02); // speed over that of sound
  const double gap = 0.2 * mach * 10 * scene.draw().transits;
  scene.add({.name = "block",
             .from = {1, gap},
             .to = {5, 3 + gap},
             .divisions = {dice.whole(3, 7), dice.whole(3, 5)},
             .sides = "bottom: sole, top: roof"});
  if (dice.chance(0.3))
    scene.form("block", Form::crown, dice.uniform(0.02, 0.2));
  const double crossing = scene.draw().phase / scene.draw().transits; // of ten units of length
  const double speed = mach * 10 * scene.draw().length / crossing;
  scene.text().initial = fmt::format("  - {{on: block, velocity: {{x: {:.9g}, y: {:.9g}}}}}\n",
                                     dice.chance(0.5) ? dice.uniform(-0.5, 0.5) * speed : 0., -speed);
  scene.probe("d_roof", "on: roof, take: mean");
  pair_either(scene, "joint", "sole", "above");
  return scene.study(1, dice.whole(16, 30), {3, 0}, 2);
}

} // namespace rubato::verification
