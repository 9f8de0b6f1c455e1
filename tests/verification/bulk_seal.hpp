// SPDX-License-Identifier: LGPL-3.0-or-later
/// A rubber ring of round section, pressed by a lid in a groove with friction.
#pragma once

#include <array>
#include <vector>

namespace rubato::verification {

struct SealResult {
  int cells = 0;
  std::array<double, 3> force{}; ///< on the lid at 10, 20 and 30 % of the diameter
  double wall = 0;               ///< force along the radius on the walls of the groove at 30 %
  double balance = 0;            ///< what the energy ledger misses, in parts of its largest term
  int steps = 0, cuts = 0;
  int bulk = 0;            ///< iterations of the bulk in all accepted steps
  int iterations = 0;      ///< linear solves of all attempts
  bool indefinite = false; ///< whether an effective matrix was, without contact
};

/// A cord of diameter 2 at the mean radius 10, Mooney-Rivlin with c10 = 0.6, c01 = 0.15 and K = 150, in a
/// groove 2.4 wide: floor, walls and lid are rigid lines, friction 0.1, mortar contact by its defaults,
/// axisymmetric, static. `n` cells along a radius outside of the square core of 2n × 2n. `step`: in parts of
/// the diameter. Throws std::runtime_error when a step fails.
SealResult press_seal(int n, double step = 0.025);

} // namespace rubato::verification
