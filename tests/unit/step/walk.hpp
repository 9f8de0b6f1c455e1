// SPDX-License-Identifier: LGPL-3.0-or-later
/// Walks a deck's run step by step, everything that a step leaves behind at hand.
#pragma once

#include "rubato/deck/read.hpp"
#include "rubato/mesh/mesh.hpp"
#include "rubato/model/model.hpp"
#include "rubato/results/nodal_fields.hpp"
#include "rubato/step/advance.hpp"
#include "rubato/step/linear_step.hpp"
#include "rubato/step/start.hpp"
#include "rubato/time/step_control.hpp"

#include <functional>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace rubato::test {

class Walk {
public:
  explicit Walk(std::string_view deck, const std::vector<deck::Setting>& changes = {})
      : Walk(model::build_model(deck::parse_deck(deck, "deck.yaml", changes).runs.front())) {}

  explicit Walk(model::Model given)
      : model(std::move(given)), scheme(time::make_scheme(model.study.time)),
        state(step::initial_state(model, scheme, model.study.time.begin,
                                  model.study.time.start != study::StartKind::at_rest_unloaded)),
        control(model.study.time, state.t) {}

  /// Steps to the next instant of the list, cutting when it must; false when that doesn't help.
  bool advance() {
    auto next = control;
    bool reached = false;
    while (!reached) {
      const bool listed = control.target_is_listed();
      if (!system || system->step != control.length())
        system = step::make_effective_system(model, scheme, control.length());
      step::State trial;
      reports.push_back(step::advance(model, scheme, *system, state, control.target(), trial));
      if (!reports.back().converged()) {
        if (!control.cut()) {
          control = next;
          return false;
        }
        continue;
      }
      control.accept();
      next = control;
      reached = listed;
      before = std::exchange(state, std::move(trial));
      if (accepted)
        accepted();
    }
    return true;
  }

  bool to_end() {
    while (!control.finished())
      if (!advance())
        return false;
    return true;
  }

  double displacement(mesh::NodeIndex node, int component) const {
    return state.motion.u[model.dofs.dof(node, component)];
  }
  mesh::NodeIndex node_at(double x, double y, double z = 0) const {
    for (const auto node : model.dofs.nodes)
      if ((model.mesh.points[static_cast<std::size_t>(node)] - Eigen::Vector3d(x, y, z)).norm() < 1e-9)
        return node;
    return -1;
  }
  results::Resultants resultants(std::size_t zone = 0) const {
    return results::contact_resultants(state.zones[zone]);
  }
  /// λ of the i-th slave node.
  double pressure(std::size_t i, std::size_t zone = 0) const {
    return state.zones[zone]
        .multipliers[static_cast<Eigen::Index>(i) * model.zones[zone].multipliers_per_node()];
  }
  const Eigen::Vector3d& slave_point(std::size_t i, std::size_t zone = 0) const {
    return model.mesh.points[static_cast<std::size_t>(model.zones[zone].slave.nodes[i])];
  }
  std::size_t slave_count(std::size_t zone = 0) const { return model.zones[zone].slave.nodes.size(); }

  model::Model model;
  time::Scheme scheme;
  step::State state;  ///< the last accepted one
  step::State before; ///< the one before it
  time::StepControl control;
  std::optional<step::EffectiveSystem> system; ///< of the last step's length
  std::vector<step::StepReport> reports;
  std::function<void()> accepted; ///< called after every accepted step, cut ones too
};

} // namespace rubato::test
