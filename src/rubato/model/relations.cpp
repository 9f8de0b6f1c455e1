// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/model/relations.hpp"

#include "rubato/cell/quadrature.hpp"
#include "rubato/cell/reference_nodes.hpp"
#include "rubato/cell/shape_table.hpp"
#include "rubato/contact/small_vectors.hpp"
#include "rubato/core/time_integral.hpp"
#include "rubato/linalg/dense_decompositions.hpp"
#include "rubato/linalg/pivoted_qr.hpp"
#include "rubato/mesh/skin.hpp"
#include "rubato/model/embedding.hpp"
#include "rubato/model/node_label.hpp"
#include "rubato/study/fields.hpp"
#include "rubato/study/words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <span>

namespace rubato::model {
namespace {

using constraint::Equation;
using constraint::ImposedValue;
using constraint::Term;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using mesh::NodeIndex;

/// Coefficients below this part of the largest are rounding.
constexpr double coefficient_rounding = 1e-13;
/// Pivots of rigid motions below this part of the largest are rounding.
constexpr double rank_tolerance_of_motions = 1e-10;
/// Normals of faces that meet at a node are averaged up to this cosine of their angle: beyond it, at an edge,
/// the node is held along each.
const double same_face = std::cos(30 * std::acos(-1.0) / 180);
/// Nodes whose places differ by less than this part of the size of their group are partners.
constexpr double partner_tolerance = 1e-5;

/// An equation is solved for its first dof where that has a large coefficient: the largest first.
Equation equation_of(std::vector<Term> terms, ImposedValue value, std::size_t source) {
  const auto magnitude = [](const Term& term) { return std::abs(term.coefficient); };
  const auto largest = std::ranges::max_element(terms, {}, magnitude);
  if (largest != terms.end()) {
    const double least = coefficient_rounding * magnitude(*largest);
    std::iter_swap(terms.begin(), largest);
    std::erase_if(terms, [&](const Term& term) { return magnitude(term) <= least; });
  }
  return {std::move(terms), std::move(value), static_cast<int>(source)};
}

// ---- along a direction -----------------------------------------------------------------------------------

/// The unit normals at the nodes of a face, out of the body.
std::vector<Vector3d> node_normals(const mesh::Mesh& mesh, const mesh::SurfaceFace& face) {
  const auto nodes = face.nodes();
  std::vector<cell::QuadraturePoint> at;
  for (std::size_t n = 0; n < nodes.size(); ++n)
    at.push_back({cell::reference_node(face.type, static_cast<int>(n)), 0});
  const auto table = cell::tabulate(face.type, at);
  const bool edge = cell::topology(face.type).dimension == 1;
  std::vector<Vector3d> normals;
  for (std::size_t q = 0; q < at.size(); ++q) {
    Vector3d first = Vector3d::Zero();
    Vector3d second(0, 0, edge ? 1 : 0);
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      const auto& x = mesh.points[static_cast<std::size_t>(nodes[n])];
      const auto row = static_cast<Index>(n) * (edge ? 1 : 2);
      contact::add_scaled(table.gradients(row, static_cast<Index>(q)), x, first);
      if (!edge)
        contact::add_scaled(table.gradients(row + 1, static_cast<Index>(q)), x, second);
    }
    normals.push_back(contact::unit_of(contact::cross(first, second)));
  }
  return normals;
}

/// The directions that the faces of a group have at each node, of length 1: one on smooth surfaces, one for
/// each side of an edge.
std::map<NodeIndex, std::vector<Vector3d>> normals_of(const Parts& parts, const Mention& on,
                                                      std::vector<Fault>& faults) {
  std::map<NodeIndex, std::vector<Vector3d>> sums;
  const auto* group = cells_named(parts.mesh, on, faults);
  if (group == nullptr)
    return sums;
  const auto oriented = mesh::oriented_faces(parts.mesh, group->items);
  for (const auto& text : mesh::faults_of(parts.mesh, oriented))
    faults.push_back(fault_at(on.path, fmt::format("held surface '{}': {}", on.name, text)));
  for (const auto& face : oriented.faces) {
    const auto normals = node_normals(parts.mesh, face);
    for (std::size_t n = 0; n < normals.size(); ++n) {
      auto& known = sums[face.nodes()[n]];
      const auto near = std::ranges::find_if(known, [&](const Vector3d& sum) {
        return contact::dot(contact::unit_of(sum), normals[n]) > same_face;
      });
      if (near == known.end())
        known.push_back(normals[n]);
      else
        contact::add_scaled(1, normals[n], *near);
    }
  }
  for (auto& [node, directions] : sums)
    for (auto& direction : directions)
      direction = contact::unit_of(direction);
  return sums;
}

std::map<NodeIndex, std::vector<Vector3d>> directions_of(const Parts& parts, const study::Support& support,
                                                         const std::string& path,
                                                         std::vector<Fault>& faults) {
  const Mention on{support.on, path + ".on"};
  if (support.along->normal)
    return normals_of(parts, on, faults);
  const auto& d = support.along->direction;
  std::map<NodeIndex, std::vector<Vector3d>> directions;
  for (const auto node : body_nodes_or_fault(parts.mesh, parts.dofs, on, "to hold", faults))
    directions[node] = {contact::unit_of({d[0], d[1], d[2]})};
  return directions;
}

// ---- relations -------------------------------------------------------------------------------------------

class RelationEquations {
public:
  RelationEquations(const Parts& parts, const study::Relation& relation, Equations& equations,
                    std::vector<Fault>& faults)
      : parts_(parts), relation_(relation), equations_(equations), faults_(faults),
        path_(fmt::format("relations.{}.{}", relation.name,
                          study::word_of(study::relation_words, relation.kind))) {}

  void add() {
    switch (relation_.kind) {
    case study::RelationKind::equation:
      return add_equation();
    case study::RelationKind::equal:
      return add_equal();
    case study::RelationKind::pairs:
      return add_pairs();
    case study::RelationKind::rigid:
      return add_rigid();
    case study::RelationKind::embedded:
      return add_embedded();
    case study::RelationKind::distributed: // says nothing by itself
      return;
    }
  }

private:
  void enter(Equation equation) { equations_.list.push_back(std::move(equation)); }
  std::size_t source(const std::string& path) {
    equations_.paths.push_back(path);
    return equations_.paths.size() - 1;
  }
  std::vector<NodeIndex> nodes_of(const std::string& name, const std::string& path) {
    return body_nodes_or_fault(parts_.mesh, parts_.dofs, {name, path}, "to relate", faults_);
  }
  bool has_component(int i) const {
    return i < parts_.dofs.components && relation_.components.at(static_cast<std::size_t>(i));
  }

  void add_equation() {
    std::vector<Term> terms;
    NodeIndex first = -1;
    for (std::size_t k = 0; k < relation_.terms.size(); ++k) {
      const auto& term = relation_.terms[k];
      const auto at = fmt::format("{}.terms.{}.on", path_, k);
      const auto nodes = nodes_of(term.on, at);
      if (nodes.empty())
        return;
      if (nodes.size() > 1)
        return faults_.push_back(fault_at(
            at, fmt::format("group '{}' has {} nodes, expected one; 'equal' and 'pairs' relate groups",
                            term.on, nodes.size())));
      first = first < 0 ? nodes.front() : first;
      for (int i = 0; i < parts_.dofs.components; ++i)
        if (const double c = term.coefficients.at(static_cast<std::size_t>(i)); c != 0)
          terms.push_back({parts_.dofs.dof(nodes.front(), i), c});
    }
    const auto field = shared_field(parts_, relation_.value, path_ + ".value");
    enter(equation_of(std::move(terms), imposed_at(parts_, first, field), source(path_)));
  }

  void add_equal() {
    const auto nodes = nodes_of(relation_.on, path_ + ".on");
    const auto from = source(path_);
    for (std::size_t n = 1; n < nodes.size(); ++n)
      for (int i = 0; i < parts_.dofs.components; ++i)
        if (has_component(i))
          enter({{{parts_.dofs.dof(nodes[n], i), 1}, {parts_.dofs.dof(nodes.front(), i), -1}},
                 {},
                 static_cast<int>(from)});
  }

  const Vector3d& place(NodeIndex node) const { return parts_.mesh.points[static_cast<std::size_t>(node)]; }

  void add_pairs() {
    const auto nodes = nodes_of(relation_.on, path_ + ".on");
    const auto others = nodes_of(relation_.with, path_ + ".with");
    if (nodes.empty() || others.empty())
      return;
    if (nodes.size() != others.size())
      return faults_.push_back(
          fault_at(path_ + ".with", fmt::format("'{}' has {} nodes and '{}' {}, expected as many",
                                                relation_.with, others.size(), relation_.on, nodes.size())));
    const auto from = source(path_);
    const Vector3d middle = mean_place(parts_.mesh, nodes);
    const Vector3d shift = contact::difference_of(mean_place(parts_.mesh, others), middle);
    const auto fields = differences();
    double size = 0;
    for (const auto node : nodes)
      size = std::max(size, contact::length_of(contact::difference_of(place(node), middle)));
    for (const auto node : nodes) {
      const auto shifted = contact::sum_of(place(node), shift);
      const auto distance = [&](NodeIndex other) {
        return contact::length_of(contact::difference_of(shifted, place(other)));
      };
      const auto partner = *std::ranges::min_element(others, {}, distance);
      if (distance(partner) > partner_tolerance * size)
        return faults_.push_back(fault_at(
            path_ + ".with",
            fmt::format("node {} of '{}' has no partner in '{}': shifted by ({:.6g}, {:.6g}, {:.6g}), "
                        "from the mean of one group to that of the other, it is {:.3g} from the nearest, {}",
                        node_label(parts_.mesh, node), relation_.on, relation_.with, shift[0], shift[1],
                        shift[2], distance(partner), node_label(parts_.mesh, partner))));
      relate(node, partner, from, fields);
    }
  }

  using Fields = std::array<std::shared_ptr<const FieldFunction>, 3>;

  /// By component.
  Fields differences() const {
    Fields fields;
    for (std::size_t axis = 0; axis < fields.size(); ++axis)
      fields.at(axis) = shared_field(parts_, relation_.difference.at(axis),
                                     fmt::format("{}.difference.{}", path_, study::axis_words.at(axis)));
    return fields;
  }

  void relate(NodeIndex node, NodeIndex partner, std::size_t from, const Fields& fields) {
    for (int i = 0; i < parts_.dofs.components; ++i)
      if (has_component(i))
        enter({{{parts_.dofs.dof(node, i), 1}, {parts_.dofs.dof(partner, i), -1}},
               imposed_at(parts_, node, fields.at(static_cast<std::size_t>(i))),
               static_cast<int>(from)});
  }

  /// u_node = Σ N_i u_i of the cell that it lies in. Nodes of the cells themselves follow already.
  void add_embedded() {
    if (relation_.on.empty()) // a reference says nothing by itself
      return;
    const auto nodes = nodes_of(relation_.on, path_ + ".on");
    const auto cells =
        host_cells(parts_.mesh, parts_.dofs.components, {relation_.cells, path_ + ".in"}, faults_);
    if (nodes.empty() || cells.empty())
      return;
    const mesh::PlaceFinder finder(parts_.mesh, cells);
    const auto from = source(path_);
    for (const auto node : nodes) {
      const auto found = cell_at(finder, place(node), node);
      if (!found)
        return faults_.push_back(
            fault_at(path_ + ".on",
                     fmt::format("node {} of '{}' lies in no cell{} but its own",
                                 node_label(parts_.mesh, node), relation_.on, of_group(relation_.cells))));
      embed(node, *found, from);
    }
  }

  void embed(NodeIndex node, const mesh::CellShare& at, std::size_t from) {
    const auto& nodes = at.nodes;
    for (int i = 0; i < parts_.dofs.components; ++i) {
      std::vector<Term> terms{{parts_.dofs.dof(node, i), 1}};
      for (std::size_t n = 0; n < nodes.size(); ++n)
        if (std::abs(at.weights[n]) > coefficient_rounding)
          terms.push_back({parts_.dofs.dof(nodes[n], i), -at.weights[n]});
      enter({std::move(terms), {}, static_cast<int>(from)});
    }
  }

  /// All dofs follow from as many of them as there are rigid motions, chosen by QR with column pivoting.
  void add_rigid() {
    const auto* reference = reference_named(parts_.references, relation_.name);
    if (reference == nullptr)
      return;
    const MatrixXd rigid = rigid_motions_of(*reference, parts_.mesh, parts_.dofs.components);
    MatrixXd of_dofs(rigid.cols(), rigid.rows());
    for (Index d = 0; d < rigid.rows(); ++d)
      for (Index k = 0; k < rigid.cols(); ++k)
        of_dofs(k, d) = rigid(d, k);
    const auto order = linalg::independent_columns(of_dofs, rank_tolerance_of_motions);
    const auto rank = static_cast<Index>(order.size());
    MatrixXd chosen(rigid.cols(), rank);
    std::vector<char> is_chosen(reference->dofs.size(), 0);
    for (Index k = 0; k < rank; ++k) {
      const auto dof = order[static_cast<std::size_t>(k)];
      std::copy_n(&of_dofs(0, static_cast<Index>(dof)), rigid.cols(), &chosen(0, k));
      is_chosen[dof] = 1;
    }
    const auto by_chosen = linalg::PivotedQr(std::move(chosen)).solve(of_dofs);
    const auto from = source(path_);
    for (std::size_t d = 0; d < reference->dofs.size(); ++d) {
      if (is_chosen[d] != 0)
        continue;
      std::vector<Term> terms{{reference->dofs[d], 1}};
      for (Index k = 0; k < rank; ++k)
        if (const double c = by_chosen(k, static_cast<Index>(d)); std::abs(c) > coefficient_rounding)
          terms.push_back({reference->dofs[order[static_cast<std::size_t>(k)]], -c});
      enter({std::move(terms), {}, static_cast<int>(from)});
    }
  }

  const Parts& parts_;
  const study::Relation& relation_;
  Equations& equations_;
  std::vector<Fault>& faults_;
  std::string path_;
};

/// Whether it changes with time other than by its function.
bool moves(const FieldFunction& field) {
  return (field.expression && field.expression->has('t')) ||
         (field.sampled && field.sampled->varies_in_time());
}

/// Unit vectors across a normal: one in the plane, two in space.
std::vector<Vector3d> tangents_of(const Vector3d& normal, int components) {
  if (components == 2)
    return {Vector3d(-normal[1], normal[0], 0)};
  const Vector3d one = contact::unit_across(normal);
  return {one, contact::cross(normal, one)};
}

} // namespace

std::shared_ptr<const FieldFunction> shared_field(const Parts& parts, const study::Field& field,
                                                  const std::string& path) {
  auto function = study::field_function(field, parts.study.functions, path);
  const auto& time = parts.study.time;
  if (field.given != study::Given::displacement)
    function = integrated(function, static_cast<int>(field.given), time.begin, time.end);
  return std::make_shared<const FieldFunction>(std::move(function));
}

ImposedValue imposed_at(const Parts& parts, const Vector3d& x,
                        const std::shared_ptr<const FieldFunction>& field) {
  if (!field->expression && !field->profile && !field->sampled)
    return {field->number, field->function};
  const std::array place{x[0], x[1], x[2]};
  for (const double t : {parts.study.time.begin, parts.study.time.end})
    field->at(place, t); // throws now rather than in a step
  if (moves(*field))
    return {0, std::nullopt,
            std::make_shared<const constraint::FieldAtPlace>(constraint::FieldAtPlace{field, place})};
  return {field->multiplied_at(place, parts.study.time.begin), field->function};
}

ImposedValue imposed_at(const Parts& parts, NodeIndex node,
                        const std::shared_ptr<const FieldFunction>& field) {
  return imposed_at(parts, parts.mesh.points[static_cast<std::size_t>(node)], field);
}

void add_oblique(const Parts& parts, const study::Support& support, const std::string& path,
                 Equations& equations, std::vector<Fault>& faults) {
  equations.paths.push_back(path);
  const auto field = shared_field(parts, support.along->value, path + ".value");
  for (const auto& [node, directions] : directions_of(parts, support, path, faults)) {
    if (!parts.dofs.has(node))
      continue;
    for (const auto& direction : directions) {
      std::vector<Term> terms;
      terms.reserve(static_cast<std::size_t>(parts.dofs.components));
      for (int i = 0; i < parts.dofs.components; ++i)
        terms.push_back({parts.dofs.dof(node, i), direction[i]});
      equations.list.push_back(
          equation_of(std::move(terms), imposed_at(parts, node, field), equations.paths.size() - 1));
    }
  }
}

void add_held_reference(const Parts& parts, const study::Support& support, const std::string& path,
                        Equations& equations) {
  const auto& reference = *reference_named(parts.references, support.on);
  const int components = parts.dofs.components;
  const auto enter = [&](const std::vector<double>& row, const study::Field& wanted, const std::string& at) {
    std::vector<Term> terms;
    for (std::size_t d = 0; d < reference.dofs.size(); ++d)
      terms.push_back({reference.dofs[d], row[d]});
    equations.paths.push_back(at);
    equations.list.push_back(equation_of(std::move(terms),
                                         imposed_at(parts, reference.place, shared_field(parts, wanted, at)),
                                         equations.paths.size() - 1));
  };
  /// Σ weight · row of the motion
  const auto row_of = [&](std::span<const double> weights, Index first) {
    std::vector<double> row(reference.dofs.size(), 0.0);
    for (std::size_t d = 0; d < row.size(); ++d)
      for (std::size_t i = 0; i < weights.size(); ++i)
        row[d] += weights[i] * reference.motion(first + static_cast<Index>(i), static_cast<Index>(d));
    return row;
  };
  constexpr std::array whole{1.0};
  for (int i = 0; i < components; ++i)
    if (const auto& wanted = support.components.at(static_cast<std::size_t>(i)))
      enter(row_of(whole, i), *wanted, fmt::format("{}.{}", path, "xyz"[i]));
  for (int i = 0; i < 3; ++i)
    if (const auto& wanted = support.turns.at(static_cast<std::size_t>(i)))
      enter(row_of(whole, components == 3 ? components + i : components), *wanted,
            fmt::format("{}.turn.{}", path, "xyz"[i]));
  if (const auto& along = support.along) {
    Vector3d direction(along->direction[0], along->direction[1], along->direction[2]);
    direction = contact::unit_of(direction);
    enter(row_of({direction.data(), static_cast<std::size_t>(components)}, 0), along->value, path + ".value");
  }
}

void add_preload(const Parts& parts, const study::Preload& preload, const PreloadedCut& cut,
                 const std::optional<double>& locked, Equations& equations) {
  const auto path = "preload." + preload.name;
  equations.paths.push_back(path);
  const auto source = equations.paths.size() - 1;
  const int components = parts.dofs.components;
  const auto& first = cut.pairs.front();
  const auto jump = [&](const Vector3d& along) {
    std::vector<Term> terms;
    for (int i = 0; i < components; ++i)
      terms.insert(terms.end(), {{parts.dofs.dof(first.in_front, i), along[i]},
                                 {parts.dofs.dof(first.behind, i), -along[i]}});
    return terms;
  };
  for (const auto& pair : std::span(cut.pairs).subspan(1))
    for (int i = 0; i < components; ++i)
      equations.list.push_back({{{parts.dofs.dof(pair.in_front, i), 1},
                                 {parts.dofs.dof(pair.behind, i), -1},
                                 {parts.dofs.dof(first.in_front, i), -1},
                                 {parts.dofs.dof(first.behind, i), 1}},
                                {},
                                static_cast<int>(source)});
  const auto backwards = contact::scaled(-1, cut.normal);
  const auto across = tangents_of(cut.normal, components);
  for (const auto& tangent : across)
    equations.list.push_back(equation_of(jump(tangent), {}, source));
  if (locked)
    equations.list.push_back(equation_of(jump(backwards), {*locked, std::nullopt}, source));
  else if (!preload.by_force)
    equations.list.push_back(equation_of(
        jump(backwards), {preload.value.value, function_named(parts.study, preload.value.function)}, source));
}

void add_relation(const Parts& parts, const study::Relation& relation, Equations& equations,
                  std::vector<Fault>& faults) {
  RelationEquations(parts, relation, equations, faults).add();
}

} // namespace rubato::model
