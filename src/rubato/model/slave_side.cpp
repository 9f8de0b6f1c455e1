// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/model/slave_side.hpp"

#include "rubato/contact/small_vectors.hpp"
#include "rubato/domain/cell_matrices.hpp"
#include "rubato/material/stretching.hpp"
#include "rubato/mesh/sheet.hpp"
#include "rubato/model/rigid_sides.hpp"
#include "rubato/study/words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace rubato::model {
namespace {

/// Sizes and stiffnesses this near to each other, relatively, don't decide.
constexpr double alike = 0.1;

bool is_less(double a, double b) {
  return a < (1 - alike) * b;
}

} // namespace

SideMeasures::SideMeasures(const mesh::Mesh& mesh, const domain::Bulk& bulk, const domain::DofMap& dofs,
                           const constraint::Reduction& reduction)
    : mesh_(&mesh), dofs_(&dofs), reduction_(&reduction),
      stiffness_of_cell_(static_cast<std::size_t>(mesh.cell_count()), 0) {
  std::vector<double> of_law;
  for (const auto& law : bulk.laws)
    of_law.push_back(material::stretching_stiffness(law, bulk.section.physics));
  for (std::size_t i = 0; i < bulk.cells.size(); ++i)
    stiffness_of_cell_[static_cast<std::size_t>(bulk.cells[i])] =
        bulk.field(i) != nullptr
            ? material::stretching_stiffness(domain::typical_law(mesh, bulk, i), bulk.section.physics)
            : of_law[static_cast<std::size_t>(bulk.law_of_cell[i])];
}

SideMeasures::Side SideMeasures::of(std::span<const mesh::SurfaceFace> faces) const {
  Side side;
  side.has_cells = true;
  std::vector<mesh::NodeIndex> nodes;
  for (const auto& face : faces) {
    const double area = contact::length_of(mesh::normal_of(*mesh_, face));
    side.face_size += mesh_->dimension == 3 ? std::sqrt(area) : area;
    if (face.owner == mesh::SurfaceFace::none)
      side.has_cells = false;
    else
      side.stiffness += stiffness_of_cell_[static_cast<std::size_t>(face.owner)];
    nodes.insert(nodes.end(), face.nodes().begin(), face.nodes().end());
    for (const auto node : face.nodes())
      for (int i = 0; i < dofs_->components; ++i)
        side.can_move = side.can_move || !reduction_->is_prescribed(dofs_->dof(node, i));
  }
  side.is_rigid = is_rigid(nodes, *dofs_, *reduction_);
  const auto count = static_cast<double>(std::max<std::size_t>(1, faces.size()));
  side.face_size /= count;
  side.stiffness /= count;
  return side;
}

SlaveChoice choose_slave(const SideMeasures::Side& first, const SideMeasures::Side& second) {
  const std::array sides{&first, &second};
  for (const std::size_t i : {0U, 1U}) {
    const auto& other = *sides[1 - i];
    if (sides[i]->has_cells && !other.has_cells)
      return {i, "the other side has no cells behind it"};
  }
  for (const std::size_t i : {0U, 1U})
    if (sides[i]->can_move && !sides[1 - i]->can_move)
      return {i, "supports hold the other side"};
  for (const std::size_t i : {0U, 1U})
    if (!sides[i]->is_rigid && sides[1 - i]->is_rigid)
      return {i, "a relation makes the other side rigid"};
  for (const std::size_t i : {0U, 1U})
    if (is_less(sides[i]->face_size, sides[1 - i]->face_size))
      return {i, fmt::format("its faces are finer ({:.4g} against {:.4g})", sides[i]->face_size,
                             sides[1 - i]->face_size)};
  for (const std::size_t i : {0U, 1U})
    if (is_less(sides[i]->stiffness, sides[1 - i]->stiffness))
      return {i, fmt::format("its faces are as fine and its material is softer ({:.4g} against {:.4g})",
                             sides[i]->stiffness, sides[1 - i]->stiffness)};
  return {0, "it is named first; its faces are as fine and its material is as stiff as the other side's"};
}

} // namespace rubato::model
