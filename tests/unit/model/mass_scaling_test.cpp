// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/deck/read.hpp"
#include "rubato/domain/cell_rates.hpp"
#include "rubato/model/build_model.hpp"
#include "rubato/model/mass_scaling.hpp"
#include "rubato/model/model.hpp"
#include "rubato/model/model_forces.hpp"
#include "rubato/step/explicit/explicit_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <string>
#include <vector>

namespace rubato::model::mass_scaling_test {
namespace {

/// A strip of four cells, two of them a tenth as wide as high, side by side.
Model strip(const std::string& time, const std::string& material = "young: 1, poisson: 0.2") {
  const auto study = deck::parse_deck(R"(
mesh: {generate: [{name: strip, rectangle: {from: [0, 0], to: [4, 1]}, divisions: [4, 1], sides: {left: held}}]}
physics: plane_strain
materials: {body: {density: 2, )" + material +
                                          R"(}}
supports: [{on: held, fix: [x, y]}]
loads: [{gravity: {y: -3}}]
time: {scheme: central_difference, end: 10, record: 1)" +
                                          time + "}\n",
                                      "deck.yaml")
                         .runs.front();
  auto mesh = load_mesh(study.mesh);
  for (auto& x : mesh.points)
    x[0] = std::vector{0.0, 1.9, 2.0, 2.1, 4.0}.at(static_cast<std::size_t>(std::lround(x[0])));
  return build_model(study, std::move(mesh));
}

double own_step(const Model& model, std::size_t cell) {
  return 2 / std::sqrt(domain::vibration_of(model.mesh, model.bulk, cell).largest());
}

TEST(CellVibration, BoundsItsLargestEigenvalueFromAbove) {
  for (const auto* material :
       {"young: 1, poisson: 0.2", "young: 1, poisson: 0.499", "law: hyperelastic, c10: 0.2, bulk: 100"}) {
    const auto model = strip("", material);
    for (std::size_t i = 0; i < model.bulk.cells.size(); ++i) {
      const auto cell = domain::vibration_of(model.mesh, model.bulk, i);
      EXPECT_GE(cell.bound(), cell.largest());
      EXPECT_LE(cell.bound(), 2 * cell.largest());
    }
  }
}

TEST(MassScaling, GivesMassToTheCellsThatNeedIt) {
  const auto plain = strip("");
  const double thin = own_step(plain, 1), wide = own_step(plain, 0);
  ASSERT_LT(thin, 0.3 * wide);
  const double wanted = 0.5 * 0.9 * wide;
  const auto scaled = strip(", mass_scaling: {step: " + std::to_string(wanted) + "}");
  const double factor = std::pow(wanted / (0.9 * thin), 2);
  const auto scaling = scaled_masses(scaled);
  EXPECT_EQ(scaling.cells, 2);
  EXPECT_NEAR(scaling.largest_factor, factor, 1e-5 * factor);
  EXPECT_NEAR(scaling.mass, 2 * 4, 1e-12);
  EXPECT_NEAR(scaling.added_mass, (factor - 1) * 2 * 0.2, 1e-4);
  EXPECT_NEAR(scaled.lumped_mass.sum() - plain.lumped_mass.sum(), 2 * scaling.added_mass, 1e-9);
  EXPECT_EQ((scaled.lumped_mass - plain.lumped_mass).minCoeff(), 0);
  const double step = 0.9 * step::ExplicitMotion(scaled).spectrum().stable_step();
  EXPECT_GE(step, wanted * (1 - 0.006)); // Lanczos' value is up to 1 % too large
  EXPECT_LT(0.9 * step::ExplicitMotion(plain).spectrum().stable_step(), 0.5 * wanted);
}

TEST(MassScaling, LeavesTheWeightAsItIs) {
  const auto plain = strip("");
  const auto scaled = strip(", mass_scaling: {step: 0.5}");
  EXPECT_EQ(external_force(scaled, 1), external_force(plain, 1));
}

TEST(MassScaling, TellsWhatItAdded) {
  const auto scaled = strip(", mass_scaling: {step: 0.5}");
  ASSERT_FALSE(scaled.notes.empty());
  const auto& note = scaled.notes.back();
  EXPECT_TRUE(note.starts_with("mass_scaling adds ")) << note;
  EXPECT_NE(note.find("for steps of 0.5: "), std::string::npos) << note;
  EXPECT_NE(note.find(" of 4 cells have more than their density"), std::string::npos) << note;
  const auto enough = strip(", mass_scaling: {step: 1e-3}");
  EXPECT_EQ(enough.notes.back(), "mass_scaling adds no mass: every cell allows steps of 0.001");
  EXPECT_EQ(enough.lumped_mass, strip("").lumped_mass);
}

TEST(MassScaling, IsPartOfTheKineticEnergy) {
  const auto plain = strip("");
  const auto scaled = strip(", mass_scaling: {step: 0.5}");
  for (const auto* model : {&plain, &scaled}) {
    step::ExplicitMotion motion(*model);
    const double h = 0.5 * motion.spectrum().stable_step();
    motion.advance(200 * h, 200);
    const auto energy = motion.energy();
    EXPECT_LE(std::abs(energy.balance()), 1e-12 * energy.largest());
    const auto v = motion.state().motion.v;
    EXPECT_NEAR(energy.kinetic, 0.5 * v.dot(model->lumped_mass.cwiseProduct(v)), 0.05 * energy.largest());
  }
}

TEST(MassScaling, IsRefusedOfOtherSchemes) {
  auto study = strip("").study;
  study.time.scheme = study::SchemeKind::newmark;
  study.time.step = 0.1;
  study.time.mass_scaling = 0.1;
  EXPECT_THROW(build_model(study), InputError);
}

} // namespace
} // namespace rubato::model::mass_scaling_test
