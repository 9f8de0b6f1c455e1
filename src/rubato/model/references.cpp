// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/model/references.hpp"

#include "rubato/linalg/dense_decompositions.hpp"
#include "rubato/mesh/names.hpp"
#include "rubato/model/build.hpp"
#include "rubato/model/embedding.hpp"
#include "rubato/study/words.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

namespace rubato::model {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;

/// Eigenvalues of RᵀR below this part of the largest belong to rotations that the nodes do not tell.
constexpr double told_rotation = 1e-10;

Index rotations_of(int components) {
  return components == 3 ? 3 : 1;
}

/// (RᵀR)⁺ Rᵀ, rotations per radian.
void fit(const mesh::Mesh& mesh, int components, Reference& reference) {
  const MatrixXd rigid = rigid_motions_of(reference, mesh, components);
  const auto [values, vectors] = linalg::symmetric_eigen(MatrixXd(rigid.transpose() * rigid));
  const double least = told_rotation * values[values.size() - 1];
  Eigen::VectorXd inverse = Eigen::VectorXd::Zero(values.size());
  for (Index k = 0; k < values.size(); ++k)
    if (values[k] > least)
      inverse[k] = 1 / values[k];
  reference.turns = (values.array() > least).all();
  reference.motion = vectors * inverse.asDiagonal() * vectors.transpose() * rigid.transpose();
  reference.motion.bottomRows(rotations_of(components)) /= reference.size;
}

std::vector<int> dofs_of(std::span<const mesh::NodeIndex> nodes, const domain::DofMap& dofs) {
  std::vector<int> all;
  for (const auto node : nodes)
    for (int i = 0; i < dofs.components; ++i)
      all.push_back(dofs.dof(node, i));
  return all;
}

double size_of(const mesh::Mesh& mesh, const Reference& reference) {
  double size = 0;
  for (const auto node : reference.nodes)
    size = std::max(size, (mesh.points[static_cast<std::size_t>(node)] - reference.place).norm());
  return size > 0 ? size : 1;
}

/// A place in a cell has a displacement alone.
std::optional<Reference> embedded_reference(const study::Relation& relation, const std::string& path,
                                            const mesh::Mesh& mesh, const domain::DofMap& dofs,
                                            std::vector<Fault>& faults) {
  const auto cells = host_cells(mesh, dofs.components, {relation.cells, path + ".in"}, faults);
  if (cells.empty())
    return std::nullopt;
  Reference reference;
  reference.name = relation.name;
  reference.place = Vector3d(relation.at->at(0), relation.at->at(1), relation.at->at(2));
  const auto found = cell_at(mesh::PlaceFinder(mesh, cells), reference.place);
  if (!found) {
    faults.push_back(fault_at(path + ".at",
                              fmt::format("({:.6g}, {:.6g}, {:.6g}) lies in no cell{}", reference.place[0],
                                          reference.place[1], reference.place[2], of_group(relation.cells))));
    return std::nullopt;
  }
  reference.nodes = found->nodes;
  reference.dofs = dofs_of(reference.nodes, dofs);
  reference.size = size_of(mesh, reference);
  reference.turns = false;
  reference.motion = MatrixXd::Zero(dofs.components + rotations_of(dofs.components),
                                    static_cast<Index>(reference.dofs.size()));
  for (std::size_t n = 0; n < found->weights.size(); ++n)
    for (int i = 0; i < dofs.components; ++i)
      reference.motion(i, static_cast<Index>(n) * dofs.components + i) = found->weights[n];
  return reference;
}

} // namespace

Vector3d mean_place(const mesh::Mesh& mesh, std::span<const mesh::NodeIndex> nodes) {
  Vector3d sum = Vector3d::Zero();
  for (const auto node : nodes)
    sum += mesh.points[static_cast<std::size_t>(node)];
  return sum / static_cast<double>(nodes.size());
}

MatrixXd rigid_motions_of(const Reference& reference, const mesh::Mesh& mesh, int components) {
  const Index rotations = rotations_of(components);
  MatrixXd rigid(static_cast<Index>(reference.dofs.size()), components + rotations);
  for (std::size_t n = 0; n < reference.nodes.size(); ++n) {
    const Vector3d arm =
        (mesh.points[static_cast<std::size_t>(reference.nodes[n])] - reference.place) / reference.size;
    auto rows = rigid.middleRows(static_cast<Index>(n) * components, components);
    rows.leftCols(components).setIdentity();
    for (Index k = 0; k < rotations; ++k) {
      const Vector3d axis = Vector3d::Unit(components == 3 ? k : 2);
      rows.col(components + k) = axis.cross(arm).head(components);
    }
  }
  return rigid;
}

std::vector<Reference> make_references(const study::Study& study, const mesh::Mesh& mesh,
                                       const domain::DofMap& dofs, std::vector<Fault>& faults) {
  std::vector<Reference> references;
  for (const auto& relation : study.relations) {
    if (!study::has_reference(relation))
      continue;
    const auto path =
        fmt::format("relations.{}.{}", relation.name, study::word_of(study::relation_words, relation.kind));
    if (!mesh::find_nodes(mesh, relation.name).nodes.empty())
      faults.push_back(
          fault_at("relations." + relation.name,
                   fmt::format("'{}' is a name of the mesh already, expected another name for the reference",
                               relation.name)));
    if (relation.kind == study::RelationKind::embedded) {
      if (auto reference = embedded_reference(relation, path, mesh, dofs, faults))
        references.push_back(std::move(*reference));
      continue;
    }
    Reference reference;
    reference.name = relation.name;
    reference.nodes = body_nodes_or_fault(mesh, dofs, Mention{relation.on, path + ".on"}, "to move", faults);
    if (reference.nodes.empty())
      continue;
    reference.place = relation.at ? Vector3d(relation.at->at(0), relation.at->at(1), relation.at->at(2))
                                  : mean_place(mesh, reference.nodes);
    reference.dofs = dofs_of(reference.nodes, dofs);
    reference.size = size_of(mesh, reference);
    fit(mesh, dofs.components, reference);
    if (!reference.turns && relation.at)
      faults.push_back(fault_at(path + ".at",
                                fmt::format("the nodes of '{}' lie on a line or in a point, which tells "
                                            "no motion of a place beside it; expected no 'at', or a group of "
                                            "nodes that span more",
                                            relation.on)));
    references.push_back(std::move(reference));
  }
  return references;
}

const Reference* reference_named(std::span<const Reference> references, const std::string& name) {
  const auto found = std::ranges::find(references, name, &Reference::name);
  return found == references.end() ? nullptr : &*found;
}

} // namespace rubato::model
