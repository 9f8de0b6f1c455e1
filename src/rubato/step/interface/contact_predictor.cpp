// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/interface/contact_predictor.hpp"

#include "rubato/step/interface/friction_cones.hpp"
#include "rubato/step/interface/tresca_problem.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rubato::step {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// Points that the forces of others push into the master join in so many rounds.
constexpr int most_rounds = 8;
/// Each round adds a point, so that there is an end.
constexpr int unlimited = std::numeric_limits<int>::max();
/// Misfit of forces and motions where frames are held, in parts of the largest force, of free bodies.
constexpr double well_balanced = 1e-3;
/// Those join first that are pushed in by this part of the deepest.
constexpr double deep = 0.6;
/// Part of a surface that is watched from which on all of it is.
constexpr double watched_in_place = 0.5;
/// Columns of a compliance for a thread between two looks at whether the run is to stop, and at least.
constexpr Index columns_of_thread = 128;
constexpr std::size_t fewest_columns = 50;

/// Keeps the entries that there are; others have any value.
void enlarge(VectorXd& values, Index size) {
  VectorXd larger(size);
  std::copy_n(values.data(), values.size(), larger.data());
  values.swap(larger);
}

/// The same of a square matrix.
void enlarge(MatrixXd& matrix, Index size) {
  MatrixXd larger(size, size);
  for (Index j = 0; j < matrix.cols(); ++j)
    std::copy_n(matrix.data() + j * matrix.rows(), matrix.rows(), larger.data() + j * size);
  matrix.swap(larger);
}

/// Component of a vector along an axis of a point's frame.
double along_axis(const PredictorPoint& point, Index axis, const Vector3d& vector) {
  const double* const direction = &point.frame(0, axis);
  return direction[0] * vector[0] + direction[1] * vector[1] + direction[2] * vector[2];
}

double length_of(double x, double y) {
  return std::sqrt(x * x + y * y);
}

/// Shortens friction to its limit.
void limit_friction(double limit, double* friction) {
  if (const double length = length_of(friction[0], friction[1]); length > limit) {
    friction[0] *= limit / length;
    friction[1] *= limit / length;
  }
}

} // namespace

Vector3d measures_of(const PredictorPoint& point, const VectorXd& d) {
  const Vector3d moved = point.stencil.gather(d);
  Vector3d measures = point.value;
  for (int a = 0; a < 3; ++a)
    measures[a] += along_axis(point, a, moved);
  return measures;
}

void add_force(std::span<const PredictorPoint> points, int first, int last, VectorXd& force) {
  for (const auto& point : points) {
    if (point.force[0] == 0)
      continue;
    Vector3d in_space = Vector3d::Zero();
    for (int a = first; a <= last; ++a)
      for (int c = 0; c < 3; ++c)
        in_space[c] += point.force[a] * point.frame(c, a);
    point.stencil.scatter(in_space, force);
  }
}

ContactPredictor::ContactPredictor(Compliance& compliance, double factor, int components,
                                   NormalSolution how_far, std::size_t least_watched, std::size_t many,
                                   std::size_t most_formed)
    : compliance_(compliance), factor_(factor), components_(components), how_far_(how_far),
      least_watched_(least_watched), many_(many), most_formed_(most_formed), watched_(compliance) {}

void ContactPredictor::improve(std::span<PredictorPoint> points, const VectorXd& free, VectorXd d,
                               const linalg::WholeMatrix& matrix, Progress& progress) {
  forget_points();
  VectorXd unpressed = free;
  add_motion(points, 1, 2, unpressed);
  const int rounds = how_far_ == NormalSolution::projected_cg ? unlimited : most_rounds;
  for (int round = 0; round < rounds && progress.report() && choose_more(points, d); ++round) {
    formed_ = !are_too_many();
    if (!formed_)
      return improve_by_products(points, free, matrix, progress);
    find_normal_forces(unpressed, progress);
    d = unpressed;
    add_motion(points, 0, 0, d);
  }
  d += free - unpressed;
  find_friction(points, d, progress);
  if (how_far_ != NormalSolution::near && !sliding_.empty())
    solve_coupled(points, free, progress);
}

/// Of bodies that only contact holds: friction that has been found for pressing forces as they were leaves
/// gaps of the size of a rigid motion. Those that press are solved for together, then those too that they
/// push into the master.
void ContactPredictor::solve_coupled(std::span<PredictorPoint> points, const VectorXd& free,
                                     Progress& progress) {
  std::vector<PredictorPoint*> together;
  FrictionCones cones;
  for (int round = 0; round < most_rounds && progress.report(); ++round) {
    VectorXd d = free;
    add_motion(points, 0, 2, d);
    if (misfit_by_point_compliance(points, d) <= well_balanced || !join(points, d, together))
      return;
    VectorXd forces(static_cast<Index>(together.size()) * components_);
    for (std::size_t k = 0; k < together.size(); ++k)
      std::copy_n(together[k]->force.data(), components_,
                  forces.data() + static_cast<Index>(k) * components_);
    add_cones(together, free, cones, progress);
    if (progress.stopped())
      return;
    const auto solved = solve_friction(cones, forces, progress);
    if (!solved)
      return;
    for (std::size_t k = 0; k < together.size(); ++k)
      std::copy_n(solved->data() + static_cast<Index>(k) * components_, components_,
                  together[k]->force.data());
  }
}

/// Points that press, and those that penetrate deepest, join others. Whether there are any.
bool ContactPredictor::join(std::span<PredictorPoint> points, const VectorXd& d,
                            std::vector<PredictorPoint*>& together) {
  const std::vector<PredictorPoint*> known = together;
  double deepest = 0;
  for (const auto& point : points)
    if (point.force[0] == 0)
      deepest = std::min(deepest, measures_of(point, d)[0]);
  for (auto& point : points)
    if (std::ranges::find(known, &point) == known.end()) {
      const double gap = measures_of(point, d)[0];
      if (point.force[0] > 0 || (gap < 0 && gap <= deep * deepest))
        together.push_back(&point);
    }
  return together.size() > known.size();
}

/// By the rows and columns of points that have joined.
void ContactPredictor::add_cones(std::span<PredictorPoint* const> together, const VectorXd& free,
                                 FrictionCones& cones, Progress& progress) {
  const auto known = cones.friction.size();
  const auto count = static_cast<Index>(together.size());
  watch(together);
  Push pushed;
  enlarge(cones.matrix, count * components_);
  enlarge(cones.values, count * components_);
  enlarge(cones.friction, count);
  for (Index k = known; k < count && progress.report(); ++k) {
    const auto& point = *together[static_cast<std::size_t>(k)];
    const Vector3d measures = measures_of(point, free);
    std::copy_n(measures.data(), components_, cones.values.data() + k * components_);
    cones.friction[k] = point.friction;
    for (Index a = 0; a < components_; ++a) {
      push(point, static_cast<int>(a), pushed);
      const Index column = k * components_ + a;
      for (Index i = 0; i <= k; ++i) {
        const auto& seeing = *together[static_cast<std::size_t>(i)];
        const Vector3d moved = seeing.stencil.gather(pushed.moved);
        for (Index b = 0; b < components_; ++b)
          cones.matrix(i * components_ + b, column) = along_axis(seeing, b, moved);
      }
      for (Index row = 0; row < k * components_; ++row)
        cones.matrix(column, row) = cones.matrix(row, column);
    }
    for (Index a = 0; a < components_; ++a)
      cones.matrix(k * components_ + a, k * components_ + a) +=
          a == 0 ? point.penalty_compliance : point.tangential_compliance;
  }
}

/// The largest gap or slip that forces do not fit, as a force on the point's own surface, in parts of the
/// largest force.
double ContactPredictor::misfit_by_point_compliance(std::span<const PredictorPoint> points,
                                                    const VectorXd& d) const {
  double misfit = 0;
  double largest = 0;
  for (const auto& point : points) {
    const Vector3d measures = measures_of(point, d);
    const double gap = measures[0] + point.penalty_compliance * point.force[0];
    misfit = std::max(misfit, (point.force[0] > 0 ? std::abs(gap) : -gap) / point.point_compliance);
    largest = std::max(largest, point.force[0]);
    std::array<double, 2> wanted{};
    for (int a = 0; a < 2; ++a) {
      const double friction = point.force[1 + a];
      const double slip = measures[1 + a] + point.tangential_compliance * friction;
      wanted[static_cast<std::size_t>(a)] = friction - slip / point.point_compliance;
    }
    limit_friction(point.friction * point.force[0], wanted.data());
    misfit = std::max(misfit, length_of(wanted[0] - point.force[1], wanted[1] - point.force[2]));
  }
  return misfit > 0 ? misfit / largest : 0.0;
}

double ContactPredictor::misfit(std::span<const PredictorPoint> points, const VectorXd& d) const {
  if (!formed_)
    return 0;
  double change = 0;
  double largest = 0;
  for (std::size_t k = 0; k < chosen_.size(); ++k) {
    const auto& point = *chosen_[k];
    const double point_compliance = point_compliance_of(k) + point.penalty_compliance;
    const double gap = measures_of(point, d)[0] + point.penalty_compliance * point.force[0];
    if (point_compliance > 0)
      change =
          std::max(change, std::abs(std::max(0.0, point.force[0] - gap / point_compliance) - point.force[0]));
    largest = std::max(largest, point.force[0]);
  }
  const Index tangents = components_ - 1;
  for (std::size_t k = 0; k < sliding_.size(); ++k) {
    const auto& point = *chosen_[sliding_[k]];
    double point_compliance = -std::numeric_limits<double>::infinity();
    for (Index i = static_cast<Index>(k) * tangents; i < static_cast<Index>(k + 1) * tangents; ++i)
      point_compliance = std::max(point_compliance, tangential_compliance_(i, i));
    std::array<double, 2> wanted{point.force[1], point.force[2]};
    if (point_compliance > 0) {
      const Vector3d measures = measures_of(point, d);
      for (Index a = 0; a < tangents; ++a)
        wanted[static_cast<std::size_t>(a)] -=
            (measures[1 + a] + point.tangential_compliance * point.force[1 + a]) / point_compliance;
    }
    limit_friction(point.friction * point.force[0], wanted.data());
    change = std::max({change, std::abs(wanted[0] - point.force[1]), std::abs(wanted[1] - point.force[2])});
  }
  double point_compliance = 0;
  for (std::size_t k = 0; k < chosen_.size(); ++k)
    point_compliance = k == 0 ? point_compliance_of(k) : std::max(point_compliance, point_compliance_of(k));
  for (const auto& point : points)
    if (point.force[0] == 0)
      if (const double gap = measures_of(point, d)[0]; gap < 0)
        change = std::max(change, point_compliance > 0 ? -gap / point_compliance
                                                       : std::numeric_limits<double>::infinity());
  return change > 0 ? change / largest : 0.0;
}

/// How far a unit pressing force opens its own gap.
double ContactPredictor::point_compliance_of(std::size_t chosen) const {
  return normal_compliance_(static_cast<Index>(chosen), static_cast<Index>(chosen));
}

void ContactPredictor::forget() {
  forget_points();
  forget_surface();
}

void ContactPredictor::forget_points() {
  chosen_.clear();
  sliding_.clear();
  normal_compliance_.resize(0, 0);
}

/// Moves the surface by some of the forces of all points.
void ContactPredictor::add_motion(std::span<const PredictorPoint> points, int first, int last, VectorXd& d) {
  force_.setZero(d.size());
  add_force(points, first, last, force_);
  compliance_.add(factor_, force_, d);
}

/// Points that press, and those that penetrate deepest, join those that are chosen already. Whether there are
/// any.
bool ContactPredictor::choose_more(std::span<PredictorPoint> points, const VectorXd& d) {
  const auto known = static_cast<std::ptrdiff_t>(chosen_.size());
  const auto is_known = [&](const PredictorPoint& point) {
    return std::find(chosen_.begin(), chosen_.begin() + known, &point) != chosen_.begin() + known;
  };
  gaps_.resize(points.size());
  double deepest = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    gaps_[i] = is_known(points[i]) ? 0.0 : measures_of(points[i], d)[0];
    deepest = std::min(deepest, gaps_[i]);
  }
  for (std::size_t i = 0; i < points.size(); ++i)
    if ((gaps_[i] < 0 && gaps_[i] <= deep * deepest) || (points[i].force[0] > 0 && !is_known(points[i])))
      chosen_.push_back(&points[i]);
  return static_cast<std::ptrdiff_t>(chosen_.size()) > known;
}

/// Of a large surface, takes the parts that points stand on to those that push moves. Where these are most of
/// it, what stands in memory already is read sooner than S between them is copied.
void ContactPredictor::watch(std::span<PredictorPoint* const> points) {
  if (static_cast<std::size_t>(compliance_.size()) < least_watched_)
    return;
  for (const auto* point : points)
    for (const auto& node : point->stencil.nodes)
      for (const int at : node.at)
        if (at >= 0)
          watched_.add({&at, 1});
  watches_all_ = watches_all_ || (compliance_.is_computed_whole() &&
                                  static_cast<double>(watched_.size()) >
                                      watched_in_place * static_cast<double>(compliance_.size()));
  if (watches_all_) {
    compliance_.compute_whole(watched_.interface_dofs());
    watched_.forget();
  } else {
    watched_.touch_added();
  }
}

/// Moves the surface, of a large one what is watched, by a unit force along an axis of the frame of a point.
void ContactPredictor::push(const PredictorPoint& point, int axis, Push& push) const {
  push.forces.clear();
  for (const auto& node : point.stencil.nodes)
    for (std::size_t c = 0; c < 3; ++c)
      if (const int at = node.at[c]; at >= 0)
        push.forces.push_back({at, node.weight * point.frame(static_cast<Index>(c), axis)});
  if (watched_.size() > 0) {
    push.moved.resize(compliance_.size());
    push_watched(push);
  } else {
    push.moved.setZero(compliance_.size());
    compliance_.add(factor_, push.forces, push.moved);
  }
}

void ContactPredictor::push_watched(Push& push) const {
  push.active.clear();
  Eigen::RowVectorXd force(static_cast<Index>(push.forces.size()));
  for (const auto& [interface_dof, part] : push.forces) {
    force[static_cast<Index>(push.active.size())] = factor_ * part;
    push.active.push_back(watched_.active_dof_of(interface_dof));
  }
  push.of_watched.setZero(watched_.size());
  watched_.add_motion(push.active, force, push.of_watched.data());
  for (std::size_t k = 0; k < watched_.interface_dofs().size(); ++k)
    push.moved[watched_.interface_dofs()[k]] = push.of_watched[static_cast<Index>(k)];
}

/// Calls work(column, storage) for the columns from `first` on, of points whose surfaces are watched by
/// threads: S stands in memory then.
template <class Work>
void ContactPredictor::each_column(Index first, Index count, Progress& progress, const Work& work) const {
  const Threads threads = is_watched() ? compliance_.threads() : Threads();
  const Index at_once = columns_of_thread * threads.count();
  for (Index start = first; start < count && progress.report(); start += at_once) {
    const auto columns = static_cast<std::size_t>(std::min(at_once, count - start));
    threads.each_range(columns, fewest_columns, [&](std::size_t begin, std::size_t end) {
      Push storage;
      for (auto column = begin; column < end; ++column)
        work(start + static_cast<Index>(column), storage);
    });
  }
}

/// Whether the points chosen are so many that it saves work.
bool ContactPredictor::takes_together() const {
  return chosen_.size() >= many_ && compliance_.takes_forces_together();
}

/// Of the points chosen, from their forces together.
void ContactPredictor::find_normal_compliance() {
  std::vector<Eigen::Triplet<double, int>> entries;
  for (std::size_t j = 0; j < chosen_.size(); ++j)
    for (const auto& node : chosen_[j]->stencil.nodes)
      for (std::size_t c = 0; c < 3; ++c)
        if (node.at[c] >= 0)
          entries.emplace_back(node.at[c], static_cast<int>(j),
                               node.weight * chosen_[j]->frame(static_cast<Index>(c), 0));
  linalg::SparseMatrix forces(compliance_.size(), static_cast<Index>(chosen_.size()));
  forces.setFromTriplets(entries.begin(), entries.end());
  normal_compliance_ = compliance_.between_forces(forces);
  normal_compliance_ *= factor_;
}

/// By the rows and columns of the points chosen last.
void ContactPredictor::add_normal_compliance(Progress& progress) {
  const Index known = normal_compliance_.rows();
  const auto count = static_cast<Index>(chosen_.size());
  if (takes_together()) {
    find_normal_compliance();
    progress.report();
    return;
  }
  enlarge(normal_compliance_, count);
  watch(chosen_);
  each_column(known, count, progress, [&](Index j, Push& pushed) {
    push(*chosen_[static_cast<std::size_t>(j)], 0, pushed);
    for (Index i = 0; i <= j; ++i) {
      const auto& seeing = *chosen_[static_cast<std::size_t>(i)];
      normal_compliance_(i, j) = normal_compliance_(j, i) =
          along_axis(seeing, 0, seeing.stencil.gather(pushed.moved));
    }
  });
}

void ContactPredictor::add_tangential_compliance(Progress& progress) {
  const Index tangents = components_ - 1;
  const auto count = static_cast<Index>(sliding_.size());
  if (takes_together()) { // nothing of theirs is watched yet
    std::vector<PredictorPoint*> sliding;
    for (const auto k : sliding_)
      sliding.push_back(chosen_[k]);
    watch(sliding);
  }
  tangential_compliance_.resize(count * tangents, count * tangents);
  each_column(0, count, progress, [&](Index j, Push& pushed) {
    const auto& point = *chosen_[sliding_[static_cast<std::size_t>(j)]];
    for (Index b = 0; b < tangents; ++b) {
      push(point, static_cast<int>(1 + b), pushed);
      for (Index i = 0; i <= j; ++i) {
        const auto& seeing = *chosen_[sliding_[static_cast<std::size_t>(i)]];
        const Vector3d moved = seeing.stencil.gather(pushed.moved);
        for (Index a = 0; a < tangents; ++a)
          tangential_compliance_(i * tangents + a, j * tangents + b) =
              tangential_compliance_(j * tangents + b, i * tangents + a) = along_axis(seeing, 1 + a, moved);
      }
      tangential_compliance_(j * tangents + b, j * tangents + b) += point.tangential_compliance;
    }
  });
}

/// `without`: the surface without pressing forces.
void ContactPredictor::find_normal_forces(const VectorXd& without, Progress& progress) {
  const auto count = static_cast<Index>(chosen_.size());
  add_normal_compliance(progress);
  if (progress.stopped())
    return;
  VectorXd gaps(count);
  VectorXd forces(count);
  MatrixXd matrix = normal_compliance_;
  for (Index k = 0; k < count; ++k) {
    const auto& point = *chosen_[static_cast<std::size_t>(k)];
    gaps[k] = measures_of(point, without)[0];
    forces[k] = point.force[0];
    matrix(k, k) += point.penalty_compliance;
  }
  solve_normal_problem(matrix, gaps, how_far_, forces, progress);
  for (Index k = 0; k < count; ++k)
    chosen_[static_cast<std::size_t>(k)]->force[0] = forces[k];
}

/// `without`: the surface under the pressing forces alone.
void ContactPredictor::find_friction(std::span<PredictorPoint> points, const VectorXd& without,
                                     Progress& progress) {
  for (auto& point : points)
    if (point.force[0] == 0 || point.friction == 0)
      point.force[1] = point.force[2] = 0;
  sliding_.clear();
  for (std::size_t k = 0; k < chosen_.size(); ++k)
    if (chosen_[k]->force[0] > 0 && chosen_[k]->friction > 0)
      sliding_.push_back(k);
  if (sliding_.empty())
    return;
  const Index tangents = components_ - 1;
  add_tangential_compliance(progress);
  if (progress.stopped())
    return;
  VectorXd slips(tangential_compliance_.rows());
  VectorXd forces(tangential_compliance_.rows());
  VectorXd limits(static_cast<Index>(sliding_.size()));
  for (Index k = 0; k < limits.size(); ++k) {
    const auto& point = *chosen_[sliding_[static_cast<std::size_t>(k)]];
    const Vector3d measures = measures_of(point, without);
    std::copy_n(measures.data() + 1, tangents, slips.data() + k * tangents);
    std::copy_n(point.force.data() + 1, tangents, forces.data() + k * tangents);
    limits[k] = point.friction * point.force[0];
  }
  solve_tresca_problem(tangential_compliance_, slips, limits, static_cast<int>(tangents), forces, progress);
  for (Index k = 0; k < limits.size(); ++k)
    std::copy_n(forces.data() + k * tangents, tangents,
                chosen_[sliding_[static_cast<std::size_t>(k)]]->force.data() + 1);
}

} // namespace rubato::step
