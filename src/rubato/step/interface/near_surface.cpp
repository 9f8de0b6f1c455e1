// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/interface/near_surface.hpp"

#include "rubato/linalg/sparse_products.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace rubato::step {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using Triplets = std::vector<Eigen::Triplet<double, int>>;

/// Unknowns that are taken, and the place of each of all unknowns among them: −1 of others.
struct NearUnknowns {
  std::vector<int> taken;
  std::vector<int> place;

  void take(int unknown) {
    if (auto& at = place[static_cast<std::size_t>(unknown)]; at < 0) {
      at = static_cast<int>(taken.size());
      taken.push_back(unknown);
    }
  }
};

/// Those of the points.
NearUnknowns near_unknowns(const linalg::SparseMatrix& matrix, const Compliance& compliance,
                           std::span<const ActivePoint> points) {
  NearUnknowns near{{}, std::vector<int>(static_cast<std::size_t>(matrix.cols()), -1)};
  for (const auto& point : points)
    for (const int at : point.interface_dofs)
      compliance.for_each_unknown(at, [&](int unknown, double) { near.take(unknown); });
  return near;
}

void add_bulk(const linalg::SparseMatrix& matrix, const NearUnknowns& near, Triplets& entries) {
  for (std::size_t column = 0; column < near.taken.size(); ++column)
    for (linalg::SparseMatrix::InnerIterator entry(matrix, near.taken[column]); entry; ++entry)
      if (const int row = near.place[static_cast<std::size_t>(entry.row())]; row >= 0)
        entries.emplace_back(row, static_cast<int>(column), entry.value());
}

/// Entries of both matrices that a point has. `first`: of its components among the rows of `whole`.
void add_point(const ActivePoint& point, int first, const Compliance& compliance, const NearUnknowns& near,
               double force_weight, Triplets& whole, Triplets& slopes) {
  const int d = point.components();
  for (int i = 0; i < d; ++i)
    for (int j = 0; j < d; ++j)
      if (point.by_force(i, j) != 0)
        whole.emplace_back(first + i, first + j, point.by_force(i, j));
  for (std::size_t q = 0; q < point.interface_dofs.size(); ++q)
    compliance.for_each_unknown(point.interface_dofs[q], [&](int unknown, double coefficient) {
      const int at = near.place[static_cast<std::size_t>(unknown)];
      const double* const sees = &point.rows.left(0, static_cast<Index>(q));
      const double* const pushes = &point.rows.right(0, static_cast<Index>(q));
      for (int i = 0; i < d; ++i) {
        if (sees[i] != 0)
          whole.emplace_back(first + i, at, coefficient * sees[i]);
        if (pushes[i] != 0)
          whole.emplace_back(at, first + i, force_weight * coefficient * pushes[i]);
      }
      for (int i = 0; i < point.n_xi(); ++i)
        slopes.emplace_back(static_cast<int>(point.first_slope) + i, at, -coefficient * sees[d + i]);
    });
}

} // namespace

std::optional<NearSurface> NearSurface::of(const linalg::SparseMatrix& matrix, const Compliance& compliance,
                                           std::span<const ActivePoint> points, double force_weight) {
  const auto near = near_unknowns(matrix, compliance, points);
  const auto bulk = static_cast<int>(near.taken.size());
  int forces = 0;
  int slopes = 0;
  Triplets of_whole, of_slopes;
  add_bulk(matrix, near, of_whole);
  for (const auto& point : points) {
    add_point(point, bulk + static_cast<int>(point.first), compliance, near, force_weight, of_whole,
              of_slopes);
    forces += point.components();
    slopes += point.n_xi();
  }
  linalg::SparseMatrix whole(bulk + forces, bulk + forces);
  whole.setFromTriplets(of_whole.begin(), of_whole.end());
  linalg::SparseMatrix by_displacement(slopes, bulk);
  by_displacement.setFromTriplets(of_slopes.begin(), of_slopes.end());
  auto factor = linalg::LuFactor::of(whole);
  if (!factor)
    return std::nullopt;
  return NearSurface(std::move(*factor), by_displacement);
}

VectorXd NearSurface::solve(const VectorXd& left) const {
  const Index near = slopes_.cols();
  const Index slopes = slopes_.rows();
  const Index forces = left.size() - slopes;
  VectorXd right = VectorXd::Zero(near + forces);
  std::copy_n(left.data(), forces, right.data() + near);
  const VectorXd found = factor_.solve(right);
  VectorXd moved(near), change(left.size());
  std::copy_n(found.data(), near, moved.data());
  std::copy_n(found.data() + near, forces, change.data());
  const VectorXd turned = linalg::product(slopes_, moved);
  for (Index k = 0; k < slopes; ++k)
    change[forces + k] = left[forces + k] + turned[k];
  return change;
}

} // namespace rubato::step
