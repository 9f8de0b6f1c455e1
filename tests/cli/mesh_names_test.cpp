// SPDX-License-Identifier: LGPL-3.0-or-later
// Meshes of others through the program: names of nodes, plane meshes with three coordinates, the axis,
// formats.
#include "rubato/mesh/builder.hpp"
#include "rubato/mesh/io/gmsh.hpp"
#include "rubato/mesh/io/med.hpp"

#include <gtest/gtest.h>

#include "program.hpp"
#include <algorithm>

namespace rubato::mesh_names_test {
namespace {

using test::run_program;

const std::string deck = R"(mesh: {file: square.med}
physics: axisymmetric
materials:
  steel: {young: 200e9, poisson: 0.3, density: 7800, cells: all}
supports:
  - {on: held, fix: [y]}
loads:
  - {nodal_force: {on: N4, x: 1}}
probes: {tip: {node: N4}}
time: {scheme: static, step: 1, end: 1}
)";

/// Two squares from the axis on, in space, with cells that turn clockwise and coordinates with rounding.
mesh::Mesh squares() {
  mesh::MeshBuilder builder(3);
  const std::vector<std::string> names{"N6", "N5", "N4", "N3", "N2", "N1"};
  for (int i = 0; i < 6; ++i)
    builder.add_node({i % 3 == 0 ? -1.2e-15 : i % 3, double(i / 3), 4 + 1e-14 * i}, i + 1,
                     names[static_cast<std::size_t>(i)]);
  builder.add_cell(CellType::quad4, std::array{0, 3, 4, 1}, 11);
  builder.add_cell(CellType::quad4, std::array{1, 4, 5, 2}, 12);
  builder.add_to_node_group("held", std::array{0, 1, 2});
  return std::move(builder).build();
}

class MeshOfOthers : public testing::Test {
protected:
  MeshOfOthers() {
    test::write_text(folder_ / "deck.yaml", deck);
    mesh::write_med(folder_ / "square.med", squares());
  }
  test::Outcome run(const std::vector<std::string>& arguments) const {
    return run_program(arguments, folder_.path());
  }

  test::ScratchFolder folder_;
};

TEST_F(MeshOfOthers, IsTakenAsItIsMeant) {
  const auto outcome = run({"run", "deck.yaml", "-o", "out", "-q"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto summary = test::text_of(folder_ / "out/run/run.json");
  EXPECT_NE(summary.find("complete"), std::string::npos) << summary;
  // N4 is the outer node of the held side, number 3. Number 4 stands on the axis, where no force acts
  // outward.
  const auto probes = test::text_of(folder_ / "out/run/probes.csv");
  const auto last = probes.substr(probes.rfind('\n', probes.size() - 2) + 1);
  EXPECT_GT(std::stod(last.substr(last.find(',') + 1)), 1e-14) << probes;
}

TEST_F(MeshOfOthers, IsRefusedForANameThatItsNodesDoNotHave) {
  const auto outcome = run({"run", "deck.yaml", "--set", "probes.tip.node=N7", "-o", "out"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(
      outcome.err.find("found 'N7', expected a group or a node (by its name) of the mesh; did you mean 'N"),
      std::string::npos)
      << outcome.err;
}

TEST_F(MeshOfOthers, IsToldByInfoAsARunSeesIt) {
  const auto outcome = run({"info", "square.med"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const auto* words : {"2D mesh, 6 nodes", "  area 2\n", "nodes have names in the file",
                            "nothing looks wrong", "note: 2 reversed cells, mended in a run: 11 12\n"})
    EXPECT_NE(outcome.out.find(words), std::string::npos) << words << "\n" << outcome.out;
}

const std::string blocks = R"(mesh:
  generate:
    - name: upper
      box: {from: [0, 0, 1], to: [1, 1, 2]}
      divisions: [2, 2, 1]
      cells: hexa20
      sides: {top: load, bottom: upper_contact}
    - name: lower
      box: {from: [0, 0, 0], to: [1, 1, 1]}
      divisions: [3, 3, 1]
      cells: penta15
      sides: {bottom: held, top: lower_contact}
physics: solid
materials:
  steel: {young: 200e9, poisson: 0.3, density: 7800, cells: all}
supports:
  - {on: held, fix: [x, y, z]}
  - {on: upper_contact, fix: [x, y]}
loads:
  - pressure: {on: load, value: 1e8}
contact:
  interface: {master: upper_contact, slave: lower_contact, integration: nodes}
probes: {top: {point: [1, 1, 2]}, mean: {on: load, take: mean}}
time: {scheme: hht, alpha: -0.1, step: 1e-4, end: 2e-4}
)";

TEST(MeshOfCodeAster, GivesTheResultsOfTheSameMeshInMed) {
  const test::ScratchFolder folder;
  test::write_text(folder / "blocks.yaml", blocks);
  for (const std::string format : {"med", "mail"}) {
    const auto file = "blocks." + format;
    const auto written = run_program({"mesh", "blocks.yaml", file}, folder.path());
    EXPECT_EQ(written.exit_code, 0) << written.err;
    const auto outcome =
        run_program({"run", "blocks.yaml", "--set", "mesh.file=" + file, "-o", format, "-q"}, folder.path());
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  }
  const auto probes = test::text_of(folder / "mail/run/probes.csv");
  EXPECT_EQ(probes, test::text_of(folder / "med/run/probes.csv"));
  EXPECT_EQ(std::ranges::count(probes, '\n'), 4) << probes;
}

TEST_F(MeshOfOthers, HasTheFormatsThatAreBuiltIn) {
  const auto help = run({"info", "--help"}).out;
  const auto version = run({"--version"}).out;
  EXPECT_NE(help.find(".med, .rmed, .mmed, .msh, .mail"), std::string::npos) << help;
  EXPECT_EQ(help.find(".geo") != std::string::npos, mesh::is_gmsh_built_in());
  EXPECT_EQ(version.find("(.geo): built in") != std::string::npos, mesh::is_gmsh_built_in()) << version;
  EXPECT_EQ(version.find("(.geo): not built in") == std::string::npos, mesh::is_gmsh_built_in()) << version;
}

} // namespace
} // namespace rubato::mesh_names_test
