// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/results/contact_table.hpp"

#include "rubato/contact/arc_length.hpp"
#include "rubato/contact/dropped_nodes.hpp"
#include "rubato/contact/pairing.hpp"
#include "rubato/mesh/names.hpp"
#include "rubato/model/model.hpp"
#include "rubato/results/run_folder.hpp"
#include "rubato/study/words.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <iterator>
#include <utility>

namespace rubato::results {
namespace {

std::string header(int components) {
  std::vector<std::string> columns{"t", "node"};
  if (components == 2)
    columns.emplace_back("s");
  const auto axes = std::span(study::axis_words).first(static_cast<std::size_t>(components));
  columns.insert(columns.end(), axes.begin(), axes.end());
  columns.emplace_back("pressure");
  for (const auto axis : axes)
    columns.push_back(fmt::format("traction.{}", axis));
  columns.insert(columns.end(), {"gap", "slip", "status", "friction_work", "area"});
  return fmt::format("{}", fmt::join(columns, ","));
}

std::filesystem::path path_of(const model::Model& model, std::size_t zone,
                              const std::filesystem::path& folder) {
  return folder / contact_file(model.zones[zone].settings.name);
}

} // namespace

ContactTable::ContactTable(const model::Model& model, std::size_t zone, const std::filesystem::path& folder)
    : ContactTable(model, zone, LineFile(path_of(model, zone, folder))) {
  file_.add(header(model.dofs.components));
}

ContactTable::ContactTable(const model::Model& model, std::size_t zone, const std::filesystem::path& folder,
                           std::uintmax_t bytes)
    : ContactTable(model, zone, LineFile(path_of(model, zone, folder), bytes)) {}

ContactTable::ContactTable(const model::Model& model, std::size_t zone, LineFile file)
    : model_(&model), zone_(zone), file_(std::move(file)) {
  for (const auto& point : points())
    nodes_.push_back(point.node_position < 0 ? "" : mesh::node_name(model.mesh, point.nodes.front()));
  if (model.dofs.components == 2)
    arc_lengths_ = contact::arc_lengths(model.mesh, model.zones[zone]);
}

std::span<const contact::SlavePoint> ContactTable::points() const {
  return model_->zones[zone_].points;
}

void ContactTable::write(const step::State& state) {
  if (points().empty())
    return;
  std::string lines;
  for (std::size_t i = 0; i < points().size(); ++i) {
    if (i > 0)
      lines += '\n';
    lines += line(state, i);
  }
  file_.add(lines);
}

std::string ContactTable::line(const step::State& state, std::size_t point) const {
  const auto& zone = state.zones[zone_];
  const auto& outcome = zone.outcomes[point];
  const auto& history = zone.friction_history[point];
  const int components = model_->dofs.components;
  const Eigen::Vector3d place = contact::position(points()[point], {.mesh = &model_->mesh,
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
  const auto traction = contact::reported_traction(zone, point);
  for (int i = 0; i < components; ++i)
    add(traction[i]);
  if (std::isfinite(outcome.gap))
    add(outcome.gap);
  else
    line += ',';
  add(history.slip);
  line += ',';
  line += to_string(contact::reported_status(zone, point));
  add(history.work);
  add(outcome.area);
  return line;
}

} // namespace rubato::results
