// SPDX-License-Identifier: LGPL-3.0-or-later
// Multi-point constraints of *MPC as linear equations.
#include "rubato/core/naming.hpp"
#include "rubato/inp/points.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace rubato::inp {
namespace {

using Eigen::Vector3d;
using mesh::inp::compact;

/// A constraint with its nodes, which may be written on several lines.
struct Mpc {
  Word at;
  std::string kind;
  std::vector<Word> words;                        ///< of nodes
  std::vector<std::vector<std::int32_t>> entries; ///< the nodes of each word
  std::vector<std::int32_t> nodes;                ///< all of them in the order of the lines
};

Word label_of(const Mpc& mpc) {
  return mpc.at;
}

void refuse_count(Reading& reading, const Mpc& mpc, std::string_view expected) {
  reading.faults.add(label_of(mpc), fmt::format("found {} nodes of an MPC of type {}, expected {}",
                                                mpc.nodes.size(), mpc.kind, expected));
}

/// u_a = Σ weights of others, along each axis of the model.
void follow(Reading& reading, const Mpc& mpc, std::int32_t node,
            const std::vector<std::pair<std::int32_t, double>>& others) {
  for (int axis = 0; axis < reading.dimension(); ++axis) {
    Sum sum;
    sum.add(node, Vector3d::Unit(axis));
    for (const auto& [other, weight] : others)
      sum.add(other, -weight * Vector3d::Unit(axis));
    add_equation(reading, sum, "mpc", mpc.at);
  }
}

/// Pairs of nodes, or of sets of as many, or a set and a node, with the same displacement.
void join(Reading& reading, const Mpc& mpc) {
  if (mpc.entries.size() != 2)
    return reading.faults.add(mpc.at, fmt::format("found {} nodes, expected two", mpc.entries.size()));
  const auto& first = mpc.entries[0];
  const auto& second = mpc.entries[1];
  if (second.size() != 1 && second.size() != first.size())
    return reading.faults.add(mpc.words[1], fmt::format("found {} nodes beside {}, expected as many, or one",
                                                        second.size(), first.size()));
  for (std::size_t i = 0; i < first.size(); ++i) {
    const auto other = second[second.size() == 1 ? 0 : i];
    if (other == first[i])
      continue;
    follow(reading, mpc, first[i], {{other, 1}});
    const auto turned = reading.content.rotation_nodes.find(first[i]);
    const auto turns = reading.content.rotation_nodes.find(other);
    const bool both = turned != reading.content.rotation_nodes.end() &&
                      turns != reading.content.rotation_nodes.end() && mpc.kind == "TIE";
    if (both)
      follow(reading, mpc, turned->second, {{turns->second, 1}});
  }
}

/// The distance of two nodes is kept, to first order.
void keep_distance(Reading& reading, const Mpc& mpc) {
  if (mpc.nodes.size() != 2)
    return refuse_count(reading, mpc, "two");
  const auto a = mpc.nodes[0], b = mpc.nodes[1];
  const auto rotation = reading.content.rotation_nodes.find(b);
  const bool carried = mpc.kind == "BEAM" && rotation != reading.content.rotation_nodes.end() &&
                       reading.used_nodes.contains(rotation->second);
  if (carried) {
    for (int axis = 0; axis < reading.dimension(); ++axis) {
      Sum sum;
      sum.add(a, Vector3d::Unit(axis));
      add_carried(reading, b, point_of(reading, a), Vector3d::Unit(axis), -1, sum);
      add_equation(reading, sum, "mpc", mpc.at);
    }
    return;
  }
  const Vector3d way = point_of(reading, b) - point_of(reading, a);
  if (way.norm() == 0)
    return reading.faults.add(mpc.at, fmt::format("found two nodes at one place in an MPC of type {}, "
                                                  "expected PIN",
                                                  mpc.kind));
  Sum sum;
  sum.add(a, way.normalized());
  sum.add(b, -way.normalized());
  add_equation(reading, sum, "mpc", mpc.at);
  if (mpc.kind == "BEAM")
    note(reading, mpc.at,
         "BEAM keeps the distance of two nodes, as CalculiX has it; in Abaqus it is a rigid beam where the "
         "second node has rotations");
}

/// Nodes on the line through the first and the last one stay on it, to first order.
void keep_straight(Reading& reading, const Mpc& mpc, std::int32_t from, std::int32_t to,
                   std::span<const std::int32_t> others) {
  const Vector3d start = point_of(reading, from);
  const Vector3d way = point_of(reading, to) - start;
  if (way.norm() == 0)
    return reading.faults.add(mpc.at, "found a line between two nodes at one place, expected two places");
  const Vector3d along = way.normalized();
  std::vector<Vector3d> across{along.unitOrthogonal()};
  if (reading.dimension() == 2)
    across = {Vector3d(-along.y(), along.x(), 0)};
  else
    across.push_back(along.cross(across[0]));
  for (const auto node : others) {
    const double part = (point_of(reading, node) - start).dot(way) / way.squaredNorm();
    for (const auto& direction : across) {
      Sum sum;
      sum.add(node, direction);
      sum.add(from, (part - 1) * direction);
      sum.add(to, -part * direction);
      add_equation(reading, sum, "mpc", mpc.at);
    }
  }
}

/// Nodes in the plane of the first three stay in it, to first order.
void keep_plane(Reading& reading, const Mpc& mpc) {
  if (mpc.nodes.size() < 4 || reading.dimension() == 2)
    return refuse_count(reading, mpc, "four or more in space");
  const auto& n = mpc.nodes;
  const Vector3d a = point_of(reading, n[0]);
  const Vector3d ab = point_of(reading, n[1]) - a, ac = point_of(reading, n[2]) - a;
  const Vector3d normal = ab.cross(ac);
  if (normal.norm() <= 1e-10 * ab.norm() * ac.norm())
    return reading.faults.add(mpc.at, "found three first nodes on a line, expected three that span a plane");
  const Vector3d unit = normal.normalized();
  for (std::size_t i = 3; i < n.size(); ++i) {
    const Vector3d at = point_of(reading, n[i]) - a;
    const double second = at.cross(ac).dot(normal) / normal.squaredNorm();
    const double third = ab.cross(at).dot(normal) / normal.squaredNorm();
    Sum sum;
    sum.add(n[i], unit);
    sum.add(n[0], (second + third - 1) * unit);
    sum.add(n[1], -second * unit);
    sum.add(n[2], -third * unit);
    add_equation(reading, sum, "mpc", mpc.at);
  }
}

/// The mean rotation of nodes about an axis through their mean is the first displacement of the last node,
/// whose coordinates are the axis.
void keep_mean_rotation(Reading& reading, const Mpc& mpc) {
  auto nodes = mpc.nodes;
  if (nodes.size() < 3)
    return refuse_count(reading, mpc, "nodes and a last one that has the axis and the rotation");
  const auto angle = nodes.back();
  nodes.pop_back();
  std::ranges::sort(nodes);
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  const Vector3d given = point_of(reading, angle);
  if (given.norm() == 0)
    return reading.faults.add(mpc.words.back(), "found a last node at 0, whose coordinates are the axis of "
                                                "the mean rotation, expected a direction");
  const Vector3d axis = given.normalized();
  Vector3d middle = Vector3d::Zero();
  for (const auto node : nodes)
    middle += point_of(reading, node) / static_cast<double>(nodes.size());
  Sum sum;
  sum.add(angle, Vector3d::UnitX());
  const auto count = static_cast<double>(nodes.size());
  Vector3d mean = Vector3d::Zero(); // of what the nodes' own displacements are multiplied by
  std::vector<Vector3d> turned;
  double counted = 0;
  for (const auto node : nodes) {
    Vector3d arm = point_of(reading, node) - middle;
    arm -= arm.dot(axis) * axis;
    const bool on_axis = arm.norm() <= 1e-10 * (point_of(reading, node) - middle).norm() || arm.norm() == 0;
    turned.push_back(on_axis ? Vector3d::Zero() : Vector3d(axis.cross(arm) / arm.squaredNorm()));
    counted += on_axis ? 0 : 1;
    mean += turned.back() / count;
  }
  if (counted == 0)
    return reading.faults.add(mpc.at, "found nodes on the axis of a mean rotation only, expected some beside "
                                      "it");
  for (std::size_t i = 0; i < nodes.size(); ++i)
    sum.add(nodes[i], -(turned[i] - mean) / counted);
  add_equation(reading, sum, "mpc", mpc.at);
}

/// A node between two, or in a face of four, as shape functions say.
void keep_between(Reading& reading, const Mpc& mpc) {
  if (mpc.nodes.size() != 3)
    return refuse_count(reading, mpc, "three");
  const Vector3d start = point_of(reading, mpc.nodes[1]);
  const Vector3d way = point_of(reading, mpc.nodes[2]) - start;
  if (way.norm() == 0)
    return reading.faults.add(mpc.at, "found a line between two nodes at one place, expected two places");
  const double part = (point_of(reading, mpc.nodes[0]) - start).dot(way) / way.squaredNorm();
  follow(reading, mpc, mpc.nodes[0], {{mpc.nodes[1], 1 - part}, {mpc.nodes[2], part}});
}

void apply(Reading& reading, const Mpc& mpc) {
  const auto& kind = mpc.kind;
  const std::span<const std::int32_t> nodes = mpc.nodes;
  if (kind == "PIN" || kind == "TIE")
    return join(reading, mpc);
  if (kind == "LINEAR")
    return keep_between(reading, mpc);
  if (kind == "STRAIGHT" && nodes.size() < 3)
    return refuse_count(reading, mpc, "three or more");
  if (kind == "SLIDER" && nodes.size() < 3)
    return refuse_count(reading, mpc, "three or more");
  if (kind == "STRAIGHT")
    keep_straight(reading, mpc, nodes.front(), nodes.back(), nodes.subspan(1, nodes.size() - 2));
  else if (kind == "SLIDER")
    keep_straight(reading, mpc, nodes[1], nodes.back(), nodes.first(1));
  else if (kind == "PLANE")
    keep_plane(reading, mpc);
  else if (kind == "MEANROT")
    keep_mean_rotation(reading, mpc);
  else
    keep_distance(reading, mpc);
  note(reading, mpc.at,
       fmt::format("MPC of type {} is linear in rubato: it holds for small rotations, also "
                   "with NLGEOM",
                   kind));
}

constexpr std::array<std::string_view, 9> known_kinds{"PIN",   "TIE",     "LINEAR", "STRAIGHT", "SLIDER",
                                                      "PLANE", "MEANROT", "BEAM",   "LINK"};

/// Lines of a constraint; a line that begins with no type goes on with the nodes of the one above.
std::vector<Mpc> constraints_of(const Block& block) {
  std::vector<Mpc> all;
  for (const auto& line : block.lines) {
    const auto fields = mesh::inp::fields_of(line);
    if (fields.empty())
      continue;
    const auto number = mesh::inp::integer_in(fields[0].text);
    const bool goes_on = !all.empty() && (fields[0].empty() || number);
    if (!goes_on)
      all.push_back({fields[0], compact(fields[0].text), {}, {}, {}});
    const std::size_t first = goes_on && number.value_or(0) != 0 ? 0 : 1;
    for (std::size_t i = first; i < fields.size(); ++i)
      if (!fields[i].empty())
        all.back().words.push_back(fields[i]);
  }
  return all;
}

} // namespace

void read_mpc(Reading& reading, std::size_t index) {
  const auto& placed = reading.content.layout.blocks[index];
  for (auto& mpc : constraints_of(*placed.block)) {
    if (std::ranges::find(known_kinds, std::string_view(mpc.kind)) == known_kinds.end()) {
      reading.faults.add(mpc.at,
                         fmt::format("found an MPC of type {}, expected PIN, TIE, LINEAR, STRAIGHT, SLIDER, "
                                     "PLANE, MEANROT, BEAM or LINK",
                                     shown(std::string(mpc.at.text))));
      continue;
    }
    bool sound = true;
    for (const auto& word : mpc.words) {
      const auto found = mesh::inp::find_nodes(reading.content, placed.scope, word, reading.faults);
      sound = sound && found.has_value();
      mpc.entries.push_back(found ? found->items : std::vector<std::int32_t>{});
      mpc.nodes.insert(mpc.nodes.end(), mpc.entries.back().begin(), mpc.entries.back().end());
    }
    if (sound)
      apply(reading, mpc);
  }
}

} // namespace rubato::inp
