// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/results/compare.hpp"

#include "rubato/core/error.hpp"
#include "rubato/core/naming.hpp"
#include "rubato/mesh/io/med.hpp"
#include "rubato/model/build.hpp"
#include "rubato/model/node_label.hpp"
#include "rubato/results/history.hpp"
#include "rubato/results/med_fields.hpp"
#include "rubato/results/run_folder.hpp"
#include "rubato/results/vtu.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace rubato::results {
namespace {

namespace fs = std::filesystem;
using mesh::NodeIndex;

/// Nodes nearer than this part of the mesh's extent stand at one place.
constexpr double same_place = 1e-9;

std::string did_you_mean(const std::string& word, const std::vector<std::string>& candidates) {
  const auto nearest = nearest_word(word, candidates);
  return nearest.empty() ? fmt::format("; there are {}", fmt::join(candidates, ", "))
                         : fmt::format("; did you mean '{}'?", nearest);
}

/// A field as one run stored it.
struct Stored {
  std::vector<std::string> components;
  double at = 0;
  mesh::Mesh mesh;
  std::vector<double> values;
};

const MedField& field_named(const fs::path& run, const std::vector<MedField>& fields,
                            const std::string& name) {
  const auto found = std::ranges::find(fields, name, &MedField::name);
  if (found != fields.end())
    return *found;
  std::vector<std::string> names;
  std::ranges::transform(fields, std::back_inserter(names), &MedField::name);
  std::ranges::sort(names);
  throw InputError(
      fmt::format("{}: no field is called '{}'{}", run.string(), name, did_you_mean(name, names)));
}

/// The stored instants before and after t, as a sentence shows them.
std::string around(const std::vector<Instant>& instants, double t) {
  const Instant* before = nullptr;
  const Instant* after = nullptr;
  for (const auto& instant : instants) {
    if (instant.time < t && (before == nullptr || instant.time > before->time))
      before = &instant;
    if (instant.time > t && (after == nullptr || instant.time < after->time))
      after = &instant;
  }
  if (before != nullptr && after != nullptr)
    return fmt::format("the nearest stored are {} and {}", before->time, after->time);
  return fmt::format("the nearest stored is {}", (before != nullptr ? before : after)->time);
}

const Instant& instant_at(const fs::path& run, const MedField& field, double t) {
  const auto [first, last] = std::ranges::minmax_element(field.instants, {}, &Instant::time);
  const double length = std::max(last->time - first->time, std::abs(last->time));
  const auto found = std::ranges::find_if(
      field.instants, [&](const Instant& instant) { return is_same_instant(instant.time, t, length); });
  if (found == field.instants.end())
    throw InputError(
        fmt::format("{}: holds no {} at t = {}; {}", run.string(), field.name, t, around(field.instants, t)));
  return *found;
}

Stored read_stored(const fs::path& run, const std::string& name, double at) {
  if (!fs::exists(run / summary_file))
    throw InputError(
        fmt::format("{}: found no {}, expected the folder of a run", run.string(), summary_file));
  const auto file = run / med_file;
  if (!fs::exists(file))
    throw InputError(fmt::format("{}: holds no fields that can be read back, expected a run with 'fields: "
                                 "{{formats: [med], at: [{}]}}'",
                                 run.string(), at));
  auto fields = med_fields(file);
  std::erase_if(fields, [](const MedField& field) { return !field.at_nodes; });
  if (fields.empty())
    throw InputError(fmt::format("{}: has stored no field yet", run.string()));
  const auto& field = field_named(run, fields, name);
  const auto& instant = instant_at(run, field, at);
  return {field.component_names, instant.time, mesh::read_med(file, field.mesh_name),
          read_med_field(file, name, instant.number)};
}

double extent_of(const mesh::Mesh& mesh) {
  Eigen::AlignedBox<double, 3> box;
  for (const auto& point : mesh.points)
    box.extend(point);
  return box.diagonal().norm();
}

/// What is different between two meshes; empty when they are the same.
std::string difference_of(const mesh::Mesh& a, const mesh::Mesh& b) {
  if (a.node_count() != b.node_count() || a.cell_count() != b.cell_count())
    return fmt::format("{} nodes and {} cells against {} and {}", a.node_count(), a.cell_count(),
                       b.node_count(), b.cell_count());
  const double slack = same_place * extent_of(a);
  for (NodeIndex node = 0; node < a.node_count(); ++node) {
    const auto n = static_cast<std::size_t>(node);
    if (a.node_numbers[n] != b.node_numbers[n] || (a.points[n] - b.points[n]).norm() > slack)
      return fmt::format("node {} against {}", model::node_label(a, node), model::node_label(b, node));
  }
  const auto same_cells = [](const mesh::CellBlock& one, const mesh::CellBlock& other) {
    return one.type == other.type && one.nodes == other.nodes;
  };
  return std::ranges::equal(a.blocks, b.blocks, same_cells) ? "" : "other cells on the same nodes";
}

std::vector<double> minus(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> difference(a.size());
  std::ranges::transform(a, b, difference.begin(), std::minus());
  return difference;
}

/// The columns of a probe in a history; `run` says which one a fault is about.
std::vector<std::string> columns_of(const Table& history, const std::string& probe, std::string_view run) {
  std::vector<std::string> found;
  std::vector<std::string> names;
  for (std::size_t c = 1; c < history.columns.size(); ++c) {
    const auto& column = history.columns[c];
    const auto name = column.substr(0, column.rfind('.'));
    if (column == probe || name == probe)
      found.push_back(column);
    if (names.empty() || names.back() != name)
      names.push_back(name);
  }
  if (found.empty() && names.empty())
    throw InputError(fmt::format("run {}: found no probes", run));
  if (found.empty())
    throw InputError(
        fmt::format("run {}: no probe is called '{}'{}", run, probe, did_you_mean(probe, names)));
  return found;
}

double value_or_fault(const Table& history, const std::string& column, double t, std::string_view run) {
  if (const auto value = value_at(history, history.column(column), t))
    return *value;
  if (history.column(column) < 0 || history.rows.empty())
    throw InputError(fmt::format("run {}: found no {}", run, column));
  throw InputError(fmt::format("run {}: goes from t = {} to {}, which does not reach {}", run,
                               history.rows.front()[0], history.rows.back()[0], t));
}

std::vector<double> common_instants(const Table& a, const Table& b) {
  std::vector<double> common;
  const double length = a.rows.empty() ? 0.0 : a.rows.back()[0] - a.rows.front()[0];
  auto other = b.rows.begin();
  for (const auto& row : a.rows) {
    while (other != b.rows.end() && (*other)[0] < row[0] && !is_same_instant((*other)[0], row[0], length))
      ++other;
    if (other != b.rows.end() && is_same_instant((*other)[0], row[0], length))
      common.push_back(row[0]);
  }
  if (common.empty())
    throw InputError("the two runs have no instant in common, expected one where both are compared");
  return common;
}

HistoryComparison compare_column(const Table& a, const Table& b, const std::string& column,
                                 std::span<const double> instants) {
  HistoryComparison found{.quantity = column, .instants = static_cast<int>(instants.size())};
  for (const double t : instants) {
    const double of_a = value_or_fault(a, column, t, "A");
    const double of_b = value_or_fault(b, column, t, "B");
    found.largest_a = std::max(found.largest_a, std::abs(of_a));
    if (t == instants.front() || std::abs(of_a - of_b) > std::abs(found.difference())) {
      found.at = t;
      found.a = of_a;
      found.b = of_b;
    }
  }
  return found;
}

} // namespace

FieldComparison compare_fields(const fs::path& run_a, const fs::path& run_b, const std::string& field,
                               double at) {
  auto a = read_stored(run_a, field, at);
  auto b = read_stored(run_b, field, at);
  if (const auto difference = difference_of(a.mesh, b.mesh); !difference.empty())
    throw InputError(
        fmt::format("{} and {} have different meshes: {}", run_a.string(), run_b.string(), difference));
  if (a.components.size() == 1 && a.components.front() == "1")
    a.components.front().clear();
  auto difference = minus(a.values, b.values);
  return {field,
          std::move(a.components),
          a.at,
          std::move(a.mesh),
          std::move(a.values),
          std::move(b.values),
          std::move(difference)};
}

std::vector<Extent> extents(const FieldComparison& fields, std::span<const NodeIndex> nodes) {
  const auto width = fields.components.size();
  std::vector<Extent> parts;
  for (std::size_t c = 0; c < width; ++c) {
    Extent part{.component = fields.components[c], .node = nodes.front()};
    double squares = 0;
    for (const auto node : nodes) {
      const auto i = static_cast<std::size_t>(node) * width + c;
      squares += fields.difference[i] * fields.difference[i];
      part.largest_a = std::max(part.largest_a, std::abs(fields.a[i]));
      part.largest_b = std::max(part.largest_b, std::abs(fields.b[i]));
      if (node == nodes.front() || std::abs(fields.difference[i]) > std::abs(part.difference)) {
        part.difference = fields.difference[i];
        part.node = node;
      }
    }
    part.rms = std::sqrt(squares / static_cast<double>(nodes.size()));
    parts.push_back(std::move(part));
  }
  return parts;
}

std::vector<NodeIndex> all_nodes(const mesh::Mesh& mesh) {
  std::vector<NodeIndex> nodes(static_cast<std::size_t>(mesh.node_count()));
  std::iota(nodes.begin(), nodes.end(), 0);
  return nodes;
}

std::vector<NodeIndex> nodes_of(const mesh::Mesh& mesh, const std::string& name) {
  std::vector<Fault> faults;
  auto nodes = model::nodes_or_fault(mesh, {name, {}}, faults);
  if (!faults.empty())
    throw InputError(std::move(faults));
  return nodes;
}

void write_vtu(const fs::path& path, const FieldComparison& fields) {
  const auto width = static_cast<int>(fields.components.size());
  const auto names = width == 1 ? std::vector<std::string>{} : fields.components;
  const std::vector<NodalField> arrays{{fields.field + "_difference", width, fields.difference, names, ""},
                                       {fields.field + "_A", width, fields.a, names, ""},
                                       {fields.field + "_B", width, fields.b, names, ""}};
  write_vtu(path, fields.mesh, arrays);
}

std::vector<HistoryComparison> compare_histories(const Table& a, const Table& b, const std::string& probe,
                                                 std::optional<double> at) {
  const auto columns = columns_of(a, probe, "A");
  columns_of(b, probe, "B");
  const auto instants = at ? std::vector{*at} : common_instants(a, b);
  std::vector<HistoryComparison> found(columns.size());
  std::ranges::transform(columns, found.begin(),
                         [&](const std::string& column) { return compare_column(a, b, column, instants); });
  return found;
}

} // namespace rubato::results
