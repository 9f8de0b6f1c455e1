// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/inp/read.hpp"

#include "rubato/core/naming.hpp"
#include "rubato/inp/points.hpp"
#include "rubato/inp/steps.hpp"
#include "rubato/mesh/index_lists.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>

namespace rubato::inp {
namespace {

using mesh::inp::Family;
using mesh::inp::Use;

/// A keyword outside of steps. Keywords of an earlier phase are read first: others name what they give.
struct ModelKeyword {
  std::string_view name;
  int phase;
  void (*read)(Reading&, std::size_t);
};
constexpr int phase_count = 3;
constexpr void (*with_its_parent)(Reading&, std::size_t) = nullptr;
constexpr std::array model_keywords{ModelKeyword{"AMPLITUDE", 0, read_amplitude},
                                    ModelKeyword{"MATERIAL", 0, read_material},
                                    ModelKeyword{"ELASTIC", 0, read_elastic},
                                    ModelKeyword{"DENSITY", 0, read_density},
                                    ModelKeyword{"EXPANSION", 0, read_expansion},
                                    ModelKeyword{"DAMPING", 0, read_damping},
                                    ModelKeyword{"PLASTIC", 0, read_plastic},
                                    ModelKeyword{"HYPERELASTIC", 0, read_hyperelastic},
                                    ModelKeyword{"VISCOELASTIC", 0, read_viscoelastic},
                                    ModelKeyword{"CREEP", 0, read_creep},
                                    ModelKeyword{"CYCLIC HARDENING", 0, read_cyclic_hardening},
                                    ModelKeyword{"RATE DEPENDENT", 0, read_rate_dependent},
                                    ModelKeyword{"ORIENTATION", 0, read_orientation},
                                    ModelKeyword{"TRANSFORM", 0, read_transform},
                                    ModelKeyword{"SURFACE INTERACTION", 0, read_interaction},
                                    ModelKeyword{"SURFACE BEHAVIOR", 0, read_surface_behavior},
                                    ModelKeyword{"FRICTION", 0, read_friction},
                                    ModelKeyword{"COUPLING", 1, read_coupling},
                                    ModelKeyword{"KINEMATIC", 1, with_its_parent},
                                    ModelKeyword{"DISTRIBUTING", 1, with_its_parent},
                                    ModelKeyword{"KINEMATIC COUPLING", 1, read_kinematic_coupling},
                                    ModelKeyword{"DISTRIBUTING COUPLING", 1, read_distributing_coupling},
                                    ModelKeyword{"RIGID BODY", 1, read_rigid_body},
                                    ModelKeyword{"SOLID SECTION", 1, read_solid_section},
                                    ModelKeyword{"CONTACT PAIR", 1, read_contact_pair},
                                    ModelKeyword{"TIE", 1, read_tie},
                                    ModelKeyword{"CONTACT", 1, read_general_contact},
                                    ModelKeyword{"CONTACT INCLUSIONS", 1, with_its_parent},
                                    ModelKeyword{"CONTACT PROPERTY ASSIGNMENT", 1, with_its_parent},
                                    ModelKeyword{"CLEARANCE", 2, read_clearance},
                                    ModelKeyword{"EMBEDDED ELEMENT", 2, read_embedded},
                                    ModelKeyword{"EQUATION", 2, read_equation},
                                    ModelKeyword{"MPC", 2, read_mpc},
                                    ModelKeyword{"GAP", 2, read_gap},
                                    ModelKeyword{"PRE-TENSION SECTION", 2, read_pretension},
                                    ModelKeyword{"SPRING", 2, read_spring},
                                    ModelKeyword{"DASHPOT", 2, read_dashpot},
                                    ModelKeyword{"MASS", 2, read_mass},
                                    ModelKeyword{"INITIAL CONDITIONS", 2, read_initial_conditions}};

const ModelKeyword* model_keyword(const Block& block) {
  const auto* const found = std::ranges::find(model_keywords, block.keyword->name, &ModelKeyword::name);
  return found == model_keywords.end() ? nullptr : found;
}

/// Whether each block is in a step.
std::vector<bool> in_steps(const Content& content) {
  std::vector<bool> inside;
  bool open = false;
  for (const auto& placed : content.layout.blocks) {
    open = placed.block->is("STEP") || (open && !placed.block->is("END STEP"));
    inside.push_back(open);
  }
  return inside;
}

void read_model(Reading& reading) {
  const auto& blocks = reading.content.layout.blocks;
  const auto inside = in_steps(reading.content);
  for (int phase = 0; phase < phase_count; ++phase)
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      const auto* const row = model_keyword(*blocks[i].block);
      const bool here = !inside[i] || blocks[i].block->is("AMPLITUDE");
      if (row == nullptr || row->phase != phase || !here)
        continue;
      mesh::inp::check_parameters(*blocks[i].block, reading.faults);
      if (row->read != nullptr)
        row->read(reading, i);
    }
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const auto& block = *blocks[i].block;
    if (inside[i])
      continue;
    if (block.keyword->use == Use::harmless)
      leave_out(reading, block);
    else if (block.keyword->use == Use::unavailable)
      reading.faults.add(block.at,
                         fmt::format("found *{}, which rubato does not have{}{}", block.keyword->name,
                                     block.keyword->note.empty() ? "" : ": ", block.keyword->note));
  }
}

void read_title(Reading& reading) {
  for (const auto& placed : reading.content.layout.blocks)
    if (placed.block->is("HEADING") && !placed.block->lines.empty() && reading.title.empty())
      reading.title = std::string(mesh::inp::word_of(placed.block->lines.front()).text);
}

std::optional<study::Physics> physics_of(const Content& content) {
  for (const auto& element : content.elements)
    switch (element.type->family) {
    case Family::solid:
      return study::Physics::solid;
    case Family::plane_stress:
      return study::Physics::plane_stress;
    case Family::plane_strain:
      return study::Physics::plane_strain;
    case Family::axisymmetric:
      return study::Physics::axisymmetric;
    default:
      break;
    }
  return std::nullopt;
}

void tell_harmless(Reading& reading) {
  if (reading.harmless.empty())
    return;
  std::vector<std::string> parts;
  for (const auto& [what, lines] : reading.harmless)
    parts.push_back(fmt::format(
        "{} (line{} {}{})", what, lines.size() > 1 ? "s" : "",
        fmt::join(lines.begin(),
                  lines.begin() + std::min<std::ptrdiff_t>(static_cast<std::ptrdiff_t>(lines.size()), 5),
                  ", "),
        lines.size() > 5 ? ", …" : ""));
  reading.notes.push_back(fmt::format("{}: left out, without effect on the answer: {}",
                                      reading.content.source.names.front(), fmt::join(parts, ", ")));
}

void check_temperatures(Reading& reading, const Input& input) {
  const bool heated =
      std::ranges::any_of(input.runs, [](const auto& study) { return !study.temperatures.empty(); });
  const auto all = reading.content.points.size();
  auto nodes = reading.nodes_with_initial_temperature;
  mesh::sort_without_repeats(nodes);
  if (!heated || nodes.empty() || nodes.size() == all)
    return;
  std::vector<std::int32_t> of_elements;
  for (const auto& element : reading.content.elements) {
    const auto own = reading.content.nodes_of(element);
    of_elements.insert(of_elements.end(), own.begin(), own.end());
  }
  mesh::sort_without_repeats(of_elements);
  if (!std::ranges::includes(nodes, of_elements))
    reading.faults.add(
        reading.places.at("initial temperature"),
        "found initial temperatures of some nodes only, expected one for all nodes of elements");
}

/// The nodes of bodies, and remarks on the mesh.
void note_bodies(Reading& reading) {
  const auto& content = reading.content;
  reading.body_nodes.assign(content.points.size(), 0);
  for (const auto& element : content.elements)
    if (mesh::inp::is_continuum(element.type->family))
      for (const auto node : content.nodes_of(element))
        reading.body_nodes[static_cast<std::size_t>(node)] = 1;
  for (const auto& remark : content.remarks)
    note(reading, remark.at, remark.text);
}

Input finished(const Content& content, const std::string& file, Purpose purpose) {
  Faults faults;
  Reading reading(content, faults);
  reading.study.mesh.file = file;
  reading.places["mesh"] = {file, 0, 0};
  Input input;
  const auto physics = physics_of(content);
  if (!physics)
    throw InputError("found no solid, plane or axisymmetric elements in the file, expected some", {file});
  reading.study.physics = *physics;
  read_title(reading);
  note_bodies(reading);
  check_elements(reading);
  read_model(reading);
  check_properties(reading);
  hold_unused(reading);
  read_steps(reading, purpose, input);
  check_temperatures(reading, input);
  faults.throw_if_any();
  tell_harmless(reading);
  input.title = reading.title;
  input.notes = std::move(reading.notes);
  return input;
}

} // namespace

void read_initial_conditions(Reading& reading, std::size_t index) {
  const auto& placed = reading.content.layout.blocks[index];
  const auto& block = *placed.block;
  const auto type = mesh::inp::require_value(block, "TYPE", "the kind of initial condition", reading.faults);
  const auto kind = mesh::inp::compact(type.text);
  if (kind != "VELOCITY" && kind != "DISPLACEMENT" && kind != "TEMPERATURE")
    return reading.faults.add(
        type.empty() ? block.at : type,
        fmt::format("found TYPE={}, expected VELOCITY, DISPLACEMENT or TEMPERATURE", type.text));
  for (const auto& line : block.lines) {
    const auto fields = mesh::inp::fields_of(line);
    const auto target = fields.empty() ? std::nullopt : find_target(reading, placed.scope, fields[0]);
    if (!target)
      continue;
    const auto second = mesh::inp::field(fields, 1, fields[0]);
    if (kind == "TEMPERATURE") {
      const auto value = mesh::inp::require_number(second, "the temperature", reading.faults);
      if (value && reading.initial_temperature.value_or(*value) != *value)
        reading.faults.add(
            second, fmt::format("found the initial temperature {} beside {}, expected one for all nodes: "
                                "strains are 0 at it",
                                *value, *reading.initial_temperature));
      reading.initial_temperature = value.value_or(0);
      reading.places["initial temperature"] = second.at();
      reading.nodes_with_initial_temperature.insert(reading.nodes_with_initial_temperature.end(),
                                                    target->nodes.begin(), target->nodes.end());
      continue;
    }
    const auto dof = mesh::inp::require_integer(second, "a degree of freedom", reading.faults);
    const auto value =
        mesh::inp::require_number(mesh::inp::field(fields, 2, second), "the value", reading.faults);
    if (!dof || !value)
      continue;
    if (*dof < 1 || *dof > reading.dimension() || target->reference != nullptr) {
      reading.faults.add(
          second, fmt::format("found the degree of freedom {}, expected a displacement of nodes of a body, "
                              "1 to {}",
                              *dof, reading.dimension()));
      continue;
    }
    if (std::ranges::any_of(target->nodes, [&](std::int32_t node) { return has_own_axes(reading, node); })) {
      reading.faults.add(fields[0],
                         "found an initial motion of nodes with *TRANSFORM, expected nodes without");
      continue;
    }
    study::InitialMotion motion;
    motion.on = target->name;
    (kind == "VELOCITY" ? motion.velocity : motion.displacement).at(static_cast<std::size_t>(*dof) - 1) =
        *value;
    reading.places[fmt::format("initial.{}", reading.study.initial.size())] = fields[0].at();
    reading.study.initial.push_back(motion);
  }
}

Input read_input(const std::filesystem::path& file, Purpose purpose) {
  return finished(mesh::inp::read_content(file), file.string(), purpose);
}

Input parse_input(std::string text, const std::string& name, Purpose purpose) {
  return finished(mesh::inp::parse_content(std::move(text), name), name, purpose);
}

} // namespace rubato::inp
