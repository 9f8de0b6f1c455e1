// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/model/embedding.hpp"

#include "rubato/cell/parts.hpp"
#include "rubato/cell/reference_cell.hpp"

#include <Eigen/LU>
#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace rubato::model {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using mesh::CellIndex;
using mesh::NodeIndex;

constexpr int most_iterations = 50;
/// Of the size of the reference cell.
constexpr double solved = 1e-14;
/// Shape functions of the corners are negative outside of the cell: the least that counts as on its side.
constexpr double on_side = -1e-6;

/// N_i and ∂N_i/∂ξ_a at a point of the reference cell.
struct Shapes {
  std::vector<double> values;
  MatrixXd gradients; ///< nodes × dimension
};

Shapes shapes_at(const cell::ReferenceCell& reference, const Vector3d& xi) {
  Shapes shapes{std::vector<double>(static_cast<std::size_t>(reference.node_count)), {}};
  std::vector<double> flat(shapes.values.size() * static_cast<std::size_t>(reference.dimension));
  reference.values(xi, shapes.values);
  reference.gradients(xi, flat);
  shapes.gradients = Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
      flat.data(), reference.node_count, reference.dimension);
  return shapes;
}

/// The mean of the reference nodes.
Vector3d middle_of(const cell::ReferenceCell& reference) {
  const Vector3d sum =
      std::accumulate(reference.nodes.begin(), reference.nodes.end(), Vector3d(Vector3d::Zero()));
  return sum / static_cast<double>(reference.node_count);
}

/// Where all shape functions of the corners are at least 0 a point is in the cell, whatever its shape.
bool is_inside(CellType type, const Vector3d& xi) {
  const auto& corners = cell::reference_cell(cell::linear_type(type));
  std::vector<double> values(static_cast<std::size_t>(corners.node_count));
  corners.values(xi, values);
  return std::ranges::all_of(values, [](double value) { return value >= on_side; });
}

} // namespace

std::string of_group(const std::string& name) {
  return name.empty() ? "" : fmt::format(" of group '{}'", name);
}

std::vector<CellIndex> host_cells(const mesh::Mesh& mesh, int dimension, const Mention& group,
                                  std::vector<Fault>& faults) {
  std::vector<CellIndex> cells;
  if (group.name.empty()) {
    cells.resize(static_cast<std::size_t>(mesh.cell_count()));
    std::iota(cells.begin(), cells.end(), CellIndex{0});
  } else if (const auto* named = cells_named(mesh, group, faults)) {
    cells = named->items;
  } else {
    return cells;
  }
  std::erase_if(cells,
                [&](CellIndex cell) { return cell::topology(mesh.type_of(cell)).dimension != dimension; });
  if (cells.empty())
    faults.push_back(fault_at(group.path, fmt::format("group '{}' holds no cells that deform", group.name)));
  return cells;
}

CellFinder::CellFinder(const mesh::Mesh& mesh, std::span<const CellIndex> cells)
    : mesh_(mesh), cells_(cells.begin(), cells.end()) {
  for (const auto cell : cells_) {
    const auto nodes = mesh.nodes_of(cell);
    Vector3d centre = Vector3d::Zero();
    for (const auto node : nodes)
      centre += mesh.points[static_cast<std::size_t>(node)] / static_cast<double>(nodes.size());
    for (const auto node : nodes)
      reach_ = std::max(reach_, (mesh.points[static_cast<std::size_t>(node)] - centre).norm());
    centres_.push_back(centre);
  }
  reach_ *= 1 - 10 * on_side;
  tree_.emplace(centres_);
}

std::optional<Embedding> CellFinder::find(const Vector3d& place, NodeIndex except) const {
  std::vector<std::uint32_t> near;
  tree_->append_within(place, reach_, near);
  std::ranges::sort(near);
  for (const auto i : near) {
    const auto nodes = mesh_.nodes_of(cells_[i]);
    if (std::ranges::find(nodes, except) != nodes.end())
      continue;
    if (auto found = place_in(cells_[i], place))
      return found;
  }
  return std::nullopt;
}

/// Newton's iteration on Σ N_i(ξ) x_i = x.
std::optional<Embedding> CellFinder::place_in(CellIndex cell, const Vector3d& place) const {
  const auto type = mesh_.type_of(cell);
  const auto& reference = cell::reference_cell(type);
  const auto nodes = mesh_.nodes_of(cell);
  const auto d = static_cast<Index>(reference.dimension);
  MatrixXd points(d, reference.node_count);
  for (std::size_t i = 0; i < nodes.size(); ++i)
    points.col(static_cast<Index>(i)) = mesh_.points[static_cast<std::size_t>(nodes[i])].head(d);
  Vector3d xi = middle_of(reference);
  for (int k = 0; k < most_iterations; ++k) {
    const auto shapes = shapes_at(reference, xi);
    const Eigen::Map<const Eigen::VectorXd> n(shapes.values.data(), reference.node_count);
    const MatrixXd jacobian = points * shapes.gradients;
    const Eigen::VectorXd step = jacobian.partialPivLu().solve(place.head(d) - points * n);
    if (!step.allFinite() || step.norm() > 1e3)
      return std::nullopt;
    xi.head(d) += step;
    if (step.norm() <= solved)
      break;
  }
  if (!is_inside(type, xi))
    return std::nullopt;
  return Embedding{cell, shapes_at(reference, xi).values};
}

} // namespace rubato::model
