// SPDX-License-Identifier: LGPL-3.0-or-later
/// The forces of energy_momentum.hpp in finite strain. With 𝐂 and the mean terms of strain_energy.hpp at {C},
/// B of dE = B(F) du and h = ½[C], of which
///
///   S* = S_½ + g h     f = Σ w B({F})ᵀ S*     g = ([U] − Σ w S_½:h)/Σ w h:h
///
/// the derivative by u at the end is, G being the terms of S* alone (δ_ik S*_JL),
///
///   ½ Σ w (B({F})ᵀ (𝐂 + 2 g I_sym) B(F₁) + G) + ½ mean terms of ({F}, F₁) + Σ w B({F})ᵀ h ⊗ dg
///   dg = Σ w (S₁ − S_½ − ½ 𝐂:h − ½ mean terms of h − 2 g h):B(F₁)du / Σ w h:h
///
/// The symmetric matrix near it has {F} instead of F₁ and no g: half a stiffness in the middle of the step.
#pragma once

#include "rubato/element/nonlinear/between_motion.hpp"
#include "rubato/element/nonlinear/block_sums.hpp"
#include "rubato/element/nonlinear/strain_energy.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rubato::element {

template <class S> class BetweenKernel {
public:
  BetweenKernel(const CellKind& kind, const PointLaws& laws, const BetweenInput& input,
                const BetweenOutput& output)
      : kind_(kind), laws_(laws), input_(input), output_(output), modes_(mode_count(kind)),
        motion_(kind, input, modes_ / S::d), energy_(kind, laws, motion_.gradients(), input, output.now) {}

  BetweenResult evaluate() {
    set_modes_of_start();
    BetweenResult result{start(), 0};
    result.stored_before = before_.stored;
    if (result)
      result.after = modes_ > 0 ? with_modes_solved() : respond();
    if (!result)
      return result;
    result.after.mode_force = mode_force_;
    put_force();
    put_tangents();
    put_records();
    if (!std::isfinite(force_.sum()))
      result.after.failure = Failure::not_finite;
    return result;
  }

private:
  using Motion = BetweenMotion<S>;
  using Nodal = typename Motion::Nodal;
  using Matrix3 = Eigen::Matrix3d;
  using Stress6 = material::Stress6;
  using Tangent6 = material::Tangent6;
  static constexpr int most_dofs = Motion::most_nodes * S::d;
  using Whole = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, most_dofs, most_dofs>;
  using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, most_dofs, 1>;
  using OfDofs = Eigen::Matrix<double, 9, Eigen::Dynamic, Eigen::ColMajor, 9, most_dofs>;
  template <class T> using AtPoints = AtPointsOf<S, T>;

  static constexpr double epsilon = std::numeric_limits<double>::epsilon();

  static std::size_t place(int q) { return static_cast<std::size_t>(q); }
  int points() const { return motion_.points(); }
  int dofs() const { return motion_.nodes() * S::d; }
  int node_dofs() const { return dofs() - modes_; }
  double weight(int q) const { return motion_.gradients().weight(q); }

  AtPoints<Matrix3> excess_of(const AtPoints<Matrix3>& gradient) const {
    AtPoints<Matrix3> excess;
    for (std::size_t q = 0; q < place(points()); ++q)
      excess[q] = gradient[q] + gradient[q].transpose() + gradient[q].transpose() * gradient[q];
    return excess;
  }

  void set_modes_of_start() {
    const auto modes = input_.old.last(place(modes_));
    motion_.set_modes_before(modes.data());
    motion_.set_modes_after(modes.data());
    unknowns_ = Eigen::Map<const Vector>(modes.data(), modes_);
  }

  CellResult start() {
    if (const auto result = motion_.move(); !result)
      return result;
    excess_before_ = excess_of(motion_.before);
    return energy_.respond(excess_before_, material::Want::stress, before_);
  }

  /// Energies, stresses, g and f at the present end of the step.
  CellResult respond() {
    if (const auto result = motion_.move(); !result)
      return result;
    const auto excess_after = excess_of(motion_.after);
    AtPoints<Matrix3> excess;
    for (std::size_t q = 0; q < place(points()); ++q)
      excess[q] = 0.5 * (excess_before_[q] + excess_after[q]);
    if (const auto result = energy_.respond(excess, middle_want(), middle_); !result)
      return result;
    const auto result = energy_.respond(excess_after, material::Want::stress, after_);
    if (result)
      set_force();
    return result;
  }

  bool wants_tangent() const { return !output_.tangent.empty() || !output_.exact_tangent.empty(); }
  material::Want middle_want() const {
    return wants_tangent() || modes_ > 0 ? material::Want::tangent : material::Want::stress;
  }

  void set_force() {
    set_correction();
    force_ = motion_.no_force();
    for (int q = 0; q < points(); ++q) {
      const auto p = place(q);
      const Matrix3 s = tensor_of(middle_.stress[p]) + correction_ * motion_.half_change[p];
      stress_[p] = stress_of(s);
      motion_.add_force(q, s + motion_.middle[p] * s, force_);
    }
  }

  /// g. What rounding leaves of [U] must not become a stress: it would where [C] is small.
  void set_correction() {
    constexpr double times = 4; // rounding of U and H was measured up to 1.3 of their epsilon
    double work = 0, size = 0;
    noise_ = 0;
    for (int q = 0; q < points(); ++q) {
      const auto p = place(q);
      const Matrix3 s = tensor_of(middle_.stress[p]);
      work += weight(q) * s.cwiseProduct(motion_.half_change[p]).sum();
      size += weight(q) * motion_.half_change[p].squaredNorm();
      const double reach = motion_.reach[p] * (1 + motion_.reach[p]);
      noise_ += weight(q) * times * epsilon *
                (before_.response[p].stored + after_.response[p].stored + s.norm() * reach);
    }
    const double rest = after_.stored - before_.stored - work;
    change_size_ = size;
    correction_ = size > 0 ? beyond_noise(rest) / size : 0;
  }

  /// 0 up to the noise, the whole from twice the noise on, and straight between: Newton's method must not go
  /// to and fro across a jump.
  double beyond_noise(double rest) const {
    const double beyond = std::abs(rest) - noise_;
    return beyond <= 0 ? 0 : std::copysign(std::min(std::abs(rest), 2 * beyond), rest);
  }

  // --- the cell's own unknowns

  /// Newton's method for forces on the modes that vanish, halved while a law fails or they grow.
  CellResult with_modes_solved() {
    auto result = respond();
    for (int i = 0; i < input_.modes.most_iterations && result && !modes_are_solved(); ++i)
      result = with_better_modes();
    if (result && !modes_are_solved())
      result.failure = Failure::mode_iteration;
    std::ranges::copy(unknowns_, output_.now.last(place(modes_)).begin());
    return result;
  }

  CellResult with_better_modes() {
    energy_.set_moduli(middle_, moduli_);
    const Whole k = exact_tangent();
    const Eigen::PartialPivLU<Whole> factor(k.bottomRightCorner(modes_, modes_));
    const auto level = [&] { return std::abs(mode_residual().dot(factor.solve(mode_residual()))); };
    const Vector step = -factor.solve(mode_residual());
    const double before = level();
    if (!std::isfinite(before))
      return {Failure::not_finite};
    CellResult result;
    const auto respond_there = [&] {
      motion_.set_modes_after(unknowns_.data());
      return respond();
    };
    const auto is_better = [&] { return modes_are_solved() || level() < before; };
    if (!go_halving(step, unknowns_, result, respond_there, is_better))
      is_stalled_ = true;
    return result;
  }

  Vector mode_residual() const {
    Vector residual(modes_);
    for (int m = 0; m < modes_; ++m)
      residual[m] = force_(node_dofs() / S::d + m / S::d, m % S::d);
    return residual;
  }

  /// Also sets what forces on modes are compared with.
  bool modes_are_solved() {
    constexpr double rounding = 4 * epsilon, stalled = 1e3;
    double noise = 0;
    mode_force_ = 0;
    for (int m = 0; m < modes_ / S::d; ++m) {
      double size = 0, strained = 0;
      for (int q = 0; q < points(); ++q) {
        const auto p = place(q);
        const double g = weight(q) * motion_.gradients(q).row(node_dofs() / S::d + m).norm();
        size += g * (stress_[p].norm() * (1 + motion_.middle[p].norm()));
        strained +=
            g * (middle_.response[p].tangent.cwiseAbs().maxCoeff() * motion_.reach[p] +
                 (change_size_ > 0 ? noise_ / change_size_ * motion_.half_change[p].norm() / epsilon : 0));
      }
      mode_force_ = std::max(mode_force_, size);
      noise = std::max(noise, rounding * (size + strained));
    }
    const double scale = std::max(mode_force_, input_.modes.force);
    const double floor = is_stalled_ ? stalled * noise : noise;
    return mode_residual().cwiseAbs().maxCoeff() <= std::max(input_.modes.relative * scale, floor);
  }

  // --- derivatives

  static Vector in_a_column(const Nodal& nodal) { return nodal.transpose().reshaped(); }

  /// Σ w B(F)ᵀ s of stresses, F = 1 + h.
  Vector force_of(const AtPoints<Matrix3>& h, const AtPoints<Stress6>& stress) const {
    auto sum = motion_.no_force();
    for (int q = 0; q < points(); ++q) {
      const Matrix3 s = tensor_of(stress[place(q)]);
      motion_.add_force(q, s + h[place(q)] * s, sum);
    }
    return in_a_column(sum);
  }

  /// Σ w s:h.
  double work_of(const AtPoints<Stress6>& stress) const {
    double sum = 0;
    for (int q = 0; q < points(); ++q)
      sum += weight(q) * tensor_of(stress[place(q)]).cwiseProduct(motion_.half_change[place(q)]).sum();
    return sum;
  }

  Whole symmetric_tangent() {
    LargeModuli<S> moduli;
    for (int q = 0; q < points(); ++q) {
      const auto p = place(q);
      first_moduli(StrainKind::green_lagrange, {motion_.middle[p], {}}, {stress_[p], moduli_.at[p], 0},
                   moduli.at[p]);
      moduli.at[p] *= 0.5 * weight(q);
    }
    Whole k(dofs(), dofs());
    BlockSums<S, LargeModuli<S>>(motion_.gradients(), moduli).put(0, motion_.nodes(), k);
    if (energy_.is_averaged()) {
      const Vector t = force_of(motion_.middle, moduli_.change);
      const Vector half = 0.5 * (force_of(motion_.middle, moduli_.across) + moduli_.along / 2 * t);
      k += t * half.transpose() + half * t.transpose();
    }
    return k;
  }

  Whole exact_tangent() const {
    Whole k = Whole::Zero(dofs(), dofs());
    for (int q = 0; q < points(); ++q)
      add_point(q, k);
    if (energy_.is_averaged()) {
      const Vector t = force_of(motion_.middle, moduli_.change), t1 = force_of(motion_.after, moduli_.change);
      const Vector r = force_of(motion_.middle, moduli_.across), r1 = force_of(motion_.after, moduli_.across);
      k += 0.5 * (t * r1.transpose() + (r + moduli_.along * t) * t1.transpose());
    }
    if (correction_ != 0)
      k += force_of(motion_.middle, changes()) * correction_derivative().transpose();
    return k;
  }

  /// dF by dofs: component aI at a + 3 I.
  OfDofs by_dofs(int q) const {
    OfDofs map = OfDofs::Zero(9, dofs());
    for (int i = 0; i < motion_.nodes(); ++i)
      for (int a = 0; a < S::d; ++a)
        for (int row = 0; row < S::rows; ++row)
          if (const int at = tensor_place(a, row, S::d); at >= 0)
            map(at, i * S::d + a) = motion_.gradients().at(q, row, i);
    return map;
  }

  void add_point(int q, Whole& k) const {
    const auto p = place(q);
    Tangent6 c = moduli_.at[p];
    c.diagonal().head<3>().array() += 2 * correction_;
    c.diagonal().tail<3>().array() += correction_;
    const Eigen::Matrix<double, 6, 9> middle = strain_by_gradient(Matrix3::Identity() + motion_.middle[p]);
    const Eigen::Matrix<double, 6, 9> after = strain_by_gradient(Matrix3::Identity() + motion_.after[p]);
    Moduli moduli = middle.transpose() * c * after;
    add_stress_part(tensor_of(stress_[p]), moduli);
    const OfDofs map = by_dofs(q);
    const OfDofs stressed = (0.5 * weight(q)) * moduli * map;
    k.noalias() += map.transpose() * stressed;
  }

  AtPoints<Stress6> changes() const {
    AtPoints<Stress6> h;
    for (std::size_t q = 0; q < place(points()); ++q)
      h[q] = stress_of(motion_.half_change[q]);
    return h;
  }

  /// dg by the dofs.
  Vector correction_derivative() const {
    const bool is_averaged = energy_.is_averaged();
    const double t = is_averaged ? work_of(moduli_.change) : 0, r = is_averaged ? work_of(moduli_.across) : 0;
    AtPoints<Stress6> stress;
    for (std::size_t q = 0; q < place(points()); ++q) {
      const Stress6 h = stress_of(motion_.half_change[q]);
      const material::Strain6 strain = 2 * half_strain_of(motion_.half_change[q]);
      stress[q] = after_.stress[q] - middle_.stress[q] - 0.5 * moduli_.at[q] * strain - 2 * correction_ * h;
      if (is_averaged)
        stress[q] -= 0.5 * (t * moduli_.across[q] + (r + moduli_.along * t) * moduli_.change[q]);
    }
    return force_of(motion_.after, stress) / change_size_;
  }

  // --- output

  void put_force() const {
    for (int i = 0; i < node_dofs(); ++i)
      output_.force[place(i)] = force_(i / S::d, i % S::d);
  }

  void put_tangents() {
    if (wants_tangent())
      energy_.set_moduli(middle_, moduli_);
    if (!output_.tangent.empty()) {
      put_condensed(symmetric_tangent(), output_.tangent);
      make_symmetric(output_.tangent);
    }
    if (!output_.exact_tangent.empty())
      put_condensed(exact_tangent(), output_.exact_tangent);
  }

  /// Without the modes, which follow the nodes.
  void put_condensed(const Whole& k, std::span<double> out) const {
    const int n = node_dofs();
    Eigen::Map<Eigen::MatrixXd> condensed(out.data(), n, n);
    condensed = k.topLeftCorner(n, n);
    if (modes_ == 0)
      return;
    const Whole followed =
        k.bottomRightCorner(modes_, modes_).partialPivLu().solve(k.bottomLeftCorner(modes_, n));
    condensed -= k.topRightCorner(n, modes_) * followed;
  }

  /// Of what is symmetric but for rounding.
  void make_symmetric(std::span<double> matrix) const {
    Eigen::Map<Eigen::MatrixXd> k(matrix.data(), node_dofs(), node_dofs());
    for (int j = 0; j < node_dofs(); ++j)
      for (int i = 0; i < j; ++i)
        k(i, j) = k(j, i) = 0.5 * (k(i, j) + k(j, i));
  }

  void put_records() const {
    for (std::size_t q = 0; q < output_.records.size(); ++q) {
      const Matrix3& h = motion_.after[q];
      const Matrix3 f = Matrix3::Identity() + h, s = tensor_of(after_.seen_stress[q]);
      const double scale = energy_.is_averaged() ? std::sqrt(after_.square[q]) : 1;
      output_.records[q] = {weight(static_cast<int>(q)),
                            after_.response[q].stored,
                            after_.strain[q],
                            material::Strain6::Zero(), // nothing is heated
                            after_.response[q].stress,
                            stress_of(f * s * f.transpose() / (scale * (1 + volume_change(h)))),
                            h,
                            f * tensor_of(after_.stress[q])};
    }
  }

  const CellKind& kind_;
  const PointLaws& laws_;
  const BetweenInput& input_;
  const BetweenOutput& output_;
  int modes_;
  Motion motion_;
  StrainEnergy<S> energy_;
  AtPoints<Matrix3> excess_before_;
  EnergyState<S> before_, middle_, after_;
  EnergyModuli<S> moduli_;
  AtPoints<Stress6> stress_; ///< S*
  Nodal force_;
  Vector unknowns_;
  double correction_ = 0, change_size_ = 0; ///< g, Σ w h:h
  double noise_ = 0;                        ///< what rounding leaves of [U] − Σ w S_½:h
  double mode_force_ = 0;
  bool is_stalled_ = false;
};

} // namespace rubato::element
