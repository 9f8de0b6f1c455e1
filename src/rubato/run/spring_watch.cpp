// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/run/spring_watch.hpp"

#include "rubato/contact/springs.hpp"
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
/// Of the largest strain energy: gaps of points that press in exact zones. Sound runs have at most 0.011.
constexpr double closed_gap_part = 0.02;
/// What is left of soft_part with the stiffness that a warning names.
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
  const auto& state = now.zones[zone];
  const bool springs = !contact::closes_gaps(model_.zones[zone]);
  Held held{.t = now.t, .zone = zone};
  double most = 0;
  for (std::size_t i = 0; i < state.outcomes.size(); ++i) {
    const double gap = state.outcomes[i].gap, pressure = state.outcomes[i].pressure;
    const double depth = springs ? -gap : std::abs(gap);
    const bool touches = springs || state.status[i] != contact::Status::open;
    if (!touches || !(pressure > 0) || !(depth > 0) || !std::isfinite(depth))
      continue;
    const double force = contact::pressing_force(state.outcomes[i]);
    held.energy += 0.5 * force * depth;
    if (pressure > most) {
      most = pressure;
      held.node = model_.zones[zone].points[i].nodes.front();
      held.depth = depth;
      held.stiffness = (model_.zones[zone].unit_weights ? force : pressure) / depth;
    }
  }
  return held;
}

void SpringWatch::note(const step::State& now, const step::EnergyLedger& ledger) {
  most_in_bodies_ = std::max(most_in_bodies_, ledger.strain);
  for (std::size_t z = 0; z < model_.zones.size(); ++z) {
    if (model_.zones[z].settings.tie)
      continue;
    auto& most = contact::closes_gaps(model_.zones[z]) ? most_in_gaps_ : most_in_springs_;
    if (const auto held = held_by(z, now); held.energy > most.energy)
      most = held;
  }
}

void SpringWatch::tell() const {
  const double part = part_of(most_in_springs_);
  if (!(part > soft_part))
    return;
  watch_.warn(fmt::format(
      "{}: the springs of contact.{} held {:.2g} times what the bodies stored, at t = {:g}, with a "
      "penetration of {:.2g} at node {}: forces of bodies that a given way squeezes are too small by {:.0f} "
      "%; expected "
      "'coefficients: {{normal: {:g}}}' or more",
      model_.study.name, model_.zones[most_in_springs_.zone].settings.name, part, most_in_springs_.t,
      most_in_springs_.depth, model::node_label(model_.mesh, most_in_springs_.node), 100 * part / (1 + part),
      rounded_up(most_in_springs_.stiffness * part / good_part)));
}

std::vector<results::Plausibility> SpringWatch::checks() const {
  std::vector<results::Plausibility> checks;
  const auto has = [&](bool springs) {
    return std::ranges::any_of(model_.zones, [&](const contact::Zone& zone) {
      return !zone.settings.tie && contact::closes_gaps(zone) != springs;
    });
  };
  if (has(true))
    checks.push_back({"contact_springs", part_of(most_in_springs_), soft_part, most_in_springs_.t,
                      place_of(most_in_springs_), "", part_of(most_in_springs_) > soft_part});
  if (has(false))
    checks.push_back(
        {"closed_gaps", part_of(most_in_gaps_), closed_gap_part, most_in_gaps_.t, place_of(most_in_gaps_),
         "half the forces of points that press, times their gaps, are this part of what the bodies "
         "stored: forces of bodies that a given way squeezes deviate by as much; expected a shorter "
         "'time.step', the other side as slave, or 'scheme: hht'"});
  return checks;
}

std::string SpringWatch::place_of(const Held& held) const {
  const auto& name = model_.zones[held.zone].settings.name;
  return held.node < 0
             ? fmt::format("contact.{}", name)
             : fmt::format("contact.{} at node {}", name, model::node_label(model_.mesh, held.node));
}

double SpringWatch::part_of(const Held& held) const {
  return most_in_bodies_ > 0 ? held.energy / most_in_bodies_ : 0;
}

} // namespace rubato::run
