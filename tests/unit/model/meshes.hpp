// SPDX-License-Identifier: LGPL-3.0-or-later
/// Meshes and studies of a few cells, made without a deck, for the parts of build_model.
#pragma once

#include "rubato/mesh/builder.hpp"
#include "rubato/model/build.hpp"

#include <array>
#include <string>
#include <utility>
#include <vector>

namespace rubato::test {

/// Squares of side 1 in a row from (0, 0) to (count, 1): node i below (i, 0), node count + 1 + i above it.
/// Groups of cells: "first" and "last" square, "floor", the edges below; of nodes: "wall", those at x = 0.
inline mesh::MeshBuilder row_of_squares(int count) {
  mesh::MeshBuilder builder(2);
  for (int y = 0; y <= 1; ++y)
    for (int x = 0; x <= count; ++x)
      builder.add_node(Eigen::Vector3d(x, y, 0));
  std::vector<mesh::MeshBuilder::CellHandle> floor;
  for (int i = 0; i < count; ++i) {
    const auto square = builder.add_cell(CellType::quad4, std::array{i, i + 1, count + 2 + i, count + 1 + i});
    floor.push_back(builder.add_cell(CellType::seg2, std::array{i, i + 1}));
    if (i == 0)
      builder.add_to_cell_group("first", std::array{square});
    if (i == count - 1)
      builder.add_to_cell_group("last", std::array{square});
  }
  builder.add_to_cell_group("floor", floor);
  builder.add_to_node_group("wall", std::array{0, count + 1});
  return builder;
}

inline study::Material elastic(const std::string& name, const std::vector<std::string>& cells = {},
                               double density = 1) {
  study::Material material;
  material.name = name;
  material.young = 1;
  material.density = density;
  material.everywhere = cells.empty();
  material.cells = cells;
  return material;
}

inline study::Study plane_study(std::vector<study::Material> materials) {
  study::Study study;
  study.physics = study::Physics::plane_strain;
  study.materials = std::move(materials);
  return study;
}

/// A study on a mesh up to its numbered dofs, and what is wrong so far.
struct Numbered {
  study::Study study;
  mesh::Mesh mesh;
  std::vector<Fault> faults{};
  domain::Bulk bulk = model::make_bulk(study, mesh, faults);
  domain::DofMap dofs = domain::number_dofs(mesh, bulk.cells, 2);
};

/// "path: text" of each.
inline std::vector<std::string> told(const std::vector<Fault>& faults) {
  std::vector<std::string> texts;
  for (const auto& fault : faults)
    texts.push_back(fault.path + ": " + fault.text);
  return texts;
}

} // namespace rubato::test
