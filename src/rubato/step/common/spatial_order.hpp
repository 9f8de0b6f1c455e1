// SPDX-License-Identifier: LGPL-3.0-or-later
/// Numbers of surface unknowns that follow their places in space: where contact asks for a few of them, their
/// neighbours in number are those that it asks for too.
#pragma once

#include "rubato/model/model.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <span>
#include <vector>

namespace rubato::step {

/// The indices of the points, by recursive bisection across the longest side of their box, down to parts of
/// at most `together` points. All parts but the last have as many. Points at one coordinate stay in their
/// order.
std::vector<std::size_t> spatial_order(std::span<const Eigen::Vector3d> points, std::size_t together);

/// The same of unknowns, which stay together node by node where they ascend: `together` nodes follow one
/// another.
std::vector<int> in_spatial_order(const model::Model& model, std::span<const int> unknowns,
                                  std::size_t together);

} // namespace rubato::step
