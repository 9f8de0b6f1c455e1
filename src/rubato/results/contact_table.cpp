// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/results/contact_table.hpp"

#include "rubato/contact/arc_length.hpp"
#include "rubato/mesh/names.hpp"
#include "rubato/results/run_folder.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <iterator>
#include <string_view>
#include <utility>

namespace rubato::results {
namespace {

using contact::Status;

constexpr std::string_view axes = "xyz";

std::string_view word_of(Status status) {
  switch (status) {
  case Status::open:
    return "open";
  case Status::stick:
    return "stick";
  case Status::slip:
    break;
  }
  return "slip";
}

std::string header(int components) {
  std::vector<std::string> columns{"t", "node"};
  if (components == 2)
    columns.emplace_back("s");
  for (const char axis : axes.substr(0, static_cast<std::size_t>(components)))
    columns.emplace_back(1, axis);
  columns.emplace_back("pressure");
  for (const char axis : axes.substr(0, static_cast<std::size_t>(components)))
    columns.push_back(fmt::format("traction.{}", axis));
  columns.insert(columns.end(), {"gap", "slip", "status", "friction_work", "area"});
  return fmt::format("{}", fmt::join(columns, ","));
}

LineFile begun(const std::filesystem::path& path, int components) {
  LineFile file(path);
  file.add(header(components));
  return file;
}

} // namespace

ContactTable::ContactTable(const model::Model& model, const contact::Zone& zone,
                           const std::filesystem::path& folder)
    : ContactTable(model, zone, begun(folder / contact_file(zone.settings.name), model.dofs.components)) {}

ContactTable::ContactTable(const model::Model& model, const contact::Zone& zone,
                           const std::filesystem::path& folder, std::uintmax_t bytes)
    : ContactTable(model, zone, LineFile(folder / contact_file(zone.settings.name), bytes)) {}

ContactTable::ContactTable(const model::Model& model, const contact::Zone& zone, LineFile file)
    : model_(&model), zone_(&zone), zone_index_(static_cast<std::size_t>(&zone - model.zones.data())),
      file_(std::move(file)) {
  for (const auto& point : zone.points)
    nodes_.push_back(point.node_position < 0 ? "" : mesh::node_name(model.mesh, point.nodes.front()));
  if (model.dofs.components == 2)
    arc_lengths_ = contact::arc_lengths(model.mesh, zone);
}

void ContactTable::write(const step::State& state) {
  if (zone_->points.empty())
    return;
  std::string lines;
  for (std::size_t i = 0; i < zone_->points.size(); ++i) {
    if (i > 0)
      lines += '\n';
    lines += line(state, i);
  }
  file_.add(lines);
}

std::string ContactTable::line(const step::State& state, std::size_t point) const {
  const auto& zone = state.zones[zone_index_];
  const auto& outcome = zone.outcomes[point];
  const auto& history = zone.friction_history[point];
  const int components = model_->dofs.components;
  const Eigen::Vector3d place = contact::position(zone_->points[point], {.mesh = &model_->mesh,
                                                                         .dofs = &model_->dofs,
                                                                         .displacement = &state.motion.u,
                                                                         .start = &state.motion.u,
                                                                         .t = state.t,
                                                                         .start_t = state.t});
  auto line = fmt::format("{},{}", state.t, nodes_[point]);
  const auto add = [&](double value) { fmt::format_to(std::back_inserter(line), ",{}", value); };
  if (components == 2)
    add(arc_lengths_[point]);
  for (int i = 0; i < components; ++i)
    add(place[i]);
  add(outcome.pressure);
  for (int i = 0; i < components; ++i)
    add(outcome.area > 0 ? outcome.tangential[i] / outcome.area : 0.0);
  if (std::isfinite(outcome.gap))
    add(outcome.gap);
  else
    line += ',';
  add(history.slip);
  line += ',';
  line += word_of(zone.status[point]);
  add(history.work);
  add(outcome.area);
  return line;
}

} // namespace rubato::results
