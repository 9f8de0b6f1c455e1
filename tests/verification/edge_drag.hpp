// SPDX-License-Identifier: LGPL-3.0-or-later
/// Bodies with an edge, a kink or a nose that are pressed on a smooth rail and dragged along it.
///
/// However the edge stands to the rail, the rail pushes along its own normal. Without friction the drag over
/// a whole number of the rail's faces does no work in the mean, with friction its mean is μ N.
#pragma once

#include "rubato/cell/topology.hpp"

#include <string>

namespace rubato::verification {

enum class Profile {
  tilted, ///< a block turned about its edge: it touches with the edge
  ski,    ///< flat over two thirds, then rising
  wedge   ///< falls at half of the slope to the middle, then rises
};

struct EdgeDrag {
  Profile profile = Profile::tilted;
  double degrees = 2; ///< of the tilt or of the rising flank; negative: on the other side
  CellType cells = CellType::quad4;
  bool rail_is_slave = false;
  double friction = 0;
};

struct EdgeDragged {
  std::string failure;   ///< why there is no end; empty when there is one
  double drag = 0;       ///< mean force against the drag over mean normal force
  double impact = 0;     ///< what contact took of the energy while dragged, over the largest strain energy
  double iterations = 0; ///< a step, while dragged
};

EdgeDragged drag_edge(const EdgeDrag& how);

} // namespace rubato::verification
