// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/results/vtk_arrays.hpp"

#include <utility>

namespace rubato::results {
namespace {

constexpr std::size_t vector_size = 3;

std::vector<double> with_third_component(std::span<const double> values) {
  std::vector<double> padded(values.size() / 2 * vector_size, 0.0);
  for (std::size_t i = 0; i < values.size() / 2 * 2; ++i)
    padded[i / 2 * vector_size + i % 2] = values[i];
  return padded;
}

} // namespace

VtkArrays::VtkArrays(std::span<const NodalField> fields, std::span<const CellField> cell_fields) {
  for (const auto& field : fields) {
    mesh::VtuArray array{field.name, field.components, field.values, field.component_names, false};
    if (field.components == 2) {
      array.values = made_.emplace_back(with_third_component(field.values));
      array.components = vector_size;
      if (!array.component_names.empty())
        array.component_names.emplace_back("z");
    }
    arrays_.push_back(std::move(array));
  }
  for (const auto& field : cell_fields)
    arrays_.push_back(
        {field.name, field.components, made_.emplace_back(cell_means(field)), field.component_names, true});
}

} // namespace rubato::results
