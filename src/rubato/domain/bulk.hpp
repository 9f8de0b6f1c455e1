// SPDX-License-Identifier: LGPL-3.0-or-later
/// The cells that deform, and what each is made of.
#pragma once

#include "rubato/element/section.hpp"
#include "rubato/material/law.hpp"
#include "rubato/mesh/mesh.hpp"

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace rubato {
struct Fault;
} // namespace rubato

namespace rubato::material {
class LawField;
} // namespace rubato::material

namespace rubato::domain {

struct Behaviour;

struct Bulk {
  element::Section section;
  std::vector<mesh::CellIndex> cells;
  std::vector<material::Law> laws;
  std::vector<std::int32_t> law_of_cell; ///< index in `laws`, one a cell of `cells`
  /// Of each law that depends on the place; null where it does not, empty when none does. `laws` have such a
  /// law at one place of its cells.
  std::vector<std::shared_ptr<const material::LawField>> fields = {};
  /// The behaviour of each law; null where its cells are linear and integrated in full. `laws` hold the
  /// elastic law at small strains, without time to relax. Empty when all would be null.
  std::vector<std::shared_ptr<const Behaviour>> behaviours = {};

  const material::Law& law(std::size_t i) const { return laws[static_cast<std::size_t>(law_of_cell[i])]; }
  /// Null when the law of the cell is the same everywhere.
  const material::LawField* field(std::size_t i) const {
    return fields.empty() ? nullptr : fields[static_cast<std::size_t>(law_of_cell[i])].get();
  }
  /// Null when the cell is linear and integrated in full.
  const Behaviour* behaviour(std::size_t i) const {
    return behaviours.empty() ? nullptr : behaviours[static_cast<std::size_t>(law_of_cell[i])].get();
  }
  /// Whether forces of the cell are a constant matrix times its displacements.
  bool is_constant(std::size_t i) const;
};

/// Whether forces are a constant matrix times the displacements in all cells.
bool is_linear(const Bulk& bulk);

/// The coordinates of one cell's nodes, copied beside each other.
class CellPoints {
public:
  CellPoints(const mesh::Mesh& mesh, std::span<const mesh::NodeIndex> nodes) : count_(nodes.size()) {
    for (std::size_t i = 0; i < count_; ++i)
      points_[i] = mesh.points[static_cast<std::size_t>(nodes[i])];
  }
  operator std::span<const Eigen::Vector3d>() const { return {points_.data(), count_}; }

private:
  std::array<Eigen::Vector3d, 27> points_;
  std::size_t count_;
};

/// "cell 12 (QUAD4) at (1.5, 0.5)": its number in the file, its type and the mean of its nodes.
std::string cell_label(const mesh::Mesh& mesh, mesh::CellIndex cell);

/// One fault for each cell that cannot be computed with, naming it by its number in the file and its type:
/// wrong dimension for the physics, Jacobian not positive (inverted or degenerate), or, when axisymmetric,
/// reaching below the axis x = 0. Empty when all is well.
std::vector<Fault> cell_faults(const mesh::Mesh& mesh, std::span<const mesh::CellIndex> cells,
                               study::Physics physics);

} // namespace rubato::domain
