// SPDX-License-Identifier: LGPL-3.0-or-later
/// Means over the area or volume of the gradients of QUAD4 and HEXA8, exact whatever their shape (D. P.
/// Flanagan, T. Belytschko, Int. J. Numer. Meth. Eng. 17 (1981) 679–706, who call them uniform gradients).
///
/// Σ_i x_i N_i = Σ_w c_w φ_w(ξ) with the waves φ_w = 1, ξ, η, ξη, … and c_w = Σ_i φ_w(ξ_i) x_i/n, n nodes.
/// The volume is a polynomial of the c_w, and V ∂N_i/∂X = ∂V/∂x_i = Σ_w φ_w(ξ_i) ∂V/∂c_w / n:
///
///   A = 4 c_ξ × c_η
///   V = 8 ([c_ξ c_η c_ζ] + ([c_ξ c_ξη c_ζξ] + [c_ξη c_η c_ηζ] + [c_ζξ c_ηζ c_ζ])/3),   [a b c] = a·(b × c)
///
/// With w as a number whose bits say which ξ are in the wave, sums over nodes or waves with the signs
/// φ_w(ξ_i) are Walsh–Hadamard transforms: 24 additions for 8 numbers.
#pragma once

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <span>

namespace rubato::element {

/// Nodes of each wave but the constant one: ξ, η, ξη, then of HEXA8 ζ, ζξ, ηζ, ξηζ (cell::shortest_waves).
template <int d> struct Waves {
  static constexpr int nodes = 1 << d;
  static constexpr int count = nodes - 1;

  const double* of(int wave) const { return values.data() + wave * nodes; }

  alignas(16) std::array<double, static_cast<std::size_t>(nodes* count)> values;
};

template <int d> const Waves<d>& waves();
template <> const Waves<2>& waves<2>();
template <> const Waves<3>& waves<3>();

/// n c_w of each wave; wave 0 is the constant one.
template <int d> std::array<std::array<double, 3>, 1 << d> wave_sums(std::span<const Eigen::Vector3d> points);

/// Component a of node i goes to a · stride + i. Returns the volume. These functions are compiled for d = 2
/// and 3.
template <int d>
double set_mean_gradients(std::span<const Eigen::Vector3d> points, int stride, double* gradients);

} // namespace rubato::element
