// SPDX-License-Identifier: LGPL-3.0-or-later

#include <gtest/gtest.h>

#include "modal_model.hpp"
#include "support/faults.hpp"
#include "support/model_of.hpp"
#include "support/two_blocks.hpp"
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace rubato::modes::modes_test {
namespace {

const std::string bar = R"(
mesh:
  generate:
    - {name: bar, rectangle: {from: [0, 0], to: [2, 0.01]}, divisions: [40, 1], cells: quad4,
       sides: {left: wall, bottom: along, top: along}}
physics: plane_stress
materials: {steel: {young: 200e9, poisson: 0, density: 8000}}
supports: [{on: wall, fix: x}, {on: along, fix: y}]
time: {scheme: static, step: 1, end: 1}
)";

const std::string loose_body = R"(
mesh:
  generate: [{name: body, box: {from: [0, 0, 0], to: [1, 2, 3]}, divisions: [1, 2, 2], cells: hexa8}]
physics: solid
materials: {steel: {young: 200e9, poisson: 0.3, density: 8000}}
time: {scheme: newmark, step: 1, end: 1}
)";

/// Bars of linear cells with consistent masses: ω² = 6 c²/h² (1 − cos kh)/(2 + cos kh), of a bar that is held
/// at one end k L = (n − 1/2) π.
TEST(Modes, OfABarAreThoseOfItsDifferenceEquation) {
  constexpr double length = 2;
  constexpr double h = length / 40;
  constexpr double speed = 5000;
  const auto modes = modes_of(test::modal_model(bar), {.number = 5});
  ASSERT_EQ(modes.frequencies.size(), 5);
  for (int n = 0; n < 5; ++n) {
    const double phase = (n + 0.5) * std::numbers::pi / length * h;
    const double omega = speed / h * std::sqrt(6 * (1 - std::cos(phase)) / (2 + std::cos(phase)));
    EXPECT_NEAR(modes.frequencies[n], omega / (2 * std::numbers::pi), 1e-11 * omega) << n;
  }
}

/// 8/((2n − 1)² π²) of the mass along the bar (theory of the continuous bar), nothing across.
TEST(Modes, OfABarCarryTheirEffectiveMasses) {
  const auto modes = modes_of(test::modal_model(bar), {.number = 2});
  ASSERT_EQ(modes.directions, (std::vector{0, 1}));
  EXPECT_NEAR(modes.mass, 8000 * 2 * 0.01, 1e-9);
  for (int n = 0; n < 2; ++n) {
    EXPECT_NEAR(modes.effective_masses(n, 0), 8 / std::pow((2 * n + 1) * std::numbers::pi, 2), 1e-3);
    EXPECT_NEAR(modes.effective_masses(n, 1), 0, 1e-15);
  }
  EXPECT_NEAR(modes.generalised_masses[0], modes.mass / 2, 1e-3 * modes.mass) << "∫ sin² along the bar";
}

TEST(Modes, HaveALongestDisplacementOfOne) {
  const auto model = test::modal_model(loose_body);
  const auto modes = modes_of(model, {.number = 12});
  for (Eigen::Index k = 0; k < 12; ++k) {
    const Eigen::VectorXd shape = modes.shapes.col(k);
    EXPECT_NEAR(shape.reshaped(3, shape.size() / 3).colwise().norm().maxCoeff(), 1, 1e-12);
    EXPECT_NEAR(shape.dot(model.mass * shape), modes.generalised_masses[k],
                1e-9 * modes.generalised_masses[k]);
  }
}

TEST(Modes, OfALooseBodyBeginWithSixOfFrequencyZero) {
  const auto modes = modes_of(test::modal_model(loose_body), {.number = 8});
  EXPECT_TRUE(modes.converged);
  EXPECT_EQ((modes.frequencies.array() == 0).count(), 6);
  EXPECT_GT(modes.frequencies[6], 100);
}

TEST(Modes, TogetherMoveTheWholeMassOfALooseBody) {
  const auto modes = modes_of(test::modal_model(loose_body), {.number = 1000});
  EXPECT_EQ(modes.frequencies.size(), 3 * 2 * 3 * 3);
  for (const double sum : modes.effective_masses.colwise().sum())
    EXPECT_NEAR(sum, 1, 1e-10);
}

TEST(Modes, OfAPlaneBodyInTwoPiecesBeginWithSixOfFrequencyZero) {
  const auto deck = test::with(test::two_blocks, "supports:\n  - {on: held, fix: [x, y]}\n", "");
  const auto modes = modes_of(test::modal_model(deck), {.number = 7});
  EXPECT_EQ((modes.frequencies.array() == 0).count(), 6) << "three of each";
}

/// Of a ring the mean of r² counts: no radial translation.
TEST(Modes, OfRingsHaveEffectiveMassesAlongTheAxisOnly) {
  const auto modes = modes_of(test::modal_model(R"(
mesh:
  generate: [{name: ring, rectangle: {from: [1, 0], to: [1.1, 0.1]}, divisions: [2, 2]}]
physics: axisymmetric
materials: {steel: {young: 200e9, poisson: 0.3, density: 8000}}
time: {scheme: newmark, step: 1, end: 1}
)"),
                              {.number = 2});
  EXPECT_EQ(modes.directions, std::vector{1});
  EXPECT_EQ(modes.frequencies[0], 0);
  EXPECT_NEAR(modes.effective_masses(0, 0), 1, 1e-9);
  EXPECT_GT(modes.frequencies[1], 100);
}

/// Side 20, thickness 0.05, held along one side: λ = 3.4917, 8.5246, 21.429 (A. W. Leissa, J. Sound Vib.
/// 31 (1973) 257–293, ν = 0.3). The stiffest motions of its cells are 1e13 times as stiff as the lowest mode.
TEST(Modes, OfAThinPlateHaveTheirDigits) {
  const auto modes = modes_of(test::modal_model(R"(
mesh:
  generate: [{name: plate, box: {from: [0, 0, 0], to: [20, 20, 0.05]}, divisions: [10, 10, 1], cells: hexa20,
              sides: {left: wall}}]
physics: solid
materials: {steel: {young: 2e5, poisson: 0.3, density: 7.8e-9, formulation: reduced}}
supports: [{on: wall, fix: [x, y, z]}]
time: {scheme: static, step: 1, end: 1}
)"),
                              {.number = 10});
  EXPECT_TRUE(modes.converged);
  EXPECT_LE(modes.residuals.maxCoeff(), 2e-8);
  const double plate = std::sqrt(2e5 * 0.05 * 0.05 / (12 * 0.91 * 7.8e-9)) / (400 * 2 * std::numbers::pi);
  const std::array leissa{3.4917, 8.5246, 21.429};
  for (std::size_t k = 0; k < leissa.size(); ++k)
    EXPECT_NEAR(modes.frequencies[static_cast<Eigen::Index>(k)], leissa[k] * plate, 0.01 * leissa[k] * plate);
}

TEST(Modes, AreRefusedWhereNothingCanMove) {
  const auto model = test::modal_model(test::with(bar, "{on: along, fix: y}", "{on: along, fix: [x, y]}"));
  EXPECT_EQ(test::fault_of([&] { modes_of(model, {}); }),
            "supports hold every displacement, expected something that can vibrate");
}

TEST(Modes, WantANumberAndMasses) {
  const auto model = test::modal_model(bar);
  EXPECT_THROW(modes_of(model, {.number = 0}), std::invalid_argument);
  EXPECT_THROW(modes_of(test::BuiltModel(deck::parse_deck(bar, "deck.yaml").runs.front()), {}),
               std::invalid_argument);
}

} // namespace
} // namespace rubato::modes::modes_test
