// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/model/contact_mass.hpp"

#include "rubato/error.hpp"
#include "rubato/model/model.hpp"

#include <Eigen/QR>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

namespace rubato::model {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using fem::SparseMatrix;

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

/// The body of every numbered node: nodes that share a cell belong together.
std::vector<int> bodies_of(const SparseMatrix& mass, int components, int nodes) {
  std::vector<int> parent(static_cast<std::size_t>(nodes));
  for (int node = 0; node < nodes; ++node)
    parent[static_cast<std::size_t>(node)] = node;
  const auto root = [&](int node) {
    while (parent[static_cast<std::size_t>(node)] != node)
      node = parent[static_cast<std::size_t>(node)] =
          parent[static_cast<std::size_t>(parent[static_cast<std::size_t>(node)])];
    return node;
  };
  for_each_entry(mass, components, [&](const Entry& entry) {
    parent[static_cast<std::size_t>(root(entry.row))] = root(entry.column);
  });
  std::vector<int> body(parent.size());
  for (int node = 0; node < nodes; ++node)
    body[static_cast<std::size_t>(node)] = root(node);
  return body;
}

/// 1, x, y, z of the numbered nodes of a body, counted from its middle in units of its size.
class Monomials {
public:
  Monomials(const mesh::Mesh& mesh, const fem::DofMap& dofs, const std::vector<int>& body, int which)
      : values_(MatrixXd::Zero(static_cast<Index>(dofs.nodes.size()), mesh.dimension + 1)) {
    Eigen::Vector3d low = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
    Eigen::Vector3d high = -low;
    const auto at = [&](std::size_t i) { return mesh.points[static_cast<std::size_t>(dofs.nodes[i])]; };
    for (std::size_t i = 0; i < body.size(); ++i)
      if (body[i] == which)
        for (int axis = 0; axis < 3; ++axis) {
          low[axis] = std::min(low[axis], at(i)[axis]);
          high[axis] = std::max(high[axis], at(i)[axis]);
        }
    const double size = (high - low).maxCoeff();
    for (std::size_t i = 0; i < body.size(); ++i) {
      if (body[i] != which)
        continue;
      const auto row = static_cast<Index>(i);
      values_(row, 0) = 1;
      for (int axis = 0; axis < mesh.dimension; ++axis)
        values_(row, 1 + axis) = (at(i)[axis] - 0.5 * (low[axis] + high[axis])) / size;
    }
  }

  Index products() const { return values_.cols() * (values_.cols() + 1) / 2; }

  /// ½ (p_i q_j + q_i p_j) of every pair p, q.
  VectorXd between(int i, int j) const {
    VectorXd all(products());
    Index next = 0;
    for (Index p = 0; p < values_.cols(); ++p)
      for (Index q = p; q < values_.cols(); ++q)
        all[next++] = 0.5 * (values_(i, p) * values_(j, q) + values_(i, q) * values_(j, p));
    return all;
  }

private:
  MatrixXd values_;
};

/// λ: how the density of a body must change to carry what its massless nodes had.
VectorXd density_change(const SparseMatrix& mass, int components, const std::vector<int>& body, int which,
                        const std::vector<char>& massless, const Monomials& monomials) {
  MatrixXd carried = MatrixXd::Zero(monomials.products(), monomials.products());
  VectorXd lost = VectorXd::Zero(monomials.products());
  for_each_entry(mass, components, [&](const Entry& entry) {
    if (body[static_cast<std::size_t>(entry.row)] != which)
      return;
    const VectorXd products = monomials.between(entry.row, entry.column);
    if (massless[static_cast<std::size_t>(entry.row)] != 0 ||
        massless[static_cast<std::size_t>(entry.column)] != 0)
      lost += entry.value * products;
    else
      carried += entry.value * products * products.transpose();
  });
  // A body that is flat in one direction carries fewer moments than there are equations for them.
  return carried.completeOrthogonalDecomposition().solve(lost);
}

} // namespace

void redistribute_mass(const mesh::Mesh& mesh, const fem::DofMap& dofs,
                       std::span<const mesh::NodeIndex> massless, SparseMatrix& mass) {
  const int components = dofs.components;
  const auto body = bodies_of(mass, components, static_cast<int>(dofs.nodes.size()));
  std::vector<char> is_massless(dofs.nodes.size(), 0);
  std::vector<int> bodies;
  for (const auto node : massless) {
    const auto number = static_cast<std::size_t>(dofs.dof(node, 0) / components);
    is_massless[number] = 1;
    bodies.push_back(body[number]);
  }
  std::ranges::sort(bodies);
  bodies.erase(std::unique(bodies.begin(), bodies.end()), bodies.end());
  for (const int which : bodies) {
    const Monomials monomials(mesh, dofs, body, which);
    const VectorXd change = density_change(mass, components, body, which, is_massless, monomials);
    for (std::size_t i = 0; i < body.size(); ++i)
      if (body[i] == which && is_massless[i] == 0 &&
          1 + change.dot(monomials.between(static_cast<int>(i), static_cast<int>(i))) <= 0)
        throw InputError(fmt::format("contact_mass: the inside of the body around {} cannot carry the mass "
                                     "of its contact surface, it has "
                                     "too few layers of cells; expected a finer mesh or consistent",
                                     node_label(mesh, dofs.nodes[i])));
    for (Index column = 0; column < mass.outerSize(); ++column)
      for (SparseMatrix::InnerIterator entry(mass, column); entry; ++entry) {
        const int row_node = static_cast<int>(entry.row()) / components;
        const int column_node = static_cast<int>(column) / components;
        if (body[static_cast<std::size_t>(row_node)] != which)
          continue;
        const bool off = is_massless[static_cast<std::size_t>(row_node)] != 0 ||
                         is_massless[static_cast<std::size_t>(column_node)] != 0;
        entry.valueRef() *= off ? 0.0 : 1 + change.dot(monomials.between(row_node, column_node));
      }
  }
}

} // namespace rubato::model
