// SPDX-License-Identifier: LGPL-3.0-or-later
/// A block of side 1 pressed on a plate and dragged over its cells, with friction: faces of either side pass
/// the edges of the other.
#pragma once

#include "rubato/cell/topology.hpp"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace rubato::verification {

struct Drag {
  CellType cells = CellType::hexa8; ///< their dimension decides: 5 faces on 17, or 3 × 3 on 7 × 7
  int finer = 1;                    ///< that many times as many faces a side
  double friction = 0.3;
  double strain = 0.0008;
  bool block_is_slave = true;
  /// Moves of the block's roof by (x, z), in faces of the block, one a step after that which presses.
  std::vector<Eigen::Vector2d> moves{};
  std::string integration = "mortar";
};

/// n equal moves by `length` in the direction of `degrees` from x.
std::vector<Eigen::Vector2d> straight(double length, int n, double degrees = 0);
/// Two moves by half a face along x, two turned by 143°, two back.
std::vector<Eigen::Vector2d> turned_and_reversed();

struct DragStep {
  int iterations = 0;
  int attempts = 1;
  double normal = 0;    ///< N, contact force across the plate
  double ratio = 0;     ///< T/N
  double direction = 0; ///< angle between friction on the block and the opposite of the move [degrees]
  int sticking = 0;     ///< slave nodes
};

struct Dragged {
  std::string failure;         ///< why there is no end; empty when there is one
  std::vector<DragStep> steps; ///< the first presses
};

Dragged drag(const Drag& how);

} // namespace rubato::verification
