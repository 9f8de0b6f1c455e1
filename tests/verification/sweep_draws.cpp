// SPDX-License-Identifier: LGPL-3.0-or-later
#include "verification/sweep_draws.hpp"

#include <fmt/format.h>

#include <utility>

namespace rubato::verification {
namespace {

struct Hardening {
  std::string keys;
  std::string words;
};

Hardening linear_hardening(double yield, double modulus) {
  return {fmt::format("hardening: {{linear: {{yield_stress: {:.4g}, modulus: {:.4g}}}}}", yield, modulus),
          fmt::format("H {:.2g}", modulus)};
}

Hardening with_back_stress(Dice& dice, double young, double yield, bool recalls) {
  auto hardening = linear_hardening(yield, young * dice.magnitude(1e-4, 1e-2));
  const double modulus = young * dice.magnitude(0.02, 0.3);
  const double recall = recalls ? dice.magnitude(30, 500) : 0;
  hardening.keys += fmt::format(", kinematic: {{modulus: {:.4g}, recall: {:.4g}}}", modulus, recall);
  hardening.words = recalls ? fmt::format("Armstrong–Frederick {:.2g}, {:.3g}", modulus, recall)
                            : fmt::format("Prager {:.2g}", modulus);
  return hardening;
}

Hardening drawn_hardening(Dice& dice, double young, double yield) {
  const auto kind = dice.one_of({"linear", "ideal", "table", "voce", "prager", "recall", "johnson_cook"});
  if (kind == "linear")
    return linear_hardening(yield, young * dice.magnitude(1e-3, 0.1));
  if (kind == "ideal")
    return linear_hardening(yield, 0);
  if (kind == "prager" || kind == "recall")
    return with_back_stress(dice, young, yield, kind == "recall");
  if (kind == "table")
    return {fmt::format("hardening: {{table: [[0, {:.4g}], [0.01, {:.4g}], [0.1, {:.4g}]]}}", yield,
                        1.2 * yield, 1.5 * yield),
            "table"};
  if (kind == "voce")
    return {fmt::format("hardening: {{voce: {{yield_stress: {:.4g}, saturation: {:.4g}, exponent: {:.3g}}}}}",
                        yield, yield * dice.magnitude(0.1, 1), dice.magnitude(5, 50)),
            "Voce"};
  return {fmt::format("hardening: {{johnson_cook: {{yield_stress: {:.4g}, factor: {:.4g}, exponent: {:.3g}, "
                      "rate_factor: {:.3g}, reference_rate: 1}}}}",
                      yield, yield * dice.uniform(0.3, 1.2), dice.uniform(0.2, 0.6),
                      dice.magnitude(0.005, 0.05)),
          "Johnson–Cook"};
}

} // namespace

DrawnMaterial drawn_metal(Dice& dice, double young, double least_yield, double most_yield,
                          const std::string& strain, double density) {
  DrawnMaterial metal;
  metal.young = young;
  metal.density = density;
  metal.yield = dice.magnitude(least_yield, most_yield);
  const auto hardening = drawn_hardening(dice, young, metal.yield);
  metal.keys =
      fmt::format("law: plastic, young: {:.4g}, poisson: 0.3, {}, strain: {}", young, hardening.keys, strain);
  metal.words = fmt::format("σ_y {:.3g}, {}, {}", metal.yield, hardening.words, strain);
  return metal;
}

DrawnMaterial drawn_rubber(Dice& dice, double least_shear, double most_shear, double density) {
  const double shear = dice.magnitude(least_shear, most_shear);
  const double bulk = shear * dice.magnitude(20, 1000);
  const auto law = dice.one_of({"hyperelastic", "hyperelastic", "yeoh", "ogden"});
  DrawnMaterial rubber;
  rubber.young = 3 * shear;
  rubber.density = density;
  rubber.rubbery = true;
  if (law == "hyperelastic") {
    const double part = dice.chance(0.5) ? dice.uniform(0.05, 0.3) : 0;
    rubber.keys = fmt::format("law: hyperelastic, c10: {:.4g}, c01: {:.4g}", 0.5 * (1 - part) * shear,
                              0.5 * part * shear);
  } else if (law == "yeoh") {
    rubber.keys = fmt::format("law: yeoh, c10: {:.4g}, c20: {:.4g}, c30: {:.4g}", 0.5 * shear, -0.01 * shear,
                              0.004 * shear);
  } else {
    rubber.keys =
        fmt::format("law: ogden, terms: [{{shear: {:.4g}, exponent: 1.3}}, {{shear: {:.4g}, exponent: -2}}]",
                    0.9 * shear, 0.1 * shear);
  }
  rubber.keys += fmt::format(", bulk: {:.4g}", bulk);
  rubber.words = fmt::format("{}, K/μ {:.0f}", law, bulk / shear);
  return rubber;
}

DrawnMaterial drawn_elastic(double young, double poisson, const std::string& more, double density) {
  DrawnMaterial elastic;
  elastic.young = young;
  elastic.density = density;
  elastic.keys = fmt::format("law: elastic, young: {:.4g}, poisson: {:.3g}{}", young, poisson, more);
  elastic.words = "elastic" + more;
  return elastic;
}

std::string material_entry(const std::string& name, const DrawnMaterial& material, const std::string& cells) {
  return fmt::format("  {}: {{{}, density: {:.4g}{}}}\n", name, material.keys, material.density,
                     cells.empty() ? "" : ", cells: " + cells);
}

DrawnContact drawn_contact(Dice& dice, double most_friction, bool rigid) {
  DrawnContact contact;
  contact.friction = dice.chance(0.15) ? 0 : dice.uniform(0, most_friction);
  const auto kind =
      dice.one_of({"", "", "", "", "", "", "nodes", "penalty", "nodal_lagrange", "nodal_penalty"});
  contact.keys = fmt::format(", friction: {:.4f}", contact.friction);
  contact.words = fmt::format("μ {:.2f}", contact.friction);
  contact.exact = kind.empty() || kind == "nodes" || (kind == "nodal_lagrange" && contact.friction == 0);
  if (kind == "nodes" && !rigid)
    contact.keys += ", integration: nodes";
  else if (!kind.empty() && kind != "nodes")
    contact.keys += ", method: " + kind;
  if (!kind.empty())
    contact.words += ", " + kind;
  return contact;
}

std::string drawn_scheme(Dice& dice, bool exact_contact) {
  const auto scheme = dice.one_of({"hht", "hht", "newmark", "moreau_jean"});
  const double alpha = dice.uniform(-0.3, -0.05);
  if (scheme == "hht" || (scheme == "moreau_jean" && !exact_contact))
    return fmt::format("scheme: hht, alpha: {:.3f}", alpha);
  return "scheme: " + scheme;
}

} // namespace rubato::verification
