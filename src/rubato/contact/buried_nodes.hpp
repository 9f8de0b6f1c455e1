// SPDX-License-Identifier: LGPL-3.0-or-later
/// Master nodes behind the slave.
///
/// Contact tests the slave's points against the master, not the master's nodes against the slave: what is
/// smaller than a slave face may sink into it between its nodes, by nodes and by mortar alike. This
/// finds such nodes.
#pragma once

#include "rubato/contact/zone.hpp"

#include <vector>

namespace rubato::contact {

/// Of a zone with a meshed master.
class BuriedNodes {
public:
  /// `shallow`, by position in the master's nodes [length]: a node as near to a slave node lies no deeper and
  /// is not looked at. The zone must outlive this.
  BuriedNodes(const Zone& zone, std::vector<double> shallow);

  /// By the same positions, how far each node lies behind a slave face that looks at it [length]; 0 where
  /// none does, and where it is not looked at. Faces around the nearest slave node are looked at, inside
  /// their limits.
  std::vector<double> depths(const Configuration& configuration);

private:
  const Zone* zone_;
  std::vector<double> shallow_;
  std::vector<std::size_t> near_; ///< a slave node that was near each last time
};

/// By position in a surface's nodes, the shortest edge of the faces around each, undeformed [length].
std::vector<double> edges_around(const mesh::Mesh& mesh, const Surface& surface);

} // namespace rubato::contact
