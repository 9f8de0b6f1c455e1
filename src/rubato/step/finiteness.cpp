// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/finiteness.hpp"

#include "rubato/contact/zone.hpp"
#include "rubato/model/model.hpp"
#include "rubato/model/model_forces.hpp"
#include "rubato/model/node_label.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace rubato::step {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using model::Model;

std::optional<Index> first_bad(const VectorXd& values) {
  for (Index i = 0; i < values.size(); ++i)
    if (!std::isfinite(values[i]))
      return i;
  return std::nullopt;
}

std::string at_node(const Model& model, std::string_view what, mesh::NodeIndex node) {
  return fmt::format("{} node {}", what, model::node_label(model.mesh, node));
}

std::string in_multipliers(const Model& model, const State& trial) {
  for (std::size_t z = 0; z < std::min(model.zones.size(), trial.zones.size()); ++z) {
    const auto& zone = model.zones[z];
    if (const auto bad = first_bad(trial.zones[z].multipliers))
      return at_node(model, fmt::format("the multiplier of contact '{}' at", zone.settings.name),
                     zone.slave.nodes[static_cast<std::size_t>(*bad / zone.multipliers_per_node())]);
  }
  return {};
}

} // namespace

std::string first_not_finite(const Model& model, double t, const State& trial, const StepReport& report) {
  if (const auto bad = first_bad(model::external_force(model, t)))
    return at_node(model, "the load on", model.node_of(static_cast<int>(*bad)));
  if (const auto bad = first_bad(model.reduction.imposed(t)))
    return at_node(model, "the imposed displacement of", model.node_of(static_cast<int>(*bad)));
  const std::array<std::pair<const VectorXd*, const char*>, 3> motion{
      {{&trial.motion.u, "the displacement of"},
       {&trial.motion.v, "the velocity of"},
       {&trial.motion.a, "the acceleration of"}}};
  for (const auto& [values, what] : motion)
    if (const auto bad = first_bad(*values))
      return at_node(model, what, model.node_of(static_cast<int>(*bad)));
  if (auto found = in_multipliers(model, trial); !found.empty())
    return found;
  if (!report.worst.empty() && !std::isfinite(report.worst.front().residual))
    return at_node(model, "the residual at", report.worst.front().node);
  return {};
}

} // namespace rubato::step
