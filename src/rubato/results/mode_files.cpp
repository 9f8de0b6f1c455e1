// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/results/mode_files.hpp"

#include "rubato/model/model.hpp"
#include "rubato/results/csv.hpp"
#include "rubato/results/nodal_fields.hpp"
#include "rubato/results/vtu.hpp"
#include "rubato/study/words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string>
#include <vector>

namespace rubato::results {
namespace {

using Eigen::Index;

void write_mode_table(const std::filesystem::path& path, const modes::Modes& modes) {
  std::vector<std::string> columns{"mode", "frequency", "generalised_mass"};
  for (const int direction : modes.directions)
    columns.push_back(
        fmt::format("effective_mass_{}", study::axis_words.at(static_cast<std::size_t>(direction))));
  columns.emplace_back("residual");
  CsvWriter table(path, columns);
  for (Index k = 0; k < modes.frequencies.size(); ++k) {
    std::vector<double> row{static_cast<double>(k + 1), modes.frequencies[k], modes.generalised_masses[k]};
    for (Index i = 0; i < modes.effective_masses.cols(); ++i)
      row.push_back(modes.effective_masses(k, i));
    row.push_back(modes.residuals[k]);
    table.row(row);
  }
}

/// 0 at nodes that no cell deforms.
OwnedField shape_field(const model::Model& model, const modes::Modes& modes, Index mode) {
  const auto& dofs = model.dofs;
  OwnedField field{fmt::format("mode_{}", mode + 1), dofs.components, {}, {}};
  field.values.assign(model.mesh.points.size() * static_cast<std::size_t>(dofs.components), 0);
  for (const auto node : dofs.nodes)
    for (int c = 0; c < dofs.components; ++c)
      field.values[static_cast<std::size_t>(node) * static_cast<std::size_t>(dofs.components) +
                   static_cast<std::size_t>(c)] = modes.shapes(dofs.dof(node, c), mode);
  return field;
}

} // namespace

void write_modes(const std::filesystem::path& folder, const model::Model& model, const modes::Modes& modes) {
  write_mode_table(folder / modes_file, modes);
  std::vector<OwnedField> shapes;
  for (Index k = 0; k < modes.frequencies.size(); ++k)
    shapes.push_back(shape_field(model, modes, k));
  std::vector<NodalField> views;
  std::ranges::transform(shapes, std::back_inserter(views), &OwnedField::view);
  write_vtu(folder / mode_shapes_file, model.mesh, views);
}

} // namespace rubato::results
