// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/mesh/place_finder.hpp"

#include "rubato/cell/parts.hpp"
#include "rubato/cell/reference_cell.hpp"
#include "rubato/core/field_function.hpp"
#include "rubato/mesh/names.hpp"

#include <Eigen/LU>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <span>

namespace rubato::mesh {
namespace {

using Eigen::Index;
using Eigen::Matrix3Xd;
using Eigen::Vector3d;

/// Places nearer than this part of the size of the mesh are one.
constexpr double same_place = 1e-6;
/// How far a quadratic cell may reach beyond its nodes, in its sizes.
constexpr double bulge = 0.25;
/// How far outside of a cell a place may be, in values of the corners' shape functions.
constexpr double outside = 1e-6;
constexpr int most_iterations = 30;
/// Of a reference coordinate, about rounding.
constexpr double settled = 1e-13;
constexpr double nearly_settled = 1e-7;
constexpr double far_outside = 1e3; ///< likewise

Box box_of(const std::vector<Vector3d>& points) {
  Box box;
  for (const auto& x : points)
    box.extend(x);
  return box;
}

double diagonal_of(const Box& box) {
  return (box.largest - box.least).norm();
}

Matrix3Xd corners(std::span<const NodeIndex> nodes, const std::vector<Vector3d>& points) {
  Matrix3Xd x(3, static_cast<Index>(nodes.size()));
  for (std::size_t i = 0; i < nodes.size(); ++i)
    x.col(static_cast<Index>(i)) = points[static_cast<std::size_t>(nodes[i])];
  return x;
}

std::vector<double> values_at(const cell::ReferenceCell& cell, const Vector3d& xi) {
  std::vector<double> values(static_cast<std::size_t>(cell.node_count));
  cell.values(xi, values);
  return values;
}

/// The step towards the place, in reference coordinates.
Vector3d step_of(const cell::ReferenceCell& cell, const Matrix3Xd& x, const Vector3d& place,
                 const Vector3d& xi) {
  const auto values = values_at(cell, xi);
  const Index d = cell.dimension;
  std::vector<double> gradients(static_cast<std::size_t>(cell.node_count * cell.dimension));
  cell.gradients(xi, gradients);
  const Vector3d here = x * Eigen::Map<const Eigen::VectorXd>(values.data(), x.cols());
  const Eigen::Map<const Eigen::MatrixXd> n_xi(gradients.data(), d, x.cols());
  const Eigen::MatrixXd jacobian = x.topRows(d) * n_xi.transpose();
  Vector3d step = Vector3d::Zero();
  step.head(d) = jacobian.partialPivLu().solve((place - here).head(d));
  return step;
}

/// By Newton's method; nothing where it does not settle.
std::optional<Vector3d> reference_place(const cell::ReferenceCell& cell, const Matrix3Xd& x,
                                        const Vector3d& place) {
  Vector3d xi = Vector3d::Zero();
  for (const auto& node : cell.nodes)
    xi += node / static_cast<double>(cell.nodes.size());
  double left = 0;
  for (int i = 0; i < most_iterations; ++i) {
    const auto step = step_of(cell, x, place, xi);
    xi += step;
    if (!(xi.norm() < far_outside))
      return std::nullopt;
    left = step.norm();
    if (left <= settled)
      return xi;
  }
  // Far from the origin places of a small cell are rounded by more.
  return left <= nearly_settled ? std::optional(xi) : std::nullopt;
}

/// The shape functions of the corners are all >= 0 inside of a cell and nowhere else near it.
bool is_inside(CellType type, const Vector3d& xi) {
  const auto values = values_at(cell::reference_cell(cell::linear_type(type)), xi);
  return std::ranges::all_of(values, [](double value) { return value >= -outside; });
}

} // namespace

std::vector<Box> boxes_around(const std::vector<Vector3d>& points, double by) {
  std::vector<Box> boxes;
  boxes.reserve(points.size());
  for (const auto& x : points)
    boxes.push_back({x.array() - by, x.array() + by});
  return boxes;
}

PlaceFinder::PlaceFinder(const Mesh& mesh) {
  take_nodes(mesh);
  std::vector<CellIndex> cells;
  for_each_cell(mesh, [&](CellIndex cell, const cell::CellTopology& shape, std::span<const NodeIndex>) {
    if (shape.dimension == mesh.dimension && cell::has_reference_cell(shape.type))
      cells.push_back(cell);
  });
  take_cells(mesh, cells);
}

PlaceFinder::PlaceFinder(const Mesh& mesh, std::span<const CellIndex> cells) {
  take_nodes(mesh);
  take_cells(mesh, cells);
}

void PlaceFinder::take_nodes(const Mesh& mesh) {
  nodes_.dimension = mesh.dimension;
  nodes_.points = mesh.points;
  nodes_.node_numbers = mesh.node_numbers;
  nodes_.node_names = mesh.node_names;
  if (!mesh.points.empty())
    tolerance_ = same_place * diagonal_of(box_of(mesh.points));
  nodes_tree_ = BoxTree(boxes_around(mesh.points, tolerance_));
}

void PlaceFinder::take_cells(const Mesh& mesh, std::span<const CellIndex> cells) {
  std::vector<Box> boxes;
  for (const auto cell : cells) {
    const auto& shape = cell::topology(mesh.type_of(cell));
    const auto nodes = mesh.nodes_of(cell);
    cells_.push_back({shape.type, {nodes.begin(), nodes.end()}});
    Box box;
    for (const auto node : nodes)
      box.extend(mesh.points[static_cast<std::size_t>(node)]);
    const double by = (shape.order == 1 ? same_place : bulge) * diagonal_of(box) + tolerance_;
    boxes.push_back({box.least.array() - by, box.largest.array() + by});
  }
  cells_tree_ = BoxTree(std::move(boxes));
}

std::string PlaceFinder::label_of(NodeIndex node) const {
  const auto& x = points()[static_cast<std::size_t>(node)];
  return fmt::format("{} ({})", node_name(nodes_, node),
                     shown_place(std::span<const double, 3>(x.data(), 3)));
}

std::vector<NodeIndex> PlaceFinder::nodes_at(const Vector3d& place) const {
  auto nodes = nodes_tree_.boxes_at(place);
  std::erase_if(nodes, [&](NodeIndex node) {
    return (points()[static_cast<std::size_t>(node)] - place).norm() > tolerance_;
  });
  return nodes;
}

std::vector<CellShare> PlaceFinder::cells_at(const Vector3d& place) const {
  std::vector<CellShare> shares;
  for (const auto index : cells_tree_.boxes_at(place)) {
    const auto& cell = cells_[static_cast<std::size_t>(index)];
    const auto& reference = cell::reference_cell(cell.type);
    const auto xi = reference_place(reference, corners(cell.nodes, points()), place);
    if (xi && is_inside(cell.type, *xi))
      shares.push_back({cell.nodes, values_at(reference, *xi)});
  }
  return shares;
}

} // namespace rubato::mesh
