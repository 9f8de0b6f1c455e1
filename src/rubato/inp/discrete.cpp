// SPDX-License-Identifier: LGPL-3.0-or-later
// Springs, dashpots and masses; what all elements need.
#include "rubato/cell/topology.hpp"
#include "rubato/core/naming.hpp"
#include "rubato/inp/reading.hpp"
#include "rubato/mesh/index_lists.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace rubato::inp {
namespace {

using mesh::inp::Element;
using mesh::inp::Family;

/// A node, or the reference that it is.
std::string end_name(Reading& reading, std::int32_t node) {
  const auto found = reading.references.find(node);
  if (found == reading.references.end())
    reading.used_nodes.insert(node);
  return found == reading.references.end() ? node_name(reading, node) : found->second.relation;
}

/// The axis that a spring or dashpot acts along; nothing for those along their line.
struct Line {
  bool sound = false;
  std::optional<std::array<double, 3>> along;
};

Line axis_of(Reading& reading, const Block& block, const Element& element) {
  const auto& name = element.type->name;
  if (name.ends_with("A"))
    return {true, std::nullopt};
  const auto fields = mesh::inp::fields_at(block, 0);
  const auto first =
      mesh::inp::require_integer(field(fields, 0, block.at), "a degree of freedom", reading.faults);
  const bool of_two = name.ends_with("2");
  const auto second = of_two ? mesh::inp::require_integer(field(fields, 1, block.at),
                                                          "a degree of freedom of the "
                                                          "second node",
                                                          reading.faults)
                             : first;
  if (!first || !second)
    return {};
  if (*first != *second || *first < 1 || *first > reading.dimension()) {
    reading.faults.add(fields[0],
                       fmt::format("found the degrees of freedom {} and {}, expected a displacement, 1 to "
                                   "{}, the same of both nodes",
                                   *first, *second, reading.dimension()));
    return {};
  }
  std::array<double, 3> along{};
  along.at(static_cast<std::size_t>(*first) - 1) = 1;
  return {true, along};
}

/// The elements of the set, all of the family.
std::vector<const Element*> elements_of(Reading& reading, const Placed& placed, Family family,
                                        std::string_view what) {
  const auto set = mesh::inp::require_value(*placed.block, "ELSET", "a set of elements", reading.faults);
  std::vector<const Element*> elements;
  if (set.empty())
    return elements;
  const auto found = mesh::inp::find_elements(reading.content, placed.scope, set, reading.faults);
  for (const auto index : found ? found->items : std::vector<std::int32_t>{}) {
    const auto& element = reading.content.elements[static_cast<std::size_t>(index)];
    if (element.type->family != family) {
      reading.faults.add(set, fmt::format("found a {} element in the set of {}, expected {}",
                                          element.type->name, placed.block->at.text, what));
      return {};
    }
    elements.push_back(&element);
  }
  if (found)
    reading.with_section.insert(reading.with_section.end(), found->items.begin(), found->items.end());
  return elements;
}

/// Lines of force and elongation as a table.
std::optional<LinearTable> spring_table(Reading& reading, const Block& block) {
  LinearTable table;
  table.outside = LinearTable::Outside::constant; // the force of the last line goes on
  for (std::size_t i = 1; i < block.lines.size(); ++i) {
    const auto fields = mesh::inp::fields_of(block.lines[i]);
    if (fields.empty())
      continue;
    const auto force = mesh::inp::require_number(fields[0], "a force", reading.faults);
    const auto elongation =
        mesh::inp::require_number(field(fields, 1, fields[0]), "an elongation", reading.faults);
    if (!force || !elongation)
      return std::nullopt;
    table.at.push_back(*elongation);
    table.values.push_back(*force);
  }
  return table;
}

/// The one number of the second line.
std::optional<double> coefficient_of(Reading& reading, const Block& block, std::string_view what) {
  const auto fields = mesh::inp::fields_at(block, 1);
  if (block.lines.size() > 2)
    reading.faults.add(mesh::inp::word_of(block.lines[2]),
                       fmt::format("found a second line of {}, expected one: it "
                                   "does not depend on anything",
                                   what));
  return mesh::inp::require_number(
      field(fields, 0, block.lines.size() > 1 ? mesh::inp::word_of(block.lines[1]) : block.at), what,
      reading.faults);
}

template <class Set>
void add_connectors(Reading& reading, const Placed& placed, Family family, std::string_view what, Set set) {
  for (const auto* element : elements_of(reading, placed, family, what)) {
    const auto line = axis_of(reading, *placed.block, *element);
    if (!line.sound)
      return;
    const auto nodes = reading.content.nodes_of(*element);
    study::Connector connector;
    connector.on = end_name(reading, nodes[0]);
    if (nodes.size() > 1)
      connector.to = end_name(reading, nodes[1]);
    connector.along = line.along;
    set(connector);
    reading.places[fmt::format("connectors.{}", reading.study.connectors.size())] = placed.block->at.at();
    reading.study.connectors.push_back(connector);
  }
}

} // namespace

void read_spring(Reading& reading, std::size_t index) {
  const auto& placed = reading.content.layout.blocks[index];
  const bool by_table = placed.block->find("NONLINEAR") != nullptr;
  const auto table = by_table ? spring_table(reading, *placed.block) : std::nullopt;
  const auto stiffness = by_table ? std::nullopt : coefficient_of(reading, *placed.block, "the stiffness");
  if (!table && !stiffness)
    return;
  add_connectors(reading, placed, Family::spring, "springs", [&](study::Connector& connector) {
    connector.stiffness = stiffness.value_or(0);
    connector.force = table;
  });
}

void read_dashpot(Reading& reading, std::size_t index) {
  const auto& placed = reading.content.layout.blocks[index];
  const auto damping = coefficient_of(reading, *placed.block, "the damping");
  if (damping)
    add_connectors(reading, placed, Family::dashpot, "dashpots",
                   [&](study::Connector& connector) { connector.damping = *damping; });
}

/// Springs that push once the clearance is closed: CalculiX' stiffness, where none is given.
void read_gap(Reading& reading, std::size_t index) {
  const auto& placed = reading.content.layout.blocks[index];
  const auto& block = *placed.block;
  constexpr double usual_stiffness = 1e12;
  std::array<double, 6> numbers{0, 0, 0, 0, 0, usual_stiffness};
  const auto fields = mesh::inp::fields_at(block, 0);
  for (std::size_t i = 0; i < std::min(numbers.size(), fields.size()); ++i)
    numbers.at(i) = mesh::inp::require_number(fields[i], "a number of the gap", reading.faults, numbers.at(i))
                        .value_or(0);
  if (!(numbers[5] > 0))
    return reading.faults.add(fields[5], "found a stiffness of the gap that is not above 0");
  note(reading, block.at,
       fmt::format("the gap pushes by a stiffness of {}, as in CalculiX with NLGEOM; in Abaqus it is rigid",
                   numbers[5]));
  for (const auto* element : elements_of(reading, placed, Family::spring, "GAPUNI elements")) {
    const auto nodes = reading.content.nodes_of(*element);
    std::array<double, 3> along{numbers[1], numbers[2], numbers[3]};
    if (along == std::array<double, 3>{}) {
      const auto& from = reading.content.points[static_cast<std::size_t>(nodes[0])];
      const auto& to = reading.content.points[static_cast<std::size_t>(nodes[1])];
      along = {to.x() - from.x(), to.y() - from.y(), to.z() - from.z()};
    }
    if (along == std::array<double, 3>{})
      return reading.faults.add(block.at, "found a gap between nodes at one place without a direction, "
                                          "expected one");
    study::Connector connector;
    connector.on = end_name(reading, nodes[0]);
    connector.to = end_name(reading, nodes[1]);
    connector.along = along;
    LinearTable table; // of the elongation, which is minus the clearance where the gap is closed
    table.outside = LinearTable::Outside::linear;
    table.at = {-numbers[0] - 1, -numbers[0], -numbers[0] + 1};
    table.values = {-numbers[5], 0, 0};
    connector.force = table;
    reading.places[fmt::format("connectors.{}", reading.study.connectors.size())] = block.at.at();
    reading.study.connectors.push_back(connector);
  }
}

void read_mass(Reading& reading, std::size_t index) {
  const auto& placed = reading.content.layout.blocks[index];
  const auto fields = mesh::inp::fields_at(*placed.block, 0);
  const auto mass = mesh::inp::require_number(field(fields, 0, placed.block->at), "the mass", reading.faults);
  if (!mass)
    return;
  for (const auto* element : elements_of(reading, placed, Family::mass, "MASS elements")) {
    reading.places[fmt::format("masses.{}", reading.study.masses.size())] = placed.block->at.at();
    reading.study.masses.push_back({end_name(reading, reading.content.nodes_of(*element)[0]), *mass, {}});
  }
}

void check_elements(Reading& reading) {
  std::set<std::string_view> told;
  for (const auto& element : reading.content.elements) {
    const auto& type = *element.type;
    if (type.family == Family::structural && told.insert(type.name).second)
      reading.faults.add(element.at,
                         fmt::format("found {} elements, expected solids: there are no shells, membranes, "
                                     "beams, trusses and rigid elements",
                                     type.name));
    if (type.how == mesh::inp::Integration::full && !type.differs.empty() && told.insert(type.name).second)
      note(reading, element.at,
           fmt::format(
               "{} has {} in Abaqus, rubato computes it as {} with full integration: coarse meshes may "
               "be stiffer, fine ones agree",
               type.name, type.differs, cell::topology(*type.cell).name));
  }
}

void check_properties(Reading& reading) {
  mesh::sort_without_repeats(reading.with_section);
  std::set<Family> told;
  const auto& elements = reading.content.elements;
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const auto family = elements[i].type->family;
    const bool needs = family != Family::skin && family != Family::structural;
    const bool has = std::ranges::binary_search(reading.with_section, static_cast<std::int32_t>(i));
    if (!needs || has || !told.insert(mesh::inp::is_continuum(family) ? Family::solid : family).second)
      continue;
    const auto* keyword = family == Family::mass      ? "*MASS"
                          : family == Family::spring  ? "*SPRING"
                          : family == Family::dashpot ? "*DASHPOT"
                                                      : "*SOLID SECTION";
    reading.faults.add(elements[i].at, fmt::format("found element {} ({}) in no set of a {}, expected one",
                                                   elements[i].number, elements[i].type->name, keyword));
  }
}

} // namespace rubato::inp
