// SPDX-License-Identifier: LGPL-3.0-or-later
/// A body of every cell and physics that loads act on.
#pragma once

#include "rubato/domain/bulk.hpp"
#include "rubato/domain/dof_map.hpp"

#include <gtest/gtest.h>

#include "support/bulk_cells.hpp"
#include "support/patch_mesh.hpp"
#include <vector>

namespace rubato::load {

inline const material::LinearElastic law{210., 0.3, 7.8};
inline constexpr double thickness = 0.7;

/// The distorted unit square or cube moved to 1 ≤ x ≤ 2.
class DistortedBody : public testing::TestWithParam<test::BulkCase> {
protected:
  study::Physics physics_ = GetParam().physics;
  int d_ = element::component_count(physics_);
  element::Section section_{physics_, thickness};
  mesh::Mesh mesh_ = test::patch_mesh(GetParam().type, 2,
                                      test::moved_by(test::shaken(d_, 2, 0.2), Eigen::Vector3d(1, 0, 0)));
  domain::Bulk bulk_ = test::whole_bulk(mesh_, section_, law);
  domain::DofMap dofs_ = domain::number_dofs(mesh_, bulk_.cells, d_);
  std::vector<test::BoundarySide> sides_ = test::boundary_sides(mesh_);
};

} // namespace rubato::load
