// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/interface/active_interface_compliance.hpp"

#include "rubato/linalg/column_sum.hpp"
#include "rubato/linalg/symmetric_product.hpp"
#include "rubato/step/interface/body_threads.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <stdexcept>
#include <vector>

namespace rubato::step {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// What one point's unit forces move: `Rows` numbers an active dof.
template <std::size_t Rows>
void apply_compliance(const ActiveInterfaceCompliance& surface, const PointRows& point,
                      std::vector<double>& by_active_dof, std::vector<double>& by_row) {
  const auto size = static_cast<std::size_t>(surface.size());
  by_active_dof.assign(size * Rows, 0.0);
  by_row.resize(by_active_dof.size());
  for (std::size_t row = 0; row < Rows; ++row) {
    double* const of_row = by_active_dof.data() + row * size;
    surface.add_motion(point.active_dofs, point.right.row(static_cast<Index>(row)), of_row);
    for (std::size_t i = 0; i < size; ++i)
      by_row[i * Rows + row] = of_row[i];
  }
}

/// What one point sees of what another one moves, column by column.
template <std::size_t Rows>
std::array<double, Rows * Rows> seen_by(const PointRows& point, const std::vector<double>& moved) {
  std::array<double, Rows * Rows> block{};
  const double* sees = point.left.data();
  for (const int active_dof : point.active_dofs) {
    const double* const at_active_dof = moved.data() + static_cast<std::size_t>(active_dof) * Rows;
    for (std::size_t column = 0; column < Rows; ++column)
      for (std::size_t row = 0; row < Rows; ++row)
        block[column * Rows + row] += at_active_dof[column] * sees[row];
    sees += point.left.rows();
  }
  return block;
}

/// What the forces of the points from `first` to before `last` do to all points.
template <std::size_t Rows>
void fill_columns(const ActiveInterfaceCompliance& surface, std::span<const PointRows* const> points,
                  double factor, std::size_t first, std::size_t last, MatrixXd& matrix) {
  std::vector<double> by_active_dof, moved;
  const auto size = points.size() * Rows;
  for (std::size_t j = first; j < last; ++j) {
    apply_compliance<Rows>(surface, *points[j], by_active_dof, moved);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto block = seen_by<Rows>(*points[i], moved);
      double* to = matrix.data() + j * Rows * size + i * Rows;
      for (std::size_t column = 0; column < Rows; ++column, to += size)
        for (std::size_t row = 0; row < Rows; ++row)
          to[row] = factor * block[column * Rows + row];
    }
  }
}

/// Points of a thread's part at least: fewer are done sooner than another thread wakes up.
constexpr std::size_t fewest_points = 100;

template <std::size_t Rows>
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
  MatrixXd filled = MatrixXd::Zero(rows, matrix.cols());
  for (Index j = 0; j < matrix.cols(); ++j)
    for (Index i = 0; i < known; ++i)
      filled(i, j) = matrix(i, j);
  matrix.swap(filled);
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
  for (std::size_t i = 0; i < interface_dofs_.size(); ++i)
    on_surface[interface_dofs_[i]] = force[static_cast<Index>(i)];
  VectorXd of_surface = VectorXd::Zero(compliance_->size());
  compliance_->add(1, on_surface, of_surface);
  moved.resize(size());
  for (std::size_t i = 0; i < interface_dofs_.size(); ++i)
    moved[static_cast<Index>(i)] = of_surface[interface_dofs_[i]];
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
