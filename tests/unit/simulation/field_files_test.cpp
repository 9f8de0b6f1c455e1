// SPDX-License-Identifier: LGPL-3.0-or-later
// Values that are fields of files: written by this program's writers, read back as loads, supports, gaps and
// materials, they give what the expressions give that made them.
#include "rubato/deck/read.hpp"
#include "rubato/mesh/io/med.hpp"
#include "rubato/mesh/io/mesh_file.hpp"
#include "rubato/model/build_model.hpp"
#include "rubato/model/model.hpp"
#include "rubato/results/med_fields.hpp"
#include "rubato/results/vtu.hpp"
#include "rubato/simulation/time_integration.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/faults.hpp"
#include "support/model_of.hpp"
#include "support/scratch_folder.hpp"
#include "support/two_blocks.hpp"
#include <array>
#include <string>
#include <vector>

namespace rubato::simulation::field_files_test {
namespace {

using Eigen::VectorXd;

const std::string box = R"(
mesh:
  generate:
    - {name: box, box: {from: [0, 0, 0], to: [2, 1, 1]}, divisions: [3, 2, 2], cells: CELLS,
       sides: {left: held, right: end, top: roof}}
physics: solid
materials: {rubber: {young: 100, poisson: 0.3, density: 2}}
supports: [{on: held, x: SUPPORT, y: 0, z: 0}]
loads: [{pressure: {on: end, value: PRESSURE}}, {surface_force: {on: roof, x: FORCE}}, {gravity: {y: WEIGHT}}]
time: {scheme: static, step: 0.5, end: 1}
)";

VectorXd end_of(const std::string& deck) {
  Simulation simulation(deck::parse_deck(deck, "deck.yaml").runs.front());
  while (!simulation.finished())
    simulation.advance();
  return simulation.state().motion.u;
}

class FieldOfAFile : public testing::TestWithParam<std::string> {
protected:
  test::ScratchFolder folder_;

  static std::string filled(std::string deck, const std::array<std::string, 4>& values) {
    const std::array keys{"SUPPORT", "PRESSURE", "FORCE", "WEIGHT"};
    for (std::size_t i = 0; i < keys.size(); ++i)
      deck = test::with(deck, keys[i], values[i]);
    return test::with(deck, "CELLS", GetParam());
  }

  static mesh::Mesh mesh_of(const std::string& deck) {
    return model::load_mesh(deck::parse_deck(deck, "deck.yaml").runs.front().mesh);
  }

  /// (1 + 2x − y + 3z) × (0.01, 1, −2).
  static std::vector<double> values_on(const mesh::Mesh& mesh, double factor) {
    std::vector<double> values;
    for (const auto& x : mesh.points)
      for (const double part : {0.01, 1., -2.})
        values.push_back(factor * part * (1 + 2 * x[0] - x[1] + 3 * x[2]));
    return values;
  }

  std::string vtu(const mesh::Mesh& mesh, const std::string& name, double factor) const {
    const auto path = folder_ / name;
    const auto values = values_on(mesh, factor);
    const results::NodalField field{"state", 3, values, {"a", "b", "c"}, ""};
    results::write_vtu(path, mesh, std::array{field});
    return path.string();
  }

  /// At the instants 0, 1, 2 the same, 2 and 3 times as large.
  std::string med(const mesh::Mesh& mesh) const {
    const auto path = folder_ / "state.med";
    mesh::write_med(path, mesh, "body");
    for (int i = 0; i < 3; ++i) {
      const auto values = values_on(mesh, i + 1);
      const results::NodalField field{"state", 3, values, {"a", "b", "c"}, ""};
      results::append_med_fields(path, "body", {i, static_cast<double>(i)}, std::array{field});
    }
    return path.string();
  }

  static std::array<std::string, 4> of_file(const std::string& file, const std::string& more) {
    std::array<std::string, 4> values;
    const std::array components{"a", "b", "c", "b"};
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i] = fmt::format("{{field: {}, name: state, component: {}{}}}", file, components[i], more);
    return values;
  }

  static std::array<std::string, 4> of_text(const std::string& factor) {
    std::array<std::string, 4> values;
    const std::array parts{"0.01", "1", "-2", "1"};
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i] = fmt::format("{}*({})*(1+2*x-y+3*z)", factor, parts[i]);
    return values;
  }

  static double difference(const VectorXd& a, const VectorXd& b) { return (a - b).norm() / b.norm(); }
};

TEST_P(FieldOfAFile, InVtuGivesWhatItsExpressionGives) {
  const auto plain = filled(box, of_text("1"));
  const auto found = end_of(filled(box, of_file(vtu(mesh_of(plain), "state.vtu", 1), "")));
  EXPECT_LT(difference(found, end_of(plain)), 1e-12);
}

TEST_P(FieldOfAFile, InMedGivesWhatItsExpressionGivesAtAnInstantAndBetween) {
  const auto twice = filled(box, of_text("2"));
  const auto file = med(mesh_of(twice));
  EXPECT_LT(difference(end_of(filled(box, of_file(file, ", at: 1"))), end_of(twice)), 1e-12);
  const auto late = [](const std::string& deck) { return test::with(deck, "end: 1", "end: 1.5"); };
  EXPECT_LT(
      difference(end_of(late(filled(box, of_file(file, "")))), end_of(late(filled(box, of_text("(1+t)"))))),
      1e-12);
}

TEST_P(FieldOfAFile, InACollectionGivesWhatItsExpressionGives) {
  const auto plain = filled(box, of_text("(1+t)"));
  const auto mesh = mesh_of(plain);
  results::PvdSeries series(folder_ / "state.pvd");
  series.add(0, vtu(mesh, "0.vtu", 1));
  series.add(2, vtu(mesh, "1.vtu", 3));
  const auto file = (folder_ / "state.pvd").string();
  EXPECT_LT(difference(end_of(filled(box, of_file(file, ""))), end_of(plain)), 1e-12);
  EXPECT_LT(difference(end_of(filled(box, of_file(file, ", at: 2"))), end_of(filled(box, of_text("3")))),
            1e-12);
}

TEST_P(FieldOfAFile, GivesTheNumbersOfMaterials) {
  const auto loads = of_text("1");
  const auto graded = test::with(filled(box, loads), "young: 100", "young: 20+10*(1+2*x-y+3*z)");
  const auto mesh = mesh_of(graded);
  std::vector<double> young;
  for (const auto& x : mesh.points)
    young.push_back(20 + 10 * (1 + 2 * x[0] - x[1] + 3 * x[2]));
  const results::NodalField field{"E", 1, young, {}, ""};
  results::write_vtu(folder_ / "E.vtu", mesh, std::array{field});
  const auto found =
      end_of(test::with(filled(box, loads), "young: 100",
                        fmt::format("young: {{field: {}, name: E}}", (folder_ / "E.vtu").string())));
  EXPECT_LT(difference(found, end_of(graded)), 1e-12);
}

TEST_P(FieldOfAFile, IsRefusedInOneSentence) {
  const auto file = med(mesh_of(filled(box, of_text("1"))));
  const auto told = [&](const std::string& value) {
    return test::fault_of([&] { test::model_of(filled(box, {value, "1", "1", "1"})); });
  };
  const auto value = [&](const std::string& rest) { return fmt::format("{{field: {}, {}}}", file, rest); };
  const auto head = "supports.0.x: file '" + file + "' ";
  EXPECT_EQ(told(value("name: stat, component: a, at: 0")),
            head + "holds no field 'stat' at the nodes; did you mean 'state'?");
  EXPECT_EQ(told(value("name: state, component: temperature, at: 0")),
            head + "holds no component 'temperature' of 'state'; expected one of a, b, c");
  EXPECT_EQ(told(value("name: state, at: 0")),
            head + "holds 'state' with the components a, b, c, expected 'component' with one of them");
  EXPECT_EQ(told(value("name: state, component: a, at: 1.4")),
            head + "holds 'state' at 3 instants, 0 to 2, none of them 1.4; the nearest is 1");
  EXPECT_EQ(told("{field: none.med, name: state}"), "supports.0.x: file 'none.med' does not exist");
  EXPECT_EQ(test::fault_of([&] {
              test::model_of(test::with(filled(box, of_text("1")), "young: 100",
                                        "young: " + value("name: state, component: b")));
            }),
            fmt::format(
                "materials.rubber.young: the field 'state' of '{}' has several instants, expected 'at' with "
                "one of them: the value depends on the place only",
                file));
}

INSTANTIATE_TEST_SUITE_P(On, FieldOfAFile, testing::Values("hexa8", "hexa20", "tetra10"),
                         [](const auto& chosen) { return chosen.param; });

/// A gap, a coefficient of friction and an imposed displacement.
TEST(AFieldOfAFile, ServesContactAsItsExpressionDoes) {
  const test::ScratchFolder folder;
  const auto filled = [](const std::string& gap, const std::string& friction) {
    return test::with(test::two_blocks, "friction: 0.2", "friction: " + friction + ", gap: " + gap);
  };
  const auto plain = filled("1e-5*(1+x)", "0.1+0.2*x");
  const auto mesh = model::load_mesh(deck::parse_deck(plain, "deck.yaml").runs.front().mesh);
  std::vector<double> values;
  for (const auto& x : mesh.points)
    values.insert(values.end(), {1e-5 * (1 + x[0]), 0.1 + 0.2 * x[0]});
  const results::NodalField field{"f", 2, values, {"gap", "mu"}, ""};
  const auto file = (folder / "f.med").string();
  mesh::write_med(file, mesh, "body");
  results::append_med_fields(file, "body", {0, 0.0}, std::array{field});
  const auto part = [&](const std::string& component) {
    return "{field: " + file + ", name: f, component: " + component + "}";
  };
  const auto expected = end_of(plain);
  const auto found = end_of(filled(part("gap"), part("mu")));
  EXPECT_LT((found - expected).norm(), 1e-12 * expected.norm());
  const auto without = end_of(test::two_blocks);
  EXPECT_GT((without - expected).norm(), 1e-3 * expected.norm()) << "the gap counts";
}

TEST(AFieldOfAnotherMesh, IsRefusedWithTheNodeAndTheDistance) {
  const test::ScratchFolder folder;
  const auto deck =
      test::with(test::two_blocks, "nodal_force: {on: tip, y: -1e7}",
                 "nodal_force: {on: tip, y: {field: " + (folder / "f.vtu").string() + ", name: T}}");
  auto mesh = model::load_mesh(deck::parse_deck(deck, "deck.yaml").runs.front().mesh);
  for (auto& x : mesh.points)
    x[1] += 0.03125;
  const std::vector<double> values(mesh.points.size(), 1);
  const results::NodalField field{"T", 1, values, {}, ""};
  results::write_vtu(folder / "f.vtu", mesh, std::array{field});
  const auto fault = test::fault_of([&] { test::model_of(deck); });
  EXPECT_NE(fault.find("the nearest node that has one is 0.03125 away"), std::string::npos) << fault;
  EXPECT_NE(fault.find("loads.0.nodal_force.y: the field 'T' of"), std::string::npos) << fault;
}

} // namespace
} // namespace rubato::simulation::field_files_test
