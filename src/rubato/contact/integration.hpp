// SPDX-License-Identifier: LGPL-3.0-or-later
/// Where on a slave face contact is enforced, and with which weight.
#pragma once

#include "rubato/cell/topology.hpp"

#include <Eigen/Core>

#include <vector>

namespace rubato::contact {

struct IntegrationPoint {
  Eigen::Vector2d xi;
  double weight = 0;   ///< on the reference face
  int node = -1;       ///< the face's local node it stands on, or −1
  int stands_for = -1; ///< local node whose exclusion excludes the point too, or −1
};

/// Points of a face. `gauss` = 0 puts them on the nodes with the weights of the closed Newton–Cotes rule of
/// the face (Code_Aster's INTEGRATION='AUTO'); TRIA6 and TRIA7 have no such rule with positive weights and
/// take the six-point Gauss rule, whose i-th point stands for the i-th node. `gauss` = n > 0 gives n Gauss
/// points a direction.
std::vector<IntegrationPoint> contact_rule(CellType face, int gauss);

/// One point on every node. Their weights are contact_rule's where that has them, else equal shares of the
/// face.
std::vector<IntegrationPoint> node_rule(CellType face);

} // namespace rubato::contact
