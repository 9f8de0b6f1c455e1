// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/time/scheme.hpp"

#include "rubato/study/study.hpp"

#include <stdexcept>

namespace rubato::time {
namespace {

using study::SchemeKind;

Scheme with_alpha(double alpha) {
  Scheme scheme;
  scheme.beta = (1 - alpha) * (1 - alpha) / 4;
  scheme.gamma = 0.5 - alpha;
  return scheme;
}

Scheme generalized_alpha(double rho) {
  const double alpha_m = (2 * rho - 1) / (rho + 1);
  const double alpha_f = rho / (rho + 1);
  Scheme scheme;
  scheme.gamma = 0.5 - alpha_m + alpha_f;
  scheme.beta = (1 - alpha_m + alpha_f) * (1 - alpha_m + alpha_f) / 4;
  scheme.inertia = {1 - alpha_m, alpha_m};
  scheme.damping = {1 - alpha_f, alpha_f};
  scheme.forces = {1 - alpha_f, alpha_f};
  return scheme;
}

Scheme theta_method(double theta) {
  Scheme scheme;
  scheme.beta = theta;
  scheme.gamma = 1;
  scheme.damping = {theta, 1 - theta};
  scheme.forces = {theta, 1 - theta};
  scheme.nonsmooth = true;
  return scheme;
}

void predict_acceleration(const Scheme& scheme, double step, const Motion& start, Eigen::VectorXd& a) {
  const double beta = scheme.beta;
  if (!scheme.dynamic)
    a.setZero(start.u.size());
  else if (scheme.nonsmooth) // a₀ is the mean of another step
    a = -1 / (beta * step) * start.v;
  else
    a = -1 / (beta * step) * start.v + (2 * beta - 1) / (2 * beta) * start.a;
}

void predict_velocity(const Scheme& scheme, double step, const Motion& start, Eigen::VectorXd& v) {
  const double beta = scheme.beta;
  const double gamma = scheme.gamma;
  if (!scheme.dynamic)
    v.setZero(start.u.size());
  else if (scheme.nonsmooth)
    v = (beta - gamma) / beta * start.v;
  else
    v = (beta - gamma) / beta * start.v + (2 * beta - gamma) * step / (2 * beta) * start.a;
}

} // namespace

Scheme make_scheme(const study::TimeStepping& settings) {
  switch (settings.scheme) {
  case SchemeKind::newmark: {
    Scheme scheme;
    scheme.beta = settings.beta.value_or(0.25);
    scheme.gamma = settings.gamma.value_or(0.5);
    return scheme;
  }
  case SchemeKind::hht: {
    auto scheme = with_alpha(settings.alpha);
    scheme.forces = {1 + settings.alpha, -settings.alpha};
    return scheme;
  }
  case SchemeKind::modified_average_acceleration:
    return with_alpha(settings.alpha);
  case SchemeKind::generalized_alpha:
    return generalized_alpha(settings.spectral_radius);
  case SchemeKind::wbz_alpha: {
    auto scheme = with_alpha(settings.alpha);
    scheme.inertia = {1 - settings.alpha, settings.alpha};
    return scheme;
  }
  case SchemeKind::moreau_jean:
    return theta_method(settings.theta);
  case SchemeKind::energy_momentum: {
    auto scheme = theta_method(0.5);
    scheme.conserving = true;
    return scheme;
  }
  case SchemeKind::static_steps: {
    Scheme scheme;
    scheme.inertia = {0, 0};
    scheme.damping = {0, 0};
    scheme.dynamic = false;
    return scheme;
  }
  case SchemeKind::central_difference:
    throw std::invalid_argument("central_difference is explicit, it has no effective matrix");
  }
  throw std::logic_error("a time scheme without its row in the table");
}

bool is_undamped(const Scheme& scheme) {
  return scheme.dynamic && !scheme.nonsmooth && scheme.gamma <= 0.5;
}

StepCoefficients coefficients_of(const Scheme& scheme, double step) {
  StepCoefficients coefficients;
  coefficients.stiffness = scheme.forces.now;
  if (!scheme.dynamic)
    return coefficients;
  coefficients.velocity = scheme.gamma / (scheme.beta * step);
  coefficients.acceleration = 1 / (scheme.beta * step * step);
  coefficients.mass = scheme.inertia.now * coefficients.acceleration;
  coefficients.damping = scheme.damping.now * coefficients.velocity;
  return coefficients;
}

Motion predict(const Scheme& scheme, double step, const Motion& start) {
  Motion end;
  predict(scheme, step, start, end);
  return end;
}

void predict(const Scheme& scheme, double step, const Motion& start, Motion& end) {
  end.u = start.u;
  predict_velocity(scheme, step, start, end.v);
  predict_acceleration(scheme, step, start, end.a);
}

Eigen::VectorXd predicted_acceleration(const Scheme& scheme, double step, const Motion& start) {
  Eigen::VectorXd a;
  predict_acceleration(scheme, step, start, a);
  return a;
}

void correct(const StepCoefficients& coefficients, const Eigen::VectorXd& d, Motion& motion) {
  motion.u += d;
  motion.v += coefficients.velocity * d;
  motion.a += coefficients.acceleration * d;
}

} // namespace rubato::time
