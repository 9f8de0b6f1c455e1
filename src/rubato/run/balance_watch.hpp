// SPDX-License-Identifier: LGPL-3.0-or-later
/// How far forces and moments of bodies and of contact zones are out of balance.
#pragma once

#include "rubato/model/bodies.hpp"
#include "rubato/model/fwd.hpp"
#include "rubato/results/plausibility.hpp"
#include "rubato/step/state.hpp"

#include <Eigen/Core>

#include <vector>

namespace rubato::run {

/// A sum that vanishes in balance, and its scale: the largest of the run each.
struct Resultant {
  double sum = 0;
  double scale = 0;
  double t = 0; ///< when `sum` was largest

  double ratio() const { return scale > 0 ? sum / scale : 0; }
};

/// Takes Σ f_int and Σ x × f_int of each body, x deformed. Their scale is the sum of the magnitudes of loads,
/// reactions, contact and inertia on the body. Bodies with springs and connectors are left out: f_int has
/// those forces, too. Takes Σ f and Σ x × f of contact over all bodies: both vanish where slave and master
/// have the same force on one line. Moments are not taken about the axis of axisymmetric studies, sums of
/// contact not with obstacles.
class BalanceWatch {
public:
  /// The model must outlive this.
  explicit BalanceWatch(const model::Model& model);

  void note(const step::State& before, const step::State& now);
  std::vector<results::Plausibility> checks() const;

private:
  struct OfBody {
    Resultant force, moment;
  };

  void note_bodies(const std::vector<Eigen::Vector3d>& places, const step::State& now);
  void note_contact(const std::vector<Eigen::Vector3d>& places, const step::State& now);
  std::vector<Eigen::Vector3d> places_at(const step::State& before, const step::State& now) const;
  Eigen::Vector3d value_at(const Eigen::VectorXd& values, std::size_t node) const;

  const model::Model& model_;
  model::Bodies bodies_;
  std::vector<OfBody> of_body_; ///< none of those that are left out
  std::vector<char> watched_;   ///< by body
  Resultant contact_force_, contact_moment_;
  bool balances_contact_ = false; ///< whether a master feels every contact force
  bool takes_moments_ = true;
  double longest_face_ = 0; ///< of all slaves [length]
  double of_before_ = 0;    ///< part of the start of a step in the place where its forces act
};

} // namespace rubato::run
