// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/mesh/names.hpp"

#include "rubato/core/error.hpp"
#include "rubato/core/naming.hpp"
#include "rubato/mesh/index_lists.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <iterator>
#include <optional>
#include <span>
#include <unordered_set>

namespace rubato::mesh {
namespace {

/// The number in "N90", "n90" or "90".
std::optional<std::int64_t> number_in(std::string_view text) {
  if (!text.empty() && (text.front() == 'N' || text.front() == 'n'))
    text.remove_prefix(1);
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size())
    return std::nullopt;
  return number;
}

template <class Values, class Wanted>
std::vector<NodeIndex> places_of(const Values& values, const Wanted& wanted) {
  std::vector<NodeIndex> places;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (values[i] == wanted)
      places.push_back(static_cast<NodeIndex>(i));
  return places;
}

bool has_names(const Mesh& mesh) {
  return !mesh.node_names.empty();
}

std::vector<NodeIndex> nodes_numbered(const Mesh& mesh, std::string_view name) {
  const auto number = number_in(name);
  return number ? places_of(mesh.node_numbers, *number) : std::vector<NodeIndex>{};
}

std::vector<NodeIndex> nodes_of_cells(const Mesh& mesh, const Group& group) {
  std::vector<NodeIndex> nodes;
  for (const auto cell : group.items) {
    const auto of_cell = mesh.nodes_of(cell);
    nodes.insert(nodes.end(), of_cell.begin(), of_cell.end());
  }
  sort_without_repeats(nodes);
  return nodes;
}

FoundNodes in_group(const Mesh& mesh, std::string_view name, std::vector<NodeIndex> nodes) {
  if (nodes.empty())
    return {{}, fmt::format("group '{}' is empty, expected a group with nodes, or a node", name)};
  if (const auto called = places_of(mesh.node_names, name); !called.empty() && called != nodes)
    return {{},
            fmt::format("found '{}', which is the name of a group and of a node that is not this group, "
                        "expected a name of one of them: rename one in the mesh",
                        name)};
  return {std::move(nodes), {}};
}

FoundNodes single_node(std::vector<NodeIndex> nodes, std::string_view name, std::string_view what) {
  if (nodes.size() > 1)
    return {
        {},
        fmt::format("found '{}', the {} of {} nodes of the mesh, expected one of a single node, or a group",
                    name, what, nodes.size())};
  return {std::move(nodes), {}};
}

/// Where the file names its nodes, a number that was meant as a name is told with the name of that node.
std::string hint_of_number(const Mesh& mesh, std::string_view name) {
  const auto numbered = has_names(mesh) ? nodes_numbered(mesh, name) : std::vector<NodeIndex>{};
  if (numbered.size() != 1)
    return {};
  return fmt::format(" (the file names its nodes: number {} is '{}' there)", *number_in(name),
                     node_name(mesh, numbered.front()));
}

std::string nothing_found(const Mesh& mesh, std::string_view name) {
  const auto groups = group_names(mesh);
  auto candidates = groups;
  candidates.insert(candidates.end(), mesh.node_names.begin(), mesh.node_names.end());
  const auto nearest = nearest_word(std::string(name), candidates);
  const auto text = fmt::format("found '{}', expected a group or a node ({}) of the mesh{}", name,
                                has_names(mesh) ? "by its name" : "'N90'", hint_of_number(mesh, name));
  if (!nearest.empty())
    return text + fmt::format("; did you mean '{}'?", nearest);
  return text + (groups.empty() ? std::string("; the mesh has no groups")
                                : fmt::format("; the mesh has the groups {}", fmt::join(groups, ", ")));
}

/// Lists of names that together must not repeat one, with the numbers of what they name.
class NamedItems {
public:
  explicit NamedItems(char letter) : letter_(letter) {}

  void add(std::vector<std::string>& names, std::span<const std::int64_t> numbers) {
    lists_.push_back({&names, numbers});
  }

  void complete() const {
    std::unordered_set<std::string> taken;
    for (const auto& list : lists_)
      std::ranges::copy_if(*list.names, std::inserter(taken, taken.end()),
                           [](const std::string& name) { return !name.empty(); });
    for (const auto& list : lists_) {
      if (taken.empty())
        list.names->clear();
      else
        complete(list, taken);
    }
  }

private:
  struct List {
    std::vector<std::string>* names;
    std::span<const std::int64_t> numbers;
  };

  void complete(const List& list, std::unordered_set<std::string>& taken) const {
    list.names->resize(list.numbers.size());
    for (std::size_t i = 0; i < list.numbers.size(); ++i) {
      auto& name = (*list.names)[i];
      if (!name.empty())
        continue;
      name = fmt::format("{}{}", letter_, list.numbers[i]);
      while (!taken.insert(name).second)
        name += '_';
    }
  }

  char letter_;
  std::vector<List> lists_;
};

} // namespace

FoundNodes find_nodes(const Mesh& mesh, std::string_view name) {
  if (const auto* group = mesh.node_group(name))
    return in_group(mesh, name, group->items);
  if (const auto* group = mesh.cell_group(name))
    return in_group(mesh, name, nodes_of_cells(mesh, *group));
  auto found = has_names(mesh) ? single_node(places_of(mesh.node_names, name), name, "name")
                               : single_node(nodes_numbered(mesh, name), name, "number");
  if (found.nodes.empty() && found.fault.empty())
    found.fault = nothing_found(mesh, name);
  return found;
}

void name_the_rest(Mesh& mesh) {
  NamedItems nodes('N');
  nodes.add(mesh.node_names, mesh.node_numbers);
  nodes.complete();
  NamedItems cells('M');
  for (auto& block : mesh.blocks)
    cells.add(block.names, block.numbers);
  cells.complete();
}

std::string node_name(const Mesh& mesh, NodeIndex node) {
  const auto i = static_cast<std::size_t>(node);
  if (i < mesh.node_names.size())
    return mesh.node_names[i];
  return fmt::format("N{}", i < mesh.node_numbers.size() ? mesh.node_numbers[i] : std::int64_t{node} + 1);
}

std::string cell_name(const Mesh& mesh, CellIndex cell) {
  const auto [block, index] = mesh.place_of(cell);
  const auto i = static_cast<std::size_t>(index);
  if (i < block->names.size())
    return block->names[i];
  return fmt::format("{}", i < block->numbers.size() ? block->numbers[i] : std::int64_t{cell} + 1);
}

} // namespace rubato::mesh
