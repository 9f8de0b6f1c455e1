// SPDX-License-Identifier: LGPL-3.0-or-later
// Strains, formulations of cells, and what goes with nonlinear bodies only.
#include "rubato/study/formulation.hpp"
#include "rubato/study/rules/rules.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace rubato::study {
namespace {

void check_strain(Rules& rules, const Material& material, const std::string& path) {
  const auto& law = entry_of(material.law);
  if (!material.strain || takes(law, *material.strain))
    return;
  std::vector<std::string_view> taken;
  for (const auto strain : law.strains)
    taken.push_back(word_of(strain_words, strain));
  rules.broken({path + ".strain", path + ".law"},
               fmt::format("the law {} takes no {} strain, expected {}", law.name,
                           word_of(strain_words, *material.strain), fmt::join(taken, " or ")));
}

/// Why numbers and axes of the material are the same everywhere; empty where they may depend on the place.
std::string one_place(const Material& material) {
  if (const auto strain = strain_of(material); strain != StrainKind::small)
    return fmt::format("{} strain", word_of(strain_words, strain));
  if (const auto formulation = material.formulation.value_or(Formulation::full);
      formulation != Formulation::full)
    return fmt::format("{} cells", word_of(formulation_words, formulation));
  return {};
}

void check_places(Rules& rules, const Material& material, const std::string& path) {
  const auto reason = one_place(material);
  if (reason.empty() || !entry_of(material.law).in_place)
    return;
  const std::vector others{path + ".strain", path + ".formulation", path + ".law"};
  const auto refuse = [&](const std::string& key, const std::string& text) {
    std::vector paths{path + "." + key};
    paths.insert(paths.end(), others.begin(), others.end());
    rules.broken(std::move(paths), text);
  };
  for (const auto& [key, value] : material.in_place)
    if (key != "density")
      refuse(key, fmt::format("depends on the place, which {} cannot; expected a number", reason));
  if (material.orthotropy.cylindrical)
    refuse("axes",
           fmt::format("axes that turn with the place do not go with {}, expected angles alone", reason));
}

/// What grows hourglasses in enhanced cells; empty where nothing does.
std::string hourglasses_with(const Material& material) {
  if (is_hyperelastic(material.law))
    return fmt::format("the law {}", entry_of(material.law).name);
  if (strain_of(material) == StrainKind::logarithmic)
    return "logarithmic strain";
  return {};
}

void check_enhanced(Rules& rules, const Material& material, const std::string& of_material) {
  const auto& study = rules.study;
  const auto path = of_material + ".formulation";
  const auto* instead = study.physics == Physics::plane_stress ? "full" : "mean_dilatation";
  if (const auto with = hourglasses_with(material); !with.empty())
    rules.broken({path, of_material + ".strain", of_material + ".law"},
                 fmt::format("enhanced cells grow hourglasses under large compression with {}, expected {}",
                             with, instead));
  else if (is_explicit(study.time.scheme) && !has_constant_stiffness(material))
    rules.broken({path, "time.scheme"},
                 fmt::format("the scheme {} takes enhanced cells of linear materials at small strain only, "
                             "expected {}",
                             word_of(scheme_words, study.time.scheme), instead));
  else if (is_explicit(study.time.scheme) && is_heated(study, material))
    rules.broken({path, of_material + ".expansion", "time.scheme"},
                 fmt::format("the scheme {} takes no enhanced cells that expand by temperature, expected {}",
                             word_of(scheme_words, study.time.scheme), instead));
}

void check_formulation(Rules& rules, const Material& material, const std::string& of_material) {
  const auto path = of_material + ".formulation";
  if (material.formulation == Formulation::enhanced)
    check_enhanced(rules, material, of_material);
  if (material.formulation == Formulation::mean_dilatation && rules.study.physics == Physics::plane_stress)
    rules.broken({path, "physics"},
                 "plane_stress has no mean_dilatation, as its thickness is free to change; expected full or "
                 "enhanced");
}

/// Forces that keep energy are those of what is stored.
void check_conserved(Rules& rules, const Material& material, const std::string& path) {
  if (rules.study.time.scheme != SchemeKind::energy_momentum)
    return;
  if (is_heated(rules.study, material) && !is_linear(rules.study, material))
    rules.broken({path + ".expansion", "time.scheme"},
                 "the scheme energy_momentum takes no nonlinear bodies that expand by temperature, expected "
                 "moreau_jean");
  if (material.law != LawKind::plastic && material.law != LawKind::prony)
    return;
  rules.broken({path + ".law", "time.scheme"},
               fmt::format("the scheme energy_momentum is for bodies that store all that is done to them, "
                           "and the law {} dissipates; expected moreau_jean, whose error in finite strain "
                           "energy.csv tells as bulk_scheme",
                           entry_of(material.law).name));
}

void check_tangent(Rules& rules) {
  const auto& study = rules.study;
  if (study.newton.tangent == TangentChoice::automatic)
    return;
  if (is_explicit(study.time.scheme))
    rules.broken({"newton.tangent", "time.scheme"},
                 fmt::format("the scheme {} solves no system, expected auto",
                             word_of(scheme_words, study.time.scheme)));
  else if (is_linear(study))
    rules.broken({"newton.tangent", "materials"},
                 "has no effect, as every material is linear and its matrix is factored once; expected auto");
}

void check_max_step(Rules& rules) {
  const auto& time = rules.study.time;
  if (!time.max_step)
    return;
  rules.number("time.max_step", *time.max_step, bounds::max_step);
  if (is_linear(rules.study))
    rules.broken({"time.max_step", "materials"},
                 "has no effect, as every material is linear; steps grow with nonlinear ones only");
  else if (time.instants.empty() && *time.max_step > 0 && *time.max_step < time.step)
    rules.broken({"time.max_step", "time.step"},
                 fmt::format("found {}, expected at least the step, {}", *time.max_step, time.step));
}

void check_max_plastic_step(Rules& rules) {
  const auto& study = rules.study;
  if (!study.time.max_plastic_step)
    return;
  rules.number("time.max_plastic_step", *study.time.max_plastic_step, bounds::max_plastic_step);
  const auto yields = [](const Material& material) { return material.law == LawKind::plastic; };
  if (std::ranges::none_of(study.materials, yields))
    rules.broken({"time.max_plastic_step", "materials"},
                 "has no effect, as no material is plastic; expected the law plastic in a material");
}

/// The factor of the loads is unknown, and which loads have it.
void check_arc_length(Rules& rules) {
  const auto& study = rules.study;
  const auto& time = study.time;
  if (!time.arc_length)
    return;
  rules.number("time.arc_length.length", time.arc_length->length, bounds::arc_length);
  rules.name("time.arc_length.on", time.arc_length->on);
  if (time.scheme != SchemeKind::static_steps)
    rules.broken({"time.arc_length", "time.scheme"},
                 fmt::format("the scheme {} follows the motion past limit loads by itself; static takes it",
                             word_of(scheme_words, time.scheme)));
  else if (is_linear(study))
    rules.broken({"time.arc_length", "materials"},
                 "has no effect, as every material is linear, and loads have no limit then");
  else if (std::ranges::none_of(study.loads, [](const Load& load) { return load.function.empty(); }))
    rules.broken({"time.arc_length", "loads"},
                 "has no load to multiply; expected one without a function of time");
  if (study.solver == Solver::condensed || study.solver == Solver::iterative)
    rules.broken({"time.arc_length", "solver"},
                 "solves the whole system in every iteration, expected solver: auto or full");
}

} // namespace

void check_bulk(Rules& rules, const Material& material, const std::string& path) {
  check_strain(rules, material, path);
  check_places(rules, material, path);
  check_formulation(rules, material, path);
  check_conserved(rules, material, path);
}

void check_nonlinear_solution(Rules& rules) {
  check_tangent(rules);
  const auto& time = rules.study.time;
  if (is_explicit(time.scheme) && (time.max_step || time.max_plastic_step))
    return rules.broken(
        {time.max_step ? "time.max_step" : "time.max_plastic_step", "time.scheme"},
        fmt::format("the scheme {} chooses its steps by what is stable", word_of(scheme_words, time.scheme)));
  check_max_step(rules);
  check_max_plastic_step(rules);
  check_arc_length(rules);
}

} // namespace rubato::study
