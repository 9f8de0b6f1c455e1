// SPDX-License-Identifier: LGPL-3.0-or-later
#include "verification/bulk_run.hpp"

#include "rubato/deck/read.hpp"
#include "rubato/model/build_model.hpp"
#include "rubato/results/cell_fields.hpp"
#include "rubato/results/probe_values.hpp"

#include "support/model_of.hpp"
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace rubato::verification {
namespace {

constexpr double time_tolerance = 1e-9;

mesh::Mesh shaped_mesh(const study::Study& study, const MeshShape& shape) {
  auto mesh = model::load_mesh(study.mesh);
  if (shape)
    std::ranges::transform(mesh.points, mesh.points.begin(), shape);
  return mesh;
}

study::Study study_of(std::string_view deck) {
  return deck::parse_deck(deck, "benchmark.yaml").runs.front();
}

test::BuiltModel shaped_model(std::string_view deck, const MeshShape& shape) {
  const auto study = study_of(deck);
  return test::BuiltModel(study, shaped_mesh(study, shape));
}

} // namespace

BulkRun::BulkRun(std::string_view deck, const MeshShape& shape) : walk_(shaped_model(deck, shape)) {}

BulkRun::BulkRun(std::string_view deck, mesh::Mesh mesh)
    : walk_(test::BuiltModel(study_of(deck), std::move(mesh))) {}

void BulkRun::go_to(double t) {
  while (walk_.state().t < t - time_tolerance * std::abs(t))
    if (!walk_.advance())
      throw std::runtime_error("a benchmark did not come to its end");
}

double BulkRun::probe(const std::string& column) const {
  const auto columns = results::probe_columns(walk_.model);
  const auto found = std::ranges::find(columns, column);
  if (found == columns.end())
    throw std::out_of_range("no probe " + column);
  std::vector<double> row;
  results::add_probe_values(walk_.model, walk_.state(), row);
  return row[static_cast<std::size_t>(found - columns.begin())];
}

std::vector<double> BulkRun::cell_values(const std::string& field) const {
  study::FieldOutput output;
  output.only = {field};
  return results::cell_fields(walk_.model, walk_.state(), output).front().parts.front().values;
}

std::vector<double> BulkRun::hardest_step() const {
  std::vector<double> residuals;
  for (const auto& report : walk_.reports)
    if (report.converged() && report.bulk_residuals.size() >= residuals.size())
      residuals = report.bulk_residuals;
  return residuals;
}

int BulkRun::iterations() const {
  int sum = 0;
  for (const auto& report : walk_.reports)
    sum += report.bulk_iterations;
  return sum;
}

int BulkRun::cuts() const {
  return static_cast<int>(walk_.simulation.counters().cuts);
}

std::optional<double> order_of(const std::vector<double>& residuals) {
  if (residuals.empty())
    return std::nullopt;
  constexpr double rounding = 1e-13;
  const double least = rounding * *std::ranges::max_element(residuals);
  auto end = residuals.end();
  while (end != residuals.begin() && *(end - 1) <= least)
    --end;
  if (end - residuals.begin() < 3)
    return std::nullopt;
  const double first = *(end - 3), second = *(end - 2), third = *(end - 1);
  if (second >= first)
    return std::nullopt;
  return std::log(third / second) / std::log(second / first);
}

} // namespace rubato::verification
