// SPDX-License-Identifier: LGPL-3.0-or-later
// Kinematic and distributing couplings of a surface or a set with a reference node.
#include "rubato/cell/shape_table.hpp"
#include "rubato/cell/topology.hpp"
#include "rubato/core/naming.hpp"
#include "rubato/inp/followers.hpp"
#include "rubato/inp/points.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rubato::inp {
namespace {

using mesh::inp::compact;
using mesh::inp::ElementFace;
using mesh::inp::field;

/// Weights that differ by less than this part of the largest count as equal.
constexpr double equal_weights = 1e-9;

/// The degrees of freedom that lines name from a field on; all of them without lines.
std::array<bool, 6> coupled_dofs(Reading& reading, const Block& block, std::size_t first_field) {
  std::array<bool, 6> held{};
  bool any = false;
  for (const auto& line : block.lines) {
    const auto fields = mesh::inp::fields_of(line);
    if (fields.size() <= first_field || fields[first_field].empty())
      continue;
    any = true;
    const auto from =
        mesh::inp::require_integer(fields[first_field], "a degree of freedom, 1 to 6", reading.faults);
    const auto last = field(fields, first_field + 1, fields[0]);
    const auto to =
        last.empty() ? from : mesh::inp::require_integer(last, "a degree of freedom, 1 to 6", reading.faults);
    for (std::int64_t dof = 1; dof <= 6; ++dof)
      if (from && to && dof >= *from && dof <= *to)
        held[static_cast<std::size_t>(dof) - 1] = true;
  }
  if (!any)
    held.fill(true);
  return held;
}

/// ∫ N of the nodes of a face, times the circumference where the model is axisymmetric.
std::vector<double> shares_of_face(const Reading& reading, const ElementFace& face,
                                   std::vector<std::int32_t>& nodes) {
  const auto& element = reading.content.elements[static_cast<std::size_t>(face.element)];
  const auto all = reading.content.nodes_of(element);
  const auto& side = cell::topology(*element.type->cell).sides[static_cast<std::size_t>(face.side)];
  nodes.clear();
  for (const auto i : side.nodes)
    nodes.push_back(all[i]);
  const auto& table = cell::mass_table(side.type);
  const int dimension = cell::topology(side.type).dimension;
  std::vector<double> shares(nodes.size(), 0.0);
  for (Eigen::Index q = 0; q < table.weights.size(); ++q) {
    Eigen::Vector3d first = Eigen::Vector3d::Zero(), second = first, place = first;
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      const auto row = static_cast<Eigen::Index>(n);
      const auto point = point_of(reading, nodes[n]);
      place += table.values(row, q) * point;
      first += table.gradients(row * dimension, q) * point;
      if (dimension == 2)
        second += table.gradients(row * dimension + 1, q) * point;
    }
    double area = (dimension == 2 ? first.cross(second).norm() : first.norm()) * table.weights[q];
    if (reading.study.physics == study::Physics::axisymmetric)
      area *= place.x();
    for (std::size_t n = 0; n < nodes.size(); ++n)
      shares[n] += table.values(static_cast<Eigen::Index>(n), q) * area;
  }
  return shares;
}

/// The share of each follower in the area of the surface; 1 each of sets and of surfaces of nodes.
std::vector<double> weights_of(const Reading& reading, const Followers& followers) {
  std::vector<double> weights(followers.nodes.size(), followers.faces.empty() ? 1.0 : 0.0);
  std::vector<std::int32_t> nodes;
  for (const auto& face : followers.faces) {
    const auto shares = shares_of_face(reading, face, nodes);
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      const auto at = std::ranges::lower_bound(followers.nodes, nodes[n]);
      weights[static_cast<std::size_t>(at - followers.nodes.begin())] += shares[n];
    }
  }
  return weights;
}

bool are_equal(const std::vector<double>& weights) {
  const auto [least, largest] = std::ranges::minmax(weights);
  return largest - least <= equal_weights * std::abs(largest);
}

/// Farthest from the reference first: rotations follow from long arms.
std::vector<std::int32_t> farthest_first(const Reading& reading, std::vector<std::int32_t> nodes,
                                         std::int32_t reference) {
  const auto place = point_of(reading, reference);
  std::erase(nodes, reference);
  std::ranges::stable_sort(nodes, std::ranges::greater(), [&](std::int32_t node) {
    return (point_of(reading, node) - place).squaredNorm();
  });
  return nodes;
}

struct Coupling {
  std::int32_t reference = -1;
  std::array<bool, 6> dofs{};
  const LocalAxes* axes = nullptr;
  Word at;
  std::string label;
};

/// Every coupled direction of every follower is that of the rigid motion of the reference.
void couple_kinematically(Reading& reading, const Followers& followers, const Coupling& coupling) {
  for (const auto node : farthest_first(reading, followers.nodes, coupling.reference)) {
    if (!is_of_body(reading, node) && !reading.used_nodes.contains(node))
      continue;
    const auto place = point_of(reading, node);
    const Eigen::Matrix3d axes =
        coupling.axes != nullptr ? axes_at(*coupling.axes, place) : Eigen::Matrix3d::Identity();
    for (int dof = 0; dof < std::min(reading.dimension(), 3); ++dof) {
      if (!coupling.dofs.at(static_cast<std::size_t>(dof)))
        continue;
      const Eigen::Vector3d along = axes.col(dof);
      Sum sum;
      sum.add(node, along);
      add_carried(reading, coupling.reference, place, along, -1, sum);
      add_equation(reading, sum, coupling.label, coupling.at);
    }
  }
}

/// The reference moves as the followers do in the weighted mean: its rotation is that of the least squares.
void couple_by_means(Reading& reading, const Followers& followers, const std::vector<double>& weights,
                     const Coupling& coupling) {
  double total = 0;
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (std::size_t n = 0; n < weights.size(); ++n) {
    total += weights[n];
    middle += weights[n] * point_of(reading, followers.nodes[n]);
  }
  middle /= total;
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  for (std::size_t n = 0; n < weights.size(); ++n) {
    const Eigen::Vector3d arm = point_of(reading, followers.nodes[n]) - middle;
    inertia += weights[n] / total * (arm.squaredNorm() * Eigen::Matrix3d::Identity() - arm * arm.transpose());
  }
  const Eigen::FullPivLU<Eigen::Matrix3d> solver(inertia);
  const bool flat = reading.dimension() == 2;
  if (flat ? !(inertia(2, 2) > 0) : solver.rcond() < 1e-12)
    return reading.faults.add(coupling.at, "found a distributing coupling of nodes on a line, which have no "
                                           "rotation about it, expected nodes that span a surface");
  const Eigen::Matrix3d inverse =
      flat ? Eigen::Matrix3d(Eigen::Vector3d(0, 0, 1 / inertia(2, 2)).asDiagonal()) : inertia.inverse();
  const Eigen::Vector3d offset = point_of(reading, coupling.reference) - middle;
  const auto rotation = reading.content.rotation_nodes.at(coupling.reference);
  // θ = inverse Σ w arm × u; about an axis a: Σ w ((inverse a) × arm) · u
  const auto add_rotation = [&](const Eigen::Vector3d& about, double factor, Sum& sum) {
    const Eigen::Vector3d turned = inverse * about;
    for (std::size_t n = 0; n < weights.size(); ++n) {
      const Eigen::Vector3d arm = point_of(reading, followers.nodes[n]) - middle;
      sum.add(followers.nodes[n], factor * weights[n] / total * turned.cross(arm));
    }
  };
  for (int axis = 0; axis < reading.dimension(); ++axis) {
    const Eigen::Vector3d along = Eigen::Vector3d::Unit(axis);
    Sum sum;
    sum.add(coupling.reference, along);
    for (std::size_t n = 0; n < weights.size(); ++n)
      sum.add(followers.nodes[n], -weights[n] / total * along);
    add_rotation(offset.cross(along), -1, sum);
    add_equation(reading, sum, coupling.label, coupling.at);
  }
  for (int axis = flat ? 2 : 0; axis < 3; ++axis) {
    Sum sum;
    sum.add(rotation, Eigen::Vector3d::Unit(flat ? 0 : axis));
    add_rotation(Eigen::Vector3d::Unit(axis), -1, sum);
    add_equation(reading, sum, coupling.label, coupling.at);
  }
}

bool is_followed_by_itself(Reading& reading, const Followers& followers, const Coupling& coupling) {
  if (!std::ranges::binary_search(followers.nodes, coupling.reference))
    return false;
  reading.faults.add(coupling.at,
                     fmt::format("found the reference node {} among the nodes that it is the "
                                 "mean of, expected a node of its own",
                                 reading.content.node_numbers[static_cast<std::size_t>(coupling.reference)]));
  return true;
}

/// Lines of the reference refer to the axes of the coupling at its place, as in CalculiX.
void turn_reference(Reading& reading, const Coupling& coupling) {
  LocalAxes axes;
  axes.turn = axes_at(*coupling.axes, point_of(reading, coupling.reference));
  for (const auto node : {coupling.reference, reading.content.rotation_nodes.at(coupling.reference)})
    reading.axes_of_node[node] = reading.transforms.size();
  reading.transforms.push_back(axes);
  note(reading, coupling.at,
       "forces and displacements of the reference node of a distributing coupling with ORIENTATION are along "
       "its axes, as in CalculiX");
}

void couple(Reading& reading, const Followers& followers, const Coupling& coupling, bool kinematic) {
  const bool has_rotation = reading.content.rotation_nodes.contains(coupling.reference);
  if (kinematic && !has_rotation) {
    add_reference(reading, study::RelationKind::rigid, followers, coupling.reference, coupling.at,
                  coupling.label);
    return;
  }
  if (kinematic)
    return couple_kinematically(reading, followers, coupling);
  const auto weights = weights_of(reading, followers);
  if (is_followed_by_itself(reading, followers, coupling))
    return;
  if (coupling.axes != nullptr)
    turn_reference(reading, coupling);
  const bool plain = are_equal(weights) && coupling.axes == nullptr &&
                     !is_of_body(reading, coupling.reference) &&
                     !reading.content.shared_references.contains(coupling.reference) &&
                     reading.study.physics != study::Physics::axisymmetric;
  if (plain)
    add_reference(reading, study::RelationKind::distributed, followers, coupling.reference, coupling.at,
                  coupling.label);
  else
    couple_by_means(reading, followers, weights, coupling);
}

const LocalAxes* coupling_axes(Reading& reading, const Block& block, LocalAxes& storage) {
  const auto* const orientation = block.find("ORIENTATION");
  if (orientation == nullptr)
    return nullptr;
  const auto* const axes = named(reading.axes, orientation->value, "an orientation", reading.faults);
  if (axes == nullptr)
    return nullptr;
  storage = local_axes(*axes);
  return &storage;
}

} // namespace

LocalAxes local_axes(const Axes& axes) {
  LocalAxes local;
  local.turn = axes.turn;
  if (!axes.cylindrical)
    return local;
  local.kind = LocalAxes::Kind::cylindrical;
  const auto& point = axes.cylindrical->point;
  const auto& line = axes.cylindrical->direction;
  local.origin = {point[0], point[1], point[2]};
  local.turn.col(2) = Eigen::Vector3d(line[0], line[1], line[2]).normalized();
  return local;
}

void read_coupling(Reading& reading, std::size_t index) {
  const auto& blocks = reading.content.layout.blocks;
  const auto& placed = blocks[index];
  const auto& block = *placed.block;
  const auto surface = mesh::inp::require_value(block, "SURFACE", "a surface", reading.faults);
  const auto reference = mesh::inp::require_value(block, "REFNODE", "a node", reading.faults);
  const auto* const next = index + 1 < blocks.size() ? blocks[index + 1].block : nullptr;
  const bool kinematic = next != nullptr && next->is("KINEMATIC");
  if (!kinematic && (next == nullptr || !next->is("DISTRIBUTING")))
    return reading.faults.add(
        block.at, fmt::format("found {} without *KINEMATIC or *DISTRIBUTING after it", block.at.text));
  mesh::inp::check_parameters(*next, reading.faults);
  for (const auto* key : {"CYCLICSYMMETRY", "CYCLICSYMMETRYMODEL"})
    if (next->find(key) != nullptr)
      return reading.faults.add(next->find(key)->name, "found a coupling of a sector of a cyclic structure, "
                                                       "expected a model of the whole circumference");
  if (const auto* way = next->find("WEIGHTINGMETHOD");
      way != nullptr && compact(way->value.text) != "UNIFORM")
    reading.faults.add(way->value,
                       fmt::format("found WEIGHTING METHOD={}, expected UNIFORM", way->value.text));
  Coupling coupling;
  LocalAxes axes;
  coupling.dofs = coupled_dofs(reading, *next, 0);
  coupling.axes = coupling_axes(reading, block, axes);
  if (surface.empty() || reference.empty())
    return;
  const auto followers = surface_followers(reading, placed.scope, surface);
  const auto node = one_node(reading, placed.scope, reference);
  if (!followers || !node)
    return;
  const auto* const name = block.find("CONSTRAINTNAME");
  coupling.reference = *node;
  coupling.at = reference;
  coupling.label = name == nullptr ? surface.text : name->value.text;
  couple(reading, *followers, coupling, kinematic);
}

void read_kinematic_coupling(Reading& reading, std::size_t index) {
  const auto& placed = reading.content.layout.blocks[index];
  const auto& block = *placed.block;
  const auto reference = mesh::inp::require_value(block, "REFNODE", "a node", reading.faults);
  const auto node = reference.empty() ? std::nullopt : one_node(reading, placed.scope, reference);
  LocalAxes axes;
  Coupling coupling;
  coupling.axes = coupling_axes(reading, block, axes);
  coupling.reference = node.value_or(-1);
  if (coupling.reference < 0)
    return;
  coupling.at = reference;
  if (block.lines.empty())
    return reading.faults.add(block.at, fmt::format("found {} without nodes, expected a set of nodes, or "
                                                    "nodes, with their degrees of freedom",
                                                    block.at.text));
  const bool rigid = !reading.content.rotation_nodes.contains(coupling.reference);
  if (rigid && block.lines.size() == 1) {
    const auto fields = mesh::inp::fields_at(block, 0);
    const auto followers = set_followers(reading, placed.scope, fields[0], false);
    coupling.label = fields[0].text;
    if (followers)
      couple(reading, *followers, coupling, true);
    return;
  }
  for (const auto& line : block.lines) {
    const auto fields = mesh::inp::fields_of(line);
    const auto found = fields.empty()
                           ? std::nullopt
                           : mesh::inp::find_nodes(reading.content, placed.scope, fields[0], reading.faults);
    if (!found)
      continue;
    Block one = block;
    one.lines = {line};
    coupling.dofs = coupled_dofs(reading, one, 1);
    coupling.label = fields[0].text;
    if (rigid)
      return reading.faults.add(
          fields[0], fmt::format("found several lines of {}, expected one set of nodes", block.at.text));
    couple_kinematically(reading, {found->name, found->items, {}}, coupling);
  }
}

void read_distributing_coupling(Reading& reading, std::size_t index) {
  const auto& placed = reading.content.layout.blocks[index];
  const auto& block = *placed.block;
  const auto reference = mesh::inp::require_value(block, "REFNODE", "a node", reading.faults);
  const auto node = reference.empty() ? std::nullopt : one_node(reading, placed.scope, reference);
  if (!node)
    return;
  Followers followers;
  std::map<std::int32_t, double> weights;
  for (const auto& line : block.lines) {
    const auto fields = mesh::inp::fields_of(line);
    const auto found = fields.empty()
                           ? std::nullopt
                           : mesh::inp::find_nodes(reading.content, placed.scope, fields[0], reading.faults);
    const auto weight = mesh::inp::require_number(field(fields, 1, fields.empty() ? block.at : fields[0]),
                                                  "a weight", reading.faults, 1);
    if (!found || !weight)
      continue;
    for (const auto item : found->items)
      weights[item] = *weight;
  }
  std::vector<double> list;
  for (const auto& [item, weight] : weights) {
    followers.nodes.push_back(item);
    list.push_back(weight);
  }
  Coupling coupling;
  coupling.reference = *node;
  coupling.at = reference;
  coupling.label = "distributing";
  if (followers.nodes.empty())
    return reading.faults.add(
        block.at, fmt::format("found {} without nodes, expected some with their weights", block.at.text));
  if (!is_followed_by_itself(reading, followers, coupling))
    couple_by_means(reading, followers, list, coupling);
}

} // namespace rubato::inp
