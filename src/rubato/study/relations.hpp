// SPDX-License-Identifier: LGPL-3.0-or-later
/// What ties displacements to one another, exactly and at every instant: linear equations.
#pragma once

#include "rubato/study/values.hpp"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace rubato::study {

/// Σ coefficient · displacement component of one node.
struct RelationTerm {
  std::string on; ///< a node, or a group of one
  std::array<double, 3> coefficients{};
  bool operator==(const RelationTerm&) const = default;
};

enum class RelationKind {
  equation,    ///< Σ coefficient · displacement = value
  equal,       ///< the nodes of a group have the same displacement
  pairs,       ///< two groups node by node: displacements differ by what is given
  rigid,       ///< the nodes of a group move as a rigid body, small rotations
  distributed, ///< a reference moves as the nodes of a group do in the mean
  embedded     ///< nodes, or a reference, move with the cells they lie in
};

struct Relation {
  std::string name;
  RelationKind kind = RelationKind::equation;
  std::vector<RelationTerm> terms;                  ///< equation
  Field value;                                      ///< equation: of the sum
  std::string on;                                   ///< group of the others; embedded: none with `at`
  std::string with;                                 ///< pairs: the other group
  std::array<bool, 3> components{true, true, true}; ///< equal, pairs: the ones meant; 2D has no third
  std::array<Field, 3> difference; ///< pairs: displacement of `on` less that of `with` [length]
  std::string cells;               ///< embedded: group of the cells; empty: all
  /// Place of the reference. rigid, distributed: the mean of the group's nodes when not given.
  std::optional<std::array<double, 3>> at;
  bool operator==(const Relation&) const = default;
};

/// Whether references of this kind have a rotation beside their displacement.
constexpr bool has_rotation(RelationKind kind) {
  return kind == RelationKind::rigid || kind == RelationKind::distributed;
}

/// Whether the relation's name stands for a point: supports hold it, forces and moments act on it, probes ask
/// for it.
inline bool has_reference(const Relation& relation) {
  return has_rotation(relation.kind) || (relation.kind == RelationKind::embedded && relation.at.has_value());
}

} // namespace rubato::study
