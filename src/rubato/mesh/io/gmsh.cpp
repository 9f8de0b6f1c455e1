// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/mesh/io/gmsh.hpp"

#include "rubato/error.hpp"

#include <fmt/format.h>

#ifndef RUBATO_HAS_GMSH

namespace rubato::mesh {

bool has_gmsh() {
  return false;
}

Mesh read_gmsh(const std::filesystem::path& path) {
  throw InputError(fmt::format(
      "mesh file '{}' needs Gmsh, and this program was built without it: convert it to MED", path.string()));
}

} // namespace rubato::mesh

#else

#include "rubato/mesh/io/gmsh_library.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <unordered_map>
#include <utility>

namespace rubato::mesh {
namespace {

using gmsh::Entity;
using gmsh::Session;
using gmsh::Tag;
using Order = std::span<const std::uint8_t>;

// Gmsh numbers mid-edge nodes in its own order of edges and face nodes in its own order of faces (Gmsh
// reference manual, "Node ordering"): our node i is Gmsh's node order[i].
constexpr std::array<std::uint8_t, 10> tetra10{0, 1, 2, 3, 4, 5, 6, 7, 9, 8};
constexpr std::array<std::uint8_t, 13> pyra13{0, 1, 2, 3, 4, 5, 8, 10, 6, 7, 9, 11, 12};
constexpr std::array<std::uint8_t, 18> penta18{0, 1, 2, 3, 4, 5, 6, 9, 7, 12, 14, 13, 8, 10, 11, 15, 17, 16};
constexpr std::array<std::uint8_t, 27> hexa27{0,  1,  2,  3,  4,  5,  6,  7,  8,  11, 13, 9,  16, 18,
                                              19, 17, 10, 12, 14, 15, 22, 23, 21, 24, 20, 25, 26};

struct KnownType {
  int gmsh;
  CellType ours;
  Order order; ///< empty when the orders agree
};

const std::array<KnownType, 18> known_types{{{1, CellType::seg2, {}},
                                             {2, CellType::tria3, {}},
                                             {3, CellType::quad4, {}},
                                             {4, CellType::tetra4, {}},
                                             {5, CellType::hexa8, {}},
                                             {6, CellType::penta6, {}},
                                             {7, CellType::pyra5, {}},
                                             {8, CellType::seg3, {}},
                                             {9, CellType::tria6, {}},
                                             {10, CellType::quad9, {}},
                                             {11, CellType::tetra10, tetra10},
                                             {12, CellType::hexa27, hexa27},
                                             {13, CellType::penta18, penta18},
                                             {15, CellType::point1, {}},
                                             {16, CellType::quad8, {}},
                                             {17, CellType::hexa20, Order(hexa27).first(20)},
                                             {18, CellType::penta15, Order(penta18).first(15)},
                                             {19, CellType::pyra13, pyra13}}};

const KnownType& known_type(const Session& session, int gmsh_type) {
  const auto* const found = std::ranges::find(known_types, gmsh_type, &KnownType::gmsh);
  if (found != known_types.end())
    return *found;
  throw InputError(fmt::format("it holds cells of type {}, which this program does not know (full quadratic "
                               "pyramids become PYRA13 with Mesh.SecondOrderIncomplete = 1)",
                               session.name_of_type(gmsh_type)));
}

/// Cells of one type while they are collected, by Gmsh's tags.
struct TaggedCells {
  std::map<Tag, std::vector<Tag>> nodes_of_cell; ///< in our order
};

struct Collected {
  std::map<CellType, TaggedCells> cells;
  std::map<std::string, std::set<std::pair<CellType, Tag>>> cell_groups;
  std::map<std::string, std::set<Tag>> node_groups;
};

/// Takes the cells of one entity of the geometry and adds them to the groups named.
void collect_cells(const Session& session, Entity entity, const std::vector<std::string>& groups,
                   Collected& into) {
  const auto found = session.elements_of(entity);
  for (std::size_t t = 0; t < found.types.size(); ++t) {
    const auto& type = known_type(session, found.types[t]);
    if (type.ours == CellType::point1)
      continue;
    const auto width = static_cast<std::size_t>(topology(type.ours).node_count);
    const auto& cells = found.cells[t];
    auto& known = into.cells[type.ours].nodes_of_cell;
    for (std::size_t c = 0; c < cells.size(); ++c) {
      std::vector<Tag> own(width);
      for (std::size_t i = 0; i < width; ++i)
        own[i] = found.nodes[t][c * width + (type.order.empty() ? i : type.order[i])];
      known.emplace(cells[c], std::move(own));
      for (const auto& group : groups)
        into.cell_groups[group].emplace(type.ours, cells[c]);
    }
  }
}

std::string group_name(const Session& session, Entity group) {
  constexpr std::array<std::string_view, 4> kinds{"point", "line", "surface", "volume"};
  auto name = session.name_of(group);
  return name.empty() ? fmt::format("{}_{}", kinds.at(static_cast<std::size_t>(group.dimension)), group.tag)
                      : name;
}

Collected collect(const Session& session) {
  Collected collected;
  for (const auto group : session.physical_groups()) {
    const auto name = group_name(session, group);
    for (const auto tag : session.entities_of(group)) {
      const Entity entity{group.dimension, tag};
      if (entity.dimension == 0)
        std::ranges::copy(session.nodes_of(entity).tags,
                          std::inserter(collected.node_groups[name], collected.node_groups[name].end()));
      else
        collect_cells(session, entity, {name}, collected);
    }
  }
  if (collected.cells.empty())
    collect_cells(session, gmsh::everything, {}, collected);
  return collected;
}

std::set<Tag> nodes_in_use(const Collected& collected) {
  std::set<Tag> used;
  for (const auto& [type, cells] : collected.cells)
    for (const auto& [cell, nodes] : cells.nodes_of_cell)
      used.insert(nodes.begin(), nodes.end());
  for (const auto& [name, nodes] : collected.node_groups)
    used.insert(nodes.begin(), nodes.end());
  return used;
}

using IndexOfNode = std::unordered_map<Tag, NodeIndex>;

IndexOfNode add_nodes(const gmsh::Nodes& nodes, const std::set<Tag>& used, Mesh& mesh) {
  std::unordered_map<Tag, std::size_t> place;
  for (std::size_t i = 0; i < nodes.tags.size(); ++i)
    place.emplace(nodes.tags[i], i);

  IndexOfNode index;
  for (const auto tag : used) {
    const auto found = place.find(tag);
    if (found == place.end())
      throw InputError(fmt::format("a cell has node {}, which does not exist", tag));
    index.emplace(tag, mesh.node_count());
    mesh.points.emplace_back(Eigen::Map<const Eigen::Vector3d>(&nodes.coordinates[3 * found->second]));
    mesh.node_numbers.push_back(static_cast<std::int64_t>(tag));
  }
  return index;
}

void add_groups(const Collected& collected, const IndexOfNode& node, Mesh& mesh) {
  std::map<std::pair<CellType, Tag>, CellIndex> index_of_cell;
  for (const auto& [type, cells] : collected.cells)
    for (const auto& [tag, nodes] : cells.nodes_of_cell)
      index_of_cell.emplace(std::pair(type, tag), static_cast<CellIndex>(index_of_cell.size()));
  for (const auto& [name, cells] : collected.cell_groups) {
    Group group{name, {}};
    for (const auto& cell : cells)
      group.items.push_back(index_of_cell.at(cell));
    mesh.cell_groups.push_back(std::move(group));
  }
  for (const auto& [name, tags] : collected.node_groups) {
    Group group{name, {}};
    for (const auto tag : tags)
      group.items.push_back(node.at(tag));
    mesh.node_groups.push_back(std::move(group));
  }
}

int space_dimension(const Mesh& mesh) {
  double size = 0.0;
  double height = 0.0;
  for (const auto& point : mesh.points) {
    size = std::max(size, point.cwiseAbs().maxCoeff());
    height = std::max(height, std::abs(point.z()));
  }
  const bool solid = std::ranges::any_of(
      mesh.blocks, [](const CellBlock& block) { return topology(block.type).dimension == 3; });
  // Gmsh computes z of a flat geometry, so it may be off zero by rounding.
  constexpr double rounding = 1e-12;
  return solid || height > rounding * size ? 3 : 2;
}

Mesh assembled(const Collected& collected, const gmsh::Nodes& nodes) {
  Mesh mesh;
  const auto index = add_nodes(nodes, nodes_in_use(collected), mesh);
  for (const auto& [type, cells] : collected.cells) {
    CellBlock block;
    block.type = type;
    for (const auto& [tag, cell] : cells.nodes_of_cell) {
      block.numbers.push_back(static_cast<std::int64_t>(tag));
      for (const auto node : cell)
        block.nodes.push_back(index.at(node));
    }
    mesh.blocks.push_back(std::move(block));
  }
  add_groups(collected, index, mesh);
  mesh.dimension = space_dimension(mesh);
  if (mesh.dimension == 2)
    for (auto& point : mesh.points)
      point.z() = 0.0;
  return mesh;
}

bool is_meshed(const Session& session) {
  return !session.elements_of(gmsh::everything).types.empty();
}

int geometry_dimension(const Session& session) {
  int dimension = 0;
  for (const auto entity : session.entities())
    dimension = std::max(dimension, entity.dimension);
  return dimension;
}

// Gmsh drops statements of a last line without an end, and doesn't say so.
void check_last_line(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  stream.seekg(0, std::ios::end);
  if (stream.tellg() == 0)
    return;
  stream.seekg(-1, std::ios::end);
  if (stream.get() != '\n')
    throw InputError("its last line has no line end, Gmsh would drop a part of it");
}

Mesh read_with_gmsh(const std::filesystem::path& path) {
  if (path.extension() == ".geo")
    check_last_line(path);
  const Session session;
  session.open(path);
  if (!is_meshed(session) && path.extension() == ".geo")
    session.generate(geometry_dimension(session));
  if (const auto error = session.first_error(); !error.empty())
    throw InputError(error);
  const auto collected = collect(session);
  if (collected.cells.empty())
    throw InputError("it holds no cells");
  return assembled(collected, session.nodes_of(gmsh::everything));
}

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& why) {
  throw InputError(fmt::format("mesh file '{}' cannot be read by Gmsh: {}", path.string(), why));
}

} // namespace

bool has_gmsh() {
  try {
    gmsh::library();
    return true;
  } catch (const InputError&) {
    return false;
  }
}

Mesh read_gmsh(const std::filesystem::path& path) {
  if (!std::filesystem::is_regular_file(path))
    throw InputError(fmt::format("mesh file '{}' {}", path.string(),
                                 std::filesystem::exists(path) ? "is a directory, a Gmsh file was expected"
                                                               : "does not exist"));
  try {
    return read_with_gmsh(path);
  } catch (const InputError& error) {
    refuse(path, error.faults().front().text);
  } catch (const std::runtime_error& error) {
    refuse(path, error.what());
  }
}

} // namespace rubato::mesh

#endif
