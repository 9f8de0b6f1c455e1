// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/plot/snapshot.hpp"

#include "rubato/core/error.hpp"
#include "rubato/core/naming.hpp"
#include "rubato/mesh/orientation.hpp"
#include "rubato/plot/instants.hpp"
#include "rubato/plot/plotted_run.hpp"
#include "rubato/results/stored_fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace rubato::plot {
namespace {

namespace fs = std::filesystem;

Snapshot snapshot_of(const fs::path& run, results::StoredFields stored, std::optional<double> at) {
  const double t = at ? stored_instant(run, stored.instants, *at) : stored.instants.back();
  const auto place = std::ranges::find(stored.instants, t) - stored.instants.begin();
  auto values = stored.values_at(static_cast<std::size_t>(place));
  Snapshot snapshot{.t = t, .mesh = std::move(stored.mesh)};
  for (std::size_t f = 0; f < values.size(); ++f)
    snapshot.arrays.push_back({stored.fields[f].name, stored.fields[f].components, std::move(values[f])});
  return snapshot;
}

bool is_scalar(const NodeArray& array) {
  return array.components.size() == 1;
}

/// Stresses have no length, neither have three principal ones: which component is meant has to be said.
bool has_length(const NodeArray& array) {
  return array.components.size() <= 3 && array.name != "principal_stress";
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
  auto stored = results::stored_fields(run);
  if (!stored || stored->instants.empty())
    throw InputError(
        fmt::format("{}: holds no fields to draw, expected a run with 'fields: {{formats: [vtu]}}' "
                    "in its deck",
                    run.string()));
  auto snapshot = snapshot_of(run, std::move(*stored), at);
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
