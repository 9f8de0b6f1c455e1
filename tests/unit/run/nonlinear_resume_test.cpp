// SPDX-License-Identifier: LGPL-3.0-or-later
// Runs of nonlinear bodies in contact that go on from checkpoints, and from the ends of other runs.
#include "rubato/domain/recovery.hpp"
#include "rubato/results/checkpoint.hpp"

#include <gtest/gtest.h>

#include "support/model_of.hpp"
#include "support/model_parts.hpp"
#include "support/scratch_folder.hpp"
#include "support/simulated_blocks.hpp"
#include "support/solid_materials.hpp"
#include <algorithm>
#include <filesystem>
#include <vector>

namespace rubato::run::nonlinear_resume_test {
namespace {

using simulation::Simulation;

/// A block that is pressed into a wider one and drawn along it.
const std::string pressed_blocks = R"(
mesh:
  generate:
    - {name: block, rectangle: {from: [0, 0], to: [1, 1]}, divisions: [3, 3], cells: quad4,
       sides: {top: top, bottom: under}}
    - {name: plane, rectangle: {from: [-0.5, -1], to: [1.5, 0]}, divisions: [5, 3], cells: quad4,
       sides: {top: over, bottom: ground}}
physics: plane_strain
materials: {metal: {young: 1000, poisson: 0.3, density: 0.1}}
functions: {press: {times: [0, 0.5, 1], values: [0, 1, 0.9]}, draw: {times: [0, 0.4, 1], values: [0, 0, 1]}}
supports:
  - {on: ground, fix: [x, y]}
  - {on: top, x: {value: 0.05, function: draw}, y: {value: -0.08, function: press}}
contact: {foot: {master: over, slave: under, integration: nodes, friction: 0.2}}
time: {scheme: static, step: 0.1, end: 1}
)";

study::Study plastic() {
  auto study = test::study_of(pressed_blocks);
  test::make_plastic(study.materials[0], 10, 50, study::StrainKind::logarithmic);
  return study;
}

study::Study with_back_stress(study::Study study) {
  study.materials[0].plasticity.kinematic = {{100, 5}};
  return study;
}

study::Study viscous() {
  auto study = test::study_of(pressed_blocks);
  auto& material = study.materials[0];
  material.law = study::LawKind::prony;
  material.prony = {{200, 0.1}, {100, 1}};
  material.strain = study::StrainKind::logarithmic;
  return study;
}

study::Study rubber() {
  auto study = test::study_of(pressed_blocks);
  auto& material = study.materials[0];
  material.law = study::LawKind::hyperelastic;
  material.hyperelasticity.c10 = 100;
  material.poisson = 0;
  material.hyperelasticity.bulk = 2000;
  return study;
}

study::Study by_hht(study::Study study) {
  study.time.scheme = study::SchemeKind::hht;
  study.time.alpha = -0.1;
  study.time.contact_mass = study::ContactMass::consistent;
  return study;
}

study::Study varying(study::Study study) {
  study.time.max_step = 0.2;
  return study;
}

study::Study cut_by_plastic_steps(study::Study study) {
  study.time.max_plastic_step = 0.02;
  return study;
}

using test::Kind;

class Resumed : public testing::TestWithParam<Kind> {};

/// A file for each step but the last.
std::vector<std::filesystem::path> keep_all(Simulation& whole, const test::ScratchFolder& folder) {
  std::vector<std::filesystem::path> files;
  while (!whole.finished()) {
    EXPECT_TRUE(whole.advance().accepted());
    if (whole.finished())
      break;
    results::Checkpoint checkpoint;
    checkpoint.memento = whole.memento();
    files.push_back(folder / ("checkpoint_" + std::to_string(files.size()) + ".h5"));
    results::write_checkpoint(files.back(), checkpoint);
  }
  return files;
}

TEST_P(Resumed, GoesOnToTheSameBits) {
  const test::ScratchFolder folder;
  Simulation whole(GetParam().study);
  const auto files = keep_all(whole, folder);
  ASSERT_GE(files.size(), 5U);
  EXPECT_GT(step::points_in_contact(whole.state()), 0);
  for (std::size_t i = 0; i < files.size(); i += 2) {
    const auto memento = results::read_checkpoint(files[i]).memento;
    Simulation resumed(whole.model(), {.memento = &memento});
    test::go_to_end(resumed);
    SCOPED_TRACE(testing::Message() << "after step " << i + 1);
    test::expect_same(resumed, whole);
  }
}

INSTANTIATE_TEST_SUITE_P(Bodies, Resumed,
                         testing::Values(Kind{"PlasticStatic", plastic()},
                                         Kind{"PlasticHht", by_hht(plastic())},
                                         Kind{"BackStressHht", by_hht(with_back_stress(plastic()))},
                                         Kind{"PronyStatic", viscous()}, Kind{"PronyHht", by_hht(viscous())},
                                         Kind{"RubberStatic", rubber()},
                                         Kind{"VaryingStatic", varying(plastic())},
                                         Kind{"CutHht", cut_by_plastic_steps(by_hht(plastic()))}),
                         test::name_of_kind);

// ---- from the end of another run

double most_plastic_strain(const test::ModelParts& model, const step::State& state) {
  const auto values = domain::nodal_plastic_strain(model.mesh, model.bulk, model.dofs, state.motion.u, {},
                                                   &state.bulk_points);
  return values.maxCoeff();
}

study::Study second_half(study::Study study) {
  study.time.begin = 0.5;
  study.time.start = study::StartKind::from_run;
  study.time.start_run = "first";
  return study;
}

study::Study first_half(study::Study study) {
  study.time.end = 0.5;
  return study;
}

/// The parts of a static run come to what the whole comes to, as far as its steps are solved.
TEST(ARunFromTheEndOfAnother, TakesWhatMaterialsRemember) {
  Simulation whole(plastic());
  test::go_to_end(whole);
  Simulation first(first_half(plastic()));
  test::go_to_end(first);
  Simulation second(second_half(plastic()), {.previous = &first.state()});
  EXPECT_EQ(second.state().bulk_points.values, first.state().bulk_points.values);
  test::go_to_end(second);
  const double p = most_plastic_strain(whole.model(), whole.state());
  EXPECT_GT(p, 0.05);
  EXPECT_GT(most_plastic_strain(first.model(), first.state()), 0.5 * p);
  EXPECT_NEAR(most_plastic_strain(second.model(), second.state()), p, 1e-6 * p);
  const auto& u = whole.state().motion.u;
  EXPECT_LE((second.state().motion.u - u).lpNorm<Eigen::Infinity>(), 1e-6 * u.lpNorm<Eigen::Infinity>());
}

TEST(ARunFromTheEndOfAnother, IsRefusedWhereMaterialsRememberSomethingElse) {
  Simulation elastic(first_half(test::study_of(pressed_blocks)));
  test::go_to_end(elastic);
  try {
    Simulation second(second_half(plastic()), {.previous = &elastic.state()});
    FAIL() << "expected InputError";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("materials that remember something else"), std::string::npos)
        << error.what();
  }
}

} // namespace
} // namespace rubato::run::nonlinear_resume_test
