// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/plot/snapshot.hpp"

#include "rubato/core/error.hpp"
#include "rubato/core/naming.hpp"
#include "rubato/mesh/io/med.hpp"
#include "rubato/mesh/orientation.hpp"
#include "rubato/plot/instants.hpp"
#include "rubato/plot/plotted_run.hpp"
#include "rubato/results/med_fields.hpp"
#include "rubato/results/run_folder.hpp"
#include "rubato/results/vtu_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

namespace rubato::plot {
namespace {

namespace fs = std::filesystem;

double chosen_instant(const fs::path& run, const std::vector<double>& stored, std::optional<double> at) {
  return at ? stored_instant(run, stored, *at) : stored.back();
}

/// The instants of the first field: all of a run have the same ones.
std::vector<double> instants_of(const results::MedField& field) {
  std::vector<double> instants(field.instants.size());
  std::ranges::transform(field.instants, instants.begin(), &results::Instant::time);
  std::ranges::sort(instants);
  return instants;
}

Snapshot read_med_snapshot(const fs::path& run, const std::vector<results::MedField>& fields,
                           std::optional<double> at) {
  const auto file = run / results::med_file;
  Snapshot snapshot{.t = chosen_instant(run, instants_of(fields.front()), at)};
  snapshot.mesh = mesh::read_med(file, fields.front().mesh_name);
  for (const auto& field : fields)
    for (const auto& instant : field.instants)
      if (instant.time == snapshot.t)
        snapshot.arrays.push_back(
            {field.name, field.component_names, results::read_med_field(file, field.name, instant.number)});
  return snapshot;
}

Snapshot read_vtu_snapshot(const fs::path& run, const std::vector<results::PvdEntry>& entries,
                           std::optional<double> at) {
  std::vector<double> stored(entries.size());
  std::ranges::transform(entries, stored.begin(), &results::PvdEntry::time);
  const double t = chosen_instant(run, stored, at);
  const auto entry = std::ranges::find(entries, t, &results::PvdEntry::time);
  auto content = results::read_vtu(entry->file);
  Snapshot snapshot{.t = t, .mesh = std::move(content.mesh)};
  for (auto& array : content.arrays)
    snapshot.arrays.push_back(
        {std::move(array.name), std::move(array.component_names), std::move(array.values)});
  return snapshot;
}

Snapshot read_any(const fs::path& run, std::optional<double> at) {
  if (const auto file = run / results::med_file; fs::exists(file))
    if (const auto fields = results::med_fields(file); !fields.empty())
      return read_med_snapshot(run, fields, at);
  if (const auto file = run / results::pvd_file; fs::exists(file))
    if (const auto entries = results::read_pvd(file); !entries.empty())
      return read_vtu_snapshot(run, entries, at);
  throw InputError(
      fmt::format("{}: holds no fields to draw, expected a run with 'fields: {{formats: [vtu]}}' "
                  "in its deck",
                  run.string()));
}

bool is_scalar(const NodeArray& array) {
  return array.components.size() == 1;
}

/// Stresses have no length: which component is meant has to be said.
bool has_length(const NodeArray& array) {
  return array.components.size() <= 3;
}

std::vector<std::string> names_of(const Snapshot& snapshot) {
  std::vector<std::string> names;
  for (const auto& array : snapshot.arrays) {
    if (has_length(array))
      names.push_back(array.name);
    if (!is_scalar(array))
      for (const auto& component : array.components)
        names.push_back(fmt::format("{}.{}", array.name, component));
  }
  return names;
}

std::vector<double> component_of(const NodeArray& array, std::size_t component) {
  const auto width = array.components.size();
  std::vector<double> values(array.values.size() / width);
  for (std::size_t node = 0; node < values.size(); ++node)
    values[node] = array.values[node * width + component];
  return values;
}

std::vector<double> lengths_of(const NodeArray& array) {
  const auto width = array.components.size();
  std::vector<double> values(array.values.size() / width);
  for (std::size_t node = 0; node < values.size(); ++node)
    values[node] =
        Eigen::Map<const Eigen::VectorXd>(&array.values[node * width], static_cast<Eigen::Index>(width))
            .norm();
  return values;
}

std::optional<std::vector<double>> values_named(const NodeArray& array, const std::string& name) {
  if (name == array.name && has_length(array))
    return is_scalar(array) ? array.values : lengths_of(array);
  if (!is_scalar(array))
    for (std::size_t c = 0; c < array.components.size(); ++c)
      if (name == fmt::format("{}.{}", array.name, array.components[c]))
        return component_of(array, c);
  return std::nullopt;
}

} // namespace

Snapshot read_snapshot(const fs::path& run, std::optional<double> at, int dimension) {
  auto snapshot = read_any(run, at);
  snapshot.mesh.dimension = dimension;
  mesh::mend_orientation(snapshot.mesh);
  return snapshot;
}

NodeValues node_values(const Snapshot& snapshot, const std::string& name) {
  for (const auto& array : snapshot.arrays)
    if (auto values = values_named(array, name))
      return {name, std::string(dimension_of(array.name)), std::move(*values)};
  throw InputError(
      fmt::format("--field: no field is called {}{}", shown(name), suggestion(name, names_of(snapshot))));
}

std::vector<Eigen::Vector3d> displacements(const Snapshot& snapshot) {
  const auto array = std::ranges::find(snapshot.arrays, "displacement", &NodeArray::name);
  if (array == snapshot.arrays.end())
    throw InputError("the stored fields have no displacement");
  const auto width = array->components.size();
  std::vector<Eigen::Vector3d> moved(snapshot.mesh.points.size(), Eigen::Vector3d::Zero());
  for (std::size_t node = 0; node < moved.size(); ++node)
    for (std::size_t c = 0; c < std::min<std::size_t>(width, 3); ++c)
      moved[node][static_cast<Eigen::Index>(c)] = array->values[node * width + c];
  return moved;
}

} // namespace rubato::plot
