// SPDX-License-Identifier: LGPL-3.0-or-later
// Relations between displacements, and the nodes that are their references.
#include "rubato/cell/topology.hpp"
#include "rubato/core/naming.hpp"
#include "rubato/inp/reading.hpp"
#include "rubato/mesh/index_lists.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace rubato::inp {
namespace {

using mesh::inp::compact;
using mesh::inp::field;

std::array<double, 3> place_of(const Reading& reading, std::int32_t node) {
  const auto& point = reading.content.points[static_cast<std::size_t>(node)];
  return {point.x(), point.y(), point.z()};
}

void add_relation(Reading& reading, study::Relation relation, const Word& at) {
  reading.places["relations." + relation.name] = at.at();
  reading.study.relations.push_back(std::move(relation));
}

/// A single node.
std::optional<std::int32_t> one_node(Reading& reading, int scope, const Word& word) {
  const auto found = mesh::inp::find_nodes(reading.content, scope, word, reading.faults);
  if (!found)
    return std::nullopt;
  if (found->items.size() == 1)
    return found->items.front();
  reading.faults.add(word, fmt::format("found {}, a set of {} nodes, expected one node",
                                       shown(std::string(word.text)), found->items.size()));
  return std::nullopt;
}

/// The group that a body or surface is in a study; `nodes` become its nodes.
struct Followers {
  std::string group;
  std::vector<std::int32_t> nodes;
};

std::optional<Followers> surface_followers(Reading& reading, int scope, const Word& word) {
  const auto* const surface = mesh::inp::find_surface(reading.content, scope, word, reading.faults);
  if (surface == nullptr)
    return std::nullopt;
  Followers followers{surface->group, surface->nodes};
  for (const auto& face : surface->faces) {
    const auto& element = reading.content.elements[static_cast<std::size_t>(face.element)];
    const auto nodes = reading.content.nodes_of(element);
    for (const auto i : cell::topology(*element.type->cell).sides[static_cast<std::size_t>(face.side)].nodes)
      followers.nodes.push_back(nodes[i]);
  }
  mesh::sort_without_repeats(followers.nodes);
  return followers;
}

std::optional<Followers> set_followers(Reading& reading, int scope, const Word& word, bool of_elements) {
  const auto found = of_elements ? mesh::inp::find_elements(reading.content, scope, word, reading.faults)
                                 : mesh::inp::find_nodes(reading.content, scope, word, reading.faults);
  if (!found)
    return std::nullopt;
  if (!found->is_set || found->name.empty()) {
    reading.faults.add(word, fmt::format("found {}, expected a set", shown(std::string(word.text))));
    return std::nullopt;
  }
  Followers followers{found->name, {}};
  if (!of_elements)
    followers.nodes = found->items;
  for (const auto index : of_elements ? found->items : std::vector<std::int32_t>{}) {
    const auto nodes = reading.content.nodes_of(reading.content.elements[static_cast<std::size_t>(index)]);
    followers.nodes.insert(followers.nodes.end(), nodes.begin(), nodes.end());
  }
  mesh::sort_without_repeats(followers.nodes);
  return followers;
}

/// A relation with a reference where the node is. A node of the group itself can't be one: it is no point of
/// its own.
std::string add_reference(Reading& reading, study::RelationKind kind, const Followers& followers,
                          std::int32_t node, const Word& at, std::string_view label) {
  if (std::ranges::binary_search(followers.nodes, node)) {
    reading.faults.add(
        at, fmt::format("found the reference node {} among the nodes that follow it, expected a node of "
                        "its own",
                        reading.content.node_numbers[static_cast<std::size_t>(node)]));
    return {};
  }
  if (std::ranges::any_of(reading.content.elements, [&](const auto& element) {
        const auto nodes = reading.content.nodes_of(element);
        return std::ranges::find(nodes, node) != nodes.end();
      })) {
    reading.faults.add(at,
                       fmt::format("found the reference node {}, which elements have, expected one without",
                                   reading.content.node_numbers[static_cast<std::size_t>(node)]));
    return {};
  }
  study::Relation relation;
  relation.kind = kind;
  relation.name = chosen_name(reading, relation_kind, label);
  relation.on = followers.group;
  relation.at = place_of(reading, node);
  if (!reading.references.try_emplace(node, ReferenceNode{relation.name, false}).second)
    reading.faults.add(at, "found a node that is a reference already, expected another one");
  auto name = relation.name;
  add_relation(reading, std::move(relation), at);
  return name;
}

/// The rows of displacements that *KINEMATIC and *KINEMATIC COUPLING name are all of them, or a fault.
void require_all_dofs(Reading& reading, const Block& block, std::size_t first_field) {
  std::array<bool, 6> held{};
  bool any = false;
  for (const auto& line : block.lines) {
    const auto fields = mesh::inp::fields_of(line);
    if (fields.size() <= first_field)
      continue;
    any = true;
    const auto from =
        mesh::inp::require_integer(fields[first_field], "a degree of freedom, 1 to 6", reading.faults);
    const auto last = field(fields, first_field + 1, fields[0]);
    const auto to =
        last.empty() ? from : mesh::inp::require_integer(last, "a degree of freedom, 1 to 6", reading.faults);
    for (std::int64_t dof = 1; dof <= 6; ++dof)
      if (from && to && dof >= *from && dof <= *to)
        held[static_cast<std::size_t>(dof) - 1] = true;
  }
  const bool all = std::all_of(held.begin(), held.begin() + reading.dimension(), [](bool is) { return is; });
  if (any && !all)
    reading.faults.add(block.at,
                       "found a kinematic coupling of some displacements only, expected all of them: a group "
                       "moves as a rigid body");
}

} // namespace

void read_coupling(Reading& reading, std::size_t index) {
  const auto& blocks = reading.content.layout.blocks;
  const auto& placed = blocks[index];
  const auto& block = *placed.block;
  const auto surface = mesh::inp::require_value(block, "SURFACE", "a surface", reading.faults);
  const auto reference = mesh::inp::require_value(block, "REFNODE", "a node", reading.faults);
  const auto* const next = index + 1 < blocks.size() ? blocks[index + 1].block : nullptr;
  const bool rigid = next != nullptr && next->is("KINEMATIC");
  if (!rigid && (next == nullptr || !next->is("DISTRIBUTING")))
    return reading.faults.add(
        block.at, fmt::format("found {} without *KINEMATIC or *DISTRIBUTING after it", block.at.text));
  mesh::inp::check_parameters(*next, reading.faults);
  require_all_dofs(reading, *next, 0);
  if (!rigid)
    note(reading, next->at,
         "*DISTRIBUTING: in rubato all nodes of the surface count alike; Abaqus weighs them by their "
         "share of the area");
  if (const auto* way = next->find("WEIGHTINGMETHOD");
      way != nullptr && compact(way->value.text) != "UNIFORM")
    reading.faults.add(way->value,
                       fmt::format("found WEIGHTING METHOD={}, expected UNIFORM", way->value.text));
  if (surface.empty() || reference.empty())
    return;
  const auto followers = surface_followers(reading, placed.scope, surface);
  const auto node = one_node(reading, placed.scope, reference);
  const auto* const name = block.find("CONSTRAINTNAME");
  if (followers && node)
    add_reference(reading, rigid ? study::RelationKind::rigid : study::RelationKind::distributed, *followers,
                  *node, reference, name == nullptr ? surface.text : name->value.text);
}

void read_kinematic_coupling(Reading& reading, std::size_t index) {
  const auto& placed = reading.content.layout.blocks[index];
  const auto& block = *placed.block;
  const auto reference = mesh::inp::require_value(block, "REFNODE", "a node", reading.faults);
  const auto fields = mesh::inp::fields_at(block, 0);
  require_all_dofs(reading, block, 1);
  if (reference.empty() || block.lines.size() != 1 || fields.empty())
    return reading.faults.add(block.at, fmt::format("found {} lines of {}, expected one with a set of nodes",
                                                    block.lines.size(), block.at.text));
  const auto followers = set_followers(reading, placed.scope, fields[0], false);
  const auto node = one_node(reading, placed.scope, reference);
  if (followers && node)
    add_reference(reading, study::RelationKind::rigid, *followers, *node, reference, fields[0].text);
}

void read_rigid_body(Reading& reading, std::size_t index) {
  const auto& placed = reading.content.layout.blocks[index];
  const auto& block = *placed.block;
  const auto reference = mesh::inp::require_value(block, "REFNODE", "a node", reading.faults);
  const auto* set = block.find("NSET");
  set = set == nullptr ? block.find("TIENSET") : set;
  const bool of_elements = set == nullptr;
  set = of_elements ? block.find("ELSET") : set;
  if (set == nullptr)
    return reading.faults.add(block.at,
                              fmt::format("found {} without NSET= or ELSET=, expected a set", block.at.text));
  if (reference.empty())
    return;
  const auto followers = set_followers(reading, placed.scope, set->value, of_elements);
  const auto node = one_node(reading, placed.scope, reference);
  if (!followers || !node)
    return;
  const auto name =
      add_reference(reading, study::RelationKind::rigid, *followers, *node, reference, set->value.text);
  const auto* const rotation = block.find("ROTNODE");
  if (rotation == nullptr || name.empty())
    return;
  const auto turning = one_node(reading, placed.scope, rotation->value);
  if (turning && !reading.references.try_emplace(*turning, ReferenceNode{name, true}).second)
    reading.faults.add(rotation->value, "found a node that is a reference already, expected another one");
}

void read_embedded(Reading& reading, std::size_t index) {
  const auto& placed = reading.content.layout.blocks[index];
  const auto& block = *placed.block;
  const auto* const host = block.find("HOSTELSET");
  for (const auto& line : block.lines)
    for (const auto& word : mesh::inp::fields_of(line)) {
      if (word.empty())
        continue;
      const auto followers = set_followers(reading, placed.scope, word, true);
      study::Relation relation;
      relation.kind = study::RelationKind::embedded;
      relation.name = chosen_name(reading, relation_kind, fmt::format("{}_embedded", word.text));
      if (host != nullptr)
        if (const auto in = set_followers(reading, placed.scope, host->value, true); in)
          relation.cells = in->group;
      if (!followers)
        continue;
      relation.on = followers->group;
      add_relation(reading, std::move(relation), word);
    }
}

void read_equation(Reading& reading, std::size_t index) {
  const auto& placed = reading.content.layout.blocks[index];
  const auto& block = *placed.block;
  auto& faults = reading.faults;
  std::vector<Word> words;
  std::size_t line = 0;
  const auto next_line = [&] {
    words.clear();
    while (line < block.lines.size() && words.empty())
      words = mesh::inp::fields_of(block.lines[line++]);
    return !words.empty();
  };
  while (next_line()) {
    const auto at = words[0];
    const auto count = mesh::inp::require_integer(at, "the number of terms", faults);
    constexpr std::int64_t most_terms = 100'000;
    if (count && (*count < 1 || *count > most_terms || words.size() > 1))
      faults.add(at, "expected the number of terms of an equation, 1 or more, alone on its line");
    if (!faults.empty())
      return;
    study::Relation relation;
    relation.kind = study::RelationKind::equation;
    relation.name = chosen_name(reading, relation_kind, "equation");
    std::vector<Word> terms;
    while (terms.size() < 3 * static_cast<std::size_t>(*count) && next_line())
      terms.insert(terms.end(), words.begin(), words.end());
    if (terms.size() != 3 * static_cast<std::size_t>(*count))
      return faults.add(
          at, fmt::format("found {} values of an equation, expected {}: node, degree of freedom and "
                          "coefficient of each term",
                          terms.size(), 3 * *count));
    for (std::size_t i = 0; i < terms.size(); i += 3) {
      const auto node = one_node(reading, placed.scope, terms[i]);
      const auto dof = mesh::inp::require_integer(terms[i + 1], "a degree of freedom", faults);
      const auto coefficient = mesh::inp::require_number(terms[i + 2], "a coefficient", faults);
      if (!node || !dof || !coefficient)
        continue;
      if (*dof < 1 || *dof > reading.dimension() || reading.references.contains(*node)) {
        faults.add(terms[i + 1],
                   fmt::format("found the degree of freedom {} of node {}, expected a displacement of a "
                               "node of a body, 1 to {}",
                               *dof, terms[i].text, reading.dimension()));
        continue;
      }
      study::RelationTerm term;
      term.on = node_name(reading, *node);
      term.coefficients.at(static_cast<std::size_t>(*dof) - 1) = *coefficient;
      if (*coefficient != 0)
        relation.terms.push_back(term);
    }
    add_relation(reading, std::move(relation), at);
  }
}

/// Pairs of nodes with the same displacement.
void read_mpc(Reading& reading, std::size_t index) {
  const auto& placed = reading.content.layout.blocks[index];
  for (const auto& line : placed.block->lines) {
    const auto fields = mesh::inp::fields_of(line);
    if (fields.empty())
      continue;
    const auto kind = compact(fields[0].text);
    if (kind != "PIN" && kind != "TIE") {
      reading.faults.add(fields[0], fmt::format("found an MPC of type {}, expected PIN or TIE",
                                                shown(std::string(fields[0].text))));
      continue;
    }
    if (fields.size() != 3) {
      reading.faults.add(fields[0], fmt::format("found {} nodes, expected two", fields.size() - 1));
      continue;
    }
    const auto a = one_node(reading, placed.scope, fields[1]);
    const auto b = one_node(reading, placed.scope, fields[2]);
    if (!a || !b)
      continue;
    for (int axis = 0; axis < reading.dimension(); ++axis) {
      study::Relation relation;
      relation.kind = study::RelationKind::equation;
      relation.name = chosen_name(reading, relation_kind, "mpc");
      for (const auto& [node, coefficient] : {std::pair(*a, 1.0), std::pair(*b, -1.0)}) {
        study::RelationTerm term;
        term.on = node_name(reading, node);
        term.coefficients.at(static_cast<std::size_t>(axis)) = coefficient;
        relation.terms.push_back(term);
      }
      add_relation(reading, std::move(relation), fields[0]);
    }
  }
}

} // namespace rubato::inp
