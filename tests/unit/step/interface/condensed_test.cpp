// SPDX-License-Identifier: LGPL-3.0-or-later
/// The condensed system of an iteration must give what the whole system gives.
#include "rubato/deck/read.hpp"
#include "rubato/step/advance.hpp"
#include "rubato/step/full/linear_step.hpp"
#include "rubato/step/start.hpp"
#include "rubato/time/step_control.hpp"

#include <gtest/gtest.h>

#include "support/decks.hpp"
#include "support/model_of.hpp"
#include <string>

namespace rubato::condensed_test {
namespace {

std::string beams(const std::string& cells, const std::string& contact) {
  const bool solid = cells.starts_with("hexa") || cells.starts_with("tetra");
  const std::string shape = solid ? "box" : "rectangle";
  const auto corner = [&](const std::string& xy) { return "[" + xy + (solid ? ", 0]" : "]"); };
  const auto far_corner = [&](const std::string& xy) { return "[" + xy + (solid ? ", 0.1]" : "]"); };
  const std::string divisions = solid ? "[8, 1, 1]" : "[8, 1]";
  const std::string load = solid ? "surface_force: {on: Tip, y: -2e8}" : "surface_force: {on: Tip, y: -2e7}";
  return "mesh:\n"
         "  generate:\n"
         "    - {name: Upper, " +
         shape + ": {from: " + corner("0, 0") + ", to: " + far_corner("1, 0.1") +
         "}, divisions: " + divisions + ", cells: " + cells +
         ", sides: {left: Wall, bottom: Above, right: Tip}}\n"
         "    - {name: Lower, " +
         shape + ": {from: " + corner("0, -0.1") + ", to: " + far_corner("1, 0") +
         "}, divisions: " + divisions + ", cells: " + cells +
         ", sides: {left: Wall, top: Below}}\n"
         "physics: " +
         (solid ? "solid" : "plane_stress") +
         "\n"
         "materials: {steel: {young: 200e9, poisson: 0.3, density: 7800, cells: all}}\n"
         "supports: [{on: Wall, fix: " +
         (solid ? "[x, y, z]" : "[x, y]") +
         "}]\n"
         "loads: [" +
         load +
         "]\n"
         "contact: {interface: {master: Above, slave: Below, exclude_nodes: [Wall], " +
         test::on_nodes(contact) +
         "}}\n"
         "newton: {residual: 1e-12}\n"
         "time: {scheme: hht, alpha: -0.1, step: 5e-4, end: 4e-3}\n";
}

struct History {
  Eigen::MatrixXd u; ///< at the end of every step, one a column
  int iterations = 0;
};

History history(const std::string& deck, study::Solver solver) {
  auto study = deck::parse_deck(deck, "beams.yaml").runs.front();
  study.solver = solver;
  const test::BuiltModel model(study);
  const auto scheme = time::make_scheme(study.time);
  auto system = step::make_effective_system(model, scheme, study.time.step);
  auto state = step::initial_state(model, scheme, 0, true);
  const auto instants = time::instants_of(study.time);
  History all{Eigen::MatrixXd(state.motion.u.size(), static_cast<Eigen::Index>(instants.size()) - 1)};
  for (std::size_t i = 1; i < instants.size(); ++i) {
    step::State trial;
    const auto report = step::advance(model, scheme, system, state, instants[i], trial);
    EXPECT_TRUE(report.converged()) << "at " << instants[i];
    state = trial;
    all.u.col(static_cast<Eigen::Index>(i) - 1) = state.motion.u;
    all.iterations += report.iterations;
  }
  return all;
}

struct RetrySettings {
  std::string name, cells, contact;
};

class Condensed : public testing::TestWithParam<RetrySettings> {};

TEST_P(Condensed, GivesWhatTheWholeSystemGives) {
  const auto deck = beams(GetParam().cells, GetParam().contact);
  const auto condensed = history(deck, study::Solver::condensed);
  const auto full = history(deck, study::Solver::full);
  EXPECT_LT((condensed.u - full.u).cwiseAbs().maxCoeff(), 1e-10 * full.u.cwiseAbs().maxCoeff());
}

/// A beam bent in its own plane rubs along its length only: what its nodal forces have across is rounding,
/// and must not be scaled up to the size of the rest.
TEST(CondensedNodal, LeavesForcesOfRoundingSizeAlone) {
  const std::string deck = R"(
mesh:
  generate:
    - {name: upper, box: {from: [0, 0, 0], to: [1, 0.1, 0.1]}, divisions: [20, 2, 1], cells: hexa8,
       sides: {left: wall, bottom: above}, edges: {right_top: loaded}}
    - {name: lower, box: {from: [0, -0.1, 0], to: [1, 0, 0.1]}, divisions: [20, 2, 1], cells: hexa8,
       sides: {left: wall, top: below}}
physics: solid
materials: {steel: {young: 200e9, poisson: 0, density: 7800}}
supports: [{on: wall, fix: [x, y, z]}]
loads: [{line_force: {on: loaded, y: -2.26714e+06}}]
contact: {interface: {master: above, slave: below, friction: 0.3, method: nodal_lagrange, exclude_nodes: [wall]}}
time: {scheme: hht, alpha: -0.164, step: 1.6e-5, end: 1.6e-4}
)";
  const auto condensed = history(deck, study::Solver::condensed);
  const auto full = history(deck, study::Solver::full);
  const double size = full.u.cwiseAbs().maxCoeff();
  EXPECT_LT((condensed.u - full.u).cwiseAbs().maxCoeff(), 1e-7 * size);
  for (Eigen::Index dof = 2; dof < full.u.rows(); dof += 3) {
    EXPECT_LT(condensed.u.row(dof).cwiseAbs().maxCoeff(), 1e-9 * size) << "across";
  }
}

INSTANTIATE_TEST_SUITE_P(
    Variants, Condensed,
    testing::Values(RetrySettings{"Plane", "quad4", "friction: 0.2"},
                    RetrySettings{"PlaneFrictionless", "quad4", "friction: 0"},
                    RetrySettings{"PlaneQuadratic", "quad8", "friction: 0.4"},
                    RetrySettings{"PlaneGauss", "quad4", "friction: 0.2, integration: {gauss: 2}"},
                    RetrySettings{"PlanePartialNewton", "quad4",
                                  "friction: 0.2, iterate: {geometry: fixed_point}"},
                    RetrySettings{"PlanePenalty", "quad4",
                                  "friction: 0.2, method: penalty, iterate: {geometry: "
                                  "fixed_point, friction: fixed_point, status: fixed_point}"},
                    RetrySettings{"PlaneNodal", "quad4", "friction: 0.2, method: nodal_penalty"},
                    RetrySettings{"Solid", "hexa8", "friction: 0.2"},
                    RetrySettings{"SolidPenalty", "hexa8", "friction: 0.2, method: penalty"},
                    RetrySettings{"SolidNodal", "hexa8", "friction: 0.2, method: nodal_lagrange"},
                    RetrySettings{"SolidSlaveNormal", "hexa8", "friction: 0.2, normal: slave"},
                    RetrySettings{"SolidQuadratic", "hexa27", "friction: 0.3"},
                    RetrySettings{"SolidSerendipity", "hexa20", "friction: 0.3"},
                    RetrySettings{"SolidSerendipityFrictionless", "hexa20", "friction: 0"},
                    RetrySettings{"SolidSerendipityByLoops", "hexa20",
                                  "friction: 0.2, iterate: {geometry: "
                                  "fixed_point, friction: fixed_point, status: fixed_point}"},
                    RetrySettings{"SolidSerendipityExactFriction", "hexa20",
                                  "friction: 0.2, method: penalty, friction_method: augmented_lagrangian"},
                    RetrySettings{"SolidTetrahedra", "tetra10", "friction: 0.2"},
                    RetrySettings{"PlaneMortar", "quad8", "friction: 0.2, integration: mortar"},
                    RetrySettings{"SolidMortar", "hexa8", "friction: 0.2, integration: mortar"},
                    RetrySettings{"SolidGauss", "hexa8", "friction: 0.2, integration: {gauss: 2}"}),
    [](const auto& variant) { return variant.param.name; });

} // namespace
} // namespace rubato::condensed_test
