// SPDX-License-Identifier: LGPL-3.0-or-later
/// Inside the module only: gaps, slips and tractions of contact points in CalculiX's directions.
#pragma once

#include "rubato/contact/pairing.hpp"
#include "rubato/model/fwd.hpp"
#include "rubato/step/state.hpp"

#include <array>
#include <cstddef>
#include <vector>

namespace rubato::results {

/// The values that CalculiX prints as CDIS and CSTR. The first tangent is the global x axis projected onto
/// the surface, or the z axis where the normal is within 18 degrees of x; the second is normal × first.
struct ContactValues {
  double opening = 0;           ///< gap, < 0 where the bodies overlap [length]
  std::array<double, 2> slip{}; ///< of the slave relative to the master [length]
  double pressure = 0;
  std::array<double, 2> shear{}; ///< of the slave on the master [force/area]
};

class ContactLister {
public:
  /// The model must outlive this.
  explicit ContactLister(const model::Model& model) : model_(&model) {}

  /// Values of a closed point. The slip is the tangential part of the displacement relative to the master
  /// point that faces the undeformed slave point; it is 0 if there is none.
  ContactValues at(const step::State& now, std::size_t zone, std::size_t point);

private:
  Eigen::Vector3d relative_displacement(const step::State& now, std::size_t zone, std::size_t point);

  const model::Model* model_;
  std::vector<std::vector<contact::Pair>> pairs_; ///< undeformed, of each zone
};

} // namespace rubato::results
