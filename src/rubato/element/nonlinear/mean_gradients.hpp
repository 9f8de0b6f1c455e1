// SPDX-License-Identifier: LGPL-3.0-or-later
/// Means over the area or volume of the gradients of QUAD4 and HEXA8, exact whatever their shape (D. P.
/// Flanagan, T. Belytschko, Int. J. Numer. Meth. Eng. 17 (1981) 679–706, who call them uniform gradients).
///
/// Σ_i x_i N_i = Σ_w c_w φ_w(ξ) with the waves φ_w = 1, ξ, η, ξη, … and c_w = Σ_i φ_w(ξ_i) x_i/n, n nodes.
/// The volume is a polynomial of the c_w, and V ∂N_i/∂X = ∂V/∂x_i = Σ_w φ_w(ξ_i) ∂V/∂c_w / n:
///
///   A = 4 c_ξ × c_η
///   V = 8 ([c_ξ c_η c_ζ] + ([c_ξ c_ξη c_ζξ] + [c_ξη c_η c_ηζ] + [c_ζξ c_ηζ c_ζ])/3),   [a b c] = a·(b × c)
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace rubato::element {

/// Nodes × waves but the constant one: ξ, η, ξη, then of HEXA8 ζ, ζξ, ηζ, ξηζ (cell::shortest_waves).
template <int d> using Waves = Eigen::Matrix<double, 1 << d, (1 << d) - 1>;

template <int d> const Waves<d>& waves();
template <> const Waves<2>& waves<2>();
template <> const Waves<3>& waves<3>();

template <int d> struct MeanGradients {
  double volume = 0;
  Eigen::Matrix<double, 1 << d, d> gradients; ///< nodes × components
};

/// `x`: coordinates, a row a node.
template <int d> MeanGradients<d> mean_gradients(const Eigen::Matrix<double, 1 << d, d>& x) {
  const auto& waves_of_nodes = waves<d>();
  const Eigen::Matrix<double, d, (1 << d) - 1> c = x.transpose().lazyProduct(waves_of_nodes) / (1 << d);
  Eigen::Matrix<double, d, (1 << d) - 1> change = Eigen::Matrix<double, d, (1 << d) - 1>::Zero();
  if constexpr (d == 2) {
    change.col(0) << c(1, 1), -c(0, 1);
    change.col(1) << -c(1, 0), c(0, 0);
  } else {
    const auto wave = [&](int i) -> Eigen::Vector3d { return c.col(i); };
    const Eigen::Vector3d xi = wave(0), eta = wave(1), xi_eta = wave(2), zeta = wave(3), zeta_xi = wave(4),
                          eta_zeta = wave(5);
    change.col(0) = eta.cross(zeta) + xi_eta.cross(zeta_xi) / 3;
    change.col(1) = zeta.cross(xi) + eta_zeta.cross(xi_eta) / 3;
    change.col(2) = (zeta_xi.cross(xi) + eta.cross(eta_zeta)) / 3;
    change.col(3) = xi.cross(eta) + zeta_xi.cross(eta_zeta) / 3;
    change.col(4) = (xi.cross(xi_eta) + eta_zeta.cross(zeta)) / 3;
    change.col(5) = (xi_eta.cross(eta) + zeta.cross(zeta_xi)) / 3;
  }
  MeanGradients<d> means;
  means.volume = (1 << d) * c.cwiseProduct(change).sum() / d;
  means.gradients = waves_of_nodes.lazyProduct(change.transpose()) / means.volume;
  return means;
}

} // namespace rubato::element
