// SPDX-License-Identifier: LGPL-3.0-or-later
/// Linear maps that are known by what they make of vectors.
#pragma once

#include <Eigen/Core>

#include <functional>

namespace rubato::linalg {

/// y of x.
using LinearMap = std::function<Eigen::VectorXd(const Eigen::VectorXd&)>;

} // namespace rubato::linalg
