// SPDX-License-Identifier: LGPL-3.0-or-later
// Contact properties, pairs, ties and general contact as zones.
#include "rubato/core/naming.hpp"
#include "rubato/inp/reading.hpp"
#include "rubato/study/contact_methods.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace rubato::inp {
namespace {

using mesh::inp::compact;
using mesh::inp::field;
using study::ContactMethod;

/// *CHANGE FRICTION or *CHANGE SURFACE BEHAVIOR right above.
const Block* change_above(const Reading& reading, std::size_t index) {
  const auto* const block = index == 0 ? nullptr : reading.content.layout.blocks[index - 1].block;
  const bool changes =
      block != nullptr && (block->is("CHANGE FRICTION") || block->is("CHANGE SURFACE BEHAVIOR"));
  return changes ? block : nullptr;
}

/// The interaction that it names; nullptr where there is none, which is a fault of its own.
Interaction* changed_by(Reading& reading, const Block* block) {
  const auto* const name = block->find("INTERACTION");
  const auto found = name == nullptr ? reading.interactions.end()
                                     : reading.interactions.find(mesh::inp::folded(name->value.text));
  if (found == reading.interactions.end())
    return nullptr;
  found->second.changed = true;
  return &found->second;
}

Interaction* interaction_above(Reading& reading, std::size_t index) {
  if (const auto* const change = change_above(reading, index); change != nullptr)
    return changed_by(reading, change);
  const auto* const parent =
      parent_of(reading, index, "SURFACE INTERACTION", {"SURFACE BEHAVIOR", "FRICTION"});
  const auto* const name = parent == nullptr ? nullptr : parent->block->find("NAME");
  const auto found = name == nullptr ? reading.interactions.end()
                                     : reading.interactions.find(mesh::inp::folded(name->value.text));
  return found == reading.interactions.end() ? nullptr : &found->second;
}

std::vector<std::optional<double>> behaviour_numbers(Reading& reading, const Block& block) {
  std::vector<std::optional<double>> numbers;
  for (const auto& line : block.lines)
    for (const auto& word : mesh::inp::fields_of(line))
      numbers.push_back(word.empty()
                            ? std::nullopt
                            : mesh::inp::require_number(word, "a number of the behaviour", reading.faults));
  return numbers;
}

/// The group of faces that a surface is in a zone; of nodes as slaves those of bodies that have them.
struct ZoneSurface {
  std::string group;
  std::string beside; ///< nodes of the faces that are not on the surface
  bool of_nodes = false;
};

std::optional<ZoneSurface> faces_group(Reading& reading, int scope, const Word& word, std::string_view of) {
  const auto* const surface = mesh::inp::find_surface(reading.content, scope, word, reading.faults);
  if (surface == nullptr)
    return std::nullopt;
  if (!surface->of_nodes)
    return ZoneSurface{surface->group, {}, false};
  if (!surface->slave_faces.empty())
    return ZoneSurface{surface->slave_faces, surface->beside, true};
  reading.faults.add(
      word, fmt::format("found the surface {} of nodes, expected one of faces (TYPE=ELEMENT): {} has "
                        "pressures on faces",
                        shown(surface->label), of));
  return std::nullopt;
}

/// Types of pairs that have pressures on faces.
constexpr std::array<std::string_view, 4> mortar_kinds{"SURFACETOSURFACE", "MORTAR", "LINMORTAR",
                                                       "PGLINMORTAR"};

/// Slave and master of a zone; nodes of the slave's faces that are not on its surface are left out.
void set_sides(Reading& reading, const ZoneSurface& slave, const ZoneSurface& master, const Word& at,
               study::ContactZone& zone) {
  zone.slave = slave.group;
  zone.master = master.group;
  if (slave.beside.empty())
    return;
  if (zone.tie)
    return reading.faults.add(at,
                              "found nodes of a tied surface that have no whole face, expected every node "
                              "of faces, or a surface of faces");
  zone.exclude_nodes.push_back(slave.beside);
}

void add_zone(Reading& reading, study::ContactZone zone, std::string_view label, const Word& at) {
  zone.name = chosen_name(reading, "contact", label);
  reading.places["contact." + zone.name] = at.at();
  reading.study.contact.push_back(std::move(zone));
}

/// Returns whether a file has keywords that CalculiX does not have.
bool is_of_abaqus(const Content& content) {
  return std::ranges::any_of(content.layout.blocks, [](const Placed& placed) {
    const auto& block = *placed.block;
    return block.is("PART") || block.is("ASSEMBLY") || block.is("INSTANCE") || block.is("PREPRINT") ||
           (block.is("OUTPUT") && (block.find("FIELD") != nullptr || block.find("HISTORY") != nullptr));
  });
}

} // namespace

void read_interaction(Reading& reading, std::size_t index) {
  const auto& block = *reading.content.layout.blocks[index].block;
  const auto name = mesh::inp::require_value(block, "NAME", "the name of the interaction", reading.faults);
  if (!name.empty() &&
      !reading.interactions.try_emplace(mesh::inp::folded(name.text), Interaction{{}, name, false}).second)
    reading.faults.add(name, fmt::format("found a second interaction {}, expected each name once",
                                         shown(std::string(name.text))));
}

void read_surface_behavior(Reading& reading, std::size_t index) {
  const auto& block = *reading.content.layout.blocks[index].block;
  auto* const interaction = interaction_above(reading, index);
  const auto* const given = block.find("PRESSUREOVERCLOSURE");
  const auto word = given == nullptr ? std::string("HARD") : compact(given->value.text);
  if (interaction == nullptr)
    return;
  auto& zone = interaction->numbers;
  zone.bilateral = block.find("NOSEPARATION") != nullptr;
  const auto numbers = behaviour_numbers(reading, block);
  const auto number = [&](std::size_t i) { return i < numbers.size() ? numbers[i] : std::nullopt; };
  if (word == "HARD") {
    if (block.find("PENALTY") != nullptr || block.find("AUGMENTEDLAGRANGE") != nullptr)
      note(reading, block.at, "hard contact is exact in rubato, not by a penalty");
  } else if (word == "LINEAR" && number(0)) {
    zone.method = ContactMethod::penalty;
    zone.normal_coefficient = *number(0);
    if (number(1).value_or(0) != 0 || number(2).value_or(0) != 0)
      note(reading, block.at,
           "linear pressure begins at gap 0 in rubato; the second and third number (CalculiX) are "
           "not used");
  } else if (word == "EXPONENTIAL" && number(0) && number(1)) {
    zone.method = ContactMethod::exponential;
    zone.clearance = *number(0);
    zone.pressure = *number(1);
    zone.curve =
        is_of_abaqus(reading.content) ? study::ExponentialCurve::abaqus : study::ExponentialCurve::calculix;
    note(reading, block.at,
         zone.curve == study::ExponentialCurve::abaqus
             ? "exponential pressure is as Abaqus has it, (p0/(e-1)) x (exp(x)-1) with x = 1 - gap/c0"
             : "exponential pressure is as CalculiX has it, p0 exp(-gap ln(100)/c0), as no keyword of the "
               "file is Abaqus' alone; in a deck 'curve: abaqus' gives the other");
  } else if (word == "TIED") {
    interaction->tied = true;
    note(reading, block.at,
         "tied contact is exact in rubato, not by a stiffness, and stays tied when pulled");
  } else if (word == "LINEAR" || word == "EXPONENTIAL") {
    reading.faults.add(block.at,
                       fmt::format("found {} numbers of a {} pressure-overclosure, expected {}",
                                   numbers.size(), word, word == "LINEAR" ? "the slope" : "c0 and p0"));
  } else {
    reading.faults.add(
        given->value, fmt::format("found PRESSURE-OVERCLOSURE={}, expected HARD, LINEAR, EXPONENTIAL or TIED",
                                  given->value.text));
  }
  zone.friction_method = study::FrictionMethod::augmented_lagrangian;
}

void read_friction(Reading& reading, std::size_t index) {
  const auto& block = *reading.content.layout.blocks[index].block;
  auto* const interaction = interaction_above(reading, index);
  const auto numbers = behaviour_numbers(reading, block);
  if (interaction == nullptr)
    return;
  if (numbers.empty() || !numbers[0])
    return reading.faults.add(block.at,
                              fmt::format("found {} without a coefficient, expected one", block.at.text));
  constexpr std::size_t most = 2; // CalculiX has the slope of sticking there
  if (numbers.size() > most)
    return reading.faults.add(block.at,
                              fmt::format("found {} numbers of friction, expected one coefficient, which "
                                          "depends on nothing",
                                          numbers.size()));
  interaction->numbers.friction = *numbers[0];
  if (numbers.size() == most || block.find("SLIPTOLERANCE") != nullptr ||
      block.find("ELASTICSLIP") != nullptr)
    note(reading, block.at,
         "friction sticks exactly in rubato; the slope of sticking or the elastic slip is not used");
}

void read_contact_pair(Reading& reading, std::size_t index) {
  const auto& placed = reading.content.layout.blocks[index];
  const auto& block = *placed.block;
  const auto property =
      mesh::inp::require_value(block, "INTERACTION", "the name of a *SURFACE INTERACTION", reading.faults);
  const auto* const interaction =
      property.empty() ? nullptr : named(reading.interactions, property, "an interaction", reading.faults);
  const auto* const type = block.find("TYPE");
  const auto kind = type == nullptr ? std::string("NODETOSURFACE") : compact(type->value.text);
  const bool massless = kind == "MASSLESS";
  const bool on_nodes = kind == "NODETOSURFACE" || massless;
  if (!on_nodes && std::ranges::find(mortar_kinds, std::string_view(kind)) == mortar_kinds.end())
    reading.faults.add(type->value,
                       fmt::format("found TYPE={}, expected NODE TO SURFACE, SURFACE TO SURFACE, "
                                   "MORTAR, LINMORTAR, PGLINMORTAR or MASSLESS",
                                   type->value.text));
  reading.massless_contact = reading.massless_contact || massless;
  for (const auto& line : block.lines) {
    const auto fields = mesh::inp::fields_of(line);
    if (fields.empty() || interaction == nullptr)
      continue;
    if (fields.size() > 2 &&
        std::any_of(fields.begin() + 2, fields.end(), [](const Word& w) { return !w.empty(); }))
      reading.faults.add(fields[2], "found more than two surfaces of a pair, expected slave and master");
    const auto slave = faces_group(reading, placed.scope, fields[0], "contact");
    const bool with_itself = fields.size() < 2 || fields[1].empty();
    const auto master = with_itself ? slave : faces_group(reading, placed.scope, fields[1], "contact");
    if (!slave || !master)
      continue;
    const bool tied = interaction->tied || block.find("TIED") != nullptr;
    auto zone = tied ? study::ContactZone{} : interaction->numbers;
    zone.tie = tied;
    zone.freeze = !tied && block.find("SMALLSLIDING") != nullptr;
    zone.integration.by =
        on_nodes || slave->of_nodes ? study::ContactIntegration::nodes : study::ContactIntegration::mortar;
    if (with_itself) {
      zone.self = slave->group;
      zone.integration.by = study::ContactIntegration::mortar;
    } else {
      set_sides(reading, *slave, *master, fields[0], zone);
    }
    add_zone(reading, std::move(zone),
             with_itself ? slave->group : fmt::format("{}_{}", slave->group, master->group), fields[0]);
  }
  if (block.lines.empty())
    reading.faults.add(block.at,
                       fmt::format("found {} without surfaces, expected slave and master", block.at.text));
}

void read_tie(Reading& reading, std::size_t index) {
  const auto& placed = reading.content.layout.blocks[index];
  const auto& block = *placed.block;
  const auto* const type = block.find("TYPE");
  const auto kind = type == nullptr ? std::string("SURFACETOSURFACE") : compact(type->value.text);
  if (kind != "SURFACETOSURFACE" && kind != "NODETOSURFACE")
    reading.faults.add(
        type->value,
        fmt::format("found TYPE={}, expected SURFACE TO SURFACE or NODE TO SURFACE", type->value.text));
  for (const auto& line : block.lines) {
    const auto fields = mesh::inp::fields_of(line);
    if (fields.empty())
      continue;
    if (fields.size() != 2) {
      reading.faults.add(fields[0],
                         fmt::format("found {} surfaces of a tie, expected slave and master", fields.size()));
      continue;
    }
    const auto slave = faces_group(reading, placed.scope, fields[0], "a tie");
    const auto master = faces_group(reading, placed.scope, fields[1], "a tie");
    if (!slave || !master)
      continue;
    study::ContactZone zone;
    zone.tie = true;
    zone.integration.by = kind == "NODETOSURFACE" || slave->of_nodes ? study::ContactIntegration::nodes
                                                                     : study::ContactIntegration::mortar;
    set_sides(reading, *slave, *master, fields[0], zone);
    const auto* const name = block.find("NAME");
    add_zone(reading, std::move(zone),
             name == nullptr ? fmt::format("{}_{}", slave->group, master->group)
                             : std::string(name->value.text),
             fields[0]);
  }
}

void read_clearance(Reading& reading, std::size_t index) {
  const auto& placed = reading.content.layout.blocks[index];
  const auto& block = *placed.block;
  auto& faults = reading.faults;
  const auto slave_name = mesh::inp::require_value(block, "SLAVE", "a surface", faults);
  const auto master_name = mesh::inp::require_value(block, "MASTER", "a surface", faults);
  const auto value = mesh::inp::require_number(
      mesh::inp::require_value(block, "VALUE", "a clearance", faults), "a clearance", faults);
  if (slave_name.empty() || master_name.empty() || !value)
    return;
  const auto slave = faces_group(reading, placed.scope, slave_name, "contact");
  const auto master = faces_group(reading, placed.scope, master_name, "contact");
  if (!slave || !master)
    return;
  const auto zone = std::ranges::find_if(reading.study.contact, [&](const study::ContactZone& other) {
    return !other.tie && other.slave == slave->group && other.master == master->group;
  });
  if (zone == reading.study.contact.end())
    return faults.add(slave_name,
                      "found a clearance of two surfaces that are no contact pair, expected those "
                      "of a *CONTACT PAIR");
  const auto* const of_slave = mesh::inp::find_surface(reading.content, placed.scope, slave_name, faults);
  const auto* const of_master = mesh::inp::find_surface(reading.content, placed.scope, master_name, faults);
  const auto [least, largest] = mesh::inp::distances(reading.content, *of_slave, *of_master);
  constexpr double uniform = 1e-3; // of the clearance
  if (largest - least > uniform * std::abs(*value))
    return faults.add(block.find("VALUE")->value,
                      fmt::format("found the clearance {} of surfaces whose meshes are {} to {} apart, "
                                  "expected meshes with one distance",
                                  *value, least, largest));
  zone->gap = study::Field(*value - (least + largest) / 2);
}

void read_general_contact(Reading& reading, std::size_t index) {
  const auto& blocks = reading.content.layout.blocks;
  const auto& contact = *blocks[index].block;
  const Block* inclusions = nullptr;
  const Block* assignment = nullptr;
  for (auto i = index + 1; i < blocks.size(); ++i) {
    if (blocks[i].block->is("CONTACT INCLUSIONS"))
      inclusions = blocks[i].block;
    else if (blocks[i].block->is("CONTACT PROPERTY ASSIGNMENT"))
      assignment = blocks[i].block;
    else if (!blocks[i].block->keyword->name.starts_with("CONTACT"))
      break;
  }
  if (inclusions == nullptr)
    return reading.faults.add(contact.at, "found *CONTACT without *CONTACT INCLUSIONS, expected it");
  study::ContactZone numbers;
  if (assignment != nullptr) {
    const auto fields = mesh::inp::fields_at(*assignment, 0);
    const auto name = field(fields, 2, assignment->at);
    if (assignment->lines.size() != 1 || !field(fields, 0, name).empty() || !field(fields, 1, name).empty())
      return reading.faults.add(assignment->at,
                                "found an assignment to some surfaces, expected one for all: ', , name'");
    const auto* const interaction = named(reading.interactions, name, "an interaction", reading.faults);
    if (interaction == nullptr)
      return;
    numbers = interaction->numbers;
  }
  numbers.integration.by = study::ContactIntegration::mortar;
  if (inclusions->find("ALLEXTERIOR") != nullptr || inclusions->lines.empty()) {
    numbers.all = true;
    return add_zone(reading, numbers, "contact", inclusions->at);
  }
  for (const auto& line : inclusions->lines) {
    const auto fields = mesh::inp::fields_of(line);
    if (fields.empty())
      continue;
    const auto first = faces_group(reading, blocks[index].scope, fields[0], "contact");
    const auto other = field(fields, 1, fields[0]);
    const auto second = other.empty() ? first : faces_group(reading, blocks[index].scope, other, "contact");
    if (!first || !second)
      continue;
    auto zone = numbers;
    const bool same = first->group == second->group;
    if (same)
      zone.self = first->group;
    else
      zone.between = {first->group, second->group};
    add_zone(reading, zone, same ? first->group : fmt::format("{}_{}", first->group, second->group),
             fields[0]);
  }
}

} // namespace rubato::inp
