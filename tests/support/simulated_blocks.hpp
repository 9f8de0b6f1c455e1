// SPDX-License-Identifier: LGPL-3.0-or-later
/// The same two blocks as an implicit and as an explicit study, and what simulations of them are held
/// against each other by.
#pragma once

#include "rubato/simulation/time_integration.hpp"
#include "rubato/study/study.hpp"

#include <gtest/gtest.h>

#include "support/two_blocks.hpp"
#include <string>

namespace rubato::test {

/// Four steps in contact.
study::Study implicit_blocks();

/// Eight records of 50 steps, in contact.
study::Study explicit_blocks();

struct Kind {
  std::string name;
  study::Study study;
};

std::string name_of_kind(const testing::TestParamInfo<Kind>& info);

inline auto both_kinds() {
  return testing::Values(Kind{"Implicit", implicit_blocks()}, Kind{"Explicit", explicit_blocks()});
}

/// Bit for bit.
void expect_same(const step::State& a, const step::State& b);

void expect_same(const step::EnergyLedger& a, const step::EnergyLedger& b);

/// Where both stand, with what they carry on.
void expect_same(const simulation::Memento& a, const simulation::Memento& b);

void expect_same(const simulation::Simulation& a, const simulation::Simulation& b);

void go_to_end(simulation::Simulation& simulation);

} // namespace rubato::test
