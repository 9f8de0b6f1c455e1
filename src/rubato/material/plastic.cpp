// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/material/plastic.hpp"

#include "rubato/material/bracketed_root.hpp"
#include "rubato/material/six.hpp"

#include <algorithm>
#include <cmath>

namespace rubato::material {
namespace {

constexpr std::size_t place_of_p = 6;
constexpr std::size_t place_of_alpha(std::size_t term) {
  return 7 + 6 * term;
}

struct Moduli {
  double shear;
  double bulk;
};
Moduli moduli_of(double young, double poisson) {
  return {young / (2 * (1 + poisson)), young / (3 * (1 - 2 * poisson))};
}

/// The back stresses at the start of the step and what they are after a growth x of p.
struct Backs {
  std::span<const BackStress> terms;
  std::array<Stress6, 3> start; ///< ⅔ C α₀
  bool recalls = false;         ///< one γ is not 0

  Backs(const Plastic& law, std::span<const double> old)
      : terms(law.kinematic.terms.data(), static_cast<std::size_t>(law.kinematic.count)) {
    for (std::size_t i = 0; i < terms.size(); ++i) {
      start[i] = 2.0 / 3 * terms[i].modulus * halved_shears(six_at(old, place_of_alpha(i)));
      recalls = recalls || terms[i].recall != 0;
    }
  }
  double kept(std::size_t i, double x) const { return 1 / (1 + terms[i].recall * x); } ///< m
  Stress6 sum(double x) const {
    Stress6 all = Stress6::Zero();
    for (std::size_t i = 0; i < terms.size(); ++i)
      all += kept(i, x) * start[i];
    return all;
  }
  /// Σ C m^power.
  double modulus(double x, int power) const {
    double all = 0;
    for (std::size_t i = 0; i < terms.size(); ++i)
      all += terms[i].modulus * (power == 1 ? kept(i, x) : kept(i, x) * kept(i, x));
    return all;
  }
  /// Y' = Σ ⅔ C γ m² α₀.
  Stress6 slope(double x) const {
    Stress6 all = Stress6::Zero();
    for (std::size_t i = 0; i < terms.size(); ++i)
      all += terms[i].recall * kept(i, x) * kept(i, x) * start[i];
    return all;
  }
};

double equivalent(const Stress6& y) {
  return std::sqrt(1.5 * double_dot(y, y));
}

/// An elastic step.
struct Trial {
  Stress6 s;
  Stress6 y; ///< Y(0)
  double q;  ///< √(3/2 Y:Y)
};

/// What the end of a plastic step is made of.
struct Flow {
  double x;          ///< Δp
  double q;          ///< √(3/2 Y:Y) at x
  Stress6 direction; ///< N
  double h;          ///< −φ'
};

Flow flow_at(const Moduli& elastic, const Backs& backs, const Trial& trial, double x, double slope) {
  const double straight = 3 * elastic.shear + backs.modulus(x, 2) + slope;
  if (!backs.recalls)
    return {x, trial.q, 1.5 / trial.q * trial.y, straight};
  const Stress6 y = trial.s - backs.sum(x);
  const double q = equivalent(y);
  const Stress6 n = 1.5 / q * y;
  return {x, q, n, straight - double_dot(n, backs.slope(x))};
}

template <class Kind>
std::optional<double> growth_of_p(const Kind& kind, const Moduli& elastic, const Backs& backs,
                                  const Trial& trial, double p, const StepInfo& step) {
  constexpr double tolerance = 1e-13; // of q; rounding leaves a few 1e-16
  const auto excess = [&](double x) -> ValueAndSlope {
    const auto [resistance, slope] = yield(kind, p, x, step);
    const auto flow = flow_at(elastic, backs, trial, x, slope);
    return {flow.q - (3 * elastic.shear + backs.modulus(x, 1)) * x - resistance, -flow.h};
  };
  const double modulus = 3 * elastic.shear + backs.modulus(0, 1);
  const auto straight_excess = [&](double x) -> ValueAndSlope {
    const auto [resistance, slope] = yield(kind, p, x, step);
    return {trial.q - modulus * x - resistance, -modulus - slope};
  };
  const double upper = trial.q / (3 * elastic.shear);
  if (backs.recalls)
    return bracketed_root(excess, upper, tolerance * trial.q);
  return bracketed_root(straight_excess, upper, tolerance * trial.q);
}

std::optional<double> growth_of_p(const LinearHardening& kind, const Moduli& elastic, const Backs& backs,
                                  const Trial& trial, double p, const StepInfo& step) {
  if (backs.recalls)
    return growth_of_p<LinearHardening>(kind, elastic, backs, trial, p, step);
  const double over = trial.q - yield(kind, p, 0, step).stress;
  return over / (3 * elastic.shear + backs.modulus(0, 1) + kind.modulus);
}

/// D without its part N'⊗N.
void set_tangent(Tangent6& d, const Moduli& elastic, const Flow& flow) {
  const double g = elastic.shear;
  set_isotropic(d, elastic.bulk, 2 * g * (1 - 3 * g * flow.x / flow.q));
  const Stress6 along = 4 * g * g * (flow.x / flow.q - 1 / flow.h) * flow.direction;
  for (int j = 0; j < 6; ++j)
    d.col(j) += flow.direction[j] * along;
}

void add_turning(Tangent6& d, const Moduli& elastic, const Backs& backs, const Flow& flow) {
  const double g = elastic.shear;
  const Stress6 slope = backs.slope(flow.x);
  const Stress6 turn =
      1.5 / flow.q * slope - double_dot(flow.direction, slope) / flow.q * flow.direction; // N'
  d.noalias() -= 4 * g * g * flow.x / flow.h * turn * flow.direction.transpose();
}

void write_state(const Backs& backs, const Flow& flow, std::span<const double> old, std::span<double> now) {
  const Strain6 growth = flow.x * doubled_shears(flow.direction);
  six_at(now, 0) = six_at(old, 0) + growth;
  now[place_of_p] = old[place_of_p] + flow.x;
  for (std::size_t i = 0; i < backs.terms.size(); ++i)
    six_at(now, place_of_alpha(i)) = backs.kept(i, flow.x) * (six_at(old, place_of_alpha(i)) + growth);
}

/// σ and what is stored, from s.
void set_stress(const Moduli& elastic, double volume, const Stress6& s, Response& out) {
  out.stored = 0.5 * elastic.bulk * volume * volume + double_dot(s, s) / (4 * elastic.shear);
  out.stress = s + elastic.bulk * volume * six_of(six_of_one);
}

/// The step of a trial beyond the yield stress.
template <class Kind>
bool flow_to(const Kind& kind, const Moduli& elastic, const Backs& backs, Trial& trial,
             std::span<const double> old, std::span<double> now, const StepInfo& step, Want want,
             Response& out) {
  const double p = old[place_of_p];
  const auto x = growth_of_p(kind, elastic, backs, trial, p, step);
  if (!x)
    return false;
  const auto flow = flow_at(elastic, backs, trial, *x, yield(kind, p, *x, step).slope);
  write_state(backs, flow, old, now);
  trial.s -= 2 * elastic.shear * flow.x * flow.direction;
  if (want == Want::stress)
    return true;
  set_tangent(out.tangent, elastic, flow);
  if (backs.recalls)
    add_turning(out.tangent, elastic, backs, flow);
  return true;
}

template <class Kind>
bool respond_with(const Kind& kind, const Plastic& law, const Strain6& strain, std::span<const double> old,
                  std::span<double> now, const StepInfo& step, Want want, Response& out) {
  constexpr double nearly_yielding = 1e-12; // of R
  const auto elastic = moduli_of(law.young, law.poisson);
  const double volume = trace(strain);
  const Backs backs(law, old);
  Trial trial;
  trial.s = 2 * elastic.shear * halved_shears(deviator(strain) - six_at(old, 0));
  trial.y = trial.s - backs.sum(0);
  trial.q = equivalent(trial.y);
  const double resistance = yield(kind, old[place_of_p], 0, step).stress;
  // Fields evaluate the stress of a state by a step of length 0. Rates are infinite then: nothing flows.
  const bool holds = depends_on_rate(kind) && step.length == 0;
  if (!holds && trial.q - resistance > nearly_yielding * resistance) {
    if (!flow_to(kind, elastic, backs, trial, old, now, step, want, out))
      return false;
  } else {
    std::copy_n(old.begin(), state_size(law), now.begin());
    if (want == Want::tangent)
      set_isotropic(out.tangent, elastic.bulk, 2 * elastic.shear);
  }
  set_stress(elastic, volume, trial.s, out);
  return true;
}

} // namespace

bool respond(const Plastic& law, const Strain6& strain, std::span<const double> old, std::span<double> now,
             const StepInfo& step, Want want, Response& out) {
  return std::visit(
      [&](const auto& kind) { return respond_with(kind, law, strain, old, now, step, want, out); },
      law.hardening);
}

Dissipation dissipation(const Plastic& law, std::span<const double> old, std::span<const double> now,
                        const Stress6& mean_stress) {
  Dissipation all;
  for (std::size_t i = 0; i < static_cast<std::size_t>(law.kinematic.count); ++i) {
    const Strain6 before = six_at(old, place_of_alpha(i));
    const Strain6 after = six_at(now, place_of_alpha(i));
    all.back_stress += law.kinematic.terms[i].modulus / 3 * strain_double_dot(after - before, after + before);
  }
  all.plastic = mean_stress.dot(six_at(now, 0) - six_at(old, 0)) - all.back_stress;
  return all;
}

Strain6 plastic_strain(const Plastic&, std::span<const double> state) {
  return six_at(state, 0);
}

double cumulated_plastic_strain(const Plastic&, std::span<const double> state) {
  return state[place_of_p];
}

bool tangent_is_symmetric(const Plastic& law) {
  const auto& [terms, count] = law.kinematic;
  return std::all_of(terms.begin(), terms.begin() + count, [](const auto& one) { return one.recall == 0; });
}

bool depends_on_rate(const Plastic& law) {
  return std::visit([](const auto& kind) { return depends_on_rate(kind); }, law.hardening);
}

double recall_of_step(const Plastic& law, std::span<const double> old, std::span<const double> now) {
  double largest = 0;
  for (int i = 0; i < law.kinematic.count; ++i)
    largest = std::max(largest, law.kinematic.terms[static_cast<std::size_t>(i)].recall);
  return largest * (now[place_of_p] - old[place_of_p]);
}

} // namespace rubato::material
