// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/element/nonlinear/between_kernel.hpp"

#include "rubato/element/nonlinear/between_motion.hpp"
#include "rubato/element/nonlinear/block_sums.hpp"
#include "rubato/element/nonlinear/kinematics.hpp"
#include "rubato/element/nonlinear/strain_energy.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rubato::element {
namespace {

using Eigen::Matrix3d;
using material::Stress6;
using material::Tangent6;

constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr int most_dofs = 3 * most_nodes_of_cell;
using Dofs = std::array<double, static_cast<std::size_t>(most_dofs)>;
template <class T> using PerDilatation = std::array<T, static_cast<std::size_t>(most_dilatations)>;

/// x:y.
double contraction(const Matrix3d& x, const Matrix3d& y) {
  double sum = 0;
  for (int i = 0; i < 9; ++i)
    sum += x.data()[i] * y.data()[i];
  return sum;
}

class BetweenKernel {
public:
  BetweenKernel(const CellKind& kind, const PointLaws& laws, const BetweenInput& input,
                const BetweenOutput& output)
      : input_(input), output_(output), d_(component_count(kind.section.physics)), modes_(mode_count(kind)),
        motion_(kind, input, modes_ / d_), energy_(kind, laws, motion_.gradients(), input, output.now) {}

  BetweenResult evaluate() {
    set_modes_of_start();
    BetweenResult result{start(), 0};
    result.stored_before = before_.stored;
    if (result)
      result.after = modes_ > 0 ? with_modes_solved() : respond();
    if (!result)
      return result;
    result.after.mode_force = mode_force_;
    if (!std::isfinite(put_force()))
      result.after.failure = Failure::not_finite;
    put_tangents();
    put_records();
    return result;
  }

private:
  int points() const { return motion_.points(); }
  int dofs() const { return motion_.nodes() * d_; }
  int node_dofs() const { return dofs() - modes_; }
  double weight(int q) const { return motion_.gradients().weight(q); }
  MatrixView whole() { return {whole_.data(), dofs()}; }

  template <class T> std::span<const T> of_points(const AtPoints<T>& values) const {
    return std::span(values).first(place(points()));
  }

  void set_modes_of_start() {
    unknowns_.fill(0);
    std::ranges::copy(input_.old.last(place(modes_)), unknowns_.begin());
    motion_.set_modes_before(unknowns_);
    motion_.set_modes_after(unknowns_);
  }

  CellResult start() {
    if (const auto result = motion_.move(); !result)
      return result;
    for (std::size_t q = 0; q < place(points()); ++q)
      excess_before_[q] = green_lagrange_doubled(motion_.before[q]);
    return energy_.respond(of_points(excess_before_), material::Want::stress, before_);
  }

  /// Energies, stresses, g and f at the present end of the step.
  CellResult respond() {
    if (const auto result = motion_.move(); !result)
      return result;
    AtPoints<Matrix3d> excess_after, excess;
    for (std::size_t q = 0; q < place(points()); ++q) {
      excess_after[q] = green_lagrange_doubled(motion_.after[q]);
      excess[q] = 0.5 * (excess_before_[q] + excess_after[q]);
    }
    if (const auto result = energy_.respond(of_points(excess), middle_want(), middle_); !result)
      return result;
    const auto result = energy_.respond(of_points(excess_after), material::Want::stress, after_);
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
    force_ = motion_.gradients().no_force();
    for (int q = 0; q < points(); ++q) {
      const auto p = place(q);
      const Matrix3d s = tensor_of(middle_.stress[p]) + correction_ * motion_.half_change[p];
      stress_[p] = stress_of(s);
      motion_.add_force(q, piola_of(motion_.middle[p], s), force_);
    }
  }

  /// g. What rounding leaves of [U] must not become a stress: it would where [C] is small.
  void set_correction() {
    constexpr double times = 4; // rounding of U and H was measured up to 1.3 of their epsilon
    double work = 0, size = 0;
    noise_ = 0;
    for (int q = 0; q < points(); ++q) {
      const auto p = place(q);
      const Matrix3d s = tensor_of(middle_.stress[p]);
      work += weight(q) * contraction(s, motion_.half_change[p]);
      size += weight(q) * contraction(motion_.half_change[p], motion_.half_change[p]);
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
    std::copy_n(unknowns_.begin(), modes_, output_.now.last(place(modes_)).begin());
    return result;
  }

  CellResult with_better_modes() {
    energy_.set_moduli(middle_, moduli_);
    set_exact_tangent();
    const ModeFactor factor(whole(), node_dofs(), modes_);
    const auto respond_there = [&] {
      motion_.set_modes_after(unknowns_);
      return respond();
    };
    return improve_modes(
        factor, modes_, unknowns_, is_stalled_, [&] { return mode_residual(); }, respond_there,
        [&] { return modes_are_solved(); });
  }

  ModeValues mode_residual() const {
    ModeValues residual{};
    for (int m = 0; m < modes_; ++m)
      residual[place(m)] = motion_.value(force_, motion_.gradients().nodes() + m / d_, m % d_);
    return residual;
  }

  /// Also sets what forces on modes are compared with.
  bool modes_are_solved() {
    constexpr double stalled = 1e3;
    // The sum over the 27 points of HEXA20 with its bubble is 1e4 times the rounding that was measured.
    const double rounding = (energy_.is_averaged() ? 1e-3 : 1) * 4 * epsilon;
    double noise = 0;
    mode_force_ = 0;
    for (int m = 0; m < modes_ / d_; ++m) {
      double size = 0, strained = 0;
      for (int q = 0; q < points(); ++q) {
        const auto p = place(q);
        const double g = weight(q) * size_of_mode(q, m);
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
    return largest(mode_residual(), modes_) <= std::max(input_.modes.relative * scale, floor);
  }

  /// |∂M_m/∂X|.
  double size_of_mode(int q, int m) const {
    double squares = 0;
    for (int row = 0; row < motion_.gradients().rows(); ++row) {
      const double g = motion_.gradients().at(q, row, motion_.gradients().nodes() + m);
      squares += g * g;
    }
    return std::sqrt(squares);
  }

  // --- derivatives

  /// Σ w B(F)ᵀ s of stresses, F = 1 + h.
  Dofs force_of(const AtPoints<Matrix3d>& h, const AtPoints<Stress6>& stress) const {
    auto sum = motion_.gradients().no_force();
    for (int q = 0; q < points(); ++q)
      motion_.add_force(q, piola_of(h[place(q)], tensor_of(stress[place(q)])), sum);
    Dofs forces;
    for (int i = 0; i < motion_.nodes(); ++i)
      for (int a = 0; a < d_; ++a)
        forces[place(i * d_ + a)] = motion_.value(sum, i, a);
    return forces;
  }

  /// Σ w s:h.
  double work_of(const AtPoints<Stress6>& stress) const {
    double sum = 0;
    for (int q = 0; q < points(); ++q)
      sum += weight(q) * contraction(tensor_of(stress[place(q)]), motion_.half_change[place(q)]);
    return sum;
  }

  /// Returns for each m the forces of φ_m times the stresses.
  PerDilatation<Dofs> forces_of(const AtPoints<Matrix3d>& h, const AtPoints<Stress6>& stress) const {
    PerDilatation<Dofs> forces;
    for (int m = 0; m < energy_.dilatations(); ++m)
      forces[place(m)] = force_of(h, energy_.space().weighted(m, stress));
    return forces;
  }

  /// x_m + factor Σ_n c_mn y_n.
  Dofs with_along(const PerDilatation<Dofs>& x, int m, double factor, const PerDilatation<Dofs>& y) const {
    Dofs sum = x[place(m)];
    for (int n = 0; n < energy_.dilatations(); ++n)
      for (std::size_t i = 0; i < place(dofs()); ++i)
        sum[i] += factor * moduli_.along(m, n) * y[place(n)][i];
    return sum;
  }

  /// K += ½ x ⊗ y.
  void add_half_product(const Dofs& x, const Dofs& y) {
    for (int j = 0; j < dofs(); ++j) {
      double* const column = whole().column(j);
      for (int i = 0; i < dofs(); ++i)
        column[i] += x[place(i)] * (0.5 * y[place(j)]);
    }
  }

  void set_symmetric_tangent() {
    AtPoints<Moduli> moduli;
    for (int q = 0; q < points(); ++q) {
      const auto p = place(q);
      first_moduli(StrainKind::green_lagrange, {motion_.middle[p], {}}, {stress_[p], moduli_.at[p], 0},
                   moduli[p]);
      moduli[p] *= 0.5 * weight(q);
    }
    put_block_sums(motion_.gradients(), of_points(moduli), 0, motion_.nodes(), whole());
    const auto t = forces_of(motion_.middle, moduli_.change), r = forces_of(motion_.middle, moduli_.across);
    for (int m = 0; m < energy_.dilatations(); ++m) {
      const auto half = with_along(r, m, 0.5, t);
      add_half_product(t[place(m)], half);
      add_half_product(half, t[place(m)]);
    }
  }

  void set_exact_tangent() {
    std::fill_n(whole_.begin(), dofs() * dofs(), 0.);
    for (int q = 0; q < points(); ++q)
      add_point(q);
    const auto t = forces_of(motion_.middle, moduli_.change), t1 = forces_of(motion_.after, moduli_.change);
    const auto r = forces_of(motion_.middle, moduli_.across), r1 = forces_of(motion_.after, moduli_.across);
    for (int m = 0; m < energy_.dilatations(); ++m) {
      add_half_product(t[place(m)], r1[place(m)]);
      add_half_product(with_along(r, m, 1, t), t1[place(m)]);
    }
    if (correction_ != 0)
      add_half_product(force_of(motion_.middle, changes()), doubled_correction_derivative());
  }

  /// B({F})ᵀ (𝐂 + 2 g I_sym) B(F₁) + G of a point.
  Moduli exact_moduli(std::size_t q) const {
    Tangent6 c = moduli_.at[q];
    for (int i = 0; i < 6; ++i)
      c(i, i) += (i < 3 ? 2 : 1) * correction_;
    Moduli moduli;
    set_moduli_between(gradient_of(motion_.middle[q]), c, gradient_of(motion_.after[q]), moduli);
    add_stress_part(tensor_of(stress_[q]), moduli);
    return moduli;
  }

  void add_point(int q) {
    const auto& gradients = motion_.gradients();
    const int rows = gradients.rows();
    const Moduli moduli = (0.5 * weight(q)) * exact_moduli(place(q));
    for (int dof = 0; dof < dofs(); ++dof) {
      const int j = dof / d_, b = dof % d_;
      std::array<double, 9> stressed{};
      for (int row = 0; row < rows; ++row)
        if (const int at = tensor_place(b, row, d_); at >= 0)
          for (int i = 0; i < 9; ++i)
            stressed[place(i)] += moduli(i, at) * gradients.at(q, row, j);
      double* const column = whole().column(dof);
      for (int row = 0; row < rows; ++row)
        for (int a = 0; a < d_; ++a)
          if (const int at = tensor_place(a, row, d_); at >= 0)
            for (int i = 0; i < motion_.nodes(); ++i)
              column[i * d_ + a] += gradients.at(q, row, i) * stressed[place(at)];
    }
  }

  AtPoints<Stress6> changes() const {
    AtPoints<Stress6> h;
    for (std::size_t q = 0; q < place(points()); ++q)
      h[q] = stress_of(motion_.half_change[q]);
    return h;
  }

  /// 2 dg by the dofs.
  Dofs doubled_correction_derivative() const {
    AtPoints<Stress6> stress;
    for (std::size_t q = 0; q < place(points()); ++q) {
      const Stress6 h = stress_of(motion_.half_change[q]);
      const material::Strain6 strain = half_strain_of(motion_.half_change[q]);
      stress[q] = after_.stress[q] - middle_.stress[q] - 2 * correction_ * h;
      for (int j = 0; j < 6; ++j)
        stress[q] -= strain[j] * moduli_.at[q].col(j);
    }
    take_dilatation(stress);
    auto derivative = force_of(motion_.after, stress);
    for (std::size_t i = 0; i < place(dofs()); ++i)
      derivative[i] *= 2 / change_size_;
    return derivative;
  }

  /// Subtracts the derivative of the projected dilatation by ½[C], halved, from the stresses.
  void take_dilatation(AtPoints<Stress6>& stress) const {
    const auto& space = energy_.space();
    PerDilatation<double> t, r;
    for (int m = 0; m < energy_.dilatations(); ++m) {
      t[place(m)] = work_of(space.weighted(m, moduli_.change));
      r[place(m)] = work_of(space.weighted(m, moduli_.across));
    }
    for (int m = 0; m < energy_.dilatations(); ++m) {
      double along = r[place(m)];
      for (int n = 0; n < energy_.dilatations(); ++n)
        along += moduli_.along(m, n) * t[place(n)];
      for (int q = 0; q < points(); ++q)
        stress[place(q)] -= 0.5 * space.at(m, q) *
                            (t[place(m)] * moduli_.across[place(q)] + along * moduli_.change[place(q)]);
    }
  }

  // --- output

  /// Returns the sum of the forces on the nodes.
  double put_force() const { return motion_.gradients().put(force_, output_.force); }

  void put_tangents() {
    if (wants_tangent())
      energy_.set_moduli(middle_, moduli_);
    if (!output_.tangent.empty()) {
      set_symmetric_tangent();
      const MatrixView k{output_.tangent.data(), node_dofs()};
      put_condensed(k);
      for (int j = 0; j < node_dofs(); ++j) // symmetric but for rounding
        for (int i = 0; i < j; ++i)
          k(i, j) = k(j, i) = 0.5 * (k(i, j) + k(j, i));
    }
    if (!output_.exact_tangent.empty()) {
      set_exact_tangent();
      put_condensed({output_.exact_tangent.data(), node_dofs()});
    }
  }

  /// Without the modes, which follow the nodes.
  void put_condensed(const MatrixView& out) {
    const int n = node_dofs();
    const auto k = whole();
    for (int j = 0; j < n; ++j)
      std::copy_n(k.column(j), n, out.column(j));
    if (modes_ == 0)
      return;
    const ModeFactor factor(k, n, modes_);
    for (int j = 0; j < n; ++j) {
      ModeValues followed;
      std::copy_n(k.column(j) + n, modes_, followed.begin());
      factor.solve(followed);
      for (int m = 0; m < modes_; ++m)
        for (int i = 0; i < n; ++i)
          out(i, j) -= k(i, n + m) * followed[place(m)];
    }
  }

  void put_records() const {
    for (std::size_t q = 0; q < output_.records.size(); ++q) {
      const Matrix3d& h = motion_.after[q];
      const double scale = energy_.is_averaged() ? std::sqrt(after_.square[q]) : 1;
      output_.records[q] = {
          weight(static_cast<int>(q)),
          after_.response[q].stored,
          after_.strain[q],
          material::Strain6::Zero(), // nothing is heated
          after_.response[q].stress,
          cauchy_stress(StrainKind::green_lagrange, h, piola_of(h, tensor_of(after_.seen_stress[q]))) / scale,
          h,
          piola_of(h, tensor_of(after_.stress[q]))};
    }
  }

  const BetweenInput& input_;
  const BetweenOutput& output_;
  int d_, modes_;
  BetweenMotion motion_;
  StrainEnergy energy_;
  AtPoints<Matrix3d> excess_before_;
  EnergyState before_, middle_, after_;
  EnergyModuli moduli_;
  AtPoints<Stress6> stress_; ///< S*
  NodalValues force_;
  std::array<double, static_cast<std::size_t>(most_dofs* most_dofs)> whole_;
  ModeValues unknowns_;
  double correction_ = 0, change_size_ = 0; ///< g, Σ w h:h
  double noise_ = 0;                        ///< what rounding leaves of [U] − Σ w S_½:h
  double mode_force_ = 0;
  bool is_stalled_ = false;
};

} // namespace

BetweenResult evaluate_between_large(const CellKind& kind, const PointLaws& laws, const BetweenInput& input,
                                     const BetweenOutput& output) {
  return BetweenKernel(kind, laws, input, output).evaluate();
}

} // namespace rubato::element
