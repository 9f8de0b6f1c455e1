// SPDX-License-Identifier: LGPL-3.0-or-later
/// Small laws of one point for tests of the cells: elastic (linear in the strain that it sees), neo-Hookean,
/// J2 with linear hardening, and any of them in plane stress.
#pragma once

#include "rubato/material/point_response.hpp"

#include <Eigen/LU>

#include <cmath>
#include <span>

namespace rubato::test {

using material::Response;
using material::StepInfo;
using material::Strain6;
using material::Stress6;
using material::Tangent6;
using material::Want;

inline Strain6 unit_trace() {
  Strain6 unit;
  unit << 1, 1, 1, 0, 0, 0;
  return unit;
}

/// K 1⊗1 + 2G I_dev.
inline Tangent6 isotropic_tangent(double bulk, double shear) {
  Tangent6 d = Tangent6::Zero();
  d.topLeftCorner<3, 3>().setConstant(bulk - 2 * shear / 3);
  d.diagonal().head<3>().array() += 2 * shear;
  d.diagonal().tail<3>().setConstant(shear);
  return d;
}

struct ElasticLaw {
  double young, poisson;
  double shear() const { return young / (2 * (1 + poisson)); }
  double bulk() const { return young / (3 * (1 - 2 * poisson)); }
};

inline int state_size(const ElasticLaw&) {
  return 0;
}

inline bool respond(const ElasticLaw& law, const Strain6& strain, std::span<const double>, std::span<double>,
                    const StepInfo&, Want want, Response& out) {
  const double shear = law.shear();
  const double lambda = law.bulk() - 2 * shear / 3;
  out.stress = shear * strain;
  out.stress.head<3>() *= 2;
  out.stress.head<3>().array() += lambda * strain.head<3>().sum();
  out.stored = 0.5 * strain.dot(out.stress);
  if (want == Want::tangent)
    out.tangent = isotropic_tangent(law.bulk(), shear);
  return true;
}

/// W = μ/2 (J^(−2/3) I₁ − 3) + K/4 (J² − 1 − 2 ln J) of Green–Lagrange's strain.
struct NeoHookeanLaw {
  double shear, bulk;
};

inline int state_size(const NeoHookeanLaw&) {
  return 0;
}

constexpr bool is_hyperelastic(const NeoHookeanLaw&) {
  return true;
}

/// C − 1 holds all digits of small strains: J² − 1 comes from its invariants.
inline bool respond(const NeoHookeanLaw& law, const Strain6& strain, std::span<const double>,
                    std::span<double>, const StepInfo&, Want want, Response& out) {
  Eigen::Matrix3d a;
  a << 2 * strain[0], strain[3], strain[5], strain[3], 2 * strain[1], strain[4], strain[5], strain[4],
      2 * strain[2];
  const double second = 0.5 * (a.trace() * a.trace() - a.squaredNorm());
  const double det_less_one = a.trace() + second + a.determinant(); // J² − 1
  if (!(det_less_one > -1))
    return false;
  const Eigen::Matrix3d inverse = (Eigen::Matrix3d::Identity() + a).inverse();
  const double trace = a.trace(), j2 = 1 + det_less_one, factor = law.shear * std::pow(j2, -1. / 3);
  // 1 − I₁/3 C⁻¹ = C⁻¹ (C − 1 − ⅓ tr(C − 1))
  const Eigen::Matrix3d dev = inverse * (a - trace / 3 * Eigen::Matrix3d::Identity());
  const double p = law.bulk / 2 * det_less_one; // J V'
  const Eigen::Matrix3d s = factor * 0.5 * (dev + dev.transpose()) + p * inverse;
  out.stress << s(0, 0), s(1, 1), s(2, 2), s(0, 1), s(1, 2), s(0, 2);
  out.stored = law.shear / 2 * ((trace + 3) * std::pow(j2, -1. / 3) - 3) +
               law.bulk / 4 * (det_less_one - std::log1p(det_less_one));
  if (want == Want::stress)
    return true;
  Strain6 c, d, unit = unit_trace();
  c << inverse(0, 0), inverse(1, 1), inverse(2, 2), inverse(0, 1), inverse(1, 2), inverse(0, 2);
  d << dev(0, 0), dev(1, 1), dev(2, 2), 0.5 * (dev(0, 1) + dev(1, 0)), 0.5 * (dev(1, 2) + dev(2, 1)),
      0.5 * (dev(0, 2) + dev(2, 0));
  Tangent6 turned; // I_C
  constexpr int pair[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {0, 2}};
  for (int m = 0; m < 6; ++m)
    for (int n = 0; n < 6; ++n) {
      const auto [i, j] = pair[m];
      const auto [k, l] = pair[n];
      turned(m, n) = 0.5 * (inverse(i, k) * inverse(j, l) + inverse(i, l) * inverse(j, k));
    }
  out.tangent =
      2 * factor * (-(d * c.transpose()) / 3 - c * unit.transpose() / 3 + (trace + 3) / 3 * turned) +
      law.bulk * j2 * c * c.transpose() - 2 * p * turned;
  out.tangent = 0.5 * (out.tangent + out.tangent.transpose()).eval();
  return true;
}

/// Backward Euler: J. C. Simo, T. J. R. Hughes, Computational Inelasticity, 1998, box 3.2. State: ε^p, p.
struct PlasticLaw {
  ElasticLaw elastic;
  double yield, hardening;
};

inline int state_size(const PlasticLaw&) {
  return 7;
}

inline bool respond(const PlasticLaw& law, const Strain6& strain, std::span<const double> old,
                    std::span<double> now, const StepInfo&, Want want, Response& out) {
  const double shear = law.elastic.shear(), bulk = law.elastic.bulk();
  const Eigen::Map<const Strain6> before(old.data());
  const double trace = strain[0] + strain[1] + strain[2];
  Strain6 s = shear * (strain - before);
  s.head<3>() *= 2;
  s.head<3>().array() -= 2 * shear * trace / 3;
  const double q = std::sqrt(1.5 * (s.squaredNorm() + s.tail<3>().squaredNorm()));
  const double limit = law.yield + law.hardening * old[6];
  const double x = q > limit ? (q - limit) / (3 * shear + law.hardening) : 0;
  const Strain6 n = q > 0 ? Strain6(1.5 / q * s) : Strain6(Strain6::Zero());
  Eigen::Map<Strain6> after(now.data());
  after = before + x * n;
  after.tail<3>() += x * n.tail<3>();
  now[6] = old[6] + x;
  out.stress = s - 2 * shear * x * n;
  const double left = q - 3 * shear * x;
  out.stored = bulk / 2 * trace * trace + left * left / (6 * shear);
  out.stress.head<3>().array() += bulk * trace;
  if (want == Want::stress)
    return true;
  out.tangent = isotropic_tangent(bulk, x > 0 ? shear * (1 - 3 * shear * x / q) : shear);
  if (x > 0)
    out.tangent += 4 * shear * shear * (x / q - 1 / (3 * shear + law.hardening)) * n * n.transpose();
  return true;
}

/// `law` with the strain along z that makes the stress there vanish.
template <class L> struct PlaneStressLaw { L law; };

template <class L> int state_size(const PlaneStressLaw<L>& plane) {
  return state_size(plane.law) + 1;
}

template <class L>
bool respond(const PlaneStressLaw<L>& plane, const Strain6& strain, std::span<const double> old,
             std::span<double> now, const StepInfo& step, Want want, Response& out) {
  constexpr int most_iterations = 25;
  const auto size = old.size() - 1;
  Strain6 full = strain;
  full[2] = old.back();
  for (int i = 0; i < most_iterations; ++i) {
    if (!respond(plane.law, full, old.first(size), now.first(size), step, Want::tangent, out))
      return false;
    const double largest = out.stress.cwiseAbs().maxCoeff();
    const double noise = 1e-15 * out.tangent(2, 2) * std::max(1., full.norm());
    if (std::abs(out.stress[2]) <= std::max(1e-13 * largest, noise))
      break;
    full[2] -= out.stress[2] / out.tangent(2, 2);
  }
  now.back() = full[2];
  out.stress[2] = 0;
  if (want == Want::tangent) {
    const Strain6 column = out.tangent.col(2);
    out.tangent -= column * column.transpose() / column[2];
  }
  return true;
}

} // namespace rubato::test
