// SPDX-License-Identifier: LGPL-3.0-or-later
// Nodes whose displacements are the rotations of reference nodes.
#include "rubato/mesh/io/inp_content.hpp"

#include <algorithm>
#include <array>
#include <set>

namespace rubato::mesh::inp {
namespace {

/// Numbers on lines of equations, by scope: nodes among them.
std::set<std::pair<int, std::int64_t>> numbers_in_equations(const Content& content) {
  std::set<std::pair<int, std::int64_t>> numbers;
  for (const auto& placed : content.layout.blocks)
    if (placed.block->is("EQUATION") || placed.block->is("MPC"))
      for (const auto& line : placed.block->lines)
        for (const auto& word : fields_of(line))
          if (const auto number = integer_in(word.text); number)
            numbers.insert({placed.scope, *number});
  return numbers;
}

std::set<NodeIndex> nodes_of_elements(const Content& content) {
  std::set<NodeIndex> nodes;
  for (const auto& element : content.elements)
    if (is_continuum(element.type->family))
      for (const auto node : content.nodes_of(element))
        nodes.insert(node);
  return nodes;
}

/// Returns whether the lines of a kinematic coupling have every displacement of the model.
bool couples_all(const Block& block, std::size_t first_field, int dimension) {
  std::array<bool, 6> held{};
  bool any = false;
  for (const auto& line : block.lines) {
    const auto fields = fields_of(line);
    if (fields.size() <= first_field || fields[first_field].empty())
      continue;
    any = true;
    const auto from = integer_in(fields[first_field].text);
    const auto last = field(fields, first_field + 1, fields[first_field]);
    const auto to = last.empty() ? from : integer_in(last.text);
    for (int dof = 1; dof <= 6; ++dof)
      if (from && to && dof >= *from && dof <= *to)
        held.at(static_cast<std::size_t>(dof) - 1) = true;
  }
  return !any || std::all_of(held.begin(), held.begin() + dimension, [](bool is) { return is; });
}

} // namespace

void add_rotation_nodes(Content& content) {
  const auto in_equations = numbers_in_equations(content);
  const auto of_elements = nodes_of_elements(content);
  std::set<NodeIndex> references;
  std::set<NodeIndex> wanted;
  Faults told_elsewhere;
  const auto& blocks = content.layout.blocks;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const auto& block = *blocks[i].block;
    const auto* const reference = block.find("REFNODE");
    const bool older = block.is("KINEMATIC COUPLING") || block.is("DISTRIBUTING COUPLING");
    if (reference == nullptr || !(older || block.is("COUPLING")))
      continue;
    const auto found = find_nodes(content, blocks[i].scope, reference->value, told_elsewhere);
    if (!found || found->items.size() != 1)
      continue;
    const auto node = found->items.front();
    const auto number = integer_in(reference->value.text);
    const auto* const next = i + 1 < blocks.size() ? blocks[i + 1].block : nullptr;
    const bool distributes =
        block.is("DISTRIBUTING COUPLING") || (next != nullptr && next->is("DISTRIBUTING"));
    const bool all = older ? couples_all(block, 1, content.dimension)
                           : next == nullptr || couples_all(*next, 0, content.dimension);
    if (!references.insert(node).second || (number && in_equations.contains({blocks[i].scope, *number})))
      content.shared_references.insert(node);
    if (distributes || !all || of_elements.contains(node) || content.shared_references.contains(node))
      wanted.insert(node);
  }
  auto next_number = content.node_numbers.empty() ? 0 : *std::ranges::max_element(content.node_numbers);
  for (const auto node : wanted) {
    content.rotation_nodes[node] = static_cast<NodeIndex>(content.points.size());
    content.points.push_back(Eigen::Vector3d(content.points[static_cast<std::size_t>(node)]));
    content.node_numbers.push_back(++next_number);
  }
}

} // namespace rubato::mesh::inp
