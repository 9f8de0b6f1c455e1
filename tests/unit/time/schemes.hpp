// SPDX-License-Identifier: LGPL-3.0-or-later
/// Schemes by name and one step of a single mass on a spring.
#pragma once

#include "rubato/study/schemes.hpp"
#include "rubato/time/scheme.hpp"

namespace rubato::test {

inline time::Scheme scheme_of(study::SchemeKind kind, double alpha = 0) {
  study::TimeStepping settings;
  settings.scheme = kind;
  settings.alpha = alpha;
  return time::make_scheme(settings);
}
inline time::Scheme newmark() {
  return scheme_of(study::SchemeKind::newmark);
}
inline time::Scheme hht(double alpha) {
  return scheme_of(study::SchemeKind::hht, alpha);
}
inline time::Scheme modified(double alpha) {
  return scheme_of(study::SchemeKind::modified_average_acceleration, alpha);
}
inline time::Scheme generalized_alpha(double spectral_radius) {
  study::TimeStepping settings;
  settings.scheme = study::SchemeKind::generalized_alpha;
  settings.spectral_radius = spectral_radius;
  return time::make_scheme(settings);
}

inline time::Scheme wbz(double alpha) {
  return scheme_of(study::SchemeKind::wbz_alpha, alpha);
}

inline time::Scheme moreau_jean(double theta) {
  study::TimeStepping settings;
  settings.scheme = study::SchemeKind::moreau_jean;
  settings.theta = theta;
  return time::make_scheme(settings);
}

inline time::Scheme energy_momentum() {
  return scheme_of(study::SchemeKind::energy_momentum);
}

/// A mass 1 on a spring ω² and a dashpot 2ξω.
struct Oscillator {
  double omega = 1;
  double ratio = 0; ///< ξ

  double stiffness() const { return omega * omega; }
  double damping() const { return 2 * ratio * omega; }
};

inline time::Motion motion(double u, double v, double a) {
  return {Eigen::VectorXd::Constant(1, u), Eigen::VectorXd::Constant(1, v), Eigen::VectorXd::Constant(1, a)};
}

/// One free step by the module's own predictor, corrector and coefficients.
inline time::Motion step(const time::Scheme& scheme, const Oscillator& spring, double h,
                         const time::Motion& start) {
  const auto c = time::coefficients_of(scheme, h);
  auto end = time::predict(scheme, h, start);
  const auto sum = [](const time::Weights& weights, double now, double before) {
    return weights.now * now + weights.before * before;
  };
  const double residual = sum(scheme.inertia, end.a[0], start.a[0]) +
                          spring.damping() * sum(scheme.damping, end.v[0], start.v[0]) +
                          spring.stiffness() * sum(scheme.forces, end.u[0], start.u[0]);
  const double effective = c.mass + c.damping * spring.damping() + c.stiffness * spring.stiffness();
  time::correct(c, Eigen::VectorXd::Constant(1, -residual / effective), end);
  return end;
}

} // namespace rubato::test
