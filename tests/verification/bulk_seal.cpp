// SPDX-License-Identifier: LGPL-3.0-or-later
#include "verification/bulk_seal.hpp"

#include "rubato/domain/bulk.hpp"
#include "rubato/mesh/builder.hpp"

#include <fmt/format.h>

#include "verification/bulk_run.hpp"
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <utility>

namespace rubato::verification {
namespace {

using Eigen::Vector3d;
using mesh::NodeIndex;

constexpr double cord = 1, mean_radius = 10, groove = 2.4;
constexpr double inner_wall = mean_radius - groove / 2, outer_wall = mean_radius + groove / 2;

/// A disc of QUAD4 about the origin: a core of 2n × 2n, whose sides bulge, and n rings between it and the
/// circle.
class Disc {
public:
  explicit Disc(int n) : n_(n) {}

  /// Cells into the group `ring`, the circle into `skin`; the disc is moved to `centre`.
  void add_to(mesh::MeshBuilder& builder, const Vector3d& centre) {
    centre_ = centre;
    const int parts = 2 * n_;
    for (int i = 0; i < parts; ++i)
      for (int j = 0; j < parts; ++j)
        add_cell(builder, {core(i, j), core(i + 1, j), core(i + 1, j + 1), core(i, j + 1)});
    for (int side = 0; side < 4; ++side)
      for (int i = 0; i < parts; ++i) {
        for (int ring = 0; ring < n_; ++ring)
          add_cell(builder, {at(side, i, ring), at(side, i, ring + 1), at(side, i + 1, ring + 1),
                             at(side, i + 1, ring)});
        add_edge(builder, at(side, i, n_), at(side, i + 1, n_));
      }
  }

private:
  Vector3d core(int i, int j) const {
    const double x = 0.5 * cord * (static_cast<double>(i) / n_ - 1);
    const double y = 0.5 * cord * (static_cast<double>(j) / n_ - 1);
    return (1 + 0.15 * (1 - 2 * (x * x + y * y) / (cord * cord))) * Vector3d(x, y, 0);
  }

  /// Sides in turn from the lower one on, counter-clockwise.
  Vector3d at(int side, int i, int ring) const {
    const int parts = 2 * n_;
    const Vector3d inner = side == 0   ? core(i, 0)
                           : side == 1 ? core(parts, i)
                           : side == 2 ? core(parts - i, parts)
                                       : core(0, parts - i);
    const double angle = std::numbers::pi / 2 * (side + static_cast<double>(i) / parts - 1.5);
    const Vector3d outer = cord * Vector3d(std::cos(angle), std::sin(angle), 0);
    return inner + (outer - inner) * ring / n_;
  }

  NodeIndex node_at(mesh::MeshBuilder& builder, const Vector3d& x) {
    constexpr double grid = 1e6; // nodes are further apart than its lines
    const std::pair key(std::lround(x[0] * grid), std::lround(x[1] * grid));
    const auto known = nodes_.find(key);
    return known != nodes_.end() ? known->second : nodes_[key] = builder.add_node(centre_ + x);
  }

  void add_cell(mesh::MeshBuilder& builder, const std::array<Vector3d, 4>& corners) {
    std::array<NodeIndex, 4> nodes;
    std::ranges::transform(corners, nodes.begin(), [&](const Vector3d& x) { return node_at(builder, x); });
    const std::array cell{builder.add_cell(CellType::quad4, nodes)};
    builder.add_to_cell_group("ring", cell);
  }

  void add_edge(mesh::MeshBuilder& builder, const Vector3d& a, const Vector3d& b) {
    const std::array nodes{node_at(builder, a), node_at(builder, b)};
    const std::array edge{builder.add_cell(CellType::seg2, nodes)};
    builder.add_to_cell_group("skin", edge);
  }

  int n_;
  Vector3d centre_ = Vector3d::Zero();
  std::map<std::pair<long, long>, NodeIndex> nodes_;
};

/// A rigid surface: it faces what is on its left.
void add_line(mesh::MeshBuilder& builder, const std::string& name, const Vector3d& from, const Vector3d& to) {
  const std::array nodes{builder.add_node(from), builder.add_node(to)};
  const std::array line{builder.add_cell(CellType::seg2, nodes)};
  builder.add_to_cell_group(name, line);
}

mesh::Mesh seal_mesh(int n) {
  constexpr double beyond = 0.2 * cord, top = 2 * cord;
  mesh::MeshBuilder builder(2);
  Disc(n).add_to(builder, {mean_radius, cord, 0});
  add_line(builder, "floor", {inner_wall, 0, 0}, {outer_wall, 0, 0});
  add_line(builder, "lid", {outer_wall, top, 0}, {inner_wall, top, 0});
  add_line(builder, "inner", {inner_wall, top + beyond, 0}, {inner_wall, -beyond, 0});
  add_line(builder, "outer", {outer_wall, -beyond, 0}, {outer_wall, top + beyond, 0});
  return std::move(builder).build();
}

/// Time is the squeeze in parts of the diameter.
constexpr std::string_view seal_deck = R"(
mesh: {file: seal.med}
physics: axisymmetric
materials: {rubber: {law: hyperelastic, c10: 0.6, c01: 0.15, bulk: 150, cells: ring}}
functions: {press: {times: [0, 1], values: [0, 1]}}
supports:
  - {on: floor, fix: [x, y]}
  - {on: inner, fix: [x, y]}
  - {on: outer, fix: [x, y]}
  - {on: lid, fix: x, y: {value: -2, function: press}}
contact:
  below: {master: floor, slave: skin, friction: 0.1}
  inside: {master: inner, slave: skin, friction: 0.1}
  outside: {master: outer, slave: skin, friction: 0.1}
  above: {master: lid, slave: skin, friction: 0.1}
probes:
  lid: {on: lid, field: reaction}
  inner: {on: inner, field: reaction}
  outer: {on: outer, field: reaction}
time: {scheme: static, end: 0.3, step: )";

} // namespace

SealResult press_seal(int n, double step) {
  BulkRun run(fmt::format("{}{}}}\n", seal_deck, step), seal_mesh(n));
  SealResult result{.cells = static_cast<int>(run.walk().model.bulk.cells.size())};
  for (const std::size_t i : {0U, 1U, 2U}) {
    run.go_to(0.1 * static_cast<double>(i + 1));
    result.force[i] = -run.probe("lid.y");
  }
  result.wall = std::abs(run.probe("outer.x")) + std::abs(run.probe("inner.x"));
  const auto& energy = run.walk().simulation.energy();
  result.balance = std::abs(energy.balance()) / energy.largest();
  result.steps = static_cast<int>(run.walk().simulation.counters().steps);
  result.cuts = run.cuts();
  result.bulk = run.iterations();
  for (const auto& report : run.walk().reports) {
    result.iterations += report.iterations;
    result.indefinite = result.indefinite || report.indefinite;
  }
  return result;
}

} // namespace rubato::verification
