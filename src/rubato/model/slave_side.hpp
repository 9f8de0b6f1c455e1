// SPDX-License-Identifier: LGPL-3.0-or-later
/// Which of two surfaces is the slave of a contact zone.
///
/// Pressures live on the slave's nodes, and its points are kept out of the master: the finer surface sees
/// more of the other one, and of two that are equally fine the softer one bends around the stiffer. (P.
/// Wriggers, Computational Contact Mechanics, 2nd ed., Springer 2006.)
#pragma once

#include "rubato/constraint/reduction.hpp"
#include "rubato/domain/bulk.hpp"
#include "rubato/domain/dof_map.hpp"
#include "rubato/mesh/mesh.hpp"
#include "rubato/mesh/skin.hpp"

#include <cstddef>
#include <span>
#include <string>

namespace rubato::model {

/// What is known of a mesh's surfaces: how stiff the cells behind them are, and what supports hold.
class SideMeasures {
public:
  SideMeasures(const mesh::Mesh& mesh, const domain::Bulk& bulk, const domain::DofMap& dofs,
               const constraint::Reduction& reduction);

  struct Side {
    double face_size = 0; ///< mean of the faces' lengths, in 3D of the square roots of their areas [length]
    /// Mean over the faces of the material's resistance to stretching along an axis, held across [stress]; 0
    /// where no face has a cell behind it.
    double stiffness = 0;
    bool has_cells = false; ///< behind every face
    bool can_move = false;  ///< supports leave a component of some node free
    bool is_rigid = false;  ///< by a relation
  };
  Side of(std::span<const mesh::SurfaceFace> faces) const;

private:
  const mesh::Mesh* mesh_;
  const domain::DofMap* dofs_;
  const constraint::Reduction* reduction_;
  std::vector<double> stiffness_of_cell_;
};

struct SlaveChoice {
  std::size_t slave = 0; ///< 0 or 1
  std::string reason;    ///< "its faces are finer (0.1 against 0.25)"
};

/// One without cells behind it is never the slave, then one that supports hold whole; then the finer one is,
/// then the softer one; measures within 10 % of each other are equal. Of sides that are alike the first.
SlaveChoice choose_slave(const SideMeasures::Side& first, const SideMeasures::Side& second);

} // namespace rubato::model
