// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/model/references.hpp"

#include "rubato/contact/small_vectors.hpp"
#include "rubato/linalg/dense_decompositions.hpp"
#include "rubato/linalg/dense_products.hpp"
#include "rubato/mesh/names.hpp"
#include "rubato/model/build.hpp"
#include "rubato/model/embedding.hpp"
#include "rubato/study/words.hpp"

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
  const auto [values, vectors] = linalg::symmetric_eigen(linalg::transposed_product(rigid, rigid));
  const double least = told_rotation * values[values.size() - 1];
  MatrixXd inverse = MatrixXd::Zero(values.size(), values.size());
  reference.turns = true;
  for (Index k = 0; k < values.size(); ++k) {
    reference.turns = reference.turns && values[k] > least;
    if (values[k] > least)
      linalg::add_square(1 / values[k], Eigen::Map<const Eigen::VectorXd>(&vectors(0, k), vectors.rows()),
                         inverse);
  }
  reference.motion = MatrixXd::Zero(values.size(), rigid.rows());
  for (Index d = 0; d < rigid.rows(); ++d)
    for (Index i = 0; i < values.size(); ++i) {
      double& moved = reference.motion(i, d);
      for (Index k = 0; k < values.size(); ++k)
        moved += inverse(i, k) * rigid(d, k);
      if (i >= components)
        moved /= reference.size;
    }
}

std::vector<int> dofs_of(std::span<const mesh::NodeIndex> nodes, const domain::DofMap& dofs) {
  std::vector<int> all;
  for (const auto node : nodes)
    for (int i = 0; i < dofs.components; ++i)
      all.push_back(dofs.dof(node, i));
  return all;
}

double distance(const Vector3d& a, const Vector3d& b) {
  return contact::length_of(contact::difference_of(a, b));
}

double size_of(const mesh::Mesh& mesh, const Reference& reference) {
  double size = 0;
  for (const auto node : reference.nodes)
    size = std::max(size, distance(mesh.points[static_cast<std::size_t>(node)], reference.place));
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
    contact::add_scaled(1, mesh.points[static_cast<std::size_t>(node)], sum);
  for (auto& value : sum)
    value /= static_cast<double>(nodes.size());
  return sum;
}

MatrixXd rigid_motions_of(const Reference& reference, const mesh::Mesh& mesh, int components) {
  const Index rotations = rotations_of(components);
  MatrixXd rigid = MatrixXd::Zero(static_cast<Index>(reference.dofs.size()), components + rotations);
  for (std::size_t n = 0; n < reference.nodes.size(); ++n) {
    Vector3d arm =
        contact::difference_of(mesh.points[static_cast<std::size_t>(reference.nodes[n])], reference.place);
    for (auto& value : arm)
      value /= reference.size;
    const Index row = static_cast<Index>(n) * components;
    for (Index a = 0; a < components; ++a)
      rigid(row + a, a) = 1;
    for (Index k = 0; k < rotations; ++k) {
      Vector3d axis = Vector3d::Zero();
      axis[components == 3 ? k : 2] = 1;
      const auto turned = contact::cross(axis, arm);
      for (Index a = 0; a < components; ++a)
        rigid(row + a, components + k) = turned[a];
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
