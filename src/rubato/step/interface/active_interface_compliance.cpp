// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/interface/active_interface_compliance.hpp"

#include "rubato/linalg/column_sum.hpp"
#include "rubato/linalg/symmetric_product.hpp"
#include "rubato/step/interface/body_threads.hpp"

#include <algorithm>
#include <stdexcept>

namespace rubato::step {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// What one point's unit forces move, row after row of them: one column an active dof.
template <int Rows>
void apply_compliance(const ActiveInterfaceCompliance& surface, const PointRows& point,
                      MatrixXd& by_active_dof, Eigen::Matrix<double, Rows, Eigen::Dynamic>& by_row) {
  by_active_dof.setZero(surface.size(), Rows);
  for (int row = 0; row < Rows; ++row)
    surface.add_motion(point.active_dofs, point.right.row(row), by_active_dof.col(row).data());
  by_row = by_active_dof.transpose();
}

/// What one point sees of what another one moves.
template <int Rows>
Eigen::Matrix<double, Rows, Rows> seen_by(const PointRows& point,
                                          const Eigen::Matrix<double, Rows, Eigen::Dynamic>& moved) {
  using Column = Eigen::Map<const Eigen::Matrix<double, Rows, 1>>;
  Eigen::Matrix<double, Rows, Rows> block = Eigen::Matrix<double, Rows, Rows>::Zero();
  const double* left = point.left.data();
  for (const int active_dof : point.active_dofs) {
    const Column sees(left);
    const double* at_active_dof = moved.data() + active_dof * Rows;
    for (int column = 0; column < Rows; ++column)
      block.col(column) += at_active_dof[column] * sees;
    left += point.left.rows();
  }
  return block;
}

/// What the forces of the points from `first` to before `last` do to all points.
template <int Rows>
void fill_columns(const ActiveInterfaceCompliance& surface, std::span<const PointRows* const> points,
                  double factor, std::size_t first, std::size_t last, MatrixXd& matrix) {
  MatrixXd by_active_dof;
  Eigen::Matrix<double, Rows, Eigen::Dynamic> moved;
  for (std::size_t j = first; j < last; ++j) {
    apply_compliance<Rows>(surface, *points[j], by_active_dof, moved);
    for (std::size_t i = 0; i < points.size(); ++i)
      matrix.template block<Rows, Rows>(static_cast<Index>(i) * Rows, static_cast<Index>(j) * Rows) =
          factor * seen_by<Rows>(*points[i], moved);
  }
}

/// Points of a thread's part at least: fewer are done sooner than another thread wakes up.
constexpr std::size_t fewest_points = 100;

template <int Rows>
void fill(const ActiveInterfaceCompliance& surface, std::span<const PointRows* const> points, double factor,
          MatrixXd& matrix) {
  surface.threads().each_range(points.size(), fewest_points, [&](std::size_t first, std::size_t last) {
    fill_columns<Rows>(surface, points, factor, first, last, matrix);
  });
}

void fill_up_with_zeros(MatrixXd& matrix, Index rows) {
  const Index known = matrix.rows();
  if (known >= rows)
    return;
  matrix.conservativeResize(rows, Eigen::NoChange);
  matrix.bottomRows(rows - known).setZero();
}

} // namespace

void ActiveInterfaceCompliance::forget() {
  for (const int interface_dof : interface_dofs_)
    active_dof_of_[static_cast<std::size_t>(interface_dof)] = -1;
  interface_dofs_.clear();
  numbered_ = 0;
  formed_ = false;
  body_of_.clear();
  bodies_.clear();
}

void ActiveInterfaceCompliance::add(std::span<const int> interface_dofs) {
  active_dof_of_.resize(static_cast<std::size_t>(compliance_->size()), -1);
  for (const int interface_dof : interface_dofs)
    if (auto& active_dof = active_dof_of_[static_cast<std::size_t>(interface_dof)]; active_dof < 0) {
      active_dof = 0;
      interface_dofs_.push_back(interface_dof);
    }
}

void ActiveInterfaceCompliance::number_added() {
  if (interface_dofs_.size() == numbered_)
    return;
  numbered_ = interface_dofs_.size();
  formed_ = false;
  std::ranges::sort(interface_dofs_);
  for (std::size_t active_dof = 0; active_dof < interface_dofs_.size(); ++active_dof)
    active_dof_of_[static_cast<std::size_t>(interface_dofs_[active_dof])] = static_cast<int>(active_dof);
}

void ActiveInterfaceCompliance::touch_added() {
  number_added();
  if (formed_)
    return;
  formed_ = true;
  body_of_.clear();
  std::vector<std::span<const int>> parts;
  const auto& starts = compliance_->body_starts();
  for (std::size_t b = 0; b + 1 < starts.size(); ++b) {
    const auto begin = std::ranges::lower_bound(interface_dofs_, starts[b]);
    const auto end = std::ranges::lower_bound(interface_dofs_, starts[b + 1]);
    if (begin == end)
      continue;
    body_of_.insert(body_of_.end(), static_cast<std::size_t>(end - begin), static_cast<int>(parts.size()));
    if (parts.size() == bodies_.size())
      bodies_.emplace_back();
    bodies_[parts.size()].first = begin - interface_dofs_.begin();
    parts.emplace_back(begin, end);
  }
  compliance_->compute_whole(interface_dofs_);
  for_each_body(compliance_->threads(), parts.size(), interface_dofs_.size(),
                [&](std::size_t part) { compliance_->within_body(parts[part], bodies_[part].s); });
}

void ActiveInterfaceCompliance::multiply(const VectorXd& force, VectorXd& moved) const {
  if (!formed_)
    return multiply_by_surface(force, moved);
  moved.setZero(size());
  for_each_body(compliance_->threads(), bodies_.size(), interface_dofs_.size(), [&](std::size_t b) {
    const auto& body = bodies_[b];
    linalg::add_symmetric_product(1, body.s, force.data() + body.first, moved.data() + body.first);
  });
}

void ActiveInterfaceCompliance::multiply_by_surface(const VectorXd& force, VectorXd& moved) const {
  VectorXd on_surface = VectorXd::Zero(compliance_->size());
  on_surface(interface_dofs_) = force;
  VectorXd of_surface = VectorXd::Zero(compliance_->size());
  compliance_->add(1, on_surface, of_surface);
  moved = of_surface(interface_dofs_);
}

void ActiveInterfaceCompliance::add_motion(
    std::span<const int> active_dofs,
    const Eigen::Ref<const Eigen::RowVectorXd, 0, Eigen::InnerStride<>>& force, double* moved) const {
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const auto& body = bodies_[b];
    linalg::ColumnSum sum(moved + body.first, body.s.rows());
    for (std::size_t q = 0; q < active_dofs.size(); ++q)
      if (const double part = force[static_cast<Index>(q)];
          part != 0 && body_of_[static_cast<std::size_t>(active_dofs[q])] == static_cast<int>(b))
        sum.add(part, body.s.col(active_dofs[q] - body.first).data());
    sum.add_rest();
  }
}

void PointRows::fill_up(Index rows) {
  fill_up_with_zeros(left, rows);
  fill_up_with_zeros(right, rows);
}

MatrixXd moved_by(const ActiveInterfaceCompliance& surface, const PointRows& point, Index rows) {
  MatrixXd by_active_dof = MatrixXd::Zero(surface.size(), rows);
  for (Index row = 0; row < rows; ++row)
    surface.add_motion(point.active_dofs, point.right.row(row), by_active_dof.col(row).data());
  return by_active_dof;
}

MatrixXd between_points(const ActiveInterfaceCompliance& surface, std::span<const PointRows* const> points,
                        Index rows, double factor) {
  const Index size = static_cast<Index>(points.size()) * rows;
  MatrixXd matrix(size, size);
  switch (rows) {
  case 1:
    fill<1>(surface, points, factor, matrix);
    break;
  case 2:
    fill<2>(surface, points, factor, matrix);
    break;
  case 3:
    fill<3>(surface, points, factor, matrix);
    break;
  case 4:
    fill<4>(surface, points, factor, matrix);
    break;
  case 5:
    fill<5>(surface, points, factor, matrix);
    break;
  default:
    throw std::invalid_argument("contact points have one to five unknowns each");
  }
  return matrix;
}

} // namespace rubato::step
