// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/cell/shape_table.hpp"
#include "rubato/contact/small_vectors.hpp"
#include "rubato/domain/cell_matrices.hpp"
#include "rubato/element/element.hpp"
#include "rubato/material/law_field.hpp"
#include "rubato/model/build.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>
#include <span>
#include <vector>

namespace rubato::model {
namespace {

using Eigen::Matrix3Xd;
using Eigen::Vector3d;

/// Points nearer to the line about which axes turn than this part of their cell are on it.
constexpr double on_axis = 1e-6;

double size_of(const Matrix3Xd& places) {
  Vector3d low = contact::column_of(places, 0);
  Vector3d high = low;
  for (Eigen::Index k = 1; k < places.cols(); ++k)
    for (Eigen::Index i = 0; i < low.size(); ++i) {
      low[i] = std::min(low[i], places(i, k));
      high[i] = std::max(high[i], places(i, k));
    }
  return contact::length_of(contact::difference_of(high, low));
}

Vector3d to_vector(const std::array<double, 3>& numbers) {
  return {numbers[0], numbers[1], numbers[2]};
}

/// Angles about the line at which the nodes are seen that are not on it, ascending [radians].
std::vector<double> angles_about(const study::CylindricalAxes& axes, const Matrix3Xd& nodes, double size) {
  const Vector3d along = contact::unit_of(to_vector(axes.direction));
  const Vector3d across = contact::unit_across(along);
  const Vector3d third = contact::cross(along, across);
  std::vector<double> angles;
  for (Eigen::Index k = 0; k < nodes.cols(); ++k) {
    const Vector3d arm = contact::difference_of(contact::column_of(nodes, k), to_vector(axes.point));
    const double x = contact::dot(arm, across);
    const double y = contact::dot(arm, third);
    if (std::hypot(x, y) > on_axis * size)
      angles.push_back(std::atan2(y, x));
  }
  std::ranges::sort(angles);
  return angles;
}

/// Whether the line goes through the inside of the cell: its nodes are seen all around the line. A line along
/// an edge or through a node leaves half of the directions free.
bool is_crossed(const study::CylindricalAxes& axes, const Matrix3Xd& nodes) {
  const auto angles = angles_about(axes, nodes, size_of(nodes));
  if (angles.empty())
    return true;
  double gap = angles.front() + 2 * std::numbers::pi - angles.back();
  for (std::size_t i = 1; i < angles.size(); ++i)
    gap = std::max(gap, angles[i] - angles[i - 1]);
  return gap < std::numbers::pi - on_axis;
}

void refuse_on_axis(const mesh::Mesh& mesh, mesh::CellIndex cell, const material::LawField& field,
                    const study::CylindricalAxes& axes, const Matrix3Xd& nodes, const Matrix3Xd& points) {
  const double size = size_of(nodes);
  bool is_on_point = false;
  for (Eigen::Index k = 0; k < points.cols(); ++k)
    is_on_point =
        is_on_point || field.distance_to_axis(contact::column_of(points, k)).value_or(size) <= on_axis * size;
  if (is_on_point || is_crossed(axes, nodes))
    throw InputError(
        {fault_at(field.path_of_axes(),
                  fmt::format("{}: {} lies on the line about which the axes turn, where they have "
                              "no direction, expected cells with other axes there",
                              field.path_of_axes(), domain::cell_label(mesh, cell)))});
}

/// Throws InputError where the law is not valid at a point of the cell.
void evaluate(const study::Material& material, const mesh::Mesh& mesh, const domain::Bulk& bulk,
              std::size_t cell) {
  const auto& field = *bulk.field(cell);
  const auto index = bulk.cells[cell];
  const auto type = mesh.type_of(index);
  const domain::CellPoints nodes(mesh, mesh.nodes_of(index));
  const std::span<const Eigen::Vector3d> points = nodes;
  const auto places = element::places(cell::stiffness_table(type), points);
  if (const auto& axes = material.orthotropy.cylindrical;
      axes && field.distance_to_axis(contact::column_of(places, 0))) {
    Matrix3Xd corners(3, static_cast<Eigen::Index>(points.size()));
    for (std::size_t k = 0; k < points.size(); ++k)
      contact::set_column(static_cast<Eigen::Index>(k), points[k], corners);
    refuse_on_axis(mesh, index, field, *axes, corners, places);
  }
  if (field.varies_tangent())
    for (Eigen::Index k = 0; k < places.cols(); ++k)
      field.at(contact::column_of(places, k));
  if (!field.varies_density())
    return;
  const auto places_of_mass = element::places(cell::mass_table(type), points);
  for (Eigen::Index k = 0; k < places_of_mass.cols(); ++k)
    field.density_at(contact::column_of(places_of_mass, k));
}

} // namespace

void check_law_fields(const study::Study& study, const mesh::Mesh& mesh, domain::Bulk& bulk,
                      std::vector<Fault>& faults) {
  if (bulk.fields.empty())
    return;
  std::vector<char> seen(bulk.laws.size(), 0);
  std::vector<char> told(bulk.laws.size(), 0);
  for (std::size_t i = 0; i < bulk.cells.size(); ++i) {
    const auto law = static_cast<std::size_t>(bulk.law_of_cell[i]);
    if (bulk.field(i) == nullptr || told[law] != 0)
      continue;
    try {
      evaluate(study.materials[law], mesh, bulk, i);
      if (seen[law] == 0)
        bulk.laws[law] = domain::typical_law(mesh, bulk, i);
      seen[law] = 1;
    } catch (const InputError& error) {
      told[law] = 1;
      std::ranges::copy(error.faults(), std::back_inserter(faults));
    }
  }
}

} // namespace rubato::model
