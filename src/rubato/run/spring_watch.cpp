// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/run/spring_watch.hpp"

#include "rubato/contact/zone.hpp"
#include "rubato/model/model.hpp"
#include "rubato/model/node_label.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rubato::run {
namespace {

/// Of what the bodies store: forces may be too small by as much.
constexpr double soft_part = 0.05;
/// What is left of it with the stiffness that a warning names.
constexpr double good_part = 0.01;

/// 1, 2 or 5 times a power of ten, not much below x.
double rounded_up(double x) {
  constexpr double enough = 0.95;
  const double power = std::pow(10, std::floor(std::log10(x)));
  for (const double digit : {1., 2., 5.})
    if (digit * power >= enough * x)
      return digit * power;
  return 10 * power;
}

} // namespace

SpringWatch::Held SpringWatch::held_by(std::size_t zone, const step::State& now) const {
  const auto& outcomes = now.zones[zone].outcomes;
  Held held{.t = now.t, .zone = zone};
  double most = 0;
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    const double gap = outcomes[i].gap, pressure = outcomes[i].pressure;
    if (!(pressure > 0) || !(gap < 0))
      continue;
    const double force = contact::pressing_force(outcomes[i]);
    held.energy += 0.5 * force * -gap;
    if (pressure > most) {
      most = pressure;
      held.node = model_.zones[zone].points[i].nodes.front();
      held.depth = -gap;
      held.stiffness = (model_.zones[zone].unit_weights ? force : pressure) / -gap;
    }
  }
  return held;
}

void SpringWatch::note(const step::State& now, const step::EnergyLedger& ledger) {
  most_in_bodies_ = std::max(most_in_bodies_, ledger.strain);
  for (std::size_t z = 0; z < model_.zones.size(); ++z)
    if (!study::entry_of(model_.zones[z].settings.method).exact)
      if (const auto held = held_by(z, now); held.energy > most_.energy)
        most_ = held;
}

void SpringWatch::tell() const {
  const double part = this->part();
  if (!(part > soft_part))
    return;
  watch_.warn(fmt::format(
      "{}: the springs of contact.{} held {:.2g} times what the bodies stored, at t = {:g}, with a "
      "penetration of {:.2g} at node {}: forces of bodies that a given way squeezes are too small by {:.0f} "
      "%; expected "
      "'coefficients: {{normal: {:g}}}' or more",
      model_.study.name, model_.zones[most_.zone].settings.name, part, most_.t, most_.depth,
      model::node_label(model_.mesh, most_.node), 100 * part / (1 + part),
      rounded_up(most_.stiffness * part / good_part)));
}

std::vector<results::Plausibility> SpringWatch::checks() const {
  const bool any = std::ranges::any_of(
      model_.zones, [](const auto& zone) { return !study::entry_of(zone.settings.method).exact; });
  if (!any)
    return {};
  return {{"contact_springs", part(), soft_part, most_.t,
           fmt::format("contact.{}", model_.zones[most_.zone].settings.name), "", part() > soft_part}};
}

} // namespace rubato::run
