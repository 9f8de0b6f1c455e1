// SPDX-License-Identifier: LGPL-3.0-or-later
/// V11: the first mode of a clamped beam, how a run moves it, and the closed forms of theory.
#pragma once

#include "rubato/constraint/reduction.hpp"
#include "rubato/deck/read.hpp"
#include "rubato/domain/domain.hpp"
#include "rubato/run/run_study.hpp"

#include <Eigen/Core>

#include "support/dense.hpp"
#include "support/model_parts.hpp"
#include "support/scratch_folder.hpp"
#include "support/walk.hpp"
#include <algorithm>
#include <cmath>
#include <complex>
#include <stdexcept>
#include <string>
#include <vector>

namespace rubato::verification {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Bernoulli: 1.8751² √(EI/(ρ A L⁴)). Timoshenko (T. C. Huang, J. Appl. Mech. 28, 1961), shear factor 5/6.
inline constexpr double bernoulli = 513.9582;
inline constexpr double timoshenko = 510.6146;

struct Mode {
  double omega = 0;
  VectorXd mass_times_shape; ///< of every dof; times u it gives the mode's amplitude
};

/// By a dense generalized eigenvalue solution.
inline Mode first_mode(const test::ModelParts& model) {
  const auto& free = model.reduction.free_dofs();
  const MatrixXd k = MatrixXd(model.domain.initial_tangent())(free, free);
  const MatrixXd m = MatrixXd(model.mass)(free, free);
  const auto modes = test::general_modes(k, m);
  Mode mode{std::sqrt(modes.values[0]), VectorXd::Zero(model.dofs.dof_count)};
  mode.mass_times_shape(free) = m * modes.vectors.col(0);
  return mode;
}

/// The runs of cases/v11_free_beam: the beam bent, then let go.
class FreeBeamRuns {
public:
  /// A run's first mode: its circular frequency and its amplitude at 0, h, 2h, …
  struct Vibration {
    double omega = 0;
    double h = 0;
    time::Scheme scheme;
    std::vector<double> amplitude;
  };

  const run::RunResult& bent() const { return bent_; }
  const study::Study& study(const std::string& name) const {
    return *std::ranges::find(deck_.runs, name, &study::Study::name);
  }

  Vibration vibration(const std::string& name) const {
    test::Walk walk(study(name), &bent_.end);
    const auto mode = first_mode(walk.model);
    Vibration result{mode.omega, study(name).time.step, walk.scheme, {}};
    result.amplitude.push_back(mode.mass_times_shape.dot(walk.state().motion.u));
    while (!walk.finished()) {
      if (!walk.advance())
        throw std::runtime_error("a linear step failed");
      result.amplitude.push_back(mode.mass_times_shape.dot(walk.state().motion.u));
    }
    return result;
  }

private:
  deck::Deck deck_ = deck::read_deck(RUBATO_SOURCE_DIR "/cases/v11_free_beam/beam.yaml");
  test::ScratchFolder folder_;
  run::RunResult bent_ = run::run_study(study("bent"), folder_ / "bent", {});
};

/// λ² = s λ − d, from the recurrence q₍ₙ₊₂₎ = s q₍ₙ₊₁₎ − d qₙ that a vibration obeys once the scheme's
/// spurious root has died out: the complex amplification of one step.
inline std::complex<double> measured_amplification(const std::vector<double>& q) {
  const auto n = static_cast<Eigen::Index>(q.size()) - 2;
  const Eigen::Index first = n / 2;
  MatrixXd left(n - first, 2);
  VectorXd right(n - first);
  for (Eigen::Index i = first; i < n; ++i) {
    const auto k = static_cast<std::size_t>(i);
    left.row(i - first) << q[k + 1], -q[k];
    right[i - first] = q[k + 2];
  }
  const Eigen::Vector2d sd = test::least_squares(left, right);
  return {sd[0] / 2, std::sqrt(sd[1] - sd[0] * sd[0] / 4)};
}

/// The closed form: the amplification matrix of (u, h v, h² a) for equilibrium with weights 1−α_m, α_m on
/// inertia and 1−α_f, α_f on the spring (hht: α_f = −α, α_m = 0).
inline Eigen::Matrix3d amplification(double alpha_m, double alpha_f, double beta, double gamma,
                                     double omega_h) {
  const double w = omega_h * omega_h;
  const double divisor = 1 - alpha_m + (1 - alpha_f) * beta * w;
  Eigen::Matrix3d a;
  a.row(2) << -w, -(1 - alpha_f) * w, -alpha_m - (1 - alpha_f) * (0.5 - beta) * w;
  a.row(2) /= divisor;
  a.row(0) = Eigen::RowVector3d(1, 1, 0.5 - beta) + beta * a.row(2);
  a.row(1) = Eigen::RowVector3d(0, 1, 1 - gamma) + gamma * a.row(2);
  return a;
}

/// The root that is the motion: the one of largest angle; the third is spurious and real.
inline std::complex<double> principal(const Eigen::Matrix3d& matrix) {
  const Eigen::Vector3cd values = test::eigenvalues(matrix);
  Eigen::Index index = 0;
  values.imag().maxCoeff(&index);
  return values[index];
}

} // namespace rubato::verification
