// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/results/cell_fields.hpp"

#include "rubato/element/element.hpp"
#include "rubato/model/model.hpp"
#include "rubato/results/cell_quantities.hpp"
#include "rubato/study/words.hpp"

#include <algorithm>

namespace rubato::results {
namespace {

using Eigen::Index;
using study::FieldPlace;

/// Of each cell of the mesh its place in the bulk; −1 of others.
std::vector<std::int64_t> places_in_bulk(const model::Model& model) {
  std::vector<std::int64_t> places(static_cast<std::size_t>(model.mesh.cell_count()), -1);
  for (std::size_t i = 0; i < model.bulk.cells.size(); ++i)
    places[static_cast<std::size_t>(model.bulk.cells[i])] = static_cast<std::int64_t>(i);
  return places;
}

int highest_dimension(const mesh::Mesh& mesh) {
  int highest = 0;
  for (const auto& block : mesh.blocks)
    highest = std::max(highest, cell::topology(block.type).dimension);
  return highest;
}

void append(const Eigen::MatrixXd& values, std::vector<double>& to) {
  to.insert(to.end(), values.data(), values.data() + values.size());
}

study::ProbeField quantity(const study::StoredField& stored) {
  return std::ranges::find(study::probe_field_words, study::quantity_of(stored),
                           &study::Word<study::ProbeField>::text)
      ->value;
}

class FieldMaker {
public:
  FieldMaker(const model::Model& model, const step::State& now)
      : model_(model), quantities_(model, now), in_bulk_(places_in_bulk(model)) {}

  CellField make(const study::StoredField& stored) {
    const auto components = static_cast<int>(std::max<std::size_t>(1, stored.components.size()));
    CellField field{stored.name, components, stored.components, stored.place, {}, {}};
    const int highest = highest_dimension(model_.mesh);
    std::size_t cell = 0;
    for (const auto& block : model_.mesh.blocks) {
      const auto count = static_cast<std::size_t>(block.cell_count());
      if (cell::topology(block.type).dimension == highest)
        add_part(block, cell, quantity(stored), field);
      cell += count;
    }
    return field;
  }

private:
  /// Cells that do not deform have no stress.
  void add_part(const mesh::CellBlock& block, std::size_t first, study::ProbeField what, CellField& field) {
    auto& part = field.parts.emplace_back();
    part.type = block.type;
    part.places = places_in(field.place, block.type);
    for (mesh::CellIndex i = 0; i < block.cell_count(); ++i) {
      const auto place = in_bulk_[first + static_cast<std::size_t>(i)];
      append(place < 0 ? Eigen::MatrixXd(Eigen::MatrixXd::Zero(field.components, part.places))
                       : values_of(what, field.place, static_cast<std::size_t>(place)),
             part.values);
      if (field.place == FieldPlace::gauss_points)
        append(point_volumes(block, i, part.places), field.volumes);
    }
  }

  static int places_in(FieldPlace place, CellType type) {
    const auto& to_nodes = domain::extrapolation(type);
    if (place == FieldPlace::cells)
      return 1;
    return static_cast<int>(place == FieldPlace::gauss_points ? to_nodes.cols() : to_nodes.rows());
  }

  Eigen::MatrixXd values_of(study::ProbeField what, FieldPlace place, std::size_t cell) {
    if (place == FieldPlace::cells)
      return quantities_.mean(what, cell);
    return place == FieldPlace::gauss_points ? quantities_.at_points(what, cell)
                                             : quantities_.at_nodes(what, cell);
  }

  Eigen::MatrixXd point_volumes(const mesh::CellBlock& block, mesh::CellIndex cell, int points) const {
    Eigen::VectorXd volumes(points);
    element::point_volumes(block.type, domain::CellPoints(model_.mesh, block.cell(cell)), model_.bulk.section,
                           volumes);
    return volumes;
  }

  const model::Model& model_;
  CellQuantities quantities_;
  std::vector<std::int64_t> in_bulk_;
};

/// Temperatures of a model that has none are left out.
bool is_known(const model::Model& model, const study::StoredField& stored) {
  return quantity(stored) != study::ProbeField::temperature || model.domain.heat() != nullptr;
}

} // namespace

std::vector<CellField> cell_fields(const model::Model& model, const step::State& now,
                                   const study::FieldOutput& output) {
  std::vector<CellField> fields;
  FieldMaker maker(model, now);
  for (const auto& stored : study::stored_fields(model.dofs.components))
    if (stored.place != FieldPlace::nodes && study::is_written(output, stored) && is_known(model, stored))
      fields.push_back(maker.make(stored));
  return fields;
}

std::vector<double> cell_means(const CellField& field) {
  std::vector<double> means;
  std::size_t point = 0;
  for (const auto& part : field.parts) {
    const Index size = Index{field.components} * part.places;
    for (std::size_t at = 0; at < part.values.size(); at += static_cast<std::size_t>(size)) {
      const Eigen::Map<const Eigen::MatrixXd> values(part.values.data() + at, field.components, part.places);
      const Eigen::VectorXd weights =
          field.volumes.empty()
              ? Eigen::VectorXd(Eigen::VectorXd::Ones(part.places))
              : Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(field.volumes.data() + point, part.places));
      append(values * weights / weights.sum(), means);
      point += static_cast<std::size_t>(part.places);
    }
  }
  return means;
}

} // namespace rubato::results
