// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/interface/compliance.hpp"

#include "rubato/core/disjoint_sets.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace rubato::step {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

std::vector<int> positions_of_unknowns(const std::vector<int>& surface, Index unknowns) {
  std::vector<int> positions(static_cast<std::size_t>(unknowns), -1);
  for (std::size_t i = 0; i < surface.size(); ++i)
    positions[static_cast<std::size_t>(surface[i])] = static_cast<int>(i);
  return positions;
}

using Rows = Eigen::SparseMatrix<double, Eigen::RowMajor, int>;

/// y += B x
void add_rows(const Rows& rows, const VectorXd& x, VectorXd& y) {
  for (Index row = 0; row < rows.outerSize(); ++row) {
    double sum = 0;
    for (Rows::InnerIterator entry(rows, row); entry; ++entry)
      sum += entry.value() * x[entry.col()];
    y[row] += sum;
  }
}

VectorXd transposed_product(const Rows& rows, const VectorXd& x) {
  VectorXd y = VectorXd::Zero(rows.cols());
  for (Index row = 0; row < rows.outerSize(); ++row)
    for (Rows::InnerIterator entry(rows, row); entry; ++entry)
      y[entry.col()] += entry.value() * x[row];
  return y;
}

/// B S Bᵀ
MatrixXd between_rows(const Rows& rows, const MatrixXd& s) {
  MatrixXd right = MatrixXd::Zero(rows.rows(), s.cols());
  for (Index j = 0; j < s.cols(); ++j)
    for (Index row = 0; row < rows.outerSize(); ++row)
      for (Rows::InnerIterator entry(rows, row); entry; ++entry)
        right(row, j) += entry.value() * s(entry.col(), j);
  MatrixXd between = MatrixXd::Zero(rows.rows(), rows.rows());
  for (Index row = 0; row < rows.outerSize(); ++row)
    for (Rows::InnerIterator entry(rows, row); entry; ++entry)
      for (Index i = 0; i < right.rows(); ++i)
        between(i, row) += right(i, entry.col()) * entry.value();
  return between;
}

/// Bᵀ F
linalg::SparseMatrix transposed_product(const Rows& rows, const linalg::SparseMatrix& forces) {
  std::vector<Eigen::Triplet<double, int>> entries;
  for (Index column = 0; column < forces.outerSize(); ++column)
    for (linalg::SparseMatrix::InnerIterator force(forces, column); force; ++force)
      for (Rows::InnerIterator entry(rows, force.row()); entry; ++entry)
        entries.emplace_back(entry.col(), static_cast<int>(column), entry.value() * force.value());
  linalg::SparseMatrix product(rows.cols(), forces.cols());
  product.setFromTriplets(entries.begin(), entries.end());
  return product;
}

} // namespace

Compliance::Compliance(linalg::SplitFactor factor, const constraint::Reduction& reduction,
                       std::span<const int> related_dofs, Index largest_whole)
    : Compliance(std::make_unique<linalg::SplitFactor>(std::move(factor)), reduction, related_dofs,
                 largest_whole) {}

Compliance::Compliance(std::unique_ptr<linalg::SurfaceSolver> solver, const constraint::Reduction& reduction,
                       std::span<const int> related_dofs, Index largest_whole)
    : unknowns_(std::move(solver), largest_whole) {
  for (const int unknown : unknowns_.solver().surface())
    dofs_.push_back(reduction.free_dofs()[static_cast<std::size_t>(unknown)]);
  if (!related_dofs.empty())
    relate(reduction, related_dofs);
  number(reduction);
}

void Compliance::number(const constraint::Reduction& reduction) {
  interface_dofs_.assign(static_cast<std::size_t>(reduction.dof_count()), -1);
  for (std::size_t i = 0; i < dofs_.size(); ++i)
    interface_dofs_[static_cast<std::size_t>(dofs_[i])] = static_cast<int>(i);
}

/// By position: the first body of those that relations of the surface tie to its own.
std::vector<std::size_t> Compliance::bodies_of(const constraint::Reduction& reduction,
                                               std::span<const int> related_dofs) const {
  const auto& starts = unknowns_.solver().body_starts();
  const auto positions = positions_of_unknowns(unknowns_.solver().surface(), reduction.unknown_count());
  const auto body_of = [&](int position) {
    return static_cast<std::size_t>(std::ranges::upper_bound(starts, position) - starts.begin() - 1);
  };
  DisjointSets tied(starts.size());
  for (const int dof : related_dofs) {
    int first = -1;
    reduction.for_each_unknown(dof, [&](int unknown, double) {
      const int position = positions[static_cast<std::size_t>(unknown)];
      if (first >= 0)
        tied.join(body_of(first), body_of(position));
      first = position;
    });
  }
  std::vector<std::size_t> bodies(dofs_.size());
  for (std::size_t i = 0; i < bodies.size(); ++i)
    bodies[i] = tied.root(body_of(static_cast<int>(i)));
  return bodies;
}

void Compliance::relate(const constraint::Reduction& reduction, std::span<const int> related_dofs) {
  const auto bodies = bodies_of(reduction, related_dofs);
  const auto positions = positions_of_unknowns(unknowns_.solver().surface(), reduction.unknown_count());
  struct Placed {
    std::size_t body;
    int dof;
  };
  std::vector<Placed> placed;
  for (std::size_t i = 0; i < dofs_.size(); ++i)
    placed.push_back({bodies[i], dofs_[i]});
  for (const int dof : related_dofs) {
    std::size_t body = 0;
    reduction.for_each_unknown(dof, [&](int unknown, double) {
      body = bodies[static_cast<std::size_t>(positions[static_cast<std::size_t>(unknown)])];
    });
    placed.push_back({body, dof});
  }
  std::ranges::stable_sort(placed, {}, &Placed::body);
  auto& related = related_.emplace();
  related.rows.resize(static_cast<Index>(placed.size()), unknowns_.size());
  std::vector<Eigen::Triplet<double, int>> entries;
  dofs_.clear();
  for (const auto& [body, dof] : placed) {
    const auto row = static_cast<int>(dofs_.size());
    if (row == 0 || body != placed[static_cast<std::size_t>(row) - 1].body)
      related.starts.push_back(row);
    dofs_.push_back(dof);
    reduction.for_each_unknown(dof, [&, row](int unknown, double coefficient) {
      entries.emplace_back(row, positions[static_cast<std::size_t>(unknown)], coefficient);
    });
  }
  related.starts.push_back(static_cast<int>(dofs_.size()));
  related.rows.setFromTriplets(entries.begin(), entries.end());
}

VectorXd Compliance::surface_of(const VectorXd& half_way) const {
  VectorXd moved = unknowns_.solver().surface_of(half_way);
  if (!related_)
    return moved;
  VectorXd of_dofs = VectorXd::Zero(related_->rows.rows());
  add_rows(related_->rows, moved, of_dofs);
  return of_dofs;
}

void Compliance::load_surface(const VectorXd& force, VectorXd& half_way) const {
  unknowns_.solver().load_surface(related_ ? transposed_product(related_->rows, force) : force, half_way);
}

MatrixXd Compliance::between(std::span<const int> interface_dofs) {
  if (!related_)
    return unknowns_.between(interface_dofs);
  MatrixXd s;
  within_body(interface_dofs, s);
  return s;
}

/// B_d S_u B_dᵀ with the positions that the rows of B have.
void Compliance::within_body(std::span<const int> interface_dofs, MatrixXd& s) {
  if (!related_)
    return unknowns_.within_body(interface_dofs, s);
  std::vector<int> positions;
  for (const int i : interface_dofs)
    for (Rows::InnerIterator entry(related_->rows, i); entry; ++entry)
      positions.push_back(entry.col());
  std::ranges::sort(positions);
  positions.erase(std::unique(positions.begin(), positions.end()), positions.end());
  std::vector<Eigen::Triplet<double, int>> entries;
  for (std::size_t k = 0; k < interface_dofs.size(); ++k)
    for (Rows::InnerIterator entry(related_->rows, interface_dofs[k]); entry; ++entry)
      entries.emplace_back(
          static_cast<int>(k),
          static_cast<int>(std::ranges::lower_bound(positions, entry.col()) - positions.begin()),
          entry.value());
  Rows rows(static_cast<Index>(interface_dofs.size()), static_cast<Index>(positions.size()));
  rows.setFromTriplets(entries.begin(), entries.end());
  s = between_rows(rows, unknowns_.between(positions));
}

MatrixXd Compliance::between_forces(const linalg::SparseMatrix& forces) const {
  if (!related_)
    return unknowns_.between_forces(forces);
  return unknowns_.between_forces(transposed_product(related_->rows, forces));
}

void Compliance::add(double factor, const VectorXd& force, VectorXd& d) {
  if (!related_)
    return unknowns_.add(factor, force, d);
  VectorXd moved = VectorXd::Zero(unknowns_.size());
  unknowns_.add(factor, transposed_product(related_->rows, force), moved);
  add_rows(related_->rows, moved, d);
}

void Compliance::add(double factor, std::span<const ForceAt> force, VectorXd& d) {
  if (!related_)
    return unknowns_.add(factor, force, d);
  VectorXd of_all = VectorXd::Zero(size());
  for (const auto& at : force)
    of_all[at.interface_dof] += at.force;
  add(factor, of_all, d);
}

double Compliance::own(int interface_dof) {
  if (!related_)
    return unknowns_.own(interface_dof);
  MatrixXd s;
  within_body(std::array{interface_dof}, s);
  return s(0, 0);
}

} // namespace rubato::step
