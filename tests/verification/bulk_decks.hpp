// SPDX-License-Identifier: LGPL-3.0-or-later
/// Static decks that several studies of bodies share. `material` is what a material has in braces.
#pragma once

#include <Eigen/Core>

#include <string>
#include <string_view>

namespace rubato::verification {

/// Cook's membrane (R. D. Cook, J. Struct. Div. ASCE 100 (1974) 1851–1863) on n × n QUAD4 of the unit square,
/// which cook_shape puts in its place; `force` grows over [0, 1]. Probes: `corner` (48, 60) and `middle` (48,
/// 52).
std::string cook_deck(int n, std::string_view physics, std::string_view material, double force,
                      double step = 1);
/// 48 wide, 44 high where it is held, 16 where it is pulled.
Eigen::Vector3d cook_shape(const Eigen::Vector3d& x);

/// A tube in plane strain, axisymmetric, n cells from the inner to the outer radius, as high as a cell is
/// wide. `inner_support` is what `supports` has of the group `inner`, `rest` are functions, loads and time.
/// Probes: `inner` and `outer` displacement, `hold`, the reaction of the group `inner`.
struct Tube {
  double inner = 0, outer = 0;
  int cells = 0;
  double height() const { return (outer - inner) / cells; }
};
std::string tube_deck(const Tube& tube, std::string_view material, std::string_view inner_support,
                      std::string_view rest);
/// Lamé's widening of the inner radius under the inner pressure 1, plane strain.
double lame_widening(const Tube& tube, double young, double poisson);
/// Under the inner pressure 1.
inline constexpr std::string_view tube_pressure = R"(
loads: [{pressure: {on: inner, value: 1}}]
time: {scheme: static, step: 1, end: 1}
)";

/// A cantilever of 20 × 2 × 2 along x under a force of 1 along z at its end. Probe: `end`, the mean there.
std::string beam_deck(std::string_view divisions, std::string_view cells, std::string_view material);

} // namespace rubato::verification
