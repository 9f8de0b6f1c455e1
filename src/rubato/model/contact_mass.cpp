// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/model/contact_mass.hpp"

#include "rubato/core/error.hpp"
#include "rubato/linalg/dense_decompositions.hpp"
#include "rubato/model/bodies.hpp"
#include "rubato/model/model.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>
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
  MatrixXd x(static_cast<Index>(nodes.size()), mesh.dimension);
  for (std::size_t i = 0; i < nodes.size(); ++i)
    x.row(static_cast<Index>(i)) =
        mesh.points[static_cast<std::size_t>(dofs.nodes[static_cast<std::size_t>(nodes[i])])].head(
            mesh.dimension);
  const Eigen::RowVectorXd low = x.colwise().minCoeff();
  const Eigen::RowVectorXd high = x.colwise().maxCoeff();
  MatrixXd positions(x.rows(), mesh.dimension + 1);
  positions.col(0).setOnes();
  positions.rightCols(mesh.dimension) = (x.rowwise() - 0.5 * (low + high)) / (high - low).maxCoeff();
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
      products.col(next++) = columns.col(p).cwiseProduct(columns.col(q));
  return products;
}

/// Σ m_ij p_i q_j of every pair of the first `count` columns of `columns`.
VectorXd moments_of(const SparseMatrix& mass, const MatrixXd& columns, Index count) {
  VectorXd moments(count * (count + 1) / 2);
  Index next = 0;
  for (Index p = 0; p < count; ++p) {
    const VectorXd weighed = mass * columns.col(p);
    for (Index q = p; q < count; ++q)
      moments[next++] = weighed.dot(columns.col(q));
  }
  return moments;
}

/// Factors d with which d_i m_ij d_j has the moments of the first `count` columns of 1, x, y, z: the product
/// of a polynomial's values, found by Newton's method from the factor that keeps the mass. Nothing comes back
/// when there are none that are positive and moderate.
std::optional<VectorXd> factors_of(const Body& body, Index count) {
  const auto& x = body.positions;
  const VectorXd wanted = moments_of(body.before, x, count);
  const double carried = x.col(0).dot(body.inside * x.col(0));
  if (!(carried > 0))
    return std::nullopt;
  const MatrixXd basis = products_of(x, count);
  VectorXd factors = VectorXd::Constant(x.rows(), std::sqrt(wanted[0] / carried));
  for (int round = 0; round < newton_rounds; ++round) {
    const MatrixXd scaled = factors.asDiagonal() * x.leftCols(count);
    const VectorXd missing = wanted - moments_of(body.inside, scaled, count);
    if (missing.norm() <= kept_moments * wanted.norm()) {
      const bool moderate = factors.minCoeff() > 1 / most_change && factors.maxCoeff() < most_change;
      return count == 1 || moderate ? std::optional(factors) : std::nullopt;
    }
    const MatrixXd weighed = body.inside * scaled;
    MatrixXd slope(wanted.size(), basis.cols());
    Index row = 0;
    for (Index p = 0; p < count; ++p)
      for (Index q = p; q < count; ++q) {
        const VectorXd gradient =
            x.col(p).cwiseProduct(weighed.col(q)) + x.col(q).cwiseProduct(weighed.col(p));
        slope.row(row++) = gradient.transpose() * basis;
      }
    factors += basis * linalg::least_norm_solution(slope, missing);
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
    if (!(body.before.sum() > 0))
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
