// SPDX-License-Identifier: LGPL-3.0-or-later
// Numbers that are not finite are refused wherever a deck has numbers, each at its place.
#include "rubato/deck/read.hpp"

#include <gtest/gtest.h>

#include "support/faults.hpp"
#include <string>

namespace rubato::deck::finite_test {
namespace {

const std::string every_number = R"(mesh:
  generate:
    - name: upper
      rectangle: {from: [0, 0], to: [1, 0.2]}
      divisions: [4, 2]
      sides: {left: held, bottom: upper_face, top: roof}
    - name: lower
      rectangle: {from: [0, -0.2], to: [1, 0]}
      divisions: [4, 2]
      sides: {left: held, top: lower_face}
physics: plane_stress
thickness: 1
materials: {steel: {young: 2e11, poisson: 0.3, density: 7800, rayleigh: {stiffness: 0, mass: 1}}}
functions: {ramp: {times: [0, 1], values: [0, 1]}}
supports: [{on: held, x: 0, y: {value: 0, function: ramp}}]
loads: [{pressure: {on: roof, value: 1e6, function: ramp}}, {gravity: {y: -10}}]
contact:
  interface: {master: upper_face, slave: lower_face, friction: 0.2, method: penalty,
              coefficients: {normal: 1e12, tangential: 1e6}}
time: {scheme: hht, alpha: -0.1, step: 1e-4, end: 4e-4}
newton: {residual: 1e-8}
probes: {end: {point: [1, 0.2]}}
)";

class NumberOfADeck : public testing::TestWithParam<const char*> {};

TEST_P(NumberOfADeck, IsRefusedUnlessItIsFinite) {
  const std::string path = GetParam();
  ASSERT_EQ(test::fault_of([&] { parse_deck(every_number, "deck.yaml"); }), "nothing thrown");
  for (const char* word : {"nan", ".nan", "inf", "-inf", ".inf", "-.inf", "1e400", "-1e400"}) {
    const auto fault = test::fault_of([&] {
      parse_deck(every_number, "deck.yaml", std::vector<Setting>{{path, word}});
    });
    EXPECT_TRUE(fault.starts_with("--set " + path + ": " + path + ": found '" + word + "', expected "))
        << fault;
  }
}

INSTANTIATE_TEST_SUITE_P(
    At, NumberOfADeck,
    testing::Values("mesh.generate.0.rectangle.from.0", "mesh.generate.0.rectangle.to.1", "thickness",
                    "materials.steel.young", "materials.steel.poisson", "materials.steel.density",
                    "materials.steel.rayleigh.stiffness", "materials.steel.rayleigh.mass",
                    "functions.ramp.times.1", "functions.ramp.values.0", "supports.0.x", "supports.0.y.value",
                    "loads.0.pressure.value", "loads.1.gravity.y", "contact.interface.friction",
                    "contact.interface.coefficients.normal", "contact.interface.coefficients.tangential",
                    "time.alpha", "time.step", "time.end", "newton.residual", "probes.end.point.0"),
    [](const auto& chosen) {
      std::string name = chosen.param;
      std::erase_if(name, [](char letter) { return letter == '.' || letter == '_'; });
      return name;
    });

} // namespace
} // namespace rubato::deck::finite_test
