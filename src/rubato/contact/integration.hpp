// SPDX-License-Identifier: LGPL-3.0-or-later
/// Where on a slave face contact is enforced, and with which weight.
#pragma once

#include "rubato/cell/topology.hpp"
#include "rubato/study/study.hpp"

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace rubato::contact {

struct IntegrationPoint {
  Eigen::Vector2d xi;
  double weight = 0;   ///< on the reference face
  int node = -1;       ///< the face's local node it stands on, or −1
  int stands_for = -1; ///< local node whose exclusion excludes the point too, or −1
};

/// Points of a face: a row of the table of rules.
struct Integration {
  study::ContactIntegration by;
  /// Null of mortar, whose points are the slave's nodes and whose integrals follow the master.
  std::vector<IntegrationPoint> (*points)(CellType face, int order);
  /// Whether a point on a node stands for the node's share of a face: on a surface of revolution that is the
  /// integral of its shape function.
  bool shares_of_nodes;
  /// Whether points count as one each instead of by their areas: their tractions are forces then.
  bool unit_weights;
};
const Integration& integration(study::ContactIntegration by);

/// The one that a zone's settings ask for. Nodal methods have one relation a node, whatever its share of the
/// surface, and take `node_rule`.
Integration integration_of(const study::ContactZone& settings);

/// The least order of a rule (0 of one that has none) with points enough to tell the multipliers of a face's
/// nodes apart, and exact for its shape functions, so that it hands on a uniform pressure. Nothing where no
/// order is.
std::optional<int> least_order(study::ContactIntegration by, CellType face);

/// Points on the nodes with the weights of the closed Newton–Cotes rule of the face (Code_Aster's
/// INTEGRATION='AUTO'). TRIA6 and TRIA7 have no such rule with positive weights and take the six-point Gauss
/// rule, whose i-th point stands for the i-th node.
std::vector<IntegrationPoint> nodal_rule(CellType face);

/// `order` Gauss points a direction.
std::vector<IntegrationPoint> gauss_rule(CellType face, int order);

/// One point on every node, for relations a node. Their areas are nodal_rule's weights where that has points
/// on all nodes, else equal shares of the face.
std::vector<IntegrationPoint> node_rule(CellType face);

} // namespace rubato::contact
