// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/law.hpp"

#include <array>

namespace rubato::contact {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

constexpr int gap = 0;
constexpr int slip = 1;
constexpr int pressure = 3;
constexpr int semi = 4;

Vector2d augmented(const PointState& point, const PointCoefficients& coefficients) {
  return point.semi + coefficients.tangential * point.slip;
}

/// Λ = 0
void free_semi_multipliers(const PointState& point, PointResponse& response) {
  response.equations.tail<2>() = point.semi;
  response.d_equations.block<2, 2>(1, semi).setIdentity();
}

void open_contact(const PointState& point, const PointCoefficients& coefficients, PointResponse& response) {
  response.equations[0] = -point.pressure / coefficients.normal;
  response.d_equations(0, pressure) = -1 / coefficients.normal;
  free_semi_multipliers(point, response);
}

void close_contact(const PointState& point, const PointCoefficients& coefficients, PointResponse& response) {
  response.traction[0] = point.pressure - coefficients.normal * point.gap;
  response.d_traction(0, gap) = -coefficients.normal;
  response.d_traction(0, pressure) = 1;
  response.equations[0] = -point.gap;
  response.d_equations(0, gap) = -1;
}

/// Traction −μ λ ρ and the equation Λ = ρ (slip), c_t Δs = 0 (stick).
void rub(const PointState& point, Status status, const PointCoefficients& coefficients,
         PointResponse& response) {
  const Vector2d r = augmented(point, coefficients);
  Vector2d rho = r;
  Matrix2d d_rho = Matrix2d::Identity();
  if (status == Status::slip) {
    const double length = r.norm();
    rho = r / length;
    d_rho = (Matrix2d::Identity() - rho * rho.transpose()) / length;
  }
  const double threshold = coefficients.friction * point.pressure;
  response.traction.tail<2>() = -threshold * rho;
  response.d_traction.block<2, 1>(1, pressure) = -coefficients.friction * rho;
  response.d_traction.block<2, 2>(1, semi) = -threshold * d_rho;
  response.d_traction.block<2, 2>(1, slip) = -threshold * coefficients.tangential * d_rho;
  response.equations.tail<2>() = point.semi - rho;
  response.d_equations.block<2, 2>(1, semi) = Matrix2d::Identity() - d_rho;
  response.d_equations.block<2, 2>(1, slip) = -coefficients.tangential * d_rho;
}

} // namespace

Status augmented_lagrangian_status(const PointState& point, const PointCoefficients& coefficients) {
  const double pushed = point.pressure - coefficients.normal * (point.gap + coefficients.gap_tolerance);
  const double held = point.pressure - coefficients.normal * point.gap;
  if (point.pressure > 0 ? held <= 0 : pushed <= 0)
    return Status::open;
  const bool sticks =
      coefficients.friction > 0 && point.pressure > 0 && augmented(point, coefficients).norm() <= 1;
  return sticks ? Status::stick : Status::slip;
}

PointResponse augmented_lagrangian(const PointState& point, Status status,
                                   const PointCoefficients& coefficients) {
  PointResponse response;
  if (status == Status::open) {
    open_contact(point, coefficients, response);
    return response;
  }
  close_contact(point, coefficients, response);
  if (coefficients.friction > 0 && point.pressure > 0 &&
      (status == Status::stick || augmented(point, coefficients).norm() > 0))
    rub(point, status, coefficients, response);
  else
    free_semi_multipliers(point, response);
  return response;
}

std::span<const MethodEntry> all_methods() {
  static constexpr std::array<MethodEntry, 1> entries{
      {{"augmented_lagrangian", "CONTINUE, STANDARD",
        "exact contact and Coulomb friction with multipliers"}}};
  return entries;
}

} // namespace rubato::contact
