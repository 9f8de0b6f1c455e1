// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/results/stored_fields.hpp"

#include "rubato/core/error.hpp"
#include "rubato/mesh/io/med.hpp"
#include "rubato/mesh/io/vtu_reader.hpp"
#include "rubato/model/model.hpp"
#include "rubato/results/med_fields.hpp"
#include "rubato/results/run_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

namespace rubato::results {
namespace {

namespace fs = std::filesystem;

/// Scalars come with a component that is called 1, or nothing.
std::vector<std::string> names_of_components(std::vector<std::string> names) {
  if (names.size() == 1)
    names.front().clear();
  return names;
}

/// The values of one array of a file, as many components a node as the layout has: vectors in a plane have a
/// third one of zeros there.
std::vector<double> array_values(const mesh::vtk::VtuArray& array, std::size_t components) {
  if (array.component_names.size() == components)
    return array.values;
  const auto stored = array.component_names.size();
  std::vector<double> values;
  values.reserve(array.values.size() / stored * components);
  for (std::size_t i = 0; i < array.values.size(); ++i)
    if (i % stored < components)
      values.push_back(array.values[i]);
  return values;
}

/// A vector in a plane has two components.
FieldLayout layout_of(const mesh::vtk::VtuArray& array, int dimension) {
  constexpr std::size_t vector_size = 3;
  auto names = array.component_names;
  if (dimension == 2 && names.size() == vector_size && names.back() == "z")
    names.pop_back();
  return {array.name, names_of_components(std::move(names))};
}

std::vector<std::vector<double>> vtu_values(const fs::path& file, const std::vector<FieldLayout>& fields) {
  const auto arrays = mesh::vtk::read_vtu_arrays(file);
  std::vector<std::vector<double>> values;
  for (const auto& field : fields) {
    const auto found = std::ranges::find(arrays, field.name, &mesh::vtk::VtuArray::name);
    if (found == arrays.end())
      throw InputError(
          fmt::format("{}: holds no field '{}', other than the files before it", file.string(), field.name));
    values.push_back(array_values(*found, field.components.size()));
  }
  return values;
}

/// The instants at which every field of the file is stored.
std::vector<Instant> common_instants(const std::vector<MedField>& fields) {
  auto common = fields.front().instants;
  for (const auto& field : fields)
    std::erase_if(common, [&](const Instant& instant) {
      return std::ranges::find(field.instants, instant.number, &Instant::number) == field.instants.end();
    });
  std::ranges::sort(common, {}, &Instant::time);
  return common;
}

} // namespace

std::optional<StoredFields> stored_vtu_fields(const fs::path& run) {
  auto series = mesh::vtk::read_pvd(run / pvd_file);
  if (series.empty())
    return std::nullopt;
  std::ranges::sort(series, {}, &mesh::vtk::PvdEntry::time);
  auto first = mesh::vtk::read_vtu(series.front().file);
  StoredFields stored;
  for (const auto& array : first.arrays)
    stored.fields.push_back(layout_of(array, first.mesh.dimension));
  stored.mesh = std::move(first.mesh);
  for (const auto& entry : series)
    stored.instants.push_back(entry.time);
  stored.values_at = [series = std::move(series), fields = stored.fields](std::size_t instant) {
    return vtu_values(series.at(instant).file, fields);
  };
  return stored;
}

std::optional<StoredFields> stored_med_fields(const fs::path& run) {
  const auto file = run / med_file;
  if (!fs::exists(file))
    return std::nullopt;
  auto fields = med_fields(file);
  std::erase_if(fields, [](const MedField& field) { return !field.at_nodes; });
  if (fields.empty())
    return std::nullopt;
  StoredFields stored;
  stored.mesh = mesh::read_med(file, fields.front().mesh_name);
  const auto instants = common_instants(fields);
  for (const auto& field : fields)
    stored.fields.push_back({field.name, names_of_components(field.component_names)});
  std::ranges::transform(instants, std::back_inserter(stored.instants), &Instant::time);
  stored.values_at = [file, instants, layouts = stored.fields](std::size_t instant) {
    std::vector<std::vector<double>> values;
    values.reserve(layouts.size());
    for (const auto& field : layouts)
      values.push_back(read_med_field(file, field.name, instants.at(instant).number));
    return values;
  };
  return stored;
}

std::optional<StoredFields> stored_fields(const fs::path& run) {
  auto vtu = stored_vtu_fields(run);
  auto med = stored_med_fields(run);
  if (vtu && med)
    return med->instants.size() > vtu->instants.size() ? std::move(med) : std::move(vtu);
  return vtu ? std::move(vtu) : std::move(med);
}

} // namespace rubato::results
