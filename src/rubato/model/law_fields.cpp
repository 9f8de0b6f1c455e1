// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/domain/cell_matrices.hpp"
#include "rubato/model/build.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace rubato::model {
namespace {

/// Points nearer to the line about which axes turn than this part of their cell are on it.
constexpr double on_axis = 1e-6;

double size_of(const Eigen::Matrix3Xd& places) {
  return (places.rowwise().maxCoeff() - places.rowwise().minCoeff()).norm();
}

void refuse_on_axis(const mesh::Mesh& mesh, mesh::CellIndex cell, const material::LawField& field,
                    const Eigen::Matrix3Xd& places, double size) {
  for (const auto& place : places.colwise())
    if (const auto distance = field.distance_to_axis(place); distance && *distance <= on_axis * size)
      throw InputError(
          {fault_at(field.path_of_axes(),
                    fmt::format("{}: {} has a point on the line about which the axes turn, where they have "
                                "no direction, expected cells with other axes there",
                                field.path_of_axes(), domain::cell_label(mesh, cell)))});
}

/// Throws InputError where the law is not valid at a point of the cell.
void evaluate(const mesh::Mesh& mesh, const domain::Bulk& bulk, std::size_t cell) {
  const auto& field = *bulk.field(cell);
  const auto index = bulk.cells[cell];
  const auto type = mesh.type_of(index);
  const domain::CellPoints nodes(mesh, mesh.nodes_of(index));
  const std::span<const Eigen::Vector3d> points = nodes;
  const Eigen::Map<const Eigen::Matrix3Xd> corners(points.front().data(), 3,
                                                   static_cast<Eigen::Index>(points.size()));
  const auto places = element::places(cell::stiffness_table(type), points);
  refuse_on_axis(mesh, index, field, places, size_of(corners));
  if (field.varies_tangent())
    for (const auto& place : places.colwise())
      field.at(place);
  if (!field.varies_density())
    return;
  const auto places_of_mass = element::places(cell::mass_table(type), points);
  for (const auto& place : places_of_mass.colwise())
    field.density_at(place);
}

} // namespace

void check_law_fields(const mesh::Mesh& mesh, domain::Bulk& bulk, std::vector<Fault>& faults) {
  if (bulk.fields.empty())
    return;
  std::vector<char> seen(bulk.laws.size(), 0);
  std::vector<char> told(bulk.laws.size(), 0);
  for (std::size_t i = 0; i < bulk.cells.size(); ++i) {
    const auto law = static_cast<std::size_t>(bulk.law_of_cell[i]);
    if (bulk.field(i) == nullptr || told[law] != 0)
      continue;
    try {
      evaluate(mesh, bulk, i);
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
