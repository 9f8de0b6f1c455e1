// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/interface/interface_newton_system.hpp"

#include "rubato/linalg/dense_decompositions.hpp"
#include "rubato/linalg/dense_products.hpp"
#include "rubato/linalg/equilibration.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace rubato::step {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Part of the first residual that refinement leaves: Newton's next iteration takes the rest.
constexpr double refined_enough = 1e-7;
/// The same where rounding lets it come no further.
constexpr double refined_to_rounding = 1e-6;
/// A round of refinement that leaves more than this part of the least error is slow. Forces and places take
/// turns, so that a single one means nothing.
constexpr double slow_round = 0.5;
constexpr int most_slow_rounds = 3;
constexpr int most_refinements = 30;
/// The same by factors of Newton's last iteration: new ones are better than more rounds.
constexpr int most_refinements_by_last = 6;
/// Forces up to which columns of S that cost a solve each are computed, once a step length.
constexpr Index most_columns_of_forces = 1500;
/// Systems up to this size are solved whole at once.
constexpr Index small = 60;
/// Whole systems beyond this size take too long to give up on.
constexpr Index largest_whole = 3000;

/// Cᵀ (δz, δξ) of a point: what it puts on its displacements.
class ForceOf {
public:
  ForceOf(const ActivePoint& point, const InterfaceNewtonSystem::Change& change)
      : interpolation_(point.response.interpolation.data()), rows_(point.response.interpolation.rows()) {
    const Index d = point.components();
    std::copy_n(change.force.data() + point.first, d, all_.begin());
    std::copy_n(change.xi.data() + point.first_slope, point.n_xi(), all_.begin() + d);
  }
  double on(std::size_t q) const {
    const double* of_q = interpolation_ + static_cast<Index>(q) * rows_;
    double sum = 0;
    for (Index row = 0; row < rows_; ++row)
      sum += of_q[row] * all_[static_cast<std::size_t>(row)];
    return sum;
  }

private:
  const double* interpolation_;
  Index rows_;
  std::array<double, 5> all_{};
};

void copy_column(MatrixXd& matrix, Index from, Index to) {
  std::copy_n(matrix.data() + from * matrix.rows(), matrix.rows(), matrix.data() + to * matrix.rows());
}

/// y_i = a_i x_i
VectorXd scaled(const VectorXd& by, VectorXd values) {
  for (Index i = 0; i < values.size(); ++i)
    values[i] *= by[i];
  return values;
}

std::pair<std::size_t, std::size_t> id_of(const ActivePoint& point) {
  return {point.zone, point.index};
}

} // namespace

InterfaceNewtonSystem::InterfaceNewtonSystem(Compliance& compliance, ActiveInterfaceCompliance& surface,
                                             double force_weight, const Limits& limits)
    : compliance_(compliance), force_weight_(force_weight), limits_(limits), surface_(surface) {
  clear();
}

void InterfaceNewtonSystem::forget() {
  clear();
  shared_.forget();
  factors_.reset();
}

void InterfaceNewtonSystem::clear() {
  count_ = 0;
  forces_ = xi_count_ = 0;
  if (std::exchange(sharing_, false))
    shared_.clear();
}

contact::FactoredResponse& InterfaceNewtonSystem::add(std::size_t zone, std::size_t index,
                                                      std::span<const MultiplierShare> shares) {
  if (count_ == points_.size())
    points_.emplace_back();
  auto& point = points_[count_++];
  point.zone = zone;
  point.index = index;
  point.shares.assign(shares.begin(), shares.end());
  sharing_ = sharing_ || !shares.empty();
  return point.response;
}

/// Puts the point on the surface: displacements that supports hold leave its response.
void InterfaceNewtonSystem::number_dofs(ActivePoint& point) {
  auto& r = point.response;
  const auto& interface_dof = compliance_.interface_dof_of_dof();
  point.interface_dofs.clear();
  Index kept = 0;
  for (std::size_t q = 0; q < r.dofs.size(); ++q) {
    const int at = interface_dof[static_cast<std::size_t>(r.dofs[q])];
    if (at < 0)
      continue;
    point.interface_dofs.push_back(at);
    if (const auto from = static_cast<Index>(q); kept < from) {
      copy_column(r.interpolation, from, kept);
      copy_column(r.d_du, from, kept);
    }
    ++kept;
  }
  if (kept < r.interpolation.cols()) {
    r.interpolation.conservativeResize(Eigen::NoChange, kept);
    r.d_du.conservativeResize(Eigen::NoChange, kept);
  }
  point.first = forces_;
  point.first_slope = xi_count_;
  forces_ += point.components();
  xi_count_ += point.n_xi();
}

std::optional<InterfaceNewtonSystem::Change>
InterfaceNewtonSystem::solve(const VectorXd& d0, const VectorXd& force, const linalg::WholeMatrix& matrix) {
  for (auto& point : active()) {
    number_dofs(point);
    if (point.shares.empty())
      eliminate_multipliers(point);
    else
      keep_multipliers(point);
  }
  touch_surface();
  if (!collect_shared())
    return std::nullopt;
  if (points().empty())
    return no_change();
  VectorXd c;
  surface_.multiply(at_active_dofs(force), c);
  const VectorXd at_start = at_active_dofs(d0);
  for (Index i = 0; i < c.size(); ++i)
    c[i] = at_start[i] - force_weight_ * c[i];
  if (!forms_compliance())
    return solved_by_products(c, matrix);
  if (forces_ + xi_count_ + shared_.size() > small)
    if (auto change = solved_for_forces(c))
      return change;
  return solved_whole(c);
}

/// Whether they can be numbered.
bool InterfaceNewtonSystem::collect_shared() {
  if (!sharing_)
    return true;
  for (const auto& point : points())
    if (!point.shares.empty())
      shared_.add_pressed(point.shares, point.response.multiplier_equations());
  if (!shared_.number())
    return false;
  for (const auto& point : points()) {
    const auto& r = point.response;
    for (const auto& share : point.shares)
      for (int a = 0; a < r.multipliers(); ++a)
        for (std::size_t q = 0; q < point.rows.active_dofs.size(); ++q)
          shared_.see(shared_.unknown_of(share.first + a), point.rows.active_dofs[q],
                      share.shape * r.d_du(r.components + a, static_cast<Index>(q)));
  }
  shared_.assemble(surface_.size());
  return true;
}

/// By the factors of the iteration before while they serve.
std::optional<InterfaceNewtonSystem::Change> InterfaceNewtonSystem::solved_for_forces(const VectorXd& c) {
  for (auto& point : active())
    if (keeps_factors() && !point.interface_dofs.empty() && point.shares.empty())
      reduce_equations(point, force_weight_ * compliance_.own(point.interface_dofs.front()));
  if (has_factors_of_these())
    if (auto change = refined(c, most_refinements_by_last))
      return change;
  if (!factor(points().front().components()))
    return std::nullopt;
  return refined(c, most_refinements);
}

/// In held frames new factors solve to rounding, which loops around them count on.
bool InterfaceNewtonSystem::keeps_factors() const {
  return xi_count_ > 0;
}

bool InterfaceNewtonSystem::has_factors_of_these() const {
  return factors_ && keeps_factors() && factored_rows_ == points().front().components() &&
         factored_shared_ == shared_.unknowns() &&
         std::ranges::equal(factored_points_, points(), {}, {}, &id_of);
}

bool InterfaceNewtonSystem::forms_compliance() const {
  const Index largest =
      compliance_.has_dear_columns() ? std::min(most_columns_of_forces, limits_.formed) : limits_.formed;
  return sharing_ || forces_ <= largest;
}

/// Points come back to places that they have left, so that those of small surfaces stay.
void InterfaceNewtonSystem::forget_left_places() {
  if (surface_.size() < limits_.kept)
    return;
  std::vector<int> present;
  for (const auto& point : points())
    present.insert(present.end(), point.interface_dofs.begin(), point.interface_dofs.end());
  std::ranges::sort(present);
  const auto repeated = std::unique(present.begin(), present.end());
  if (surface_.size() > 2 * (repeated - present.begin()))
    surface_.forget();
}

void InterfaceNewtonSystem::touch_surface() {
  if (forms_compliance())
    forget_left_places();
  for (const auto& point : points())
    surface_.add(point.interface_dofs);
  if (forms_compliance())
    surface_.touch_added();
  else
    surface_.number_added();
  for (auto& point : active()) {
    point.rows.active_dofs.resize(point.interface_dofs.size());
    std::ranges::transform(point.interface_dofs, point.rows.active_dofs.begin(),
                           [&](int interface_dof) { return surface_.active_dof_of(interface_dof); });
  }
}

/// Of values, one an interface dof.
VectorXd InterfaceNewtonSystem::at_active_dofs(const VectorXd& values) const {
  VectorXd chosen(surface_.size());
  std::ranges::transform(surface_.interface_dofs(), chosen.begin(),
                         [&](int interface_dof) { return values[interface_dof]; });
  return chosen;
}

/// δz of each point, and δξ, of all as many as any has.
Index InterfaceNewtonSystem::rows_of_whole() const {
  Index rows = 0;
  for (const auto& point : points())
    rows = std::max<Index>(rows, point.components() + point.n_xi());
  return rows;
}

/// Of the first rows of each point, δz and, beyond them, δξ, and of the shared multipliers.
MatrixXd InterfaceNewtonSystem::matrix_of(Index rows) const {
  std::vector<const PointRows*> all;
  all.reserve(count_);
  for (const auto& point : points())
    all.push_back(&point.rows);
  MatrixXd matrix = between_points(surface_, all, rows, -force_weight_);
  Index first = 0;
  for (const auto& point : points()) {
    const Index d = point.components();
    for (Index b = 0; b < d; ++b)
      for (Index a = 0; a < d; ++a)
        matrix(first + a, first + b) += point.by_force(a, b);
    for (Index k = first + d; k < first + rows; ++k)
      matrix(k, k) += 1;
    first += rows;
  }
  if (shared_.size() > 0)
    add_shared(rows, matrix);
  return matrix;
}

bool InterfaceNewtonSystem::factor(Index rows) {
  MatrixXd matrix = matrix_of(rows);
  linalg::equilibrate(matrix, row_scale_, column_scale_);
  factors_ = linalg::DenseLu::of(std::move(matrix), surface_.threads());
  factored_rows_ = rows;
  factored_points_.resize(count_);
  std::ranges::transform(points(), factored_points_.begin(), &id_of);
  factored_shared_ = shared_.unknowns();
  return factors_.has_value();
}

/// What the factors answer to what is left of the equations.
InterfaceNewtonSystem::Change InterfaceNewtonSystem::correction(const Change& left) const {
  auto change =
      split(scaled(column_scale_, factors_->solve(scaled(row_scale_, joined(left, factored_rows_)))),
            factored_rows_);
  if (factored_rows_ == points().front().components()) {
    change.xi = left.xi;
    change.xi = xi_after(change);
  }
  return change;
}

/// The first rows of each point, one after the other, then the shared multipliers; rows that a point has none
/// of are 0.
VectorXd InterfaceNewtonSystem::joined(const Change& change, Index rows) const {
  VectorXd all = VectorXd::Zero(static_cast<Index>(count_) * rows + shared_.size());
  double* to = all.data();
  for (const auto& point : points()) {
    const Index d = point.components();
    std::copy_n(change.force.data() + point.first, d, to);
    if (rows > d)
      std::copy_n(change.xi.data() + point.first_slope, point.n_xi(), to + d);
    to += rows;
  }
  std::copy_n(change.shared.data(), shared_.size(), to);
  return all;
}

InterfaceNewtonSystem::Change InterfaceNewtonSystem::split(const VectorXd& all, Index rows) const {
  auto change = no_change();
  const double* from = all.data();
  for (const auto& point : points()) {
    const Index d = point.components();
    std::copy_n(from, d, change.force.data() + point.first);
    if (rows > d)
      std::copy_n(from + d, point.n_xi(), change.xi.data() + point.first_slope);
    from += rows;
  }
  std::copy_n(from, shared_.size(), change.shared.data());
  return change;
}

std::optional<InterfaceNewtonSystem::Change> InterfaceNewtonSystem::refined(const VectorXd& c, int rounds) {
  auto change = no_change();
  double first = 0;
  double least = std::numeric_limits<double>::infinity();
  int slow_rounds = 0;
  for (int round = 0; round < rounds; ++round) {
    const auto left = residual(c, change);
    const double size = largest_row(left);
    const double moves = linalg::largest_magnitude(left.xi);
    if (round == 0)
      first = size;
    const double error = first > 0 ? std::max(size / first, moves) : moves;
    if (round > 0 && error <= refined_enough)
      return change;
    slow_rounds = error <= slow_round * least ? 0 : slow_rounds + 1;
    if (slow_rounds == most_slow_rounds)
      return error <= refined_to_rounding ? std::optional(change) : std::nullopt;
    least = std::min(least, error);
    const auto by = correction(left);
    change.force += by.force;
    change.xi += by.xi;
    change.shared += by.shared;
  }
  return std::nullopt;
}

/// Of the equations of δz and δm, as they were scaled to be factored.
double InterfaceNewtonSystem::largest_row(const Change& left) const {
  double largest = 0;
  Index first = 0;
  for (const auto& point : points()) {
    for (Index a = 0; a < point.components(); ++a)
      largest = std::max(largest, std::abs(row_scale_[first + a] * left.force[point.first + a]));
    first += factored_rows_;
  }
  for (Index k = 0; k < shared_.size(); ++k)
    largest = std::max(largest, std::abs(row_scale_[first + k] * left.shared[k]));
  return largest;
}

std::optional<InterfaceNewtonSystem::Change> InterfaceNewtonSystem::solved_whole(const VectorXd& c) {
  const Index rows = rows_of_whole();
  if (static_cast<Index>(count_) * rows + shared_.size() > largest_whole)
    return std::nullopt;
  for (auto& point : active())
    point.rows.fill_up(rows);
  const auto left = residual(c, no_change());
  if (factor(rows))
    return correction(left);
  return least(left, rows);
}

/// Points that say the same share what they carry: the smallest such forces.
std::optional<InterfaceNewtonSystem::Change> InterfaceNewtonSystem::least(const Change& left,
                                                                          Index rows) const {
  const MatrixXd matrix = matrix_of(rows);
  const VectorXd solution = linalg::least_norm_solution(matrix, joined(left, rows));
  return solution.allFinite() ? std::optional(split(solution, rows)) : std::nullopt;
}

InterfaceNewtonSystem::Change InterfaceNewtonSystem::no_change() const {
  return {VectorXd::Zero(forces_), VectorXd::Zero(xi_count_), VectorXd::Zero(shared_.size())};
}

/// P δq of a point, added to δξ.
void InterfaceNewtonSystem::add_xi(const ActivePoint& point, const VectorXd& d, double* xi) {
  const auto& d_du = point.response.d_du;
  const Index rows = d_du.rows();
  const double* n_xi = d_du.data() + rows - point.n_xi();
  for (std::size_t q = 0; q < point.rows.active_dofs.size(); ++q)
    for (int a = 0; a < point.n_xi(); ++a)
      xi[a] += n_xi[static_cast<Index>(q) * rows + a] * d[point.rows.active_dofs[q]];
}

/// S Cᵀ (δz, δξ), one an active dof.
VectorXd InterfaceNewtonSystem::motion(const Change& change) const {
  VectorXd force = VectorXd::Zero(surface_.size());
  for (const auto& point : points()) {
    const ForceOf force_of(point, change);
    for (std::size_t q = 0; q < point.rows.active_dofs.size(); ++q)
      force[point.rows.active_dofs[q]] += force_of.on(q);
  }
  if (linalg::largest_magnitude(force) == 0)
    return force;
  VectorXd moved;
  surface_.multiply(force, moved);
  return moved;
}

InterfaceNewtonSystem::Change InterfaceNewtonSystem::residual(const VectorXd& c, const Change& change) const {
  VectorXd d = c;
  const VectorXd moved = motion(change);
  for (Index i = 0; i < d.size(); ++i)
    d[i] -= force_weight_ * moved[i];
  Change left{VectorXd(forces_), -change.xi, VectorXd()};
  for (const auto& point : points()) {
    const int count = point.components();
    double* forces = left.force.data() + point.first;
    for (int a = 0; a < count; ++a) {
      forces[a] = point.right[a];
      for (int b = 0; b < count; ++b)
        forces[a] -= point.by_force(a, b) * change.force[point.first + b];
    }
    const double* seen = point.rows.left.data();
    for (std::size_t q = 0; q < point.rows.active_dofs.size(); ++q, seen += point.rows.left.rows())
      for (int a = 0; a < count; ++a)
        forces[a] -= seen[a] * d[point.rows.active_dofs[q]];
    add_xi(point, d, left.xi.data() + point.first_slope);
  }
  add_shared(change, d, left);
  return left;
}

/// δξ that follows from how a change moves the surface.
VectorXd InterfaceNewtonSystem::xi_after(const Change& change) const {
  VectorXd d = motion(change);
  d *= -force_weight_;
  VectorXd xi = change.xi;
  for (const auto& point : points())
    add_xi(point, d, xi.data() + point.first_slope);
  return xi;
}

void InterfaceNewtonSystem::add_force(const Change& change, VectorXd& force) const {
  for (const auto& point : points()) {
    const ForceOf force_of(point, change);
    for (std::size_t q = 0; q < point.interface_dofs.size(); ++q)
      force[point.interface_dofs[q]] += force_of.on(q);
  }
}

contact::PointVector InterfaceNewtonSystem::multipliers_of(const ActivePoint& point, const Change& change,
                                                           const VectorXd& moved) const {
  const auto components = static_cast<std::size_t>(point.components());
  return multiplier_change(point, {change.force.data() + point.first, components}, moved);
}

} // namespace rubato::step
