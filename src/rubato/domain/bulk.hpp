// SPDX-License-Identifier: LGPL-3.0-or-later
/// The cells that deform, and what each is made of.
#pragma once

#include "rubato/core/error.hpp"
#include "rubato/element/element.hpp"
#include "rubato/element/nonlinear.hpp"
#include "rubato/material/expansion.hpp"
#include "rubato/material/law.hpp"
#include "rubato/material/law_field.hpp"
#include "rubato/material/point_law.hpp"
#include "rubato/mesh/mesh.hpp"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace rubato::domain {

/// How cells are evaluated whose forces are not ∫ Bᵀ D B u of all their points.
struct Behaviour {
  material::PointLaw law;
  element::StrainKind strain = element::StrainKind::small;
  element::Formulation formulation = element::Formulation::full; ///< full of cells that it is not offered for
  bool constant = false;                                 ///< whether one stiffness holds for every motion
  std::optional<material::FullExpansion> expansion = {}; ///< by temperature, in the axes of the model
};

struct Bulk {
  element::Section section;
  std::vector<mesh::CellIndex> cells;
  std::vector<material::Law> laws;
  std::vector<std::int32_t> law_of_cell; ///< index in `laws`, one a cell of `cells`
  /// Of each law that depends on the place; null where it does not, empty when none does. `laws` have such a
  /// law at one place of its cells.
  std::vector<std::shared_ptr<const material::LawField>> fields = {};
  /// Of each law that is evaluated otherwise; `laws` have what it is at small strains that come at once.
  /// Empty when all cells are linear and integrated in full.
  std::vector<std::optional<Behaviour>> behaviours = {};

  const material::Law& law(std::size_t i) const { return laws[static_cast<std::size_t>(law_of_cell[i])]; }
  /// Null when the law of the cell is the same everywhere.
  const material::LawField* field(std::size_t i) const {
    return fields.empty() ? nullptr : fields[static_cast<std::size_t>(law_of_cell[i])].get();
  }
  /// Null when the cell is linear and integrated in full.
  const Behaviour* behaviour(std::size_t i) const {
    if (behaviours.empty())
      return nullptr;
    const auto& behaviour = behaviours[static_cast<std::size_t>(law_of_cell[i])];
    return behaviour ? &*behaviour : nullptr;
  }
  /// Whether forces of the cell are a constant matrix times its displacements.
  bool is_constant(std::size_t i) const {
    const auto* found = behaviour(i);
    return found == nullptr || found->constant;
  }
};

/// Whether forces are a constant matrix times the displacements in all cells.
bool is_linear(const Bulk& bulk);

/// Of a cell of that type with that behaviour.
element::CellKind kind_of(const Bulk& bulk, const Behaviour& behaviour, CellType type);

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
