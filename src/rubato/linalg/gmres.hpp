// SPDX-License-Identifier: LGPL-3.0-or-later
/// Linear systems that are known by their products only.
#pragma once

#include "rubato/linalg/linear_map.hpp"

#include <optional>

namespace rubato::linalg {

/// x of A x = b by GMRES (Saad and Schultz, SIAM J. Sci. Stat. Comput. 7, 1986) without restart, from zero,
/// with one product with A an iteration. Nothing comes back when the residual is not below `tolerance` times
/// that of x = 0 after `most_products` of them, or is not finite.
std::optional<Eigen::VectorXd> gmres(const LinearMap& matrix, const Eigen::VectorXd& right_side,
                                     double tolerance, int most_products);

} // namespace rubato::linalg
