// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/point_system.hpp"

#include "rubato/step/linear_step.hpp"

#include <Eigen/QR>

#include <algorithm>
#include <limits>
#include <utility>

namespace rubato::step {
namespace {

using contact::Status;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Equations of a multiplier with entries below this part of the largest one are empty: the point stands
/// between parts that are held.
constexpr double empty_row = 1e-13;
/// Part of the first residual that refinement leaves: Newton's next iteration takes the rest.
constexpr double refined_enough = 1e-9;
/// The same where rounding lets it come no further.
constexpr double refined_to_rounding = 1e-6;
/// A round of refinement that leaves more than this part of the least error is slow. Forces and places take
/// turns, so that a single one means nothing.
constexpr double slow_round = 0.5;
constexpr int most_slow_rounds = 3;
constexpr int most_rounds = 30;
/// Whole systems beyond this size take too long to give up on.
constexpr Index largest_whole = 3000;

/// Largest entry of each row, 1 where there is none.
VectorXd row_sizes(const MatrixXd& matrix) {
  VectorXd sizes = matrix.cwiseAbs().rowwise().maxCoeff();
  return (sizes.array() > 0).select(sizes, 1.0);
}

contact::PointVector column_sizes(const contact::MultiplierColumns& matrix) {
  contact::PointVector sizes = matrix.cwiseAbs().colwise().maxCoeff().transpose();
  for (auto& size : sizes)
    size = size > 0 ? size : 1.0;
  return sizes;
}

using RowSizes = decltype(ActivePoint::row_scale);

/// Sizes of the rows of Z_m over E_m, one for all rows that are components of one vector: a component that is
/// rounding only must not be blown up to the size of the others.
RowSizes vector_sizes(const contact::MultiplierColumns& by_multiplier, Index components) {
  RowSizes sizes = by_multiplier.cwiseAbs().rowwise().maxCoeff();
  const auto join = [&](Index first, Index count) {
    if (count > 0)
      sizes.segment(first, count).setConstant(sizes.segment(first, count).maxCoeff());
  };
  join(0, components);
  if (const Index tangents = components - 1; by_multiplier.cols() >= tangents)
    join(sizes.size() - tangents, tangents);
  for (auto& size : sizes)
    size = size > 0 ? size : 1.0;
  return sizes;
}

/// Multipliers that nothing can change stay as they are.
void mend_empty_rows(contact::FactoredResponse& r, MatrixXd& by_q) {
  const Index d = r.components;
  const double scale = r.spread.topRows(d).lpNorm<Eigen::Infinity>();
  for (Index row = d; row < d + r.multipliers(); ++row)
    if (r.by_multiplier.row(row).isZero(0) && by_q.row(row).lpNorm<Eigen::Infinity>() <= empty_row * scale) {
      r.by_multiplier(row, row - d) = 1;
      by_q.row(row).setZero();
      r.equations[row - d] = 0;
    }
}

} // namespace

PointSystem::PointSystem(Compliance& compliance, TouchedSurface& surface, double force_weight)
    : compliance_(compliance), force_weight_(force_weight), surface_(surface) {
  clear();
}

void PointSystem::clear() {
  count_ = 0;
  force_ = VectorXd::Zero(static_cast<Index>(compliance_.surface().size()));
  forces_ = places_ = 0;
}

void PointSystem::add(std::size_t zone, std::size_t index, Status status,
                      const contact::FactoredResponse& response) {
  if (count_ == points_.size())
    points_.emplace_back();
  auto& point = points_[count_++];
  point.zone = zone;
  point.index = index;
  point.status = status;
  point.response = response;
  const auto& r = point.response;
  const auto& position = compliance_.position_of_dof();
  point.spread.resize(r.spread.rows(), r.spread.cols());
  point.by_q.resize(r.by_q.rows(), r.by_q.cols());
  point.positions.clear();
  Index kept = 0;
  for (std::size_t q = 0; q < r.dofs.size(); ++q) {
    const int at = position[static_cast<std::size_t>(r.dofs[q])];
    if (at < 0)
      continue;
    point.positions.push_back(at);
    point.spread.col(kept) = r.spread.col(static_cast<Index>(q));
    point.by_q.col(kept++) = r.by_q.col(static_cast<Index>(q));
    force_[at] += r.spread.col(static_cast<Index>(q)).head(r.components).dot(r.force);
  }
  if (kept < point.spread.cols()) {
    point.spread.conservativeResize(Eigen::NoChange, kept);
    point.by_q.conservativeResize(Eigen::NoChange, kept);
  }
  point.rows.first = forces_;
  point.first_slope = places_;
  forces_ += point.components();
  places_ += point.slopes();
  eliminate_multipliers(point);
}

/// The combinations of δz − Z_q δq − Z_m δm = 0 and −E_q δq − E_m δm = e that have no δm.
void PointSystem::eliminate_multipliers(ActivePoint& point) {
  auto& r = point.response;
  mend_empty_rows(r, point.by_q);
  const Index d = r.components;
  const Index m = r.multipliers();
  const Index q = point.by_q.cols();
  auto& all = combined_; // on δz, on δq, right side
  all.setZero(d + m, d + q + 1);
  all.topLeftCorner(d, d).setIdentity();
  all.middleCols(d, q) = -point.by_q.topRows(d + m);
  all.col(d + q).tail(m) = r.equations;
  if (m > 0) {
    point.column_scale = column_sizes(r.by_multiplier).cwiseInverse();
    const contact::MultiplierColumns by_multiplier = r.by_multiplier * point.column_scale.asDiagonal();
    point.row_scale = vector_sizes(by_multiplier, d).cwiseInverse();
    point.by_multiplier.compute(point.row_scale.asDiagonal() * by_multiplier);
    all.array().colwise() *= point.row_scale.array();
    all.applyOnTheLeft(point.by_multiplier.householderQ().adjoint());
  }
  point.by_force = all.block(m, 0, d, d);
  point.rows.left = all.block(m, d, d, q);
  point.rows.right = point.spread.topRows(d);
  point.right = all.col(d + q).tail(d);
}

std::optional<PointSystem::Change> PointSystem::solve(const VectorXd& d0) {
  if (points().empty())
    return no_change();
  touch_surface();
  const VectorXd on_places = force_(surface_.positions());
  VectorXd c;
  surface_.multiply(on_places, c);
  c = d0(surface_.positions()) - force_weight_ * c;
  auto change = refined(c);
  return change ? change : solved_whole(c);
}

void PointSystem::touch_surface() {
  std::vector<int> positions;
  for (const auto& point : points())
    positions.insert(positions.end(), point.positions.begin(), point.positions.end());
  surface_.touch(positions);
  for (auto& point : active()) {
    point.rows.places.resize(point.positions.size());
    std::ranges::transform(point.positions, point.rows.places.begin(),
                           [&](int position) { return surface_.place_of(position); });
  }
}

/// The matrix of δz alone, places held.
bool PointSystem::factor_forces() {
  std::vector<const PointRows*> rows;
  for (const auto& point : points())
    rows.push_back(&point.rows);
  MatrixXd matrix = between_points(surface_, rows, -force_weight_, false);
  for (const auto& point : points())
    matrix.block(point.first(), point.first(), point.components(), point.components()) += point.by_force;
  column_scale_ = row_sizes(matrix.transpose()).cwiseInverse();
  matrix *= column_scale_.asDiagonal();
  row_scale_ = row_sizes(matrix).cwiseInverse();
  matrix = row_scale_.asDiagonal() * matrix;
  factors_ = linalg::DenseLu::of(std::move(matrix));
  return factors_.has_value();
}

std::optional<PointSystem::Change> PointSystem::refined(const VectorXd& c) {
  if (!factor_forces())
    return std::nullopt;
  auto change = no_change();
  double first = 0;
  double least = std::numeric_limits<double>::infinity();
  int slow_rounds = 0;
  for (int round = 0; round < most_rounds; ++round) {
    const auto left = residual(c, change);
    const VectorXd scaled = row_scale_.cwiseProduct(left.force);
    const double size = scaled.lpNorm<Eigen::Infinity>();
    const double moves = left.places.size() > 0 ? left.places.lpNorm<Eigen::Infinity>() : 0.0;
    if (round == 0)
      first = size;
    const double error = first > 0 ? std::max(size / first, moves) : moves;
    if (round > 0 && error <= refined_enough)
      return change;
    slow_rounds = error <= slow_round * least ? 0 : slow_rounds + 1;
    if (slow_rounds == most_slow_rounds)
      return error <= refined_to_rounding ? std::optional(change) : std::nullopt;
    least = std::min(least, error);
    Change by{column_scale_.cwiseProduct(factors_->solve(scaled)), left.places};
    by.places = places_after(by);
    change.force += by.force;
    change.places += by.places;
  }
  return std::nullopt;
}

/// Column by column from what unit changes do.
std::optional<PointSystem::Change> PointSystem::solved_whole(const VectorXd& c) {
  const Index size = forces_ + places_;
  if (size > largest_whole)
    return std::nullopt;
  const auto joined = [&](const Change& change) {
    VectorXd all(size);
    all << change.force, change.places;
    return all;
  };
  const auto split = [&](const VectorXd& all) { return Change{all.head(forces_), all.tail(places_)}; };
  const VectorXd right = joined(residual(c, no_change()));
  MatrixXd matrix(size, size);
  for (Index k = 0; k < size; ++k)
    matrix.col(k) = right - joined(residual(c, split(VectorXd::Unit(size, k))));
  auto solution = solve_dense(matrix, right);
  if (!solution) {
    // Points that say the same share what they carry: the smallest such forces.
    solution = matrix.completeOrthogonalDecomposition().solve(right);
    if (!solution->allFinite())
      return std::nullopt;
  }
  return split(*solution);
}

PointSystem::Change PointSystem::no_change() const {
  return {VectorXd::Zero(forces_), VectorXd::Zero(places_)};
}

/// Cᵀ (δz, δξ) of a point at one of its displacements.
double PointSystem::force_on(const ActivePoint& point, std::size_t q, const Change& change) {
  const double* of_q = point.spread.data() + static_cast<Index>(q) * point.spread.rows();
  const double* force = change.force.data() + point.first();
  const double* places = change.places.data() + point.first_slope;
  double sum = 0;
  for (int a = 0; a < point.components(); ++a)
    sum += of_q[a] * force[a];
  for (int a = 0; a < point.slopes(); ++a)
    sum += of_q[point.components() + a] * places[a];
  return sum;
}

/// P δq of a point, added to δξ.
void PointSystem::add_places(const ActivePoint& point, const VectorXd& d, double* places) {
  const Index rows = point.by_q.rows();
  const double* slopes = point.by_q.data() + rows - point.slopes();
  for (std::size_t q = 0; q < point.rows.places.size(); ++q)
    for (int a = 0; a < point.slopes(); ++a)
      places[a] += slopes[static_cast<Index>(q) * rows + a] * d[point.rows.places[q]];
}

/// S Cᵀ (δz, δξ), one a place.
VectorXd PointSystem::motion(const Change& change) const {
  VectorXd force = VectorXd::Zero(surface_.size());
  for (const auto& point : points())
    for (std::size_t q = 0; q < point.rows.places.size(); ++q)
      force[point.rows.places[q]] += force_on(point, q, change);
  VectorXd moved;
  surface_.multiply(force, moved);
  return moved;
}

PointSystem::Change PointSystem::residual(const VectorXd& c, const Change& change) const {
  const VectorXd d = c - force_weight_ * motion(change);
  Change left{VectorXd(forces_), -change.places};
  for (const auto& point : points()) {
    const int count = point.components();
    double* forces = left.force.data() + point.first();
    for (int a = 0; a < count; ++a) {
      forces[a] = point.right[a];
      for (int b = 0; b < count; ++b)
        forces[a] -= point.by_force(a, b) * change.force[point.first() + b];
    }
    const double* seen = point.rows.left.data();
    for (std::size_t q = 0; q < point.rows.places.size(); ++q, seen += count)
      for (int a = 0; a < count; ++a)
        forces[a] -= seen[a] * d[point.rows.places[q]];
    add_places(point, d, left.places.data() + point.first_slope);
  }
  return left;
}

/// δξ that follows from how a change moves the surface.
VectorXd PointSystem::places_after(const Change& change) const {
  const VectorXd d = -force_weight_ * motion(change);
  VectorXd places = change.places;
  for (const auto& point : points())
    add_places(point, d, places.data() + point.first_slope);
  return places;
}

VectorXd PointSystem::force_after(const Change& change) const {
  VectorXd force = force_;
  for (const auto& point : points())
    for (std::size_t q = 0; q < point.positions.size(); ++q)
      force[point.positions[q]] += force_on(point, q, change);
  return force;
}

contact::PointVector PointSystem::multipliers_of(const ActivePoint& point, const Change& change,
                                                 const VectorXd& moved) const {
  const auto& r = point.response;
  const Index d = r.components;
  const Index m = r.multipliers();
  RowSizes right(d + m);
  right << change.force.segment(point.first(), d), -r.equations;
  for (std::size_t q = 0; q < point.positions.size(); ++q)
    right -= point.by_q.col(static_cast<Index>(q)).head(d + m) * moved[point.positions[q]];
  return point.column_scale.cwiseProduct(point.by_multiplier.solve(point.row_scale.cwiseProduct(right)));
}

} // namespace rubato::step
