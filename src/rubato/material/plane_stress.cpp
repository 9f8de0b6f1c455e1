// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/material/plane_stress.hpp"

#include <cmath>
#include <limits>

namespace rubato::material {
namespace {

constexpr int across = 2; ///< zz
constexpr int most_evaluations = 50;

std::span<const double> without_last(std::span<const double> state) {
  return state.first(state.size() - 1);
}

/// Whether σ_zz counts as 0.
bool vanishes_across(const Response& response, const Strain6& strain) {
  const double stress = std::abs(response.stress[across]);
  return stress <= 1e-12 * response.stress.cwiseAbs().maxCoeff() ||
         stress <= 1e-15 * response.tangent(across, across) * std::max(1.0, strain.norm());
}

/// Between which strains σ_zz changes its sign.
struct Enclosure {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();

  void add(double strain, double stress) { (stress > 0 ? high : low) = strain; }
  double held(double strain) const {
    const bool bounded = std::isfinite(low) && std::isfinite(high);
    return bounded && !(strain > low && strain < high) ? 0.5 * (low + high) : strain;
  }
};

/// Takes what is left of σ_zz out of all stresses, by their slopes in E_zz. Nearly incompressible bodies at
/// rest would else have 1e-15 of their bulk modulus as a stress, which no iteration can bring to balance.
void remove_rest_across(Response& out) {
  out.stress -= out.tangent.col(across) * (out.stress[across] / out.tangent(across, across));
  out.stress[across] = 0;
}

void condense(Response& out) {
  auto& d = out.tangent;
  const Stress6 column = d.col(across) / d(across, across);
  const Eigen::Matrix<double, 1, 6> row = d.row(across);
  d.noalias() -= column * row;
  d.col(across).setZero();
  d.row(across).setZero();
}

/// Finds E_zz, the response there and the state.
template <class L>
bool respond_in_plane(const L& law, Strain6 strain, std::span<const double> old, std::span<double> now,
                      const StepInfo& step, Response& out) {
  const auto inner_now = now.first(now.size() - 1);
  Enclosure enclosure;
  double last = old.back(); // where the law had a response
  strain[across] = last;
  for (int i = 0; i < most_evaluations; ++i) {
    if (!respond(law, strain, without_last(old), inner_now, step, Want::tangent, out)) {
      if (strain[across] == last)
        return false;
      strain[across] = 0.5 * (strain[across] + last);
      continue;
    }
    last = strain[across];
    if (vanishes_across(out, strain)) {
      now.back() = last;
      return true;
    }
    const double stress = out.stress[across];
    if (!std::isfinite(stress))
      return false;
    enclosure.add(last, stress);
    strain[across] = enclosure.held(last - stress / out.tangent(across, across));
  }
  return false;
}

} // namespace

int state_size(const PlaneStress& law) {
  return 1 + std::visit([](const auto& one) { return state_size(one); }, law.law);
}

bool respond(const PlaneStress& law, const Strain6& strain, std::span<const double> old,
             std::span<double> now, const StepInfo& step, Want want, Response& out) {
  const bool found = std::visit(
      [&](const auto& one) { return respond_in_plane(one, strain, old, now, step, out); }, law.law);
  if (!found)
    return false;
  remove_rest_across(out);
  if (want == Want::tangent)
    condense(out);
  return true;
}

Dissipation dissipation(const PlaneStress& law, std::span<const double> old, std::span<const double> now,
                        const Stress6& mean_stress) {
  return std::visit(
      [&](const auto& one) { return dissipation(one, without_last(old), without_last(now), mean_stress); },
      law.law);
}

Strain6 plastic_strain(const PlaneStress& law, std::span<const double> state) {
  return std::visit([&](const auto& one) { return plastic_strain(one, without_last(state)); }, law.law);
}

double cumulated_plastic_strain(const PlaneStress& law, std::span<const double> state) {
  return std::visit([&](const auto& one) { return cumulated_plastic_strain(one, without_last(state)); },
                    law.law);
}

bool tangent_is_symmetric(const PlaneStress& law) {
  return std::visit([](const auto& one) { return tangent_is_symmetric(one); }, law.law);
}

bool is_hyperelastic(const PlaneStress& law) {
  return std::visit([](const auto& one) { return is_hyperelastic(one); }, law.law);
}

bool depends_on_rate(const PlaneStress& law) {
  return std::visit([](const auto& one) { return depends_on_rate(one); }, law.law);
}

} // namespace rubato::material
