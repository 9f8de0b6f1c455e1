// SPDX-License-Identifier: LGPL-3.0-or-later
/// The simulation of a deck, everything that a step leaves behind at hand.
#pragma once

#include "rubato/mesh/mesh.hpp"
#include "rubato/model/model.hpp"
#include "rubato/results/nodal_fields.hpp"
#include "rubato/simulation/simulation.hpp"
#include "rubato/step/advance.hpp"
#include "rubato/step/full/linear_step.hpp"
#include "rubato/step/start.hpp"
#include "rubato/time/step_control.hpp"

#include "support/model_of.hpp"
#include <algorithm>
#include <functional>
#include <memory>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace rubato::test {

/// Implicit.
class Walk {
  /// Stays where it is when the walk moves.
  struct Told {
    step::State before;
    std::vector<step::StepReport> reports;
    int deepest_cut = 0;
  };
  std::unique_ptr<Told> told_ = std::make_unique<Told>();

public:
  explicit Walk(std::string_view deck, const std::vector<deck::Setting>& changes = {})
      : Walk(model_of(deck, changes)) {}

  /// `previous`: the end of the run that the study starts from, when it does.
  explicit Walk(model::Model given, const step::State* previous = nullptr)
      : simulation(std::move(given), {.previous = previous}), model(simulation.model()),
        scheme(time::make_scheme(model.study.time)) {
    simulation.observe(
        {.accepted =
             [told = told_.get()](const simulation::AcceptedStep& step) {
               told->before = step.before;
               told->reports.push_back(step.report);
               told->deepest_cut = std::max(told->deepest_cut, step.attempt.cut_level);
             },
         .rejected = [told = told_.get()](
                         const simulation::RejectedStep& step) { told->reports.push_back(step.report); }});
  }

  /// Steps to the next instant of the list, cutting when it must; false when that doesn't help.
  bool advance() {
    do {
      if (!simulation.advance().accepted())
        return false;
      if (accepted)
        accepted();
    } while (!finished() && simulation.next().cut_level > 0);
    return true;
  }

  bool to_end() {
    while (!finished())
      if (!advance())
        return false;
    return true;
  }

  /// Goes on from there.
  void stand_at(step::State now) {
    auto memento = simulation.memento();
    memento.state = std::move(now);
    simulation.restore(memento);
  }

  bool finished() const { return simulation.finished(); }
  /// The last accepted one.
  const step::State& state() const { return simulation.state(); }
  /// The end of the next step, and its length.
  double target() const { return simulation.next().end; }
  double length() const {
    time::StepControl control(model.study.time, state().t);
    control.go_on(std::get<simulation::ImplicitProgress>(simulation.memento().progress).place);
    return control.length();
  }

  double displacement(mesh::NodeIndex node, int component) const {
    return state().motion.u[model.dofs.dof(node, component)];
  }
  mesh::NodeIndex node_at(double x, double y, double z = 0) const {
    for (const auto node : model.dofs.nodes)
      if ((model.mesh.points[static_cast<std::size_t>(node)] - Eigen::Vector3d(x, y, z)).norm() < 1e-9)
        return node;
    return -1;
  }
  results::Resultants resultants(std::size_t zone = 0) const {
    return results::contact_resultants(state().zones[zone]);
  }
  /// λ of the i-th slave node.
  double pressure(std::size_t i, std::size_t zone = 0) const {
    return state()
        .zones[zone]
        .multipliers[static_cast<Eigen::Index>(i) * model.zones[zone].multipliers_per_node()];
  }
  const Eigen::Vector3d& slave_point(std::size_t i, std::size_t zone = 0) const {
    return model.mesh.points[static_cast<std::size_t>(model.zones[zone].slave.nodes[i])];
  }
  std::size_t slave_count(std::size_t zone = 0) const { return model.zones[zone].slave.nodes.size(); }

  simulation::Simulation simulation;
  const model::Model& model;
  time::Scheme scheme;
  const step::State& before = told_->before;                     ///< the state before the last step
  const std::vector<step::StepReport>& reports = told_->reports; ///< of every attempt
  const int& deepest_cut = told_->deepest_cut;                   ///< halvings of the shortest accepted step
  std::function<void()> accepted; ///< called after every accepted step, cut ones too
};

} // namespace rubato::test
