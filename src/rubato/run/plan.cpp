// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/run/plan.hpp"

#include "rubato/contact/zone.hpp"
#include "rubato/linalg/memory.hpp"
#include "rubato/model/build_model.hpp"
#include "rubato/model/model.hpp"
#include "rubato/simulation/time_integration.hpp"
#include "rubato/time/step_control.hpp"

namespace rubato::run {
namespace {

/// Thrown as soon as the memory is known: the factor itself is not wanted.
struct MemoryIsKnown {};

/// Builds the simulation as far as the factor.
void look_ahead(const model::Model& model, Plan& plan) {
  if (model.study.time.start == study::StartKind::from_run)
    return;
  const auto tell_memory = [&](std::size_t bytes) {
    if (bytes > linalg::available_memory())
      return; // it is refused, then
    plan.factor_bytes = bytes;
    throw MemoryIsKnown{};
  };
  try {
    const simulation::Simulation simulation(
        model, {.previous = nullptr, .memento = nullptr, .tell_memory = tell_memory});
    plan.method = simulation.method();
  } catch (const MemoryIsKnown&) {
  }
}

/// Of an explicit run the simulation tells.
std::size_t steps_of(const study::TimeStepping& time) {
  return study::is_explicit(time.scheme) ? 0
                                         : time::instants_of(time).size() - 1; // they begin with the first
}

} // namespace

Plan plan_of(const study::Study& study) {
  const auto model = model::build_model(study);
  Plan plan{.nodes = static_cast<std::size_t>(model.mesh.node_count()),
            .cells = static_cast<std::size_t>(model.mesh.cell_count()),
            .unknowns = static_cast<std::size_t>(model.reduction.unknown_count()),
            .contact_points = 0,
            .steps = steps_of(model.study.time),
            .method = {},
            .factor_bytes = {},
            .notes = model::chosen_sides(model.zones)};
  look_ahead(model, plan);
  for (const auto& zone : model.zones)
    plan.contact_points += zone.points.size();
  plan.notes.insert(plan.notes.end(), model.notes.begin(), model.notes.end());
  return plan;
}

} // namespace rubato::run
