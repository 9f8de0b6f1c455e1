// SPDX-License-Identifier: LGPL-3.0-or-later
/// Numbers of surface unknowns that follow their places in space: where contact asks for a few of them, their
/// neighbours in number are those that it asks for too.
#pragma once

#include "rubato/model/fwd.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace rubato::step {

/// In the order of rubato::spatial_order of their nodes; unknowns of a node stay together where they ascend:
/// `together` nodes follow one another.
std::vector<int> in_spatial_order(const model::Model& model, std::span<const int> unknowns,
                                  std::size_t together);

} // namespace rubato::step
