// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/small_vectors.hpp"
#include "rubato/contact/zone.hpp"
#include "rubato/domain/law_springs.hpp"
#include "rubato/domain/line_springs.hpp"
#include "rubato/linalg/sparse_sum.hpp"
#include "rubato/model/build.hpp"
#include "rubato/model/model.hpp"
#include "rubato/model/node_label.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

namespace rubato::model {
namespace {

using Eigen::Index;
using Eigen::Vector3d;

/// A place whose displacement along a direction is a sum over dofs.
struct End {
  Vector3d place = Vector3d::Zero();
  std::vector<int> dofs;
  Eigen::MatrixXd motion; ///< a row a direction
};

Eigen::MatrixXd first_rows(const Eigen::MatrixXd& matrix, Index count) {
  Eigen::MatrixXd rows(count, matrix.cols());
  for (Index j = 0; j < matrix.cols(); ++j)
    for (Index i = 0; i < count; ++i)
      rows(i, j) = matrix(i, j);
  return rows;
}

class ConnectorMaker {
public:
  ConnectorMaker(const study::Study& study, const mesh::Mesh& mesh, const domain::DofMap& dofs,
                 std::span<const Reference> references, std::vector<Fault>& faults)
      : mesh_(mesh), dofs_(dofs), references_(references), faults_(faults) {
    for (std::size_t i = 0; i < study.connectors.size(); ++i)
      add(study.connectors[i], fmt::format("connectors.{}", i));
    for (std::size_t i = 0; i < study.masses.size(); ++i)
      if (const auto* reference = reference_named(references, study.masses[i].on))
        add(study.masses[i], *reference, fmt::format("masses.{}", i));
  }
  std::vector<Connector> take() { return std::move(connectors_); }

private:
  void add(const study::Connector& connector, const std::string& path) {
    const auto ends = ends_of({connector.on, path + ".on"});
    if (ends.empty())
      return;
    if (connector.anchor) {
      const auto& place = *connector.anchor;
      for (const auto& end : ends)
        add_between(connector, end, {{place[0], place[1], place[2]}, {}, {}}, path);
      return;
    }
    if (connector.to.empty()) {
      for (const auto& end : ends)
        add(connector, end, nullptr, direction_of(*connector.along));
      return;
    }
    const auto others = ends_of({connector.to, path + ".to"});
    if (others.empty() || !is_one(ends, connector.on, path + ".on") ||
        !is_one(others, connector.to, path + ".to"))
      return;
    add_between(connector, ends.front(), others.front(), path);
  }

  void add_between(const study::Connector& connector, const End& on, const End& to, const std::string& path) {
    const Vector3d way = contact::difference_of(to.place, on.place);
    if (!connector.along && contact::length_of(way) == 0)
      return faults_.push_back(fault_at(path, without_length(connector)));
    add(connector, on, &to, connector.along ? direction_of(*connector.along) : contact::unit_of(way));
    if (connector.along)
      return;
    auto& made = connectors_.back();
    made.way = way_between(connector, on, to);
    if (!connector.rotates)
      return;
    made.line = {{connector.stiffness, std::exchange(made.force, std::nullopt)},
                 {connector.damping, std::exchange(made.damper, std::nullopt)}};
    made.stiffness = made.damping = 0;
  }

  static std::string without_length(const study::Connector& connector) {
    if (connector.anchor)
      return fmt::format("'{}' is at the anchor, expected an anchor at another place: the connector acts "
                         "along the line between them",
                         connector.on);
    if (connector.rotates)
      return fmt::format("'{}' and '{}' are at the same place, expected two places: a connector with "
                         "rotates: true acts along the line between them",
                         connector.on, connector.to);
    return fmt::format(
        "'{}' and '{}' are at the same place, expected 'along', the direction of the connector", connector.on,
        connector.to);
  }

  ConnectorWay way_between(const study::Connector& connector, const End& on, const End& to) const {
    ConnectorWay way{connector.on, connector.to, contact::difference_of(to.place, on.place), {}};
    const auto add_end = [&](const End& end, double sign) {
      for (std::size_t d = 0; d < end.dofs.size(); ++d)
        for (int i = 0; i < dofs_.components; ++i)
          way.moved[static_cast<std::size_t>(i)].push_back(
              {end.dofs[d], sign * end.motion(i, static_cast<Index>(d))});
    };
    add_end(on, -1);
    add_end(to, 1);
    return way;
  }

  /// A mass along each direction, its moments of inertia about each axis that things turn about.
  void add(const study::PointMasses& masses, const Reference& reference, const std::string& path) {
    const auto enter = [&](Index row, double mass) {
      if (mass == 0)
        return;
      Connector made{{}, 0, 0, mass};
      for (std::size_t d = 0; d < reference.dofs.size(); ++d)
        made.row.push_back({reference.dofs[d], reference.motion(row, static_cast<Index>(d))});
      connectors_.push_back(std::move(made));
    };
    const Index d = dofs_.components;
    for (Index i = 0; i < d; ++i)
      enter(i, masses.mass);
    const bool turns = masses.inertia != std::array<double, 3>{};
    if (turns && !reference.turns)
      return faults_.push_back(fault_at(
          path + ".inertia", fmt::format("'{}' tells no rotation, expected a mass alone", reference.name)));
    for (Index axis = d == 3 ? 0 : 2; turns && axis < 3; ++axis)
      enter(d == 3 ? 3 + axis : d, masses.inertia.at(static_cast<std::size_t>(axis)));
  }

  static Vector3d direction_of(const std::array<double, 3>& along) {
    return contact::unit_of({along[0], along[1], along[2]});
  }

  bool is_one(const std::vector<End>& ends, const std::string& name, const std::string& path) {
    if (ends.size() == 1)
      return true;
    faults_.push_back(
        fault_at(path, fmt::format("group '{}' has {} nodes, expected one node, or a reference that "
                                   "stands for the group",
                                   name, ends.size())));
    return false;
  }

  std::vector<End> ends_of(const Mention& name) {
    std::vector<End> ends;
    if (const auto* reference = reference_named(references_, name.name)) {
      ends.push_back({reference->place, reference->dofs, first_rows(reference->motion, dofs_.components)});
      return ends;
    }
    for (const auto node : body_nodes_or_fault(mesh_, dofs_, name, "to pull at", faults_)) {
      End end{mesh_.points[static_cast<std::size_t>(node)],
              {},
              Eigen::MatrixXd::Identity(dofs_.components, dofs_.components)};
      for (int i = 0; i < dofs_.components; ++i)
        end.dofs.push_back(dofs_.dof(node, i));
      ends.push_back(std::move(end));
    }
    return ends;
  }

  void add(const study::Connector& connector, const End& end, const End* other, const Vector3d& direction) {
    Connector made{{}, connector.stiffness, connector.damping, 0, connector.force, connector.damper};
    if (made.force)
      made.stiffness = steepest(*made.force);
    if (made.damper)
      made.damping = steepest(*made.damper);
    const auto add_end = [&](const End& at, double sign) {
      for (std::size_t d = 0; d < at.dofs.size(); ++d) {
        double along = 0;
        for (int i = 0; i < dofs_.components; ++i)
          along += sign * direction[i] * at.motion(i, static_cast<Index>(d));
        made.row.push_back({at.dofs[d], along});
      }
    };
    add_end(end, other != nullptr ? -1 : 1); // > 0: elongated
    if (other != nullptr)
      add_end(*other, 1);
    connectors_.push_back(std::move(made));
  }

  const mesh::Mesh& mesh_;
  const domain::DofMap& dofs_;
  std::span<const Reference> references_;
  std::vector<Fault>& faults_;
  std::vector<Connector> connectors_;
};

/// Its row as places and numbers beside each other.
std::pair<std::vector<int>, Eigen::VectorXd> row_of(const Connector& connector) {
  std::pair<std::vector<int>, Eigen::VectorXd> row{{},
                                                   Eigen::VectorXd(static_cast<Index>(connector.row.size()))};
  for (const auto& term : connector.row) {
    row.second[static_cast<Index>(row.first.size())] = term.coefficient;
    row.first.push_back(term.dof);
  }
  return row;
}

std::vector<domain::LawSpring> laws_of(const Model& model, std::optional<LinearTable> Connector::*law,
                                       double Connector::*held) {
  std::vector<domain::LawSpring> springs;
  for (const auto& connector : model.connectors) {
    if (!(connector.*law))
      continue;
    auto [dofs, row] = row_of(connector);
    springs.push_back({std::move(dofs), std::move(row), *(connector.*law), connector.*held});
  }
  return springs;
}

/// A cell with the node; −1: none.
mesh::CellIndex cell_at(const Model& model, mesh::NodeIndex node) {
  for (const auto cell : model.bulk.cells)
    if (std::ranges::find(model.mesh.nodes_of(cell), node) != model.mesh.nodes_of(cell).end())
      return cell;
  return -1;
}

/// The lists of all directions have the same dofs in the same order.
domain::LineSpring line_spring_of(const Model& model, const Connector& connector) {
  const auto& way = *connector.way;
  domain::LineSpring spring;
  spring.undeformed = way.undeformed;
  spring.spring = connector.line->spring;
  spring.dashpot = connector.line->dashpot;
  spring.rows = Eigen::Matrix3Xd::Zero(3, static_cast<Index>(way.moved[0].size()));
  for (const auto& term : way.moved[0])
    spring.dofs.push_back(term.dof);
  for (std::size_t i = 0; i < way.moved.size(); ++i)
    for (std::size_t d = 0; d < way.moved.at(i).size(); ++d)
      spring.rows(static_cast<Index>(i), static_cast<Index>(d)) = way.moved.at(i)[d].coefficient;
  const auto place = static_cast<std::size_t>(spring.dofs.front() / model.dofs.components);
  spring.cell = cell_at(model, model.dofs.nodes[place]);
  return spring;
}

/// Σ factor rᵀ r. Blocks of nodes are whole: what multiplies matrices reads them so.
SparseMatrix sum_of(const Model& model, double Connector::*factor) {
  std::vector<Eigen::Triplet<double, int>> entries;
  for (const auto& connector : model.connectors)
    if (const double f = connector.*factor; f > 0)
      for (const auto& a : connector.row)
        for (const auto& b : connector.row)
          entries.emplace_back(a.dof, b.dof, f * a.coefficient * b.coefficient);
  SparseMatrix sum(model.dofs.dof_count, model.dofs.dof_count);
  sum.setFromTriplets(entries.begin(), entries.end());
  return sum;
}

} // namespace

std::vector<Connector> make_connectors(const study::Study& study, const mesh::Mesh& mesh,
                                       const domain::DofMap& dofs, std::span<const Reference> references,
                                       std::vector<Fault>& faults) {
  return ConnectorMaker(study, mesh, dofs, references, faults).take();
}

std::vector<PointMass> make_point_masses(const study::Study& study, const mesh::Mesh& mesh,
                                         const domain::DofMap& dofs, std::span<const Reference> references,
                                         std::vector<Fault>& faults) {
  std::vector<PointMass> masses;
  for (std::size_t i = 0; i < study.masses.size(); ++i) {
    const auto& asked = study.masses[i];
    if (reference_named(references, asked.on) == nullptr)
      for (const auto node : body_nodes_or_fault(mesh, dofs, {asked.on, fmt::format("masses.{}.on", i)},
                                                 "to weigh down", faults))
        masses.push_back({node, asked.mass});
  }
  return masses;
}

void check_point_masses(const Model& model, std::vector<Fault>& faults) {
  if (model.study.time.contact_mass != study::ContactMass::redistributed)
    return;
  std::vector<mesh::NodeIndex> weighed;
  for (const auto& mass : model.point_masses)
    weighed.push_back(mass.node);
  for (const auto& connector : model.connectors)
    if (connector.mass > 0)
      for (const auto& term : connector.row)
        weighed.push_back(model.dofs.nodes[static_cast<std::size_t>(term.dof / model.dofs.components)]);
  for (const auto node : weighed)
    for (const auto& zone : model.zones)
      if (!zone.settings.tie && std::ranges::find(zone.slave.nodes, node) != zone.slave.nodes.end())
        return faults.push_back(fault_at(
            "masses",
            fmt::format("node {} is on the slave surface of zone '{}', which contact_mass: redistributed "
                        "leaves without mass; expected time: {{contact_mass: consistent}}, or the node "
                        "on the master",
                        node_label(model.mesh, node), zone.settings.name)));
}

void add_connectors(const Model& model, SparseMatrix& stiffness) {
  if (std::ranges::any_of(model.connectors, [](const auto& c) { return c.stiffness > 0; }))
    linalg::add_scaled(1, sum_of(model, &Connector::stiffness), stiffness);
}

std::vector<AttachedMass> attached_masses(const Model& model) {
  std::vector<AttachedMass> masses;
  for (const auto& connector : model.connectors)
    if (connector.mass > 0) {
      auto [dofs, row] = row_of(connector);
      masses.push_back({std::move(dofs), std::move(row), connector.mass});
    }
  return masses;
}

void add_reference_masses(const Model& model, SparseMatrix& mass) {
  if (std::ranges::any_of(model.connectors, [](const auto& c) { return c.mass > 0; }))
    linalg::add_scaled(1, reference_masses(model), mass);
}

SparseMatrix reference_masses(const Model& model) {
  return sum_of(model, &Connector::mass);
}

std::vector<domain::LawSpring> law_springs(const Model& model) {
  return laws_of(model, &Connector::force, &Connector::stiffness);
}

std::vector<domain::LineSpring> line_springs(const Model& model) {
  std::vector<domain::LineSpring> springs;
  for (const auto& connector : model.connectors)
    if (connector.line)
      springs.push_back(line_spring_of(model, connector));
  return springs;
}

void add_lines(std::span<const domain::LineSpring> lines, double factor, SparseMatrix& stiffness) {
  if (lines.empty())
    return;
  std::vector<Eigen::Triplet<double, int>> places;
  for (const auto& line : lines)
    for (const int row : line.dofs)
      for (const int column : line.dofs)
        places.emplace_back(row, column, 0);
  SparseMatrix sum(stiffness.rows(), stiffness.cols());
  sum.setFromTriplets(places.begin(), places.end());
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(stiffness.rows());
  domain::add_line_tangents(lines, {rest, rest}, domain::TangentOf::symmetric, sum);
  linalg::add_scaled(factor, sum, stiffness);
}

std::vector<domain::LawSpring> law_dampers(const Model& model) {
  return laws_of(model, &Connector::damper, &Connector::damping);
}

void add_slopes_at_rest(const Model& model, SparseMatrix& stiffness) {
  for (const auto& spring : law_springs(model))
    for (std::size_t i = 0; i < spring.dofs.size(); ++i)
      for (std::size_t j = 0; j < spring.dofs.size(); ++j)
        stiffness.coeffRef(spring.dofs[i], spring.dofs[j]) += (slope_at(spring.force, 0) - spring.held) *
                                                              spring.row[static_cast<Index>(i)] *
                                                              spring.row[static_cast<Index>(j)];
}

void add_dashpots(const Model& model, SparseMatrix& damping) {
  if (std::ranges::none_of(model.connectors, [](const auto& c) { return c.damping > 0; }))
    return;
  auto dashpots = sum_of(model, &Connector::damping);
  if (damping.nonZeros() > 0)
    linalg::add_scaled(1, dashpots, damping);
  else
    damping.swap(dashpots);
}

} // namespace rubato::model
