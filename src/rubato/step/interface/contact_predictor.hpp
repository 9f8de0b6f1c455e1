// SPDX-License-Identifier: LGPL-3.0-or-later
/// Predicts the active set of a step: which points will touch, stick and slip at its end, and with which
/// forces. Without it Newton's method releases one row of points an iteration.
#pragma once

#include "rubato/contact/stencil.hpp"
#include "rubato/linalg/ranked_matrix.hpp"
#include "rubato/step/interface/active_interface_compliance.hpp"
#include "rubato/step/interface/compliance.hpp"
#include "rubato/step/interface/friction_cones.hpp"
#include "rubato/step/interface/normal_problem.hpp"
#include "rubato/step/progress.hpp"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace rubato::step {

/// A point that may touch, in a frame that is held. With e = Σ weight · d, how far the surface moves it off
/// its place on the master, its gap (from `rest_gap`) and slips are `value` + frameᵀ e, and its forces F
/// along them put −weight · frame F on the surface (internal side).
struct PredictorPoint {
  std::size_t zone = 0;
  std::size_t index = 0;            ///< in the zone's points
  contact::NumberedStencil stencil; ///< on the surface; empty where the point faces nothing
  Eigen::Matrix3d frame = Eigen::Matrix3d::Identity(); ///< n, τ₁, τ₂
  Eigen::Vector3d value = Eigen::Vector3d::Zero();     ///< where d = 0 [length]
  Eigen::Vector3d force = Eigen::Vector3d::Zero();     ///< pressing ≥ 0, and along the slips [force]
  double gap = 0;                   ///< where its frame was measured, from rest_gap [length]
  double rest_gap = 0;              ///< from where its gaps are counted: its spring begins there [length]
  double weight = 0;                ///< what a pressure there is multiplied with [area], or 1
  double penalty_compliance = 0;    ///< penetration a unit of force makes: of penalties [length/force]
  double averaged_compliance = 0;   ///< the same where gaps close on average only [length/force]
  double tangential_compliance = 0; ///< the same of friction; 0 where it holds exactly [length/force]
  double friction = 0;              ///< μ
  double point_compliance =
      0; ///< what its own surface gives under a unit force, where that is asked for [length/force]
};

/// Gap and slips with the surface at d.
Eigen::Vector3d measures_of(const PredictorPoint& point, const Eigen::VectorXd& d);

/// Adds Σ weight · frame F, of the forces from `first` to `last` (0 along the gap, 1 and 2 along the slips),
/// to `force`, one an interface dof.
void add_force(std::span<const PredictorPoint> points, int first, int last, Eigen::VectorXd& force);

class ContactPredictor {
public:
  /// Unknowns of surfaces whose compliance is looked at where points stand only: of smaller ones that costs
  /// more than it saves. Results are the same to the bit.
  static constexpr std::size_t usual_least_watched = 2000;

  /// From so many points on their mutual compliance is found from their forces together where the compliance
  /// offers that: results are the same to rounding.
  static constexpr std::size_t usual_many = 500;

  /// Points that are solved for together up to which what they do to one another is computed. More of them
  /// are solved for by products with S where a start `near` the solution is enough, without friction beyond
  /// what they bring: the iterations find that.
  static constexpr std::size_t usual_most_formed = 2000;

  /// The surface moves by d = free + factor S Σ weight · frame F. Points live in a space of as many
  /// dimensions as `components`. How far pressing forces are solved for: `near` is enough for a start;
  /// `active_set` is for bodies that only contact holds, each of whose points moves all others by more than
  /// its own strain: there pressing and rubbing are solved for together, too; with `projected_cg` points join
  /// until none penetrates. `compliance` must outlive this.
  ContactPredictor(Compliance& compliance, double factor, int components,
                   NormalSolution how_far = NormalSolution::near,
                   std::size_t least_watched = usual_least_watched, std::size_t many = usual_many,
                   std::size_t most_formed = usual_most_formed);

  /// Improves the forces of the points, which have been measured with the surface at d: first the pressing
  /// ones, so that no gap is negative, then those along the slips for the pressing ones found, so that none
  /// exceeds μ times them and slips go against them (Tresca's problem). Points that have no force and don't
  /// penetrate get none. What points do to one
  /// another is computed when they press or penetrate first in a call: kept for the next one, it leads to
  /// other points that stick.
  /// Nothing that comes of it counts when the progress has stopped. `matrix`: A, or one near it.
  void improve(std::span<PredictorPoint> points, const Eigen::VectorXd& free, Eigen::VectorXd d,
               const linalg::WholeMatrix& matrix, Progress& progress);

  /// How much a sweep would change the forces now that the points have been measured anew and the surface
  /// is at d, in parts of the largest one; 0 where they were solved for by products. The points must be those
  /// of the last call.
  double misfit(std::span<const PredictorPoint> points, const Eigen::VectorXd& d) const;
  /// The parts of the surface that points stand on, which calls keep for the next one: of large surfaces as
  /// large as the compliance itself where everything touches.
  void forget_surface() {
    watched_.forget();
    watches_all_ = false;
  }
  /// These, the points and what they do to one another.
  void forget();

private:
  void forget_points();
  bool are_too_many() const;
  void improve_by_products(std::span<PredictorPoint> points, const Eigen::VectorXd& free,
                           const linalg::WholeMatrix& matrix, Progress& progress);
  void add_motion(std::span<const PredictorPoint> points, int first, int last, Eigen::VectorXd& d);
  bool choose_more(std::span<PredictorPoint> points, const Eigen::VectorXd& d);
  void watch(std::span<PredictorPoint* const> points);
  /// What moves the surface by a unit force at a point, and the surface then.
  struct Push {
    std::vector<ForceAt> forces;
    std::vector<int> active;    ///< where they act, by number of what is watched
    Eigen::VectorXd of_watched; ///< how what is watched moves
    Eigen::VectorXd moved;      ///< the same by interface dof; not defined where nothing is watched
  };
  bool is_watched() const { return watches_all_ || watched_.size() > 0; }
  void push(const PredictorPoint& point, int axis, Push& push) const;
  void push_watched(Push& push) const;
  template <class Work>
  void each_column(Eigen::Index first, Eigen::Index count, Progress& progress, const Work& work) const;
  bool takes_together() const;
  void find_normal_compliance();
  void add_normal_compliance(Progress& progress);
  void add_tangential_compliance(Progress& progress);
  void find_normal_forces(const Eigen::VectorXd& without, Progress& progress);
  void find_friction(std::span<PredictorPoint> points, const Eigen::VectorXd& without, Progress& progress);
  void add_cones(std::span<PredictorPoint* const> together, const Eigen::VectorXd& free, FrictionCones& cones,
                 Progress& progress);
  static bool join(std::span<PredictorPoint> points, const Eigen::VectorXd& d,
                   std::vector<PredictorPoint*>& together);
  void solve_coupled(std::span<PredictorPoint> points, const Eigen::VectorXd& free, Progress& progress);
  double misfit_by_point_compliance(std::span<const PredictorPoint> points, const Eigen::VectorXd& d) const;
  double point_compliance_of(std::size_t chosen) const;

  Compliance& compliance_;
  double factor_;
  Eigen::Index components_;
  NormalSolution how_far_;
  std::size_t least_watched_;
  std::size_t many_;
  std::size_t most_formed_;
  bool formed_ = true;                  ///< whether the last call has computed what points do to one another
  std::vector<PredictorPoint*> chosen_; ///< those that may touch
  std::vector<std::size_t> sliding_;    ///< of those chosen
  Eigen::MatrixXd normal_compliance_;   ///< gaps of chosen points for unit pressing forces on each
  Eigen::MatrixXd tangential_compliance_; ///< slips of sliding ones for unit friction on each
  Eigen::VectorXd force_;                 ///< storage of add_motion
  ActiveInterfaceCompliance watched_;     ///< parts of the surface whose motion push tells
  bool watches_all_ = false;              ///< so many points stand on it that push moves it whole
  std::vector<double> gaps_;              ///< storage of choose_more
};

} // namespace rubato::step
