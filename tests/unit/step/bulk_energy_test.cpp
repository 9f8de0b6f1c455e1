// SPDX-License-Identifier: LGPL-3.0-or-later
// The ledger of bodies beyond linear elasticity: an identity for whatever a step does, as that of linear
// ones, and what its entries are in closed form.
#include "rubato/domain/balance_terms.hpp"
#include "rubato/step/energy.hpp"

#include <gtest/gtest.h>

#include "support/bulk_laws.hpp"
#include "support/model_of.hpp"
#include "unit/step/any_state.hpp"
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace rubato::step::bulk_energy_test {
namespace {

using deck::Setting;
using Eigen::VectorXd;
using test::AnyStates;
using test::NamedLaw;
using test::NamedScheme;

/// Strains of a few hundredths.
constexpr double size = 0.004;
/// Of the largest entry. Own modes of enhanced cells are solved to 1e-11 of the largest forces on them.
constexpr double closed = 1e-11;

std::vector<Setting> joined(std::vector<Setting> one, const std::vector<Setting>& other) {
  one.insert(one.end(), other.begin(), other.end());
  return one;
}

/// Steps that fulfil nothing but what their parts mean, entered one after the other.
void expect_closing(AnyStates& any, const std::string& what) {
  const auto start = any.any_state();
  EnergyAccount account(any.model, any.scheme, start);
  auto before = start;
  for (const double h : {0.5, 0.4, 0.6, 0.5}) {
    const auto now = any.any_step_from(before, h);
    ASSERT_TRUE(now.bulk.internal.allFinite()) << what;
    account.enter(before, now);
    EXPECT_LE(std::abs(account.ledger().balance()), closed * account.ledger().largest()) << what;
    before = now;
  }
}

struct Combined {
  NamedLaw law;
  NamedScheme scheme;
};

/// Every law with every scheme that takes it.
std::vector<Combined> combinations() {
  std::vector<Combined> all;
  for (const auto& law : test::every_law)
    for (const auto& scheme : test::every_implicit_scheme)
      if (test::is_elastic(law) || scheme.name != "EnergyMomentum")
        all.push_back({law, scheme});
  return all;
}

class LedgerOf : public testing::TestWithParam<Combined> {
protected:
  const NamedLaw& law_ = GetParam().law;
  const NamedScheme& scheme_ = GetParam().scheme;
};

TEST_P(LedgerOf, ClosesWhateverAStepDoes) {
  AnyStates any(test::BuiltModel(test::study_with(test::pulled_block, law_, scheme_.settings)), size);
  expect_closing(any, law_.name);
}

INSTANTIATE_TEST_SUITE_P(EachLaw, LedgerOf, testing::ValuesIn(combinations()),
                         [](const auto& chosen) { return chosen.param.law.name + chosen.param.scheme.name; });

class LedgerIn : public testing::TestWithParam<NamedLaw> {};

TEST_P(LedgerIn, SpaceCloses) {
  const std::vector<Setting> solid{
      {"mesh",
       "{generate: [{name: block, box: {from: [0, 0, 0], to: [1, 1, 1]}, divisions: [2, 1, 2], sides: "
       "{left: clamp, right: pulled}}]}"},
      {"physics", "solid"},
      {"supports.0.fix", "[x, y, z]"}};
  AnyStates any(test::BuiltModel(test::study_with(test::pulled_block, GetParam(), solid)), size);
  expect_closing(any, "solid");
}

TEST_P(LedgerIn, RingsClose) {
  AnyStates any(
      test::BuiltModel(test::study_with(test::pulled_block, GetParam(), {{"physics", "axisymmetric"}})),
      size);
  expect_closing(any, "axisymmetric");
}

/// Beside a linear body that they share nodes with, on springs and a stop.
TEST_P(LedgerIn, MixedBodiesClose) {
  const std::vector<Setting> mixed{
      {"mesh.groups", "{hard: {box: {from: [0.33, 0], to: [1, 1]}, of: block, take: cells}, soft: "
                      "{difference: [block, hard]}}"},
      {"materials", "{rubber: {young: 3, poisson: 0.3, density: 2, cells: soft, rayleigh: {stiffness: 0.1}}, "
                    "steel: {young: 9, poisson: 0.2, density: 4, cells: hard}}"},
      {"springs", "[{on: pulled, y: 0.2}]"},
      {"connectors", "[{on: pulled, along: [0, 1], force: {elongations: [-1, 0, 0.001, 1], forces: [-2, 0, "
                     "0, 3]}, damping: 0.1}]"}};
  for (const auto* scheme : {"newmark", "moreau_jean", "energy_momentum"}) {
    if (std::string(scheme) == "energy_momentum" && !test::is_elastic(GetParam()))
      continue;
    AnyStates any(test::BuiltModel(test::study_with(test::pulled_block, GetParam(),
                                                    joined(mixed, {{"time.scheme", scheme}}))),
                  size);
    ASSERT_FALSE(any.model.domain.is_linear());
    expect_closing(any, scheme);
  }
}

TEST(BalanceOfMaterials, NeedsRecordsOfBothEnds) {
  const AnyStates any(test::BuiltModel(test::study_with(test::pulled_block, test::every_law.front())));
  const auto& domain = any.model.domain;
  EXPECT_THROW(domain.balance(domain.initial_states(), domain.initial_states()), std::invalid_argument);
  EXPECT_THROW(domain.back_stress_energy(domain.initial_states()), std::invalid_argument);
}

INSTANTIATE_TEST_SUITE_P(EachLaw, LedgerIn, testing::ValuesIn(test::every_law),
                         [](const auto& chosen) { return chosen.param.name; });

} // namespace
} // namespace rubato::step::bulk_energy_test
