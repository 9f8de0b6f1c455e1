// SPDX-License-Identifier: LGPL-3.0-or-later
/// Newton's iterations with held operators, accelerated by their own history (D. Anderson, J. ACM 12 (1965)
/// 547–560; H. Walker, P. Ni, SIAM J. Numer. Anal. 49 (2011) 1715–1735).
///
/// What the linearisation leaves out makes the iterations converge slowly, or wander, along few directions.
/// With G(x) what an iteration makes of an iterate and f = G(x) − x its correction of the surface's motion,
/// the next iterate is G(x) − Σ γⱼ (Gⱼ₊₁ − Gⱼ), with γ such that |f − Σ γⱼ (fⱼ₊₁ − fⱼ)| is least. Nothing is
/// computed anew for it. Where operators do not change, every correction after the first is 0.
#pragma once

#include <Eigen/Core>

#include <span>
#include <vector>

namespace rubato::step {

/// What a whole correction makes of an iterate.
struct Corrected {
  Eigen::VectorXd applied;                  ///< as SurfaceMotion::applied
  Eigen::VectorXd moved;                    ///< as SurfaceMotion::moved
  std::vector<Eigen::VectorXd> multipliers; ///< of each zone

  /// Adds share · (to − from) to forces and multipliers: `moved` follows from `applied`.
  void add(double share, const Corrected& to, const Corrected& from);
};

/// γ of changes, of which there are at least two, the last one last; none where rounding has eaten them.
std::vector<double> shares_of_history(std::span<const Eigen::VectorXd> changes);

class NewtonHistory {
public:
  void forget();
  /// The last iterate's correction of the surface's motion, and what it led to.
  void add(Eigen::VectorXd change, const Corrected& corrected);
  /// Whether the last correction is more than a tenth of the one before.
  bool is_slow() const;
  /// Combines the last correction, which the caller has, with those before.
  void accelerate(Corrected& correction) const;

private:
  std::vector<Eigen::VectorXd> changes_;
  std::vector<Corrected> corrected_; ///< as many
};

} // namespace rubato::step
