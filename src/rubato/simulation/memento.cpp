// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/simulation/memento.hpp"

#include "rubato/contact/zone.hpp"
#include "rubato/core/error.hpp"
#include "rubato/model/model.hpp"
#include "rubato/study/formulation.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace rubato::simulation {

bool fits(const model::Model& model, const step::State& state) {
  const auto same_zone = [](const contact::Zone& zone, const contact::ZoneState& of_state) {
    return zone.points.size() == of_state.status.size() &&
           zone.multiplier_count() == of_state.multipliers.size();
  };
  return state.motion.u.size() == model.dofs.dof_count &&
         std::ranges::equal(model.zones, state.zones, same_zone);
}

bool remembers_alike(const model::Model& model, const step::State& state) {
  return !study::remembers(model.study) ||
         state.bulk_points.values.size() == model.domain.initial_states().values.size();
}

namespace {

/// Ties of explicit runs have no springs.
bool fits(const model::Model& model, const ExplicitProgress& progress) {
  const auto with_springs =
      std::ranges::count_if(model.zones, [](const auto& zone) { return !zone.settings.tie; });
  return progress.motion.u.size() == model.dofs.dof_count &&
         progress.motion.zones.size() == static_cast<std::size_t>(with_springs);
}

} // namespace

void check_fits(const model::Model& model, const Memento& memento) {
  const auto& name = model.study.name;
  const auto* const motion = std::get_if<ExplicitProgress>(&memento.progress);
  if ((motion != nullptr) != study::is_explicit(model.study.time.scheme))
    throw InputError(fmt::format(
        "run '{}' cannot go on from a memento of another kind: one run is implicit, the other explicit",
        name));
  if (!fits(model, memento.state) || !remembers_alike(model, memento.state) ||
      (motion != nullptr && !fits(model, *motion)))
    throw InputError(fmt::format(
        "run '{}' cannot go on from a memento that has another mesh, other contact zones or materials that "
        "remember something else",
        name));
}

} // namespace rubato::simulation
