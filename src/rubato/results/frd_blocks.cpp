// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/results/frd_blocks.hpp"

#include "rubato/contact/dropped_nodes.hpp"
#include "rubato/contact/zone.hpp"
#include "rubato/model/model.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace rubato::results {
namespace {

/// A block that is a field of rubato under another name.
struct NamedBlock {
  std::string_view field;
  std::string_view name;
  FrdKind kind;
  std::vector<std::string_view> components;
};

const std::vector<NamedBlock>& named_blocks() {
  static const std::vector<NamedBlock> blocks{
      {"displacement", "DISP", FrdKind::vector, {"D1", "D2", "D3"}},
      {"velocity", "VELO", FrdKind::vector, {"V1", "V2", "V3"}},
      {"temperature", "NDTEMP", FrdKind::scalar, {"T"}},
      {"stress", "STRESS", FrdKind::tensor, {"SXX", "SYY", "SZZ", "SXY", "SYZ", "SZX"}},
      {"strain", "TOSTRAIN", FrdKind::tensor, {"EXX", "EYY", "EZZ", "EXY", "EYZ", "EZX"}},
      {"reaction", "FORC", FrdKind::vector, {"F1", "F2", "F3"}},
      {"cumulated_plastic_strain", "PE", FrdKind::scalar, {"PE"}}};
  return blocks;
}

/// Vectors of the plane get a third component of zeros.
std::vector<double> in_space(std::span<const double> values, int components, std::size_t wanted) {
  const auto given = static_cast<std::size_t>(components);
  if (given == wanted)
    return {values.begin(), values.end()};
  std::vector<double> padded(values.size() / given * wanted, 0.0);
  for (std::size_t i = 0; i < values.size(); ++i)
    padded[i / given * wanted + i % given] = values[i];
  return padded;
}

std::vector<double> in_all_nodes(const model::Model& model, const Eigen::VectorXd& of_dofs) {
  constexpr std::size_t directions = 3;
  std::vector<double> values(model.mesh.points.size() * directions, 0.0);
  for (const auto node : model.dofs.nodes)
    for (int i = 0; i < model.dofs.components; ++i)
      values[static_cast<std::size_t>(node) * directions + static_cast<std::size_t>(i)] =
          of_dofs[model.dofs.dof(node, i)];
  return values;
}

/// A node with several points has the values of the point with the largest pressure.
FrdBlock contact_block(const model::Model& model, const step::State& now, std::span<const double> pressures,
                       ContactLister& lister) {
  FrdBlock block{
      "CONTACT", FrdKind::tensor, {"COPEN", "CSLIP1", "CSLIP2", "CPRESS", "CSHEAR1", "CSHEAR2"}, {}};
  const auto size = block.components.size();
  block.values.assign(model.mesh.points.size() * size, 0.0);
  std::vector<double> largest(model.mesh.points.size(), -1.0);
  for (std::size_t z = 0; z < model.zones.size(); ++z)
    for (std::size_t i = 0; i < model.zones[z].points.size(); ++i) {
      const auto& point = model.zones[z].points[i];
      if (contact::reported_status(now.zones[z], i) == contact::Status::open)
        continue;
      const auto nearest = std::ranges::max_element(point.shape, {}, [](double n) { return std::abs(n); });
      const auto node =
          static_cast<std::size_t>(point.nodes[static_cast<std::size_t>(nearest - point.shape.begin())]);
      const auto values = lister.at(now, z, i);
      if (std::abs(values.pressure) <= largest[node])
        continue;
      largest[node] = std::abs(values.pressure);
      const std::array row{values.opening,  values.slip[0],  values.slip[1],
                           pressures[node], values.shear[0], values.shear[1]};
      std::ranges::copy(row, block.values.begin() + static_cast<std::ptrdiff_t>(node * size));
    }
  return block;
}

} // namespace

Eigen::VectorXd balanced_force(const model::Model& model, const step::State& now) {
  return internal_force(model, now) - contact_force(model, now);
}

std::vector<FrdBlock> frd_blocks(const model::Model& model, const step::State& now,
                                 std::span<const OwnedField> fields, ContactLister& contact) {
  std::vector<FrdBlock> blocks;
  for (const auto& named : named_blocks()) {
    const auto field = std::ranges::find(fields, named.field, &OwnedField::name);
    const bool is_at_rest =
        named.name == "VELO" && model.study.time.scheme == study::SchemeKind::static_steps;
    if (field != fields.end() && !is_at_rest)
      blocks.push_back({named.name, named.kind, named.components,
                        named.field == "reaction"
                            ? in_all_nodes(model, balanced_force(model, now))
                            : in_space(field->values, field->components, named.components.size())});
  }
  const auto pressures = std::ranges::find(fields, "contact_pressure", &OwnedField::name);
  if (pressures != fields.end())
    blocks.push_back(contact_block(model, now, pressures->values, contact));
  return blocks;
}

FrdSettings frd_settings(const model::Model& model) {
  FrdSettings settings{model.study.fields.frd_binary, model.study.fields.step, {}, {}};
  for (const auto& material : model.study.materials)
    settings.materials.push_back(material.name);
  settings.of_cell.assign(static_cast<std::size_t>(model.mesh.cell_count()), 0);
  for (std::size_t i = 0; i < model.bulk.cells.size(); ++i)
    if (model.bulk.law_of_cell[i] < static_cast<std::int32_t>(settings.materials.size()))
      settings.of_cell[static_cast<std::size_t>(model.bulk.cells[i])] = model.bulk.law_of_cell[i];
  return settings;
}

} // namespace rubato::results
