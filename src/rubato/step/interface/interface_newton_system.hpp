// SPDX-License-Identifier: LGPL-3.0-or-later
/// The linear system of the points in contact, on a bulk that answers by its surface compliance S.
///
/// Unknowns are (δz, δξ) of each point (contact/point_tangent.hpp): the change of its force and of its
/// place on the master. Its own multipliers are eliminated; those that points share are unknowns δm beside
/// them, each with the sum of the equations of its points (shared_multipliers.hpp). With C the change of
/// force put on the dofs, f₁ the scheme's weight of forces, f_c what contact puts on the surface now, and d₀
/// − f₁ S f_c how far the surface then moves from where the points were measured:
///   A₁ δz + A₂ δq = b (+ Z_m δm),   δξ − P δq = 0,   δq = d₀ − f₁ S (f_c + Cᵀ (δz, δξ))   at each point,
///   Σ ψ (E_q δq + E_m δm) = −Σ ψ e   for each shared multiplier.
/// Of few points the whole dense matrix is factored, of many that of the forces alone: the moving places
/// change little beside the forces, and the whole is refined with it; where that does not converge, it is
/// factored. The same points are refined with the factors that an iteration before has left.
///
/// Where S between the points is too large to be formed, the equations are solved by GMRES: a product with S,
/// two halves of a solve, for each of its iterations, preconditioned by the equations of the points with the
/// bulk next to them (near_surface.hpp). So far not where multipliers are shared.
#pragma once

#include "rubato/linalg/dense_lu.hpp"
#include "rubato/linalg/ranked_matrix.hpp"
#include "rubato/step/interface/active_point.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace rubato::step {

class InterfaceNewtonSystem {
public:
  struct Limits {
    /// Forces of the points, δz, up to which S between them is formed: their LU takes some seconds.
    Eigen::Index formed = 6000;
    /// Part of the first residual that is left of more of them: Newton's next iteration takes the rest.
    double left_by_products = 3e-3;
    /// Active dofs from which places that points have left are forgotten where they are more than half of
    /// all: S between all places of a large surface takes more memory than its factor.
    Eigen::Index kept = 3000;
  };

  /// Both must outlive this.
  InterfaceNewtonSystem(Compliance& compliance, ActiveInterfaceCompliance& surface, double force_weight,
                        const Limits& limits);
  InterfaceNewtonSystem(Compliance& compliance, ActiveInterfaceCompliance& surface, double force_weight)
      : InterfaceNewtonSystem(compliance, surface, force_weight, Limits()) {}

  /// Begins another iteration with no points; factors are kept for the same ones.
  void clear();
  /// Factors too.
  void forget();
  /// The response of one more point in contact, to be filled in by the caller. `shares`: of a point that
  /// shares its multipliers.
  contact::FactoredResponse& add(std::size_t zone, std::size_t index,
                                 std::span<const MultiplierShare> shares = {});
  /// A point apart that shares its multipliers.
  void add_open(std::span<const MultiplierShare> shares, const contact::PointEquations& equations) {
    shared_.add_open(shares, equations);
    sharing_ = true;
  }
  std::span<const ActivePoint> points() const { return {points_.data(), count_}; }

  struct Change {
    Eigen::VectorXd force;  ///< δz, point after point
    Eigen::VectorXd xi;     ///< δξ, point after point
    Eigen::VectorXd shared; ///< δm of the shared multipliers that are unknowns
  };
  /// Once for the points added, with d₀ and f_c one an interface dof. `matrix`: A, or one near it. Nothing
  /// comes back when the system is singular.
  std::optional<Change> solve(const Eigen::VectorXd& d0, const Eigen::VectorXd& force,
                              const linalg::WholeMatrix& matrix);
  /// f_c += Cᵀ (δz, δξ)
  void add_force(const Change& change, Eigen::VectorXd& force) const;
  /// Calls `take(multiplier, δm)` for every shared multiplier of the points added; `multiplier` counts those
  /// of all zones.
  template <class Take> void for_each_shared(const Change& change, Take take) const {
    shared_.for_each_change(change.shared, take);
  }
  /// δm of a point that owns its multipliers, given the whole change and how far the surface moved with it.
  contact::PointVector multipliers_of(const ActivePoint& point, const Change& change,
                                      const Eigen::VectorXd& moved) const;

private:
  std::span<ActivePoint> active() { return {points_.data(), count_}; }
  void number_dofs(ActivePoint& point);
  bool collect_shared();
  bool forms_compliance() const;
  void forget_left_places();
  void touch_surface();
  Eigen::VectorXd at_active_dofs(const Eigen::VectorXd& values) const;
  Eigen::Index rows_of_whole() const;
  Eigen::MatrixXd matrix_of(Eigen::Index rows) const;
  void add_shared(Eigen::Index rows, Eigen::MatrixXd& matrix) const;
  void add_shared(const Change& change, const Eigen::VectorXd& d, Change& left) const;
  bool keeps_factors() const;
  bool has_factors_of_these() const;
  bool factor(Eigen::Index rows);
  Change correction(const Change& left) const;
  double largest_row(const Change& left) const;
  Eigen::VectorXd joined(const Change& change, Eigen::Index rows) const;
  Change split(const Eigen::VectorXd& all, Eigen::Index rows) const;
  std::optional<Change> least(const Change& left, Eigen::Index rows) const;
  std::optional<Change> solved_for_forces(const Eigen::VectorXd& c);
  std::optional<Change> refined(const Eigen::VectorXd& c, int rounds);
  std::optional<Change> solved_whole(const Eigen::VectorXd& c);
  std::optional<Change> solved_by_products(const Eigen::VectorXd& c, const linalg::WholeMatrix& matrix) const;
  Eigen::VectorXd equation_weights(const Change& left, double compliance) const;
  static void add_xi(const ActivePoint& point, const Eigen::VectorXd& d, double* xi);
  Eigen::VectorXd motion(const Change& change) const;
  Change residual(const Eigen::VectorXd& c, const Change& change) const;
  Eigen::VectorXd xi_after(const Change& change) const;
  Change no_change() const;

  Compliance& compliance_;
  double force_weight_;
  Limits limits_;
  std::vector<ActivePoint> points_; ///< the first count_ of them; others are storage
  std::size_t count_ = 0;
  Eigen::Index forces_ = 0;   ///< how many δz
  Eigen::Index xi_count_ = 0; ///< how many δξ
  SharedMultipliers shared_;
  bool sharing_ = false; ///< whether any point does
  ActiveInterfaceCompliance& surface_;
  std::optional<linalg::DenseLu> factors_;
  std::vector<std::pair<std::size_t, std::size_t>> factored_points_; ///< zone and index
  std::vector<int> factored_shared_;
  Eigen::Index factored_rows_ = 0;           ///< of each point: δz alone, or δξ too
  Eigen::VectorXd row_scale_, column_scale_; ///< of the factored matrix
};

} // namespace rubato::step
