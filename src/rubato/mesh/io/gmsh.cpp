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

#include <gmsh.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <map>
#include <set>
#include <unordered_map>
#include <utility>

namespace rubato::mesh {
namespace {

using Tag = std::size_t;
using Order = std::span<const std::uint8_t>;

/// Gmsh's library between its initialize and its finalize.
class Session {
public:
  Session() {
    constexpr bool read_user_options = false;
    gmsh::initialize(0, nullptr, read_user_options);
    gmsh::option::setNumber("General.Terminal", 0);
    gmsh::option::setNumber("General.NumThreads", 1);
    gmsh::logger::start();
  }
  ~Session() {
    gmsh::logger::stop();
    gmsh::finalize();
  }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  /// The first error that Gmsh has reported so far; empty when there is none.
  static std::string first_error() {
    constexpr std::string_view mark = "Error: ";
    std::vector<std::string> lines;
    gmsh::logger::get(lines);
    const auto found =
        std::ranges::find_if(lines, [&](const std::string& line) { return line.starts_with(mark); });
    return found == lines.end() ? "" : found->substr(mark.size());
  }
};

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

const KnownType& known_type(int gmsh_type) {
  const auto* const found = std::ranges::find(known_types, gmsh_type, &KnownType::gmsh);
  if (found != known_types.end())
    return *found;
  std::string name;
  int dimension = 0;
  int order = 0;
  int nodes = 0;
  int corners = 0;
  std::vector<double> coordinates;
  gmsh::model::mesh::getElementProperties(gmsh_type, name, dimension, order, nodes, coordinates, corners);
  throw InputError(fmt::format("it holds cells of type {}, which this program does not know (full quadratic "
                               "pyramids become PYRA13 with Mesh.SecondOrderIncomplete = 1)",
                               name));
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

/// Takes the cells of one entity of the geometry (of all for dimension −1) and adds them to the groups named.
void collect_cells(int dimension, int entity, const std::vector<std::string>& groups, Collected& into) {
  std::vector<int> types;
  std::vector<std::vector<Tag>> cells;
  std::vector<std::vector<Tag>> nodes;
  gmsh::model::mesh::getElements(types, cells, nodes, dimension, entity);
  for (std::size_t t = 0; t < types.size(); ++t) {
    const auto& type = known_type(types[t]);
    if (type.ours == CellType::point1)
      continue;
    const auto width = static_cast<std::size_t>(topology(type.ours).node_count);
    auto& known = into.cells[type.ours].nodes_of_cell;
    for (std::size_t c = 0; c < cells[t].size(); ++c) {
      std::vector<Tag> own(width);
      for (std::size_t i = 0; i < width; ++i)
        own[i] = nodes[t][c * width + (type.order.empty() ? i : type.order[i])];
      known.emplace(cells[t][c], std::move(own));
      for (const auto& group : groups)
        into.cell_groups[group].emplace(type.ours, cells[t][c]);
    }
  }
}

void collect_nodes(int entity, const std::string& group, Collected& into) {
  std::vector<Tag> tags;
  std::vector<double> coordinates;
  std::vector<double> parameters;
  gmsh::model::mesh::getNodes(tags, coordinates, parameters, 0, entity, false, false);
  into.node_groups[group].insert(tags.begin(), tags.end());
}

std::string group_name(int dimension, int tag) {
  constexpr std::array<std::string_view, 4> kinds{"point", "line", "surface", "volume"};
  std::string name;
  gmsh::model::getPhysicalName(dimension, tag, name);
  return name.empty() ? fmt::format("{}_{}", kinds.at(static_cast<std::size_t>(dimension)), tag) : name;
}

Collected collect() {
  Collected collected;
  gmsh::vectorpair groups;
  gmsh::model::getPhysicalGroups(groups);
  for (const auto& [dimension, tag] : groups) {
    const auto name = group_name(dimension, tag);
    std::vector<int> entities;
    gmsh::model::getEntitiesForPhysicalGroup(dimension, tag, entities);
    for (const auto entity : entities) {
      if (dimension == 0)
        collect_nodes(entity, name, collected);
      else
        collect_cells(dimension, entity, {name}, collected);
    }
  }
  if (collected.cells.empty())
    collect_cells(-1, -1, {}, collected);
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

IndexOfNode add_nodes(const std::set<Tag>& used, Mesh& mesh) {
  std::vector<Tag> tags;
  std::vector<double> coordinates;
  std::vector<double> parameters;
  gmsh::model::mesh::getNodes(tags, coordinates, parameters, -1, -1, false, false);
  std::unordered_map<Tag, std::size_t> place;
  for (std::size_t i = 0; i < tags.size(); ++i)
    place.emplace(tags[i], i);

  IndexOfNode index;
  for (const auto tag : used) {
    const auto found = place.find(tag);
    if (found == place.end())
      throw InputError(fmt::format("a cell has node {}, which does not exist", tag));
    index.emplace(tag, mesh.node_count());
    mesh.points.emplace_back(Eigen::Map<const Eigen::Vector3d>(&coordinates[3 * found->second]));
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

Mesh assembled(const Collected& collected) {
  Mesh mesh;
  const auto index = add_nodes(nodes_in_use(collected), mesh);
  for (const auto& [type, cells] : collected.cells) {
    CellBlock block;
    block.type = type;
    for (const auto& [tag, nodes] : cells.nodes_of_cell) {
      block.numbers.push_back(static_cast<std::int64_t>(tag));
      for (const auto node : nodes)
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

bool is_meshed() {
  std::vector<int> types;
  std::vector<std::vector<Tag>> cells;
  std::vector<std::vector<Tag>> nodes;
  gmsh::model::mesh::getElements(types, cells, nodes);
  return !types.empty();
}

int geometry_dimension() {
  gmsh::vectorpair entities;
  gmsh::model::getEntities(entities);
  int dimension = 0;
  for (const auto& entity : entities)
    dimension = std::max(dimension, entity.first);
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
  gmsh::open(path.string());
  if (!is_meshed() && path.extension() == ".geo")
    gmsh::model::mesh::generate(geometry_dimension());
  if (const auto error = Session::first_error(); !error.empty())
    throw InputError(error);
  auto collected = collect();
  if (collected.cells.empty())
    throw InputError("it holds no cells");
  return assembled(collected);
}

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& why) {
  throw InputError(fmt::format("mesh file '{}' cannot be read by Gmsh: {}", path.string(), why));
}

} // namespace

bool has_gmsh() {
  return true;
}

Mesh read_gmsh(const std::filesystem::path& path) {
  if (!std::filesystem::is_regular_file(path))
    throw InputError(fmt::format("mesh file '{}' {}", path.string(),
                                 std::filesystem::exists(path) ? "is a directory, a Gmsh file was expected"
                                                               : "does not exist"));
  // Gmsh's interface throws strings in some versions, exceptions in others.
  try {
    return read_with_gmsh(path);
  } catch (const InputError& error) {
    refuse(path, error.faults().front().text);
  } catch (const std::string& text) {
    refuse(path, text);
  } catch (const std::runtime_error& error) {
    refuse(path, error.what());
  } catch (int code) {
    refuse(path, fmt::format("error {}", code));
  }
}

} // namespace rubato::mesh

#endif
