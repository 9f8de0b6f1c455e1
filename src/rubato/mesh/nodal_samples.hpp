// SPDX-License-Identifier: LGPL-3.0-or-later
/// Fields that are known at nodes, as functions of place and time.
#pragma once

#include "rubato/core/field_function.hpp"
#include "rubato/mesh/place_finder.hpp"

#include <Eigen/Core>

#include <memory>
#include <string>
#include <vector>

namespace rubato::mesh {

/// One component of a field at the nodes of a file, at its instants.
struct NodalSamples {
  std::string called;                  ///< by messages: "'T' of 'a.med'"
  std::vector<Eigen::Vector3d> places; ///< of the nodes [length]
  std::vector<double> instants;        ///< ascending, at least one
  /// Of each instant, one a node; not finite where the file has none.
  std::vector<std::vector<double>> values;
};

/// The field on the mesh of `cells`, whose nodes have the values of those that lie where they lie (that of
/// the same index first). At a node it has the value there, elsewhere it has the shape functions of the cell
/// that the place is in; between instants it is linear, before the first and after the last constant. Its
/// `at` throws InputError where a node that is needed has no value: a sentence that names it and the distance
/// to the nearest one that has; where no cell has the place; and where bodies touch and their values differ.
std::shared_ptr<const SampledField> sampled_field(std::shared_ptr<const PlaceFinder> cells,
                                                  const NodalSamples& samples);

} // namespace rubato::mesh
