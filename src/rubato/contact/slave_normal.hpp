// SPDX-License-Identifier: LGPL-3.0-or-later
/// The normal of the slave surface at a contact point: n_s, the unit of the sum over the slave faces at the
/// point of their unit normals, or of their averages at nodes (averaged_normal.hpp).
#pragma once

#include "rubato/contact/zone.hpp"

#include <Eigen/Core>

namespace rubato::contact {

Eigen::Vector3d slave_normal(const Zone& zone, const SlavePoint& point, const Configuration& configuration);

/// Writes δn_s by the displacements of the point's nodes, component by component: one column each. Columns
/// beyond these stay.
void vary_slave_normal(const Zone& zone, const SlavePoint& point, const Configuration& configuration,
                       Eigen::Matrix<double, 3, Eigen::Dynamic>& into);

} // namespace rubato::contact
