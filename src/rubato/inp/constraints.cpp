// SPDX-License-Identifier: LGPL-3.0-or-later
// Relations between displacements, and the nodes that are their references.
#include "rubato/cell/topology.hpp"
#include "rubato/core/naming.hpp"
#include "rubato/inp/followers.hpp"
#include "rubato/inp/points.hpp"
#include "rubato/mesh/index_lists.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>

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

} // namespace

std::optional<Followers> surface_followers(Reading& reading, int scope, const Word& word) {
  const auto* const surface = mesh::inp::find_surface(reading.content, scope, word, reading.faults);
  if (surface == nullptr)
    return std::nullopt;
  Followers followers{surface->group, surface->nodes, surface->faces};
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
  Followers followers{found->name, {}, {}};
  if (!of_elements)
    followers.nodes = found->items;
  for (const auto index : of_elements ? found->items : std::vector<std::int32_t>{}) {
    const auto nodes = reading.content.nodes_of(reading.content.elements[static_cast<std::size_t>(index)]);
    followers.nodes.insert(followers.nodes.end(), nodes.begin(), nodes.end());
  }
  mesh::sort_without_repeats(followers.nodes);
  return followers;
}

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

namespace {

/// The nodes of a term, a degree of freedom along their own axes, and a coefficient.
struct TermOfNodes {
  std::vector<std::int32_t> nodes;
  int dof = 0; ///< from 0
  double coefficient = 0;
};

std::optional<TermOfNodes> term_of(Reading& reading, int scope, std::span<const Word> words) {
  const auto found = mesh::inp::find_nodes(reading.content, scope, words[0], reading.faults);
  const auto dof = mesh::inp::require_integer(words[1], "a degree of freedom", reading.faults);
  const auto coefficient = mesh::inp::require_number(words[2], "a coefficient", reading.faults);
  if (!found || found->items.empty() || !dof || !coefficient)
    return std::nullopt;
  const auto node = found->items.front();
  const bool turns = reading.content.rotation_nodes.contains(node) && found->items.size() == 1 &&
                     (reading.dimension() == 3 ? *dof > 3 && *dof <= 6 : *dof == 6);
  if (!turns && (*dof < 1 || *dof > reading.dimension() || reading.references.contains(node))) {
    reading.faults.add(words[1],
                       fmt::format("found the degree of freedom {} of node {}, expected a displacement of a "
                                   "node of a body, 1 to {}",
                                   *dof, words[0].text, reading.dimension()));
    return std::nullopt;
  }
  return TermOfNodes{found->items, static_cast<int>(*dof) - 1, *coefficient};
}

void add_term(const Reading& reading, const TermOfNodes& term, std::size_t which, Sum& sum) {
  auto node = term.nodes[term.nodes.size() == 1 ? 0 : which];
  int dof = term.dof;
  if (dof >= 3) {
    node = reading.content.rotation_nodes.at(node);
    dof = reading.dimension() == 3 ? dof - 3 : 0;
  }
  sum.add(node, term.coefficient * axes_of(reading, node).col(dof));
}

/// One equation, or one for each node of the sets that terms name.
void add_equations(Reading& reading, int scope, std::span<const Word> words, const Word& at) {
  std::vector<TermOfNodes> terms;
  std::size_t count = 1;
  for (std::size_t i = 0; i < words.size(); i += 3) {
    auto term = term_of(reading, scope, words.subspan(i, 3));
    if (!term)
      return;
    count = std::max(count, term->nodes.size());
    terms.push_back(std::move(*term));
  }
  for (std::size_t i = 0; i < terms.size(); ++i)
    if (terms[i].nodes.size() != 1 && terms[i].nodes.size() != count)
      return reading.faults.add(words[3 * i],
                                fmt::format("found a set of {} nodes in an equation of sets of {}, expected "
                                            "as many, or one node",
                                            terms[i].nodes.size(), count));
  for (std::size_t which = 0; which < count; ++which) {
    Sum sum;
    for (const auto& term : terms)
      add_term(reading, term, which, sum);
    add_equation(reading, sum, "equation", at);
  }
}

} // namespace

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
    std::vector<Word> terms;
    while (terms.size() < 3 * static_cast<std::size_t>(*count) && next_line())
      terms.insert(terms.end(), words.begin(), words.end());
    if (terms.size() != 3 * static_cast<std::size_t>(*count))
      return faults.add(
          at, fmt::format("found {} values of an equation, expected {}: node, degree of freedom and "
                          "coefficient of each term",
                          terms.size(), 3 * *count));
    add_equations(reading, placed.scope, terms, at);
  }
}

} // namespace rubato::inp
