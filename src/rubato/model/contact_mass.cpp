// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/model/contact_mass.hpp"

#include "rubato/core/error.hpp"
#include "rubato/linalg/dense_decompositions.hpp"
#include "rubato/linalg/dense_products.hpp"
#include "rubato/linalg/sparse_products.hpp"
#include "rubato/model/bodies.hpp"
#include "rubato/model/model.hpp"
#include "rubato/model/node_label.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace rubato::model {
namespace {

using domain::SparseMatrix;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Rounds of Newton's method, which is quadratic from the factor that keeps the mass.
constexpr int newton_rounds = 20;
/// Moments that count as kept, relative.
constexpr double kept_moments = 1e-14;
/// Factor of a node beyond which moments are not worth it: 4 in its mass.
constexpr double most_change = 2;

/// One entry of m: two numbered nodes and what stands between them.
struct Entry {
  int row = 0;
  int column = 0;
  double value = 0;
};

/// Calls `visit` with every entry of m, the mass of one direction.
template <class Visit> void for_each_entry(const SparseMatrix& mass, int components, Visit visit) {
  for (Index column = 0; column < mass.outerSize(); column += components)
    for (SparseMatrix::InnerIterator entry(mass, column); entry; ++entry)
      if (entry.row() % components == 0)
        visit(Entry{static_cast<int>(entry.row()) / components, static_cast<int>(column) / components,
                    entry.value()});
}

/// A body that loses the mass of its surface.
struct Body {
  std::vector<int> nodes; ///< numbered ones
  SparseMatrix before;    ///< m of those nodes
  SparseMatrix inside;    ///< the same without what its massless nodes have
  MatrixXd positions;     ///< 1, x, y, z of each node, from the middle of the body in units of its size
};

MatrixXd positions_of(const mesh::Mesh& mesh, const domain::DofMap& dofs, const std::vector<int>& nodes) {
  const auto place = [&](std::size_t i) {
    return mesh.points[static_cast<std::size_t>(dofs.nodes[static_cast<std::size_t>(nodes[i])])].data();
  };
  const auto axes = static_cast<std::size_t>(mesh.dimension);
  std::array<double, 3> low{place(0)[0], place(0)[1], place(0)[2]};
  auto high = low;
  for (std::size_t i = 1; i < nodes.size(); ++i)
    for (std::size_t axis = 0; axis < axes; ++axis) {
      low[axis] = std::min(low[axis], place(i)[axis]);
      high[axis] = std::max(high[axis], place(i)[axis]);
    }
  double size = 0;
  for (std::size_t axis = 0; axis < axes; ++axis)
    size = std::max(size, high[axis] - low[axis]);
  MatrixXd positions = MatrixXd::Ones(static_cast<Index>(nodes.size()), mesh.dimension + 1);
  for (std::size_t axis = 0; axis < axes; ++axis)
    for (std::size_t i = 0; i < nodes.size(); ++i)
      positions(static_cast<Index>(i), static_cast<Index>(axis) + 1) =
          (place(i)[axis] - 0.5 * (low[axis] + high[axis])) / size;
  return positions;
}

Body take_body(const mesh::Mesh& mesh, const domain::DofMap& dofs, const SparseMatrix& mass,
               std::vector<int> nodes, const std::vector<char>& massless) {
  std::vector<int> place(dofs.nodes.size(), -1);
  for (std::size_t i = 0; i < nodes.size(); ++i)
    place[static_cast<std::size_t>(nodes[i])] = static_cast<int>(i);
  std::vector<Eigen::Triplet<double, int>> all;
  std::vector<Eigen::Triplet<double, int>> inside;
  for_each_entry(mass, dofs.components, [&](const Entry& entry) {
    const auto row = static_cast<std::size_t>(entry.row);
    const auto column = static_cast<std::size_t>(entry.column);
    if (place[row] < 0)
      return;
    all.emplace_back(place[row], place[column], entry.value);
    if (massless[row] == 0 && massless[column] == 0)
      inside.push_back(all.back());
  });
  const auto size = static_cast<Index>(nodes.size());
  Body body;
  body.before.resize(size, size);
  body.before.setFromTriplets(all.begin(), all.end());
  body.inside.resize(size, size);
  body.inside.setFromTriplets(inside.begin(), inside.end());
  body.positions = positions_of(mesh, dofs, nodes);
  body.nodes = std::move(nodes);
  return body;
}

/// Products of `count` columns with each other, one column a pair.
MatrixXd products_of(const MatrixXd& columns, Index count) {
  MatrixXd products(columns.rows(), count * (count + 1) / 2);
  Index next = 0;
  for (Index p = 0; p < count; ++p)
    for (Index q = p; q < count; ++q)
      for (Index i = 0, pair = next++; i < columns.rows(); ++i)
        products(i, pair) = columns(i, p) * columns(i, q);
  return products;
}

double dot(const double* a, const double* b, Index size) {
  double sum = 0;
  for (Index i = 0; i < size; ++i)
    sum += a[i] * b[i];
  return sum;
}

/// Σ m_ij p_i q_j of every pair of the first `count` columns of `columns`.
VectorXd moments_of(const SparseMatrix& mass, const MatrixXd& columns, Index count) {
  VectorXd moments(count * (count + 1) / 2);
  Index next = 0;
  const auto weighed = linalg::product(mass, columns);
  for (Index p = 0; p < count; ++p)
    for (Index q = p; q < count; ++q)
      moments[next++] = dot(&weighed(0, p), &columns(0, q), columns.rows());
  return moments;
}

/// Of each node d_i 1, x, y, z.
MatrixXd scaled_by(const VectorXd& factors, const MatrixXd& columns, Index count) {
  MatrixXd scaled(columns.rows(), count);
  for (Index p = 0; p < count; ++p)
    for (Index i = 0; i < columns.rows(); ++i)
      scaled(i, p) = factors[i] * columns(i, p);
  return scaled;
}

/// How the moments change with the coefficients of the polynomial.
MatrixXd slope_of(const MatrixXd& columns, const MatrixXd& weighed, const MatrixXd& basis) {
  MatrixXd slope(basis.cols(), basis.cols());
  std::vector<double> gradient(static_cast<std::size_t>(columns.rows()));
  Index row = 0;
  for (Index p = 0; p < weighed.cols(); ++p)
    for (Index q = p; q < weighed.cols(); ++q, ++row) {
      for (Index i = 0; i < columns.rows(); ++i)
        gradient[static_cast<std::size_t>(i)] = columns(i, p) * weighed(i, q) + columns(i, q) * weighed(i, p);
      for (Index k = 0; k < basis.cols(); ++k)
        slope(row, k) = dot(gradient.data(), &basis(0, k), columns.rows());
    }
  return slope;
}

bool are_moderate(const VectorXd& factors) {
  return std::all_of(factors.begin(), factors.end(),
                     [](double factor) { return factor > 1 / most_change && factor < most_change; });
}

/// Factors d with which d_i m_ij d_j has the moments of the first `count` columns of 1, x, y, z: the product
/// of a polynomial's values, found by Newton's method from the factor that keeps the mass. Nothing comes back
/// when there are none that are positive and moderate.
std::optional<VectorXd> factors_of(const Body& body, Index count) {
  const auto& x = body.positions;
  const VectorXd wanted = moments_of(body.before, x, count);
  const double carried = moments_of(body.inside, scaled_by(VectorXd::Ones(x.rows()), x, 1), 1)[0];
  if (!(carried > 0))
    return std::nullopt;
  const MatrixXd basis = products_of(x, count);
  VectorXd factors = VectorXd::Constant(x.rows(), std::sqrt(wanted[0] / carried));
  for (int round = 0; round < newton_rounds; ++round) {
    const auto scaled = scaled_by(factors, x, count);
    const VectorXd missing = wanted - moments_of(body.inside, scaled, count);
    if (missing.norm() <= kept_moments * wanted.norm())
      return count == 1 || are_moderate(factors) ? std::optional(factors) : std::nullopt;
    const auto slope = slope_of(x, linalg::product(body.inside, scaled), basis);
    linalg::add_product(basis, linalg::least_norm_solution(slope, missing), factors);
  }
  return std::nullopt;
}

} // namespace

VectorXd mass_factors(const mesh::Mesh& mesh, const domain::Bulk& bulk, const domain::DofMap& dofs,
                      std::span<const mesh::NodeIndex> massless, const SparseMatrix& mass) {
  VectorXd all = VectorXd::Ones(static_cast<Index>(dofs.nodes.size()));
  const Bodies bodies(mesh, bulk);
  std::vector<char> is_massless(dofs.nodes.size(), 0);
  std::vector<std::vector<int>> nodes_of(static_cast<std::size_t>(bodies.count()));
  std::vector<char> loses(nodes_of.size(), 0);
  for (const auto node : massless) {
    is_massless[static_cast<std::size_t>(dofs.dof(node, 0) / dofs.components)] = 1;
    loses[static_cast<std::size_t>(bodies.of(node))] = 1;
  }
  for (std::size_t i = 0; i < dofs.nodes.size(); ++i)
    if (const int body = bodies.of(dofs.nodes[i]); body >= 0)
      nodes_of[static_cast<std::size_t>(body)].push_back(static_cast<int>(i));
  for (std::size_t b = 0; b < nodes_of.size(); ++b) {
    if (loses[b] == 0)
      continue;
    const auto body = take_body(mesh, dofs, mass, std::move(nodes_of[b]), is_massless);
    const std::span entries(body.before.valuePtr(), static_cast<std::size_t>(body.before.nonZeros()));
    if (!(std::accumulate(entries.begin(), entries.end(), 0.0) > 0))
      continue; // held whole, of density 0
    // Thin bodies have no places for moments of their depth: they keep their mass alone.
    auto factors = factors_of(body, mesh.dimension + 1);
    if (!factors)
      factors = factors_of(body, 1);
    if (!factors)
      throw InputError(
          fmt::format("contact_mass: the body around {} has no nodes but on its contact surface, nothing "
                      "could carry their mass; expected more cells or consistent",
                      node_label(mesh, bodies.first_node(static_cast<int>(b)))));
    for (std::size_t i = 0; i < body.nodes.size(); ++i) {
      const int node = body.nodes[i];
      all[node] = is_massless[static_cast<std::size_t>(node)] != 0 ? 0 : (*factors)[static_cast<Index>(i)];
    }
  }
  return all;
}

void scale_mass(const VectorXd& factors, int components, SparseMatrix& mass) {
  for (int column = 0; column < mass.outerSize(); ++column)
    for (SparseMatrix::InnerIterator entry(mass, column); entry; ++entry)
      entry.valueRef() *= factors[column / components] * factors[entry.row() / components];
}

} // namespace rubato::model
