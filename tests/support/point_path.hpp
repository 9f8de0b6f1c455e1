// SPDX-License-Identifier: LGPL-3.0-or-later
/// Points of a material that are led through strains and stresses, and derivatives by differences.
#pragma once

#include "rubato/material/point_law.hpp"

#include "support/dense.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <utility>
#include <vector>

namespace rubato::test {

using material::Response;
using material::Strain6;
using material::Stress6;
using material::Tangent6;

/// A point with a past: strain, response and state of the last step, and the sums of the balance.
class PointPath {
public:
  explicit PointPath(material::PointLaw law)
      : law_(std::move(law)), state_(static_cast<std::size_t>(material::state_size(law_)), 0.0),
        next_(state_) {
    strain_.setZero();
    works_ = material::respond(law_, strain_, state_, next_, {}, material::Want::tangent, response_);
    std::fill(next_.begin(), next_.end(), 0.0);
  }

  /// One step to all six strains.
  bool to_strain(const Strain6& strain, double length = 1) {
    Response now;
    if (!material::respond(law_, strain, state_, next_, {length}, material::Want::tangent, now))
      return works_ = false;
    accept(strain, now);
    return true;
  }

  /// One step to strains where `held` is true and to stresses where it is not.
  bool to_mixed(const std::array<bool, 6>& held, const Strain6& target, double length = 1) {
    Strain6 strain = strain_;
    for (int i = 0; i < 6; ++i)
      if (held[static_cast<std::size_t>(i)])
        strain[i] = target[i];
    Response now;
    double least = std::numeric_limits<double>::infinity();
    for (int iteration = 0; iteration < 60; ++iteration) {
      if (!material::respond(law_, strain, state_, next_, {length}, material::Want::tangent, now))
        return works_ = false;
      Strain6 rest = target - now.stress;
      Tangent6 d = now.tangent;
      for (int i = 0; i < 6; ++i)
        if (held[static_cast<std::size_t>(i)])
          d.row(i) = Tangent6::Identity().row(i), rest[i] = 0;
      if (rest.norm() <= 1e-14 * now.stress.norm() ||
          (rest.norm() >= least && least < 1e-9 * now.stress.norm())) {
        accept(strain, now);
        return true;
      }
      least = std::min(least, rest.norm());
      strain += test::dense_solution(d, rest);
    }
    return works_ = false;
  }

  /// One step to a strain along x with no other stress.
  bool pull(double strain, double length = 1) {
    return to_mixed({true, false, false, false, false, false}, Strain6::Unit(0) * strain, length);
  }

  const material::PointLaw& law() const { return law_; }
  const Strain6& strain() const { return strain_; }
  const Response& response() const { return response_; }
  const std::vector<double>& state() const { return state_; }
  bool works() const { return works_; }
  double p() const { return material::cumulated_plastic_strain(law_, state_); }

  double work = 0;            ///< Σ {σ}:[ε]
  double gross = 0;           ///< Σ |{σ}|:|[ε]|: what rounding counts by
  material::Dissipation lost; ///< the sums
  double least_plastic = 0;   ///< of one step

private:
  void accept(const Strain6& strain, const Response& now) {
    const Stress6 mean = 0.5 * (response_.stress + now.stress);
    const auto step = material::dissipation(law_, state_, next_, mean);
    work += mean.dot(strain - strain_);
    gross += mean.cwiseAbs().dot((strain - strain_).cwiseAbs());
    lost.plastic += step.plastic;
    lost.back_stress += step.back_stress;
    lost.viscous += step.viscous;
    least_plastic = std::min(least_plastic, step.plastic);
    strain_ = strain;
    response_ = now;
    std::swap(state_, next_);
  }

  material::PointLaw law_;
  std::vector<double> state_, next_;
  Strain6 strain_;
  Response response_;
  bool works_ = true;
};

/// P_xx of an isotropic hyperelastic law stretched along x, or along x and y, with nothing else stressed:
/// bisection for the volume, which ends however incompressible the law is.
inline double nominal_stress(const material::PointLaw& law, double stretch, bool both_ways) {
  constexpr int halvings = 60;
  const auto strain_of = [](double square) { return 0.5 * (square - 1); };
  double low = -0.5;
  double high = 0.5;
  Response out;
  for (int i = 0; i < halvings; ++i) {
    const double logarithm = 0.5 * (low + high); // of J
    const double rest = std::exp(2 * logarithm) / (stretch * stretch);
    Strain6 strain = Strain6::Zero();
    strain[0] = strain_of(stretch * stretch);
    strain[1] = both_ways ? strain[0] : strain_of(std::sqrt(rest));
    strain[2] = both_ways ? strain_of(rest / (stretch * stretch)) : strain[1];
    if (!material::respond(law, strain, {}, {}, {}, material::Want::stress, out))
      return std::nan("");
    (out.stress[2] > 0 ? high : low) = logarithm;
  }
  return stretch * out.stress[0];
}

inline Strain6 random_six(std::mt19937& engine, double size) {
  std::uniform_real_distribution<double> component(-size, size);
  Strain6 six;
  for (auto& value : six)
    value = component(engine);
  return six;
}

/// The tangent of a step from the path's state to `strain` by differences of fourth order of the stress.
inline Tangent6 tangent_by_differences(const PointPath& path, const Strain6& strain, double length,
                                       double width) {
  std::vector<double> unused(path.state());
  const auto stress_at = [&](int i, double by) -> Stress6 {
    Response out;
    material::respond(path.law(), strain + by * Strain6::Unit(i), path.state(), unused, {length},
                      material::Want::stress, out);
    return out.stress;
  };
  Tangent6 d;
  for (int i = 0; i < 6; ++i)
    d.col(i) = (8 * (stress_at(i, width) - stress_at(i, -width)) -
                (stress_at(i, 2 * width) - stress_at(i, -2 * width))) /
               (12 * width);
  return d;
}

/// The stress without dissipation by differences of fourth order of the stored energy.
inline Stress6 stress_by_differences(const PointPath& path, const Strain6& strain, double width) {
  std::vector<double> unused(path.state());
  const auto energy_at = [&](int i, double by) {
    Response out;
    material::respond(path.law(), strain + by * Strain6::Unit(i), path.state(), unused, {},
                      material::Want::stress, out);
    return out.stored;
  };
  Stress6 s;
  for (int i = 0; i < 6; ++i)
    s[i] = (8 * (energy_at(i, width) - energy_at(i, -width)) -
            (energy_at(i, 2 * width) - energy_at(i, -2 * width))) /
           (12 * width);
  return s;
}

} // namespace rubato::test
