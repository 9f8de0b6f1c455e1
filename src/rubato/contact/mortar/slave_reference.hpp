// SPDX-License-Identifier: LGPL-3.0-or-later
/// What a slave surface is undeformed: the measure of mortar's integrals.
#pragma once

#include "rubato/contact/surface.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace rubato::contact::mortar {

/// Components that supports hold or symmetry forbids, as bits: 1 x (r), 2 y, 4 z.
using HeldComponents = std::uint8_t;
inline constexpr HeldComponents radial = 1;

/// What weights are multiplied with beside the undeformed area or length.
struct Measure {
  double thickness = 1;
  bool ring = false; ///< 2πR, R the undeformed x
};

/// What a slave surface is undeformed. Made once.
struct SlaveReference {
  std::vector<Eigen::Vector3d> undeformed; ///< X by position in the surface's nodes
  Measure measure;
  int dimension = 3;                    ///< of space
  std::vector<std::size_t> first_facet; ///< of each face, and the number of all sub-facets at the end
  std::vector<double> facet_area;       ///< ∫1 of each sub-facet
  std::vector<double> full_weight;      ///< ∫H_j over all faces, by position
  std::vector<int> tangent_neighbour;   ///< by position
  std::vector<double> kinks;            ///< by position: the largest of Face::kinks
  std::vector<std::uint8_t> on_axis;    ///< by position: whether it stands on the axis of revolution
  double longest_face = 0;              ///< largest distance of two nodes of a face: the default reach
};

/// Throws InputError where a coordinate is not finite, with the face; std::invalid_argument for cells that
/// are no faces.
SlaveReference make_slave_reference(const Surface& slave, std::vector<Eigen::Vector3d> undeformed,
                                    const Measure& measure = {});

} // namespace rubato::contact::mortar
