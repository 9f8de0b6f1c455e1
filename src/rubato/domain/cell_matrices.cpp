// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/domain/cell_matrices.hpp"

namespace rubato::domain {
namespace {

using Points = std::span<const Eigen::Vector3d>;

std::vector<double> densities_at_points(const material::LawField& field, CellType type, Points points) {
  const auto places = element::places(cell::mass_table(type), points);
  std::vector<double> densities;
  for (const auto& place : places.colwise())
    densities.push_back(field.density_at(place));
  return densities;
}

/// Null where the density is the same everywhere.
const material::LawField* density_field(const Bulk& bulk, std::size_t cell) {
  const auto* field = bulk.field(cell);
  return field != nullptr && field->varies_density() ? field : nullptr;
}

} // namespace

std::vector<material::Law> laws_at_points(const material::LawField& field, CellType type, Points points) {
  const auto places = element::places(cell::stiffness_table(type), points);
  std::vector<material::Law> laws;
  for (const auto& place : places.colwise())
    laws.push_back(field.at(place));
  return laws;
}

void cell_stiffness(const Bulk& bulk, std::size_t cell, CellType type, Points points,
                    Eigen::Ref<Eigen::MatrixXd> k) {
  const auto* field = bulk.field(cell);
  if (field == nullptr || !field->varies_tangent())
    return element::stiffness(type, points, bulk.law(cell), bulk.section, k);
  std::vector<material::Tangent> tangents;
  for (const auto& law : laws_at_points(*field, type, points))
    tangents.push_back(material::tangent(law, bulk.section.physics));
  element::varying_stiffness(type, points, tangents, bulk.section, k);
}

void cell_mass(const Bulk& bulk, std::size_t cell, CellType type, Points points,
               Eigen::Ref<Eigen::MatrixXd> m) {
  if (const auto* field = density_field(bulk, cell))
    return element::varying_mass(type, points, densities_at_points(*field, type, points), bulk.section, m);
  element::mass(type, points, material::density(bulk.law(cell)), bulk.section, m);
}

void cell_lumped_mass(const Bulk& bulk, std::size_t cell, CellType type, Points points,
                      Eigen::Ref<Eigen::VectorXd> m) {
  if (const auto* field = density_field(bulk, cell))
    return element::varying_lumped_mass(type, points, densities_at_points(*field, type, points), bulk.section,
                                        m);
  element::lumped_mass(type, points, material::density(bulk.law(cell)), bulk.section, m);
}

PointLaws::PointLaws(const Bulk& bulk, std::size_t cell, CellType type, Points points)
    : same_(&bulk.law(cell)) {
  if (const auto* field = bulk.field(cell); field != nullptr && field->varies_tangent())
    varying_ = laws_at_points(*field, type, points);
}

material::Law typical_law(const mesh::Mesh& mesh, const Bulk& bulk, std::size_t cell) {
  const auto* field = bulk.field(cell);
  if (field == nullptr)
    return bulk.law(cell);
  const auto type = mesh.type_of(bulk.cells[cell]);
  const CellPoints points(mesh, mesh.nodes_of(bulk.cells[cell]));
  const auto places = element::places(cell::stiffness_table(type), points);
  return field->at(places.col(0));
}

} // namespace rubato::domain
