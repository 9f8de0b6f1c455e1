// SPDX-License-Identifier: LGPL-3.0-or-later
#include "verification/second_way_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rubato::verification {
namespace {

constexpr double scene_depth = 2;

bool is_linear_cell(const std::string& cells) {
  return cells == "quad4" || cells == "tria3" || cells == "hexa8" || cells == "tetra4" || cells == "penta6";
}

std::string drawn_cells(Dice& dice, bool solid, bool linear) {
  if (solid && linear)
    return dice.one_of({"hexa8", "tetra4", "penta6"});
  return solid ? dice.one_of(
                     {"hexa8", "hexa8", "hexa8", "tetra4", "tetra4", "penta6", "penta6", "hexa20", "tetra10"})
               : dice.one_of({"quad4", "quad4", "tria3", "quad8", "tria6", "quad9", "tria7"});
}

std::string drawn_scheme_word(Dice& dice, bool dynamic_only) {
  if (!dynamic_only && dice.chance(0.55))
    return "static";
  return dice.one_of({"hht", "moreau_jean"});
}

/// From 0 to 1 over [begin, begin + phase], with slope 0 at both ends.
std::string smooth_ramp(double begin, double phase) {
  const auto part = fmt::format("min(max((t-{:.9g})/{:.9g},0),1)", begin, phase);
  return fmt::format("{{expression: \"{0}^2*(3-2*{0})\"}}", part);
}

std::string time_part(const SceneDraw& draw, double step, double end) {
  return fmt::format("time: {{scheme: {}{}, step: {:.9g}, end: {:.9g}}}\n", draw.scheme,
                     draw.scheme == "hht" ? ", alpha: -0.1" : "", step, end);
}

std::string section_of(std::string_view key, const std::string& entries) {
  return entries.empty() ? "" : fmt::format("{}:\n{}", key, entries);
}

} // namespace

Scene::Scene(Dice& dice, const SceneRules& rules) : dice_(dice) {
  draw_.solid = rules.solid && dice.chance(0.1);
  draw_.axisymmetric = rules.axisymmetric && !draw_.solid && dice.chance(0.3);
  const bool small = !rules.turns && dice.chance(draw_.solid ? 1 : 0.6);
  draw_.strain = small ? "small" : dice.one_of({"green_lagrange", "logarithmic"});
  draw_.friction = rules.least_friction > 0 || dice.chance(0.7) ? dice.uniform(rules.least_friction, 0.6) : 0;
  draw_.length = std::array{1e-3, 1., 25.4}[static_cast<std::size_t>(dice.whole(0, 2))];
  draw_.young = dice.magnitude(1, 1e11);
  draw_.phase = dice.magnitude(1e-3, 10);
  draw_.scheme = drawn_scheme_word(dice, rules.dynamic_only);
  draw_.transits = draw_.scheme == "static" ? 200
                   : rules.dynamic_only     ? dice.magnitude(1, 4)
                                            : dice.magnitude(10, 60);
  words_ = fmt::format("{}, {}, μ {:.2f}", draw_.scheme, draw_.strain, draw_.friction);
}

void Scene::add(const SceneBody& body) {
  const bool plastic = draw_.strain == "logarithmic" && dice_.chance(0.25);
  const double young = body.stiffness * draw_.young;
  add(body, plastic
                ? fmt::format("law: plastic, young: {:.6g}, poisson: 0.3, strain: logarithmic, hardening: "
                              "{{linear: {{yield_stress: {:.6g}, modulus: {:.6g}}}}}",
                              young, 0.01 * young, 0.1 * young)
                : fmt::format("young: {:.6g}, poisson: {:.3f}, strain: {}", young, dice_.uniform(0.1, 0.4),
                              draw_.strain));
}

void Scene::add(const SceneBody& body, const std::string& material) {
  const auto cells = drawn_cells(dice_, draw_.solid, draw_.strain != "small");
  auto divisions = body.divisions;
  if (draw_.solid)
    divisions[0] = (2 * divisions[0] + 2) / 3;
  if (!is_linear_cell(cells))
    for (auto& n : divisions)
      n = std::max(1, (n + 1) / 2);
  const double l = draw_.length;
  bodies_.push_back(body);
  linear_ = linear_ && is_linear_cell(cells);
  words_ += fmt::format(", {} {} {} × {}", body.name, cells, divisions[0], divisions[1]);
  if (material.starts_with("law: plastic"))
    words_ += " plastic";
  if (draw_.solid) {
    const int deep = is_linear_cell(cells) ? dice_.whole(1, 2) : 1;
    text_.bodies += fmt::format(
        "    - {{name: {}, box: {{from: [{:.9g}, {:.9g}, {:.9g}], to: [{:.9g}, {:.9g}, {:.9g}]}}, divisions: "
        "[{}, {}, {}], cells: {}, sides: {{{}}}}}\n",
        body.name, l * body.from[0], l * body.from[1], l * body.inset, l * body.to[0], l * body.to[1],
        l * (scene_depth - body.inset), divisions[0], divisions[1], deep, cells, body.sides);
  } else {
    text_.bodies +=
        fmt::format("    - {{name: {}, rectangle: {{from: [{:.9g}, {:.9g}], to: [{:.9g}, {:.9g}]}}, "
                    "divisions: [{}, {}], cells: {}, sides: {{{}}}}}\n",
                    body.name, l * body.from[0], l * body.from[1], l * body.to[0], l * body.to[1],
                    divisions[0], divisions[1], cells, body.sides);
  }
  const double crossing = draw_.phase / draw_.transits; // of ten units of length
  const double density = draw_.young * std::pow(crossing / (10 * l), 2);
  text_.materials +=
      fmt::format("  {}: {{{}, density: {:.6g}, cells: {}}}\n", body.name, material, density, body.name);
}

void Scene::form(const std::string& body, Form form, double amount) {
  const auto found = std::ranges::find(bodies_, body, &SceneBody::name);
  Forming forming{body, form, amount, found->from, found->to};
  for (auto* corner : {&forming.from, &forming.to}) {
    if (form != Form::polar)
      (*corner)[0] *= draw_.length;
    (*corner)[1] *= draw_.length;
  }
  if (form == Form::crown || form == Form::crown_top || form == Form::polar)
    forming.amount *= draw_.length;
  forms_.push_back(forming);
}

void Scene::hold(const std::string& group, const std::string& x, const std::string& y) {
  support(fmt::format("on: {}, x: {}, y: {}{}", group, x, y, draw_.solid ? ", z: 0" : ""));
}

void Scene::support(const std::string& text) {
  text_.supports += fmt::format("  - {{{}}}\n", text);
}

std::string Scene::moved(double by, std::string_view function) const {
  return fmt::format("{{value: {:.9g}, function: {}}}", by * draw_.length, function);
}

void Scene::load(const std::string& text) {
  text_.loads += fmt::format("  - {{{}}}\n", text);
}

void Scene::pair(const std::string& name, const std::string& slave, const std::string& master) {
  pairs_.push_back({name, slave, master});
}

void Scene::probe(const std::string& name, const std::string& text) {
  text_.probes += fmt::format("  {}: {{{}}}\n", name, text);
}

WayStudy Scene::study(int phases, int steps, std::array<double, 2> about, double arm) const {
  WayStudy study;
  if (draw_.solid)
    steps /= 2;
  if (draw_.scheme != "static")
    steps *= 2;
  study.solid = draw_.solid;
  study.finest = draw_.solid || draw_.strain != "small" ? 2 : 3;
  study.fast_explicit = linear_ && draw_.scheme != "static";
  study.stiff_spring = 100 * draw_.young / draw_.length;
  study.forms = forms_;
  study.pairs = pairs_;
  study.scheme = draw_.scheme;
  study.step = draw_.phase * phases / steps;
  study.arm = arm * draw_.length;
  study.words = fmt::format("{}, {} steps", words_, steps);
  std::string contact, probes = text_.probes;
  for (const auto& pair : pairs_) {
    contact += fmt::format("  {}: {{slave: {}, master: {}, friction: {:.4f}}}\n", pair.name, pair.slave,
                           pair.master, draw_.friction);
    probes += fmt::format("  zone_{0}: {{contact: {{zone: {0}, about: [{1:.9g}, {2:.9g}{3}]}}}}\n", pair.name,
                          about[0] * draw_.length, about[1] * draw_.length,
                          draw_.solid ? fmt::format(", {:.9g}", draw_.length * scene_depth / 2) : "");
  }
  study.deck = fmt::format("mesh:\n  generate:\n{}{}physics: {}\nmaterials:\n{}functions:\n  press: {}\n  "
                           "go: {}\n{}{}{}contact:\n{}"
                           "probes:\n{}{}checkpoint: {{last: false}}\n",
                           text_.bodies, text_.groups.empty() ? "" : "  groups:\n" + text_.groups,
                           draw_.solid          ? "solid"
                           : draw_.axisymmetric ? "axisymmetric"
                                                : "plane_strain",
                           text_.materials, smooth_ramp(0, draw_.phase),
                           smooth_ramp(draw_.phase, draw_.phase), section_of("supports", text_.supports),
                           section_of("loads", text_.loads), section_of("initial", text_.initial), contact,
                           probes, time_part(draw_, study.step, draw_.phase * phases));
  return study;
}

} // namespace rubato::verification
