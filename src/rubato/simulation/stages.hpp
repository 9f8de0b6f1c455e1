// SPDX-License-Identifier: LGPL-3.0-or-later
/// The models of a run one after the other: where supports end another one begins, with more unknowns.
#pragma once

#include "rubato/model/fwd.hpp"

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace rubato::simulation {

class Stages {
public:
  /// `instants`: those that steps end at, the releases of the model among them but for rounding. The model is
  /// that of the first stage and must outlive this.
  Stages(const model::Model& first, std::span<const double> instants);

  const model::Model& model() const { return later_ ? *later_ : *first_; }
  /// Goes to the stage of steps that end at t, or begin there. Whether that is another one than before: then
  /// the model that was is gone, unless it is the first. Throws what building a model throws, and is as
  /// before then.
  /// `shortening`: of the preloads that are locked.
  bool go_to_end_at(double t, const Eigen::VectorXd& shortening) {
    return go_to(stage_ending_at(t), shortening);
  }
  bool go_to_begin_at(double t, const Eigen::VectorXd& shortening);
  /// What preloads are shortened by that are locked at t.
  void lock_preloads_at(double t, const Eigen::VectorXd& u, Eigen::VectorXd& shortening) const;

private:
  bool go_to(std::size_t stage, const Eigen::VectorXd& shortening);
  std::size_t stage_ending_at(double t) const;

  const model::Model* first_;
  std::vector<double> ends_; ///< of all stages but the last, ascending: instants of the run
  std::size_t stage_ = 0;
  std::shared_ptr<const model::Model> later_; ///< none in the first stage
};

} // namespace rubato::simulation
