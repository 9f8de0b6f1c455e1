// SPDX-License-Identifier: LGPL-3.0-or-later
#include <gtest/gtest.h>

#include "modal_model.hpp"
#include "support/faults.hpp"
#include "support/two_blocks.hpp"

namespace rubato::modes::modal_study_test {
namespace {

TEST(ModalStudy, HasConsistentMassesWhateverTheScheme) {
  const auto frequencies = [](const std::string& time) {
    const auto deck = test::with(test::two_blocks, "{scheme: hht, alpha: -0.1, step: 1e-4, end: 4e-4}", time);
    return modes_of(test::modal_model(deck), {.number = 3}).frequencies;
  };
  const auto expected = frequencies("{scheme: hht, alpha: -0.1, step: 1e-4, end: 4e-4}");
  EXPECT_EQ(frequencies("{scheme: static, step: 1, end: 1}"), expected);
  EXPECT_EQ(frequencies("{step: 1e-4, end: 1e-4}"), expected);
}

TEST(ModalStudy, TakesZonesOfEveryMethod) {
  for (const auto* method :
       {"nodal_lagrange", "nodal_pcg", "nodal_penalty, friction_method: nodal_penalty"}) {
    const auto frictionless = std::string(method) == "nodal_pcg";
    const auto zone = std::string("integration: nodes, friction: ") + (frictionless ? "0" : "0.2") +
                      (frictionless ? ", iterate: {geometry: fixed_point}" : "") + ", method: " + method;
    const auto model =
        test::modal_model(test::with(test::two_blocks, "integration: nodes, friction: 0.2", zone));
    EXPECT_TRUE(modes_of(model, {.number = 2, .contact = Contact::stuck}).converged) << method;
  }
}

TEST(ModalStudy, WantsADensityOfEveryMaterial) {
  auto study = deck::parse_deck(test::two_blocks, "deck.yaml").runs.front();
  study.materials.front().density.reset();
  EXPECT_EQ(test::fault_of([&] { modal_study(study); }),
            "materials.steel: 'density' is missing: vibrations move masses");
}

} // namespace
} // namespace rubato::modes::modal_study_test
