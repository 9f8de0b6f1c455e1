// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/model/gauges.hpp"

#include "rubato/contact/small_vectors.hpp"
#include "rubato/core/naming.hpp"
#include "rubato/linalg/dense_decompositions.hpp"
#include "rubato/linalg/dense_products.hpp"
#include "rubato/linalg/ranked_matrix.hpp"
#include "rubato/linalg/sparse_sum.hpp"
#include "rubato/model/build.hpp"
#include "rubato/model/model.hpp"
#include "rubato/model/neutral_motions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace rubato::model {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// Nodes of a gauge: few, as they are all coupled, but enough that none carries much.
constexpr std::size_t node_count = 8;

std::vector<mesh::NodeIndex> nodes_of(const Model& model, const Bodies& bodies, int body) {
  std::vector<mesh::NodeIndex> nodes;
  std::ranges::copy_if(model.dofs.nodes, std::back_inserter(nodes),
                       [&](mesh::NodeIndex node) { return bodies.of(node) == body; });
  return nodes;
}

/// Each next one as far from the others as can be.
std::vector<mesh::NodeIndex> spread_out(const mesh::Mesh& mesh, std::span<const mesh::NodeIndex> nodes) {
  const auto place = [&](mesh::NodeIndex node) -> const Vector3d& {
    return mesh.points[static_cast<std::size_t>(node)];
  };
  std::vector<double> distance(nodes.size(), std::numeric_limits<double>::infinity());
  std::vector<mesh::NodeIndex> chosen{nodes.front()};
  while (chosen.size() < std::min(node_count, nodes.size())) {
    for (std::size_t i = 0; i < nodes.size(); ++i)
      distance[i] = std::min(
          distance[i], contact::length_of(contact::difference_of(place(nodes[i]), place(chosen.back()))));
    chosen.push_back(nodes[static_cast<std::size_t>(std::ranges::max_element(distance) - distance.begin())]);
  }
  return chosen;
}

double length_of_column(const MatrixXd& matrix, Index column) {
  double sum = 0;
  for (Index i = 0; i < matrix.rows(); ++i)
    sum += matrix(i, column) * matrix(i, column);
  return std::sqrt(sum);
}

/// A column in its direction, of length 1; 0 where it is 0.
VectorXd unit_column(const MatrixXd& matrix, Index column) {
  const double length = length_of_column(matrix, column);
  VectorXd unit(matrix.rows());
  for (Index i = 0; i < matrix.rows(); ++i)
    unit[i] = length > 0 ? matrix(i, column) / length : matrix(i, column);
  return unit;
}

void set_column(MatrixXd& matrix, Index column, const VectorXd& values) {
  std::copy(values.begin(), values.end(), &matrix(0, column));
}

/// What some nodes move by in each motion, a column of length 1 each, node by node.
MatrixXd moves_of(const Model& model, const RigidMotions& rigid, std::span<const RigidMotion> motions,
                  std::span<const mesh::NodeIndex> nodes) {
  const int components = model.dofs.components;
  MatrixXd moves(static_cast<Index>(nodes.size()) * components, static_cast<Index>(motions.size()));
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (std::size_t k = 0; k < motions.size(); ++k) {
      const auto moved = rigid.at(motions[k], model.mesh.points[static_cast<std::size_t>(nodes[i])]);
      for (int a = 0; a < components; ++a)
        moves(static_cast<Index>(i) * components + a, static_cast<Index>(k)) = moved[a];
    }
  for (Index k = 0; k < moves.cols(); ++k)
    set_column(moves, k, unit_column(moves, k));
  return moves;
}

/// Columns that span what some have beside others, the largest first.
MatrixXd beside(const MatrixXd& others, MatrixXd columns) {
  const MatrixXd all = columns;
  MatrixXd chosen(columns.rows(), columns.cols() - others.cols());
  const auto take_out = [&](const VectorXd& direction) {
    const auto parts = linalg::transposed_product(columns, direction);
    for (Index j = 0; j < columns.cols(); ++j)
      for (Index i = 0; i < columns.rows(); ++i)
        columns(i, j) -= direction[i] * parts[j];
  };
  const MatrixXd basis = linalg::orthogonal_factor(others);
  for (Index k = 0; k < others.cols(); ++k)
    take_out(unit_column(basis, k));
  for (Index k = 0; k < chosen.cols(); ++k) {
    Index largest = 0;
    for (Index j = 1; j < columns.cols(); ++j)
      if (length_of_column(columns, j) > length_of_column(columns, largest))
        largest = j;
    std::copy_n(&all(0, largest), all.rows(), &chosen(0, k));
    take_out(unit_column(columns, largest));
  }
  return chosen;
}

/// g, a column each: gᵀ is 1 on its neutral motion, 0 on the other ones and on all motions that are left.
MatrixXd gauges_of(const MatrixXd& neutral, const MatrixXd& rigid) {
  MatrixXd motions(neutral.rows(), rigid.cols());
  const auto others = beside(neutral, rigid);
  std::copy_n(neutral.data(), neutral.size(), motions.data());
  std::copy_n(others.data(), others.size(), motions.data() + neutral.size());
  const auto gram = linalg::transposed_product(motions, motions);
  return linalg::product(motions,
                         linalg::solve_symmetric(gram, MatrixXd::Identity(gram.rows(), neutral.cols())));
}

std::string note_on(const Model& model, const RigidMotions& rigid, std::span<const RigidMotion> neutral) {
  std::vector<std::string> directions;
  std::ranges::transform(neutral, std::back_inserter(directions), &direction_text);
  return fmt::format(
      "{} can move {} and nothing resists: its contact surfaces are carried into themselves without "
      "friction, "
      "and no load works on it; this motion is held at zero in the mean; a support across on one node, or "
      "friction, says what holds it",
      body_text(model, rigid.bodies(), neutral.front().body), joined(directions, ", "));
}

std::vector<Gauge> gauges_of_body(const Model& model, const RigidMotions& rigid,
                                  std::span<const RigidMotion> neutral) {
  const auto body = neutral.front().body;
  const auto nodes = spread_out(model.mesh, nodes_of(model, rigid.bodies(), body));
  const MatrixXd g =
      gauges_of(moves_of(model, rigid, neutral, nodes), moves_of(model, rigid, rigid.all_of(body), nodes));
  std::vector<Gauge> gauges;
  for (Index k = 0; k < g.cols(); ++k)
    gauges.push_back({nodes, Eigen::Map<const VectorXd>(&g(0, k), g.rows())});
  return gauges;
}

double stiffness_of(const Model& model, const Gauge& gauge, const Eigen::VectorXd& diagonal) {
  double sum = 0;
  for (const auto node : gauge.nodes)
    for (int i = 0; i < model.dofs.components; ++i)
      sum += diagonal[model.dofs.dof(node, i)];
  const double largest = linalg::largest_magnitude(gauge.values);
  return sum / static_cast<double>(gauge.values.size()) / (largest * largest);
}

} // namespace

std::vector<Gauge> make_gauges(const Model& model, std::vector<std::string>& notes) {
  RigidMotions rigid(model);
  rigid.add_firm_supports();
  const auto neutral = neutral_motions(model, rigid);
  std::vector<Gauge> gauges;
  for (std::size_t first = 0; first < neutral.size();) {
    std::size_t last = first;
    while (last < neutral.size() && neutral[last].body == neutral[first].body)
      ++last;
    const auto of_body = std::span(neutral).subspan(first, last - first);
    std::ranges::move(gauges_of_body(model, rigid, of_body), std::back_inserter(gauges));
    notes.push_back(note_on(model, rigid, of_body));
    first = last;
  }
  return gauges;
}

void add_gauges(const Model& model, SparseMatrix& stiffness) {
  if (model.gauges.empty())
    return;
  const auto diagonal = linalg::diagonal_of(stiffness, model.sharing());
  if (!model.sharing().is_first())
    return;
  std::vector<Eigen::Triplet<double, int>> entries;
  const int components = model.dofs.components;
  for (const auto& gauge : model.gauges) {
    const double k = stiffness_of(model, gauge, diagonal);
    const auto dof = [&](Index i) {
      return model.dofs.dof(gauge.nodes[static_cast<std::size_t>(i / components)],
                            static_cast<int>(i % components));
    };
    for (Index column = 0; column < gauge.values.size(); ++column)
      for (Index row = 0; row < gauge.values.size(); ++row)
        entries.emplace_back(dof(row), dof(column), k * gauge.values[row] * gauge.values[column]);
  }
  SparseMatrix springs(stiffness.rows(), stiffness.cols());
  springs.setFromTriplets(entries.begin(), entries.end());
  linalg::add_scaled(1, springs, stiffness);
}

} // namespace rubato::model
