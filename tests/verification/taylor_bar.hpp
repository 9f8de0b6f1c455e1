// SPDX-License-Identifier: LGPL-3.0-or-later
/// Taylor's impact test, a copper rod of 3.2 × 32.4 mm that hits a smooth rigid wall at 227 m/s
/// (G. I. Taylor, Proc. R. Soc. A 194 (1948) 289–299), with the numbers of published codes: E = 117 GPa,
/// ν = 0.35, ρ = 8930 kg/m³, σ_y = 400 MPa, H = 100 MPa. After 80 µs it is at rest: 21.4 to 21.8 mm long,
/// with a foot of 6.9 to 7.2 mm where that stays in the plane of the wall.
#pragma once

#include "rubato/mesh/mesh.hpp"
#include "rubato/study/study.hpp"

#include <cstddef>
#include <cstdint>
#include <string>

namespace rubato::verification {

/// A meridian of 4 × 25 QUAD4, axisymmetric, and a quarter of HEXA8, 25 layers: the foot is the group `foot`.
enum class TaylorMesh { meridian, quarter };
/// The foot slides in the plane of the wall, at rest there from the start as published studies have it, or
/// the wall is an obstacle that it may leave again.
enum class TaylorWall { sliding, contact };

struct TaylorBar {
  study::Study study;
  mesh::Mesh mesh;
};
TaylorBar taylor_bar(TaylorMesh mesh, TaylorWall wall,
                     study::Formulation formulation = study::Formulation::mean_dilatation);

struct TaylorResult {
  double length = 0;    ///< [m]
  double radius = 0;    ///< the largest, of the foot [m]
  double edge = 0;      ///< how far from the wall the widest place is [m]
  double balance = 0;   ///< largest of all records, in parts of the largest energy
  double plastic = 0;   ///< [J], of the whole rod
  double start = 0;     ///< [J]
  double scheme = 0;    ///< bulk_scheme [J]
  double hourglass = 0; ///< [J]
  std::int64_t steps = 0;
  std::size_t cells = 0;
  double seconds = 0; ///< of the processor, in steps
};
/// Throws std::runtime_error when the run comes to no end.
TaylorResult run(TaylorBar bar);

} // namespace rubato::verification
