// SPDX-License-Identifier: LGPL-3.0-or-later
#include "support/walk.hpp"

#include "rubato/contact/zone.hpp"
#include "rubato/deck/read.hpp"
#include "rubato/model/build_model.hpp"
#include "rubato/model/model.hpp"
#include "rubato/time/step_control.hpp"

#include "support/model_of.hpp"
#include <algorithm>
#include <utility>
#include <variant>

namespace rubato::test {

Walk::Walk(std::string_view deck, const std::vector<deck::Setting>& changes)
    : Walk(study_of(deck, changes)) {}

Walk::Walk(const study::Study& study, const step::State* previous)
    : Walk(model::build_model(study), previous) {}

Walk::Walk(const study::Study& study, mesh::Mesh mesh) : Walk(model::build_model(study, std::move(mesh))) {}

Walk::Walk(model::Model given, const step::State* previous)
    : simulation(std::move(given), {.previous = previous}), model(simulation.model()),
      scheme(time::make_scheme(model.study.time)) {
  observe();
}

Walk::Walk(BuiltModel given)
    : given_(std::move(given)), simulation(given_->whole), model(*given_),
      scheme(time::make_scheme(model.study.time)) {
  observe();
}

void Walk::observe() {
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

bool Walk::advance() {
  do {
    if (!simulation.advance().accepted())
      return false;
    if (accepted)
      accepted();
  } while (!finished() && simulation.next().cut_level > 0);
  return true;
}

bool Walk::to_end() {
  while (!finished())
    if (!advance())
      return false;
  return true;
}

void Walk::stand_at(step::State now) {
  auto memento = simulation.memento();
  memento.state = std::move(now);
  simulation.restore(memento);
}

double Walk::length() const {
  time::StepControl control(model.study.time, state().t);
  control.go_on(std::get<simulation::ImplicitProgress>(simulation.memento().progress).place);
  return control.length();
}

double Walk::displacement(mesh::NodeIndex node, int component) const {
  return state().motion.u[model.dofs.dof(node, component)];
}

mesh::NodeIndex Walk::node_at(double x, double y, double z) const {
  for (const auto node : model.dofs.nodes)
    if ((model.mesh.points[static_cast<std::size_t>(node)] - Eigen::Vector3d(x, y, z)).norm() < 1e-9)
      return node;
  return -1;
}

results::Resultants Walk::resultants(std::size_t zone) const {
  return results::contact_resultants(state().zones[zone]);
}

double Walk::pressure(std::size_t i, std::size_t zone) const {
  return state()
      .zones[zone]
      .multipliers[static_cast<Eigen::Index>(i) * model.zones[zone].multipliers_per_node()];
}

const Eigen::Vector3d& Walk::slave_point(std::size_t i, std::size_t zone) const {
  return model.mesh.points[static_cast<std::size_t>(model.zones[zone].slave.nodes[i])];
}

std::size_t Walk::slave_count(std::size_t zone) const {
  return model.zones[zone].slave.nodes.size();
}

} // namespace rubato::test
