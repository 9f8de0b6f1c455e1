// SPDX-License-Identifier: LGPL-3.0-or-later
/// Where a contact point takes its motion from and puts its force: nodes of both sides and their weights.
#pragma once

#include "rubato/domain/dof_map.hpp"
#include "rubato/mesh/mesh.hpp"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <vector>

namespace rubato::contact {

struct Stencil {
  std::vector<mesh::NodeIndex> nodes; ///< slave's, then master's; an obstacle has none
  Eigen::VectorXd weights;            ///< +N_i on slave nodes, −N_j(ξ̄) on master nodes
  /// Where components have weights of their own, as in a tie: one row a node; else empty.
  Eigen::Matrix<double, Eigen::Dynamic, 3> by_component;
  /// Of a tie over a gap: what the rotation of the gap vector adds at each node, −∂G/∂u; else empty.
  std::vector<Eigen::Matrix3d> turning;
  int components = 3; ///< of displacements and forces

  bool is_uniform() const { return by_component.rows() == 0; }
  double weight(Eigen::Index node, int component) const {
    return is_uniform() ? weights[node] : by_component(node, component);
  }

  /// What component `of` of a node's value counts in component `component` of the sum.
  double weight(Eigen::Index node, int component, int of) const {
    const double own = component == of ? weight(node, component) : 0;
    return turning.empty() ? own : own + turning[static_cast<std::size_t>(node)](component, of);
  }

  int unknowns() const { return static_cast<int>(nodes.size()) * components; }

  /// Σ weight · value(node): of the slave point relative to the place it faces.
  template <class Value> Eigen::Vector3d sum(const Value& value) const {
    Eigen::Vector3d total(0, 0, 0);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const Eigen::Vector3d of_node = value(nodes[i]);
      for (int c = 0; c < 3; ++c)
        total[c] += weight(static_cast<Eigen::Index>(i), c) * of_node[c];
    }
    for (std::size_t i = 0; i < turning.size(); ++i)
      add_turning(i, value(nodes[i]), total);
    return total;
  }

  /// The same of values, one a dof.
  Eigen::Vector3d gather(const Eigen::VectorXd& values, const domain::DofMap& dofs) const {
    Eigen::Vector3d total(0, 0, 0);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const auto first = dofs.dof(nodes[i], 0);
      for (int c = 0; c < components; ++c)
        total[c] += weight(static_cast<Eigen::Index>(i), c) * values[first + c];
    }
    for (std::size_t i = 0; i < turning.size(); ++i)
      add_turning(i, value_at(values, dofs.dof(nodes[i], 0)), total);
    return total;
  }

  /// Adds weight · force at each node to `values`, one a dof.
  void scatter(const Eigen::Vector3d& force, const domain::DofMap& dofs, Eigen::VectorXd& values) const {
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const auto first = dofs.dof(nodes[i], 0);
      for (int c = 0; c < components; ++c)
        values[first + c] += force_on(i, c, force);
    }
  }

  /// The same with dofs numbered anew: `number` tells for each dof its index in `values`, below 0 where it
  /// has none.
  void scatter(const Eigen::Vector3d& force, const domain::DofMap& dofs, const std::vector<int>& number,
               Eigen::VectorXd& values) const {
    for (std::size_t i = 0; i < nodes.size(); ++i)
      for (int c = 0; c < components; ++c)
        if (const int at = number[static_cast<std::size_t>(dofs.dof(nodes[i], c))]; at >= 0)
          values[at] += force_on(i, c, force);
  }

private:
  Eigen::Vector3d value_at(const Eigen::VectorXd& values, int first) const {
    Eigen::Vector3d value(0, 0, 0);
    for (int c = 0; c < components; ++c)
      value[c] = values[first + c];
    return value;
  }
  void add_turning(std::size_t node, const Eigen::Vector3d& value, Eigen::Vector3d& total) const {
    for (int c = 0; c < 3; ++c)
      for (int of = 0; of < 3; ++of)
        total[c] += turning[node](c, of) * value[of];
  }
  double force_on(std::size_t node, int component, const Eigen::Vector3d& force) const {
    const double own = weight(static_cast<Eigen::Index>(node), component) * force[component];
    return turning.empty() ? own : own + turning[node].col(component).dot(force);
  }
};

/// A stencil with the same weights for all components, on dofs that are numbered anew, without nodes that
/// have no weight or no number.
struct NumberedStencil {
  struct Node {
    std::array<int, 3> at{-1, -1, -1}; ///< by component; −1 of those without a number
    double weight = 0;
  };
  std::vector<Node> nodes;

  void take(const Stencil& stencil, const domain::DofMap& dofs, const std::vector<int>& number);
  /// Σ weight · values
  Eigen::Vector3d gather(const Eigen::VectorXd& values) const {
    Eigen::Vector3d total(0, 0, 0);
    for (const auto& node : nodes)
      for (std::size_t c = 0; c < 3; ++c)
        if (const int at = node.at[c]; at >= 0)
          total[static_cast<Eigen::Index>(c)] += node.weight * values[at];
    return total;
  }
  /// Adds weight · force at each node.
  void scatter(const Eigen::Vector3d& force, Eigen::VectorXd& values) const {
    for (const auto& node : nodes)
      for (std::size_t c = 0; c < 3; ++c)
        if (const int at = node.at[c]; at >= 0)
          values[at] += node.weight * force[static_cast<Eigen::Index>(c)];
  }
};

} // namespace rubato::contact
