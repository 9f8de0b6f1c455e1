// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/domain/cell_matrices.hpp"

#include "rubato/cell/shape_table.hpp"
#include "rubato/domain/behaviour.hpp"
#include "rubato/element/element.hpp"
#include "rubato/element/nonlinear.hpp"
#include "rubato/material/law_field.hpp"

#include <limits>
#include <vector>

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

namespace {

/// Of a cell that nothing has happened to. Where it fails, its matrix is not finite.
void initial_stiffness(const Bulk& bulk, const Behaviour& behaviour, CellType type, Points points,
                       Eigen::Ref<Eigen::MatrixXd> k) {
  const auto kind = kind_of(bulk, behaviour, type);
  const auto size = static_cast<std::size_t>(k.rows());
  const std::vector<double> zero(size, 0.0);
  std::vector<double> force(size);
  std::vector<double> tangent(size * size);
  const auto remembered =
      static_cast<std::size_t>(element::state_size_of_cell(kind, material::state_size(behaviour.law)));
  const std::vector<double> old(remembered, 0.0);
  std::vector<double> now(remembered);
  const element::PointLaws laws(behaviour.law);
  const bool done = bool(element::evaluate(kind, laws, {points, zero, old}, {now, force, tangent}));
  k = Eigen::Map<const Eigen::MatrixXd>(tangent.data(), k.rows(), k.cols());
  if (!done)
    k.setConstant(std::numeric_limits<double>::quiet_NaN());
}

} // namespace

void cell_stiffness(const Bulk& bulk, std::size_t cell, CellType type, Points points,
                    Eigen::Ref<Eigen::MatrixXd> k) {
  if (const auto* behaviour = bulk.behaviour(cell))
    return initial_stiffness(bulk, *behaviour, type, points, k);
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
