// SPDX-License-Identifier: LGPL-3.0-or-later
// Changes of the model in a step: contact properties, contact pairs, elements, yield stresses.
#include "rubato/core/naming.hpp"
#include "rubato/inp/steps.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace rubato::inp {
namespace {

using mesh::inp::compact;

/// Returns whether the zone comes from a pair, or from general contact, with this interaction.
bool is_of(const Reading& reading, const study::ContactZone& zone, const std::string& interaction) {
  const auto place = reading.places.find("contact." + zone.name);
  if (place == reading.places.end())
    return false;
  const auto& blocks = reading.content.layout.blocks;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const auto& block = *blocks[i].block;
    const auto& at = place->second;
    if (block.is("CONTACT PAIR")) {
      const auto* const name = block.find("INTERACTION");
      const bool lies_in = std::ranges::any_of(block.lines, [&](const mesh::inp::Line& line) {
        return line.line == at.line && line.file != nullptr && *line.file == at.file;
      });
      if (lies_in && name != nullptr)
        return mesh::inp::folded(name->value.text) == interaction;
    } else if (block.is("CONTACT PROPERTY ASSIGNMENT") && zone.master.empty() && zone.slave.empty()) {
      const auto fields = mesh::inp::fields_at(block, 0);
      if (mesh::inp::folded(mesh::inp::field(fields, 2, block.at).text) == interaction)
        return true;
    }
  }
  return false;
}

void give_numbers(study::ContactZone& zone, const study::ContactZone& numbers) {
  zone.friction = numbers.friction;
  zone.friction_method = numbers.friction_method;
  zone.method = numbers.method;
  zone.normal_coefficient = numbers.normal_coefficient;
  zone.tangential_coefficient = numbers.tangential_coefficient;
  zone.pressure = numbers.pressure;
  zone.clearance = numbers.clearance;
  zone.curve = numbers.curve;
  zone.bilateral = numbers.bilateral;
}

/// The zones of a line of *MODEL CHANGE: slave and master, or one surface.
std::vector<std::string> zones_of(Reading& reading, int scope, const std::vector<Word>& fields) {
  const auto* const slave = mesh::inp::find_surface(reading.content, scope, fields[0], reading.faults);
  const auto second = mesh::inp::field(fields, 1, Word{});
  const auto* const master =
      second.empty() ? slave : mesh::inp::find_surface(reading.content, scope, second, reading.faults);
  std::vector<std::string> names;
  if (slave == nullptr || master == nullptr)
    return names;
  for (const auto& zone : reading.study.contact)
    if ((zone.slave == slave->group && zone.master == master->group) ||
        (slave == master && zone.self == slave->group))
      names.push_back(zone.name);
  if (names.empty())
    reading.faults.add(fields[0],
                       fmt::format("found the pair {} and {}, expected surfaces of a *CONTACT PAIR",
                                   shown(slave->label), shown(master->label)));
  return names;
}

/// Sets of elements that are taken away, or come back with the strains that their nodes have.
void change_elements(Reading& reading, const Placed& placed, const mesh::inp::Parameter* add) {
  if (add != nullptr && compact(add->value.text) != "WITHSTRAIN")
    return reading.faults.add(add->name,
                              "found elements that are added free of strain, which needs a new undeformed "
                              "shape, expected ADD=WITH STRAIN");
  for (const auto& line : placed.block->lines)
    for (const auto& word : mesh::inp::fields_of(line)) {
      const auto found = mesh::inp::find_elements(reading.content, placed.scope, word, reading.faults);
      if (!found)
        continue;
      if (!found->is_set || found->name.empty()) {
        reading.faults.add(word, "found a single element, expected a set of elements");
        continue;
      }
      const ElementGroup group{found->name, found->items};
      std::erase(reading.removed_elements, group);
      if (add == nullptr)
        reading.removed_elements.push_back(group);
    }
}

} // namespace

void read_change(Reading& reading, std::size_t index) {
  const auto& block = *reading.content.layout.blocks[index].block;
  if (block.is("CHANGE CONTACT TYPE"))
    return note(reading, block.at,
                "the contact type of the first step is kept; contact is exact in all of them");
  if (block.is("CHANGE MATERIAL")) {
    const auto name = mesh::inp::require_value(block, "NAME", "the name of a material", reading.faults);
    if (!name.empty())
      named(reading.materials, name, "a material", reading.faults);
    return;
  }
  const auto name =
      mesh::inp::require_value(block, "INTERACTION", "the name of a *SURFACE INTERACTION", reading.faults);
  if (!name.empty())
    named(reading.interactions, name, "an interaction", reading.faults);
}

void read_change_plastic(Reading& reading, std::size_t index) {
  const auto& blocks = reading.content.layout.blocks;
  const auto& block = *blocks[index].block;
  const auto* const parent = parent_of(reading, index, "CHANGE MATERIAL", {});
  const auto* const name = parent == nullptr ? nullptr : parent->block->find("NAME");
  const auto found =
      name == nullptr ? reading.materials.end() : reading.materials.find(mesh::inp::folded(name->value.text));
  if (found == reading.materials.end())
    return;
  auto& hardening = found->second.hardening;
  const auto* const kind = block.find("HARDENING");
  const bool kinematic = kind != nullptr && compact(kind->value.text) == "KINEMATIC";
  const auto rule = kinematic ? HardeningRule::kinematic : HardeningRule::isotropic;
  if (!hardening || hardening->rule != rule)
    return reading.faults.add(block.at,
                              fmt::format("found {} of {}, which has another *PLASTIC; expected one "
                                          "with the same HARDENING",
                                          block.at.text, shown(found->second.material.name)));
  if (auto curves = heat_curves(reading, block); !curves.curves.empty())
    hardening->curves = std::move(curves);
  check_hardening(reading, *hardening);
}

void read_model_change(Reading& reading, std::size_t index) {
  const auto& placed = reading.content.layout.blocks[index];
  const auto& block = *placed.block;
  const auto* const type = block.find("TYPE");
  const auto word = type == nullptr ? std::string("ELEMENT") : compact(type->value.text);
  const auto* const add = block.find("ADD");
  if ((add != nullptr) == (block.find("REMOVE") != nullptr))
    return reading.faults.add(
        block.at, fmt::format("found {} without ADD or REMOVE, expected one of them", block.at.text));
  if (word == "ELEMENT")
    return change_elements(reading, placed, add);
  if (word != "CONTACTPAIR")
    return reading.faults.add(
        type->value, fmt::format("found TYPE={}, expected CONTACT PAIR or ELEMENT", type->value.text));
  for (const auto& line : block.lines) {
    const auto fields = mesh::inp::fields_of(line);
    if (fields.empty())
      continue;
    for (const auto& name : zones_of(reading, placed.scope, fields))
      if (add != nullptr)
        reading.removed_zones.erase(name);
      else
        reading.removed_zones.insert(name);
  }
}

void apply_changes(Reading& reading) {
  for (auto& [label, interaction] : reading.interactions) {
    if (!interaction.changed)
      continue;
    interaction.changed = false;
    for (auto& zone : reading.study.contact)
      if (is_of(reading, zone, label))
        give_numbers(zone, interaction.numbers);
  }
}

void open_removed(const Reading& reading, study::Study& study) {
  Eigen::Vector3d low = Eigen::Vector3d::Zero(), high = low;
  for (const auto& point : reading.content.points) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  constexpr double far = 1000; // of the whole model
  for (auto& zone : study.contact)
    if (reading.removed_zones.contains(zone.name)) {
      zone.gap = study::Field(far * (high - low).norm());
      zone.bilateral = false;
    }
}

void keep_friction(std::vector<study::Study>& runs) {
  constexpr double next_to_none = 1e-12;
  for (const auto& run : std::vector<study::Study>(runs))
    for (const auto& zone : run.contact)
      for (auto& other : runs)
        for (auto& same : other.contact)
          if (same.name == zone.name && zone.friction > 0 && same.friction == 0)
            same.friction = next_to_none;
}

} // namespace rubato::inp
