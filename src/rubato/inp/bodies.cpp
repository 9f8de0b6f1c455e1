// SPDX-License-Identifier: LGPL-3.0-or-later
// Materials of a step: their numbers at its temperatures, their strains, and what turns with large rotations.
#include "rubato/core/naming.hpp"
#include "rubato/inp/steps.hpp"
#include "rubato/study/formulation.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace rubato::inp {
namespace {

struct Interval {
  double lowest = 0;
  double highest = 0;
};

/// Temperatures of all nodes at the end of the step, or at its begin.
std::vector<double> node_temperatures(const Reading& reading, const History& history, bool at_end) {
  std::vector<double> all(reading.content.points.size(), reading.initial_temperature.value_or(0));
  for (const auto& active : history.temperatures) {
    const auto& course = active.course;
    const double value = at_end ? course.to : course.from;
    for (const auto node : active.items)
      all[static_cast<std::size_t>(node)] = value;
  }
  return all;
}

Interval temperatures_of(const Reading& reading, const MadeMaterial& made, const std::vector<double>& all) {
  std::optional<Interval> found;
  for (const auto element : made.elements)
    for (const auto node :
         reading.content.nodes_of(reading.content.elements[static_cast<std::size_t>(element)])) {
      const double value = all[static_cast<std::size_t>(node)];
      if (!found)
        found = {value, value};
      found->lowest = std::min(found->lowest, value);
      found->highest = std::max(found->highest, value);
    }
  return found.value_or(
      Interval{reading.initial_temperature.value_or(0), reading.initial_temperature.value_or(0)});
}

/// The temperature whose numbers the material has in the step; a fault where its nodes have several.
std::optional<double> temperature_of(Reading& reading, const MadeMaterial& made, const History& history,
                                     const Step& step) {
  const auto end = temperatures_of(reading, made, node_temperatures(reading, history, true));
  const auto begin = temperatures_of(reading, made, node_temperatures(reading, history, false));
  if (varies_between(*made.data, end.lowest, end.highest)) {
    reading.faults.add(
        made.data->at,
        fmt::format("found numbers of {} that depend on the temperature, and temperatures from "
                    "{} to {} in step {}; expected one temperature in all of its elements",
                    shown(made.data->material.name), end.lowest, end.highest, step.number));
    return std::nullopt;
  }
  const Interval whole{std::min(begin.lowest, end.lowest), std::max(begin.highest, end.highest)};
  if (varies_between(*made.data, whole.lowest, whole.highest))
    note(reading, made.data->at,
         fmt::format("step {} has the numbers of {} at the temperature at its end, {}, from its begin on",
                     step.number, made.data->material.name, end.highest));
  return end.highest;
}

bool is_rubber(const study::Material& material) {
  return study::is_hyperelastic(material.law);
}

study::StrainKind finite_strain(study::LawKind law) {
  const bool dissipates = law == study::LawKind::plastic || law == study::LawKind::prony;
  return dissipates ? study::StrainKind::logarithmic : study::StrainKind::green_lagrange;
}

void tell_finite_strain(Reading& reading, const study::Study& study, const Word& at) {
  const auto has = [&](study::LawKind law) {
    return std::ranges::any_of(study.materials, [&](const auto& material) { return material.law == law; });
  };
  if (has(study::LawKind::elastic) || has(study::LawKind::orthotropic))
    note(reading, at,
         "with NLGEOM linear elastic materials relate Green-Lagrange strain to the second Piola-Kirchhoff "
         "stress, as in CalculiX; Abaqus has a rate of Cauchy stress, which differs where strains are large");
  if (has(study::LawKind::plastic))
    note(reading, at,
         "with NLGEOM plastic materials have logarithmic strains and yield by Kirchhoff stress; Abaqus and "
         "CalculiX have Cauchy stress, which differs by the elastic change of volume");
  if (!study.relations.empty())
    note(reading, at,
         "equations, rigid bodies and couplings turn by small angles with NLGEOM, too; a run warns where a "
         "rigid body turns farther");
}

/// Applies NLGEOM to connectors and loads.
void let_turn(Reading& reading, study::Study& study, const History& history, const Word& at) {
  for (const auto& active : history.loads)
    if (active.follows)
      reading.faults.add(active.at,
                         "found TRVEC in a step with NLGEOM, which turns with its surface in Abaqus, "
                         "expected FOLLOWER=NO (it keeps its direction) or P");
  for (auto& connector : study.connectors)
    if (!connector.along && !connector.to.empty())
      connector.rotates = true;
  for (auto& load : study.loads) {
    load.follower = load.kind == study::LoadKind::pressure;
    const bool by_place = std::ranges::any_of(
        load.components, [](const study::FieldValue& value) { return value.number() == nullptr; });
    if (load.kind == study::LoadKind::gravity && by_place)
      note(reading, at,
           "CENTRIF takes the undeformed distance from the axis with NLGEOM; Abaqus and CalculiX take the "
           "present one");
  }
}

/// NLGEOM and what follows from it. Materials with a memory have one strain in all steps.
void set_strains(Reading& reading, study::Study& study, const History& history, const Step& step) {
  const bool rubber = std::ranges::any_of(study.materials, is_rubber);
  const bool nonlinear = step.procedure != Procedure::modes && (history.nonlinear || rubber);
  for (auto& material : study.materials) {
    const bool remembers = finite_strain(material.law) == study::StrainKind::logarithmic;
    if (!is_rubber(material) && (nonlinear || (remembers && history.nonlinear_later)))
      material.strain = finite_strain(material.law);
    if (!nonlinear && remembers && history.nonlinear_later)
      note(reading, step.at,
           fmt::format("{} has finite strains in the steps before NLGEOM, too", material.name));
  }
  if (!nonlinear)
    return;
  const auto& at = history.nonlinear ? history.nonlinear_at : step.at;
  if (!history.nonlinear)
    note(reading, at, "steps with *HYPERELASTIC materials have NLGEOM, as in CalculiX");
  tell_finite_strain(reading, study, at);
  let_turn(reading, study, history, at);
}

void check_creep(Reading& reading, const Step& step) {
  for (const auto& made : reading.made_materials) {
    const auto& data = *made.data;
    if (data.creeps && step.viscous)
      reading.faults.add(step.procedure_at,
                         fmt::format("found {} with the material {}, which has *CREEP: rubato has no law of "
                                     "creep, expected *STATIC",
                                     step.procedure_at.text, shown(data.material.name)));
    else if (data.creeps)
      note(reading, data.at, "*CREEP is active in *VISCO only and is not used");
    if (data.relaxation && step.procedure == Procedure::steps && !step.viscous)
      reading.faults.add(step.procedure_at,
                         fmt::format("found {} with the material {}, which has *VISCOELASTIC: it would relax "
                                     "in the step, expected *VISCO",
                                     step.procedure_at.text, shown(data.material.name)));
  }
}

} // namespace

void set_bodies(Reading& reading, study::Study& study, const History& history, const Step& step) {
  check_creep(reading, step);
  const double initial = reading.initial_temperature.value_or(0);
  const bool heated = !history.temperatures.empty();
  for (std::size_t i = 0; i < study.materials.size(); ++i) {
    const auto& made = reading.made_materials[i];
    const auto temperature = temperature_of(reading, made, history, step);
    if (!temperature)
      continue;
    auto material = material_at(*made.data, study.physics, *temperature, initial);
    auto& place = study.materials[i];
    material.name = place.name;
    material.cells = place.cells;
    material.formulation = place.formulation;
    const auto& turned = made.turned.orthotropy;
    material.orthotropy.angle_x = turned.angle_x;
    material.orthotropy.angle_y = turned.angle_y;
    material.orthotropy.angle_z = turned.angle_z;
    material.orthotropy.cylindrical = turned.cylindrical;
    if (material.expansion && heated)
      material.expansion->reference = initial;
    place = std::move(material);
  }
  set_strains(reading, study, history, step);
}

} // namespace rubato::inp
