// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/results/nodal_fields.hpp"

#include "rubato/fem/recovery.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rubato::results {
namespace {

using contact::Status;
using Eigen::Index;
using Eigen::VectorXd;
using model::Model;

const std::vector<std::string> axes{"x", "y", "z"};

OwnedField vector_field(const Model& model, std::string name, const VectorXd& values) {
  const int components = model.dofs.components;
  OwnedField field{std::move(name), components, {}, {axes.begin(), axes.begin() + components}};
  field.values.assign(static_cast<std::size_t>(model.mesh.node_count() * components), 0.0);
  for (const auto node : model.dofs.nodes)
    for (int i = 0; i < components; ++i)
      field.values[static_cast<std::size_t>(node * components + i)] = values[model.dofs.dof(node, i)];
  return field;
}

OwnedField scalar_field(const Model& model, std::string name) {
  return {
      std::move(name), 1, std::vector<double>(static_cast<std::size_t>(model.mesh.node_count()), 0.0), {}};
}

/// What a zone's points know, at the state's configuration.
std::vector<contact::PointEvaluation> evaluation(const Model& model, std::size_t zone,
                                                 const step::State& before, const step::State& now) {
  const contact::Configuration configuration{&model.mesh, &model.dofs, &now.motion.u, &before.motion.u};
  return contact::evaluate(model.zones[zone], now.zones[zone].multipliers, configuration);
}

/// A point's place among the nodes: its own node, or the one whose shape function is largest there.
mesh::NodeIndex node_of(const contact::SlavePoint& point) {
  const auto largest = std::ranges::max_element(point.shape, {}, [](double n) { return std::abs(n); });
  return point.nodes[static_cast<std::size_t>(largest - point.shape.begin())];
}

void add_contact_fields(const Model& model, const step::State& before, const step::State& now,
                        std::vector<OwnedField>& fields) {
  auto pressure = scalar_field(model, "contact_pressure");
  auto gap = scalar_field(model, "contact_gap");
  auto status = scalar_field(model, "contact_status");
  const int tangents = model.dofs.components - 1;
  OwnedField slip{"contact_slip",
                  tangents,
                  {},
                  tangents == 1 ? std::vector<std::string>{"t"} : std::vector<std::string>{"t1", "t2"}};
  slip.values.assign(static_cast<std::size_t>(model.mesh.node_count() * tangents), 0.0);
  for (std::size_t z = 0; z < model.zones.size(); ++z) {
    const auto& zone = model.zones[z];
    const int per_node = zone.multipliers_per_node();
    for (std::size_t i = 0; i < zone.slave.nodes.size(); ++i)
      pressure.values[static_cast<std::size_t>(zone.slave.nodes[i])] =
          now.zones[z].multipliers[static_cast<Index>(i) * per_node];
    const auto points = evaluation(model, z, before, now);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto node = static_cast<std::size_t>(node_of(zone.points[i]));
      const bool touches = now.zones[z].status[i] != Status::open;
      gap.values[node] = points[i].kinematics ? points[i].variables.gap : 0.0;
      status.values[node] = static_cast<double>(now.zones[z].status[i]);
      for (int a = 0; touches && a < tangents; ++a)
        slip.values[node * static_cast<std::size_t>(tangents) + static_cast<std::size_t>(a)] =
            points[i].variables.slip[a];
    }
  }
  fields.insert(fields.end(), {std::move(pressure), std::move(gap), std::move(slip), std::move(status)});
}

/// What the equations hold, augmentation included: where gaps close on average only, multipliers alone fall
/// short of it.
Eigen::Vector3d force_on_slave(const Model& model, std::size_t zone, const step::State& now) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto node : model.zones[zone].slave.nodes)
    for (int i = 0; i < model.dofs.components; ++i)
      sum[i] -= now.contact_force[model.dofs.dof(node, i)];
  return sum;
}

} // namespace

std::vector<OwnedField> nodal_fields(const Model& model, const step::State& before, const step::State& now) {
  std::vector<OwnedField> fields;
  fields.push_back(vector_field(model, "displacement", now.motion.u));
  fields.push_back(vector_field(model, "velocity", now.motion.v));
  fields.push_back(vector_field(model, "acceleration", now.motion.a));
  const auto recovered = fem::nodal_stress(model.mesh, model.bulk, model.dofs, now.motion.u);
  const auto& stress = recovered.stress;
  OwnedField tensor{
      "stress", 6, {stress.data(), stress.data() + stress.size()}, {"xx", "yy", "zz", "xy", "yz", "xz"}};
  OwnedField von_mises{"von_mises", 1, {recovered.von_mises.begin(), recovered.von_mises.end()}, {}};
  fields.push_back(std::move(tensor));
  fields.push_back(std::move(von_mises));
  if (!model.zones.empty())
    add_contact_fields(model, before, now, fields);
  return fields;
}

Resultants contact_resultants(const Model& model, std::size_t zone, const step::State& before,
                              const step::State& now) {
  Resultants sum;
  sum.smallest_gap = std::numeric_limits<double>::infinity();
  const auto points = evaluation(model, zone, before, now);
  const auto& points_of_zone = model.zones[zone].points;
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  Eigen::Vector3d tangential = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].kinematics)
      continue;
    const auto& variables = points[i].variables;
    sum.smallest_gap = std::min(sum.smallest_gap, variables.gap);
    if (now.zones[zone].status[i] == Status::open)
      continue;
    ++sum.in_contact;
    sum.sticking += now.zones[zone].status[i] == Status::stick ? 1 : 0;
    const auto& k = *points[i].kinematics;
    const double share = points_of_zone[i].weight * variables.pressure;
    sum.normal += share;
    normal += share * k.normal;
    tangential -= model.zones[zone].settings.friction * share * (k.tangents * variables.semi);
    sum.largest_pressure = std::max(sum.largest_pressure, variables.pressure);
  }
  const bool closes_at_points =
      std::ranges::all_of(points_of_zone, [](const auto& point) { return point.node_position >= 0; });
  sum.force = closes_at_points ? Eigen::Vector3d(normal + tangential) : force_on_slave(model, zone, now);
  sum.friction = tangential.norm();
  return sum;
}

} // namespace rubato::results
