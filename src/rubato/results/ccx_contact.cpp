// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/results/ccx_contact.hpp"

#include "rubato/contact/dropped_nodes.hpp"
#include "rubato/contact/zone.hpp"
#include "rubato/model/model.hpp"

#include <Eigen/Geometry>

#include <cmath>

namespace rubato::results {
namespace {

using Eigen::Vector3d;

struct Tangents {
  Vector3d first;
  Vector3d second;
};

Tangents tangents_of(const Vector3d& normal) {
  constexpr double along_x = 0.95;
  const Vector3d axis = std::abs(normal.x()) > along_x ? Vector3d::UnitZ() : Vector3d::UnitX();
  const Vector3d first = (axis - axis.dot(normal) * normal).normalized();
  return {first, normal.cross(first)};
}

Vector3d displacement_of(const model::Model& model, const step::State& now, mesh::NodeIndex node) {
  Vector3d u = Vector3d::Zero();
  if (model.dofs.has(node))
    u.head(model.dofs.components) = now.motion.u.segment(model.dofs.dof(node, 0), model.dofs.components);
  return u;
}

/// Out of the master, which presses along it; of points without pressure out of the slave's first face.
Vector3d normal_of(const contact::Zone& zone, const contact::PointOutcome& outcome, std::size_t point,
                   const mesh::Mesh& mesh) {
  const double size = outcome.normal.norm();
  if (size > 0)
    return (outcome.pressure < 0 ? -outcome.normal : outcome.normal) / size;
  const auto& places = zone.points[point].stands_on;
  if (places.empty())
    return Vector3d::UnitZ();
  const auto& face = zone.slave.faces[static_cast<std::size_t>(places.front().face)];
  contact::FaceCoordinates nodes(3, face.node_count);
  for (int i = 0; i < face.node_count; ++i)
    nodes.col(i) = mesh.points[static_cast<std::size_t>(face.nodes[static_cast<std::size_t>(i)])];
  return -contact::outward_normal(face.type, nodes, places.front().xi);
}

} // namespace

Vector3d ContactLister::relative_displacement(const step::State& now, std::size_t z, std::size_t point) {
  const auto& zone = model_->zones[z];
  if (pairs_.empty())
    pairs_.resize(model_->zones.size());
  if (pairs_[z].empty() && !zone.obstacle) {
    const Eigen::VectorXd undeformed = Eigen::VectorXd::Zero(model_->dofs.dof_count);
    pairs_[z] = contact::find_pairs(
        zone, {&model_->mesh, &model_->dofs, &undeformed, &undeformed, zone.begin, zone.begin});
  }
  const auto& slave = zone.points[point];
  Vector3d relative = Vector3d::Zero();
  for (std::size_t i = 0; i < slave.nodes.size(); ++i)
    relative += slave.shape[i] * displacement_of(*model_, now, slave.nodes[i]);
  if (zone.obstacle)
    return relative;
  const auto& pair = pairs_[z][point];
  if (!pair.paired())
    return Vector3d::Zero();
  const auto& face = zone.master.faces[static_cast<std::size_t>(pair.master_face)];
  const auto values = contact::face_values(face.type, pair.projection.clamped);
  for (int i = 0; i < face.node_count; ++i)
    relative -= values.at(static_cast<std::size_t>(i)) *
                displacement_of(*model_, now, face.nodes.at(static_cast<std::size_t>(i)));
  return relative;
}

ContactValues ContactLister::at(const step::State& now, std::size_t z, std::size_t point) {
  const auto& state = now.zones[z];
  const auto& outcome = state.outcomes[point];
  const auto normal = normal_of(model_->zones[z], outcome, point, model_->mesh);
  const auto [first, second] = tangents_of(normal);
  const auto relative = relative_displacement(now, z, point);
  const Vector3d traction = -contact::reported_traction(state, point);
  return {std::isfinite(outcome.gap) ? outcome.gap : 0.0,
          {relative.dot(first), relative.dot(second)},
          outcome.pressure,
          {traction.dot(first), traction.dot(second)}};
}

} // namespace rubato::results
