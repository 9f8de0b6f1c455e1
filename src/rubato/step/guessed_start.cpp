// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/guessed_start.hpp"

#include "rubato/step/guess_points.hpp"

#include <cstddef>
#include <vector>

namespace rubato::step {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// Frames that the guess goes through.
constexpr int rounds = 10;
/// Misfit of forces and frames, in parts of the largest force, that Newton takes over.
constexpr double settled = 3e-3;

/// The surface of one attempt: it moves by d = d_free − f₁ S f.
class GuessedStart {
public:
  GuessedStart(const model::Model& model, const time::Scheme& scheme, EffectiveSystem& system,
               const ContactSide& side, const Held& held, const VectorXd& residual, State& trial,
               Pulse& pulse)
      : model_(model), weight_(scheme.contact_weight()), system_(system), compliance_(*system.compliance),
        side_(side), held_(held), base_(trial.motion), half_way_(compliance_.factor().forward(-residual)),
        free_(compliance_.factor().surface_of(half_way_)), trial_(trial), pulse_(pulse),
        guess_(compliance_, weight_, model.dofs.components), touching_(model.zones.size()) {}

  void run() {
    move(trial_.contact_force(compliance_.dof_of_position()));
    side_.measure(trial_, held_, now_);
    if (system_.has_free_bodies || side_.has_lost_its_way(now_)) {
      go_back();
      side_.measure(trial_, held_, now_);
    }
    take_points(model_, side_, held_, compliance_, now_, moved_, trial_, points_);
    for (int round = 0; round < rounds; ++round) {
      guess_.improve(points_, free_, system_.has_free_bodies ? free_ : moved_, pulse_);
      if (pulse_.stopped())
        return;
      take_guess(model_, points_, trial_);
      move(force_on_surface(points_, free_.size()));
      find_touching(points_, moved_, touching_);
      side_.measure(trial_, held_, touching_, now_);
      move_frames(model_, compliance_, now_, moved_, touching_, points_);
      if (guess_.misfit(points_, moved_) <= settled)
        break;
    }
    move_bulk();
  }

private:
  void move(const VectorXd& force) {
    force_ = force;
    moved_ = free_;
    compliance_.add(-weight_, force, moved_);
    const auto& dofs = compliance_.dof_of_position();
    for (std::size_t i = 0; i < dofs.size(); ++i)
      trial_.motion.u[dofs[i]] = base_.u[dofs[i]] + moved_[static_cast<Index>(i)];
  }

  /// To where the step starts.
  void go_back() {
    const auto& dofs = compliance_.dof_of_position();
    for (std::size_t i = 0; i < dofs.size(); ++i) {
      trial_.motion.u[dofs[i]] = side_.committed().motion.u[dofs[i]];
      moved_[static_cast<Index>(i)] = trial_.motion.u[dofs[i]] - base_.u[dofs[i]];
    }
  }

  void move_bulk() {
    VectorXd half_way = half_way_;
    compliance_.factor().load_surface(-weight_ * force_, half_way);
    VectorXd d = VectorXd::Zero(base_.u.size());
    d(model_.free_dofs) = compliance_.factor().backward(half_way);
    trial_.motion = base_;
    time::correct(system_.coefficients, d, trial_.motion);
  }

  const model::Model& model_;
  double weight_;
  EffectiveSystem& system_;
  Compliance& compliance_;
  const ContactSide& side_;
  const Held& held_;
  time::Motion base_;
  VectorXd half_way_, free_, moved_, force_;
  State& trial_;
  Pulse& pulse_;
  ContactGuess guess_;
  std::vector<GuessPoint> points_;
  PointsOfZones touching_;
  ContactIterate now_;
};

} // namespace

void start_from_guess(const model::Model& model, const time::Scheme& scheme, EffectiveSystem& system,
                      const ContactSide& side, const Held& held, Equilibrium& equilibrium, State& trial,
                      Pulse& pulse) {
  equilibrium.evaluate(trial.motion, ContactForce(trial.motion.u.size()));
  if (equilibrium.residual().allFinite())
    GuessedStart(model, scheme, system, side, held, equilibrium.residual(), trial, pulse).run();
}

} // namespace rubato::step
