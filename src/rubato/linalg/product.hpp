// SPDX-License-Identifier: LGPL-3.0-or-later
/// Matrices that are known by their products only.
#pragma once

#include <Eigen/Core>

#include <functional>

namespace rubato::linalg {

/// y of a linear map of x.
using Product = std::function<Eigen::VectorXd(const Eigen::VectorXd&)>;

} // namespace rubato::linalg
