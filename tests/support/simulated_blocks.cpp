// SPDX-License-Identifier: LGPL-3.0-or-later
#include "support/simulated_blocks.hpp"

#include "rubato/deck/read.hpp"

#include <variant>

namespace rubato::test {

study::Study implicit_blocks() {
  return deck::parse_deck(two_blocks, "deck.yaml").runs.front();
}

study::Study explicit_blocks() {
  const auto time = "{scheme: central_difference, step: 1e-6, end: 4e-4, record: 5e-5}";
  const auto deck = with(with(two_blocks, "{scheme: hht, alpha: -0.1, step: 1e-4, end: 4e-4}", time),
                         "friction: 0.2", "friction: 0.2, method: penalty");
  return deck::parse_deck(deck, "deck.yaml").runs.front();
}

std::string name_of_kind(const testing::TestParamInfo<Kind>& info) {
  return info.param.name;
}

void expect_same(const step::State& a, const step::State& b) {
  EXPECT_EQ(a.t, b.t);
  EXPECT_EQ(a.motion.u, b.motion.u);
  EXPECT_EQ(a.motion.v, b.motion.v);
  EXPECT_EQ(a.motion.a, b.motion.a);
  EXPECT_EQ(a.residual_force, b.residual_force);
  EXPECT_EQ(a.contact_force, b.contact_force);
  EXPECT_EQ(a.reaction, b.reaction);
  EXPECT_EQ(a.zones, b.zones);
  EXPECT_EQ(a.bulk_points, b.bulk_points);
  EXPECT_EQ(a.moved, b.moved);
}

void expect_same(const step::EnergyLedger& a, const step::EnergyLedger& b) {
  EXPECT_EQ(a.kinetic, b.kinetic);
  EXPECT_EQ(a.strain, b.strain);
  EXPECT_EQ(a.contact, b.contact);
  EXPECT_EQ(a.external_work, b.external_work);
  EXPECT_EQ(a.friction, b.friction);
  EXPECT_EQ(a.impact, b.impact);
  EXPECT_EQ(a.plastic, b.plastic);
  EXPECT_EQ(a.back_stress, b.back_stress);
  EXPECT_EQ(a.viscous, b.viscous);
  EXPECT_EQ(a.numerical, b.numerical);
  EXPECT_EQ(a.bulk_scheme, b.bulk_scheme);
}

void expect_same(const simulation::Memento& a, const simulation::Memento& b) {
  expect_same(a.state, b.state);
  EXPECT_EQ(a.counters, b.counters);
  ASSERT_EQ(a.progress.index(), b.progress.index());
  if (const auto* implicit = std::get_if<simulation::ImplicitProgress>(&a.progress)) {
    const auto& other = std::get<simulation::ImplicitProgress>(b.progress);
    EXPECT_EQ(implicit->place.now, other.place.now);
    EXPECT_EQ(implicit->place.ends, other.place.ends);
    EXPECT_EQ(implicit->place.wanted, other.place.wanted);
    EXPECT_EQ(implicit->overlaps, other.overlaps);
    expect_same(implicit->energy, other.energy);
  } else {
    const auto& one = std::get<simulation::ExplicitProgress>(a.progress);
    const auto& other = std::get<simulation::ExplicitProgress>(b.progress);
    EXPECT_EQ(one.limit, other.limit);
    EXPECT_EQ(one.motion.t, other.motion.t);
    EXPECT_EQ(one.motion.steps, other.motion.steps);
    EXPECT_EQ(one.motion.u, other.motion.u);
    EXPECT_EQ(one.motion.v, other.motion.v);
    EXPECT_EQ(one.motion.contact_force, other.motion.contact_force);
    expect_same(one.motion.energy, other.motion.energy);
  }
}

void expect_same(const simulation::Simulation& a, const simulation::Simulation& b) {
  expect_same(a.memento(), b.memento());
  expect_same(a.energy(), b.energy());
  EXPECT_EQ(a.finished(), b.finished());
}

void go_to_end(simulation::Simulation& simulation) {
  while (!simulation.finished())
    ASSERT_TRUE(simulation.advance().accepted());
}

} // namespace rubato::test
