// SPDX-License-Identifier: LGPL-3.0-or-later
// Stress and strain of each cell by itself, and as MED files hold them.
#include "rubato/cell/parts.hpp"
#include "rubato/cell/reference_cell.hpp"
#include "rubato/mesh/io/med.hpp"
#include "rubato/mesh/io/med_numbering.hpp"
#include "rubato/results/cell_fields.hpp"
#include "rubato/results/med_fields.hpp"
#include "rubato/results/med_gauss.hpp"
#include "rubato/results/nodal_fields.hpp"

#include <gtest/gtest.h>
#include <med.h>

#include "support/dense.hpp"
#include "support/model_of.hpp"
#include "support/model_parts.hpp"
#include "support/scratch_folder.hpp"
#include "unit/mesh_io/one_cell.hpp"
#include <cmath>
#include <map>

namespace rubato::results::cell_fields_test {
namespace {

using Values = std::vector<double>;

study::FieldOutput with_only(std::vector<std::string> fields) {
  study::FieldOutput output;
  output.only = std::move(fields);
  return output;
}

study::FieldOutput with_also(std::vector<std::string> fields) {
  study::FieldOutput output;
  output.also = std::move(fields);
  return output;
}

/// Two bodies of different cells and materials, apart from each other, in plane stress.
const std::string two_plates = R"(
mesh:
  generate:
    - {name: left, rectangle: {from: [0, 0], to: [2, 1]}, divisions: [3, 2], cells: quad8, sides: {left: held}}
    - {name: right, rectangle: {from: [3, 0], to: [4, 1]}, divisions: [2, 2], cells: tria3, sides: {left: kept}}
physics: plane_stress
materials:
  soft: {young: 1000, poisson: 0.25, density: 1, cells: left}
  wood: {law: orthotropic, young_x: 2000, young_y: 500, poisson_xy: 0.3, poisson_xz: 0.2, shear_xy: 300, density: 1, cells: right}
supports: [{on: held, fix: [x, y]}, {on: kept, fix: [x, y]}]
time: {scheme: static, step: 1, end: 1}
)";

const std::string solid_block = R"(
mesh:
  generate: [{name: block, box: {from: [0, 0, 0], to: [1, 2, 1]}, divisions: [1, 2, 1], cells: CELLS, sides: {left: held}}]
physics: solid
materials: {soft: {young: 1000, poisson: 0.25}}
supports: [{on: held, fix: [x, y, z]}]
time: {scheme: static, step: 1, end: 1}
)";

/// u = (0.01 x + 0.03 y, −0.02 y, 0.004 z): strains xx 0.01, yy −0.02, zz 0.004, xy 0.015.
step::State stretched(const test::ModelParts& model) {
  step::State state;
  state.motion.u = Eigen::VectorXd::Zero(model.dofs.dof_count);
  for (const auto node : model.dofs.nodes) {
    const auto& x = model.mesh.points[static_cast<std::size_t>(node)];
    const Eigen::Vector3d u(0.01 * x[0] + 0.03 * x[1], -0.02 * x[1], 0.004 * x[2]);
    for (int i = 0; i < model.dofs.components; ++i)
      state.motion.u[model.dofs.dof(node, i)] = u[i];
  }
  return state;
}

void expect_all(const Values& values, const Values& expected, const std::string& what) {
  ASSERT_EQ(values.size() % expected.size(), 0U);
  for (std::size_t i = 0; i < values.size(); ++i)
    EXPECT_NEAR(values[i], expected[i % expected.size()], 1e-11) << what << ' ' << i;
}

TEST(FieldsInCells, AreExactOfALinearDisplacement) {
  const auto model = test::model_of(two_plates);
  const auto state = stretched(model);
  const auto fields =
      cell_fields(model, state, with_also({"stress_elno", "strain_elno", "stress_elga", "strain_elga"}));
  ASSERT_EQ(fields.size(), 4U);
  const double zz = -0.25 / 0.75 * (0.01 - 0.02); // σ_zz = 0
  const double modulus = 1000 / (1 - 0.0625);
  const Values soft_stress{
      modulus * (0.01 - 0.25 * 0.02), modulus * (-0.02 + 0.25 * 0.01), 0, 400 * 0.03, 0, 0};
  const double nu_yx = 0.3 * 500 / 2000;
  const double share = 1 / (1 - 0.3 * nu_yx);
  const Values wood_stress{share * (2000 * 0.01 + 0.3 * 500 * -0.02),
                           share * (500 * -0.02 + 0.3 * 500 * 0.01),
                           0,
                           300 * 0.03,
                           0,
                           0};
  for (const auto& field : fields) {
    ASSERT_EQ(field.parts.size(), 2U) << field.name;
    const bool at_points = field.place == study::FieldPlace::gauss_points;
    EXPECT_EQ(field.name.ends_with("elga"), at_points);
    EXPECT_EQ(field.parts[0].type, CellType::tria3);
    EXPECT_EQ(field.parts[0].places, at_points ? 1 : 3);
    EXPECT_EQ(field.parts[1].places, at_points ? 9 : 8);
    EXPECT_EQ(field.parts[0].values.size(), static_cast<std::size_t>(8 * field.parts[0].places * 6));
    EXPECT_EQ(field.parts[1].values.size(), static_cast<std::size_t>(6 * field.parts[1].places * 6));
    const bool is_strain = field.name.starts_with("strain");
    expect_all(field.parts[1].values, is_strain ? Values{0.01, -0.02, zz, 0.015, 0, 0} : soft_stress,
               field.name);
    // ν_yz is not given
    const Values wood_strain{0.01, -0.02, -0.2 * wood_stress[0] / 2000, 0.015, 0, 0};
    expect_all(field.parts[0].values, is_strain ? wood_strain : wood_stress, field.name);
    const auto means = cell_means(field);
    ASSERT_EQ(means.size(), 14U * 6);
    EXPECT_NEAR(means.back(), 0, 1e-12);
    EXPECT_NEAR(means[3], is_strain ? 0.015 : 9, 1e-11);
  }
}

TEST(FieldsInCells, AreThoseThatAreAskedFor) {
  const auto model = test::model_of(two_plates);
  const auto state = stretched(model);
  EXPECT_TRUE(cell_fields(model, state, {}).empty());
  EXPECT_EQ(cell_fields(model, state, with_only({"strain_elga", "stress"})).size(), 1U);
}

TEST(StrainAtNodes, IsATensorWithTheStrainAcrossThePlane) {
  const auto model = test::model_of(two_plates);
  const auto strain = strain_field(model, stretched(model));
  const auto& names = strain.component_names;
  EXPECT_EQ(names, (std::vector<std::string>{"xx", "yy", "zz", "xy", "yz", "xz"}));
  for (const auto node : model.dofs.nodes)
    if (model.mesh.points[static_cast<std::size_t>(node)][0] < 2.5) {
      for (std::size_t i = 0; i < 6; ++i)
        EXPECT_NEAR(strain.values[static_cast<std::size_t>(node) * 6 + i],
                    (Values{0.01, -0.02, 0.01 / 3, 0.015, 0, 0})[i], 1e-13);
    }
}

TEST(StrainAtNodes, IsNamedToBeWritten) {
  auto model = test::model_of(two_plates);
  auto state = stretched(model);
  state.motion.v = state.motion.a = state.motion.u;
  const auto names = [&](const study::FieldOutput& output) {
    std::vector<std::string> found;
    for (const auto& field : nodal_fields(model, state, output))
      found.push_back(field.name);
    return found;
  };
  using Names = std::vector<std::string>;
  EXPECT_EQ(names({}), (Names{"displacement", "velocity", "acceleration", "stress", "von_mises"}));
  EXPECT_EQ(names(with_also({"strain"})),
            (Names{"displacement", "velocity", "acceleration", "stress", "von_mises", "strain"}));
  EXPECT_EQ(names(with_only({"strain", "von_mises"})), (Names{"von_mises", "strain"}));
}

// ---- MED
// ----------------------------------------------------------------------------------------------------

/// The corners of reference cells that MEDCoupling knows, in MED's order (GaussInfo.cxx: TRIA3B, QUAD4B,
/// TETRA4B, PYRA5B, PENTA6B, HEXA8B).
const std::map<CellType, Values> corners_of_medcoupling{
    {CellType::tria3, {0, 0, 1, 0, 0, 1}},
    {CellType::quad4, {-1, -1, 1, -1, 1, 1, -1, 1}},
    {CellType::tetra4, {0, 1, 0, 0, 0, 0, 0, 0, 1, 1, 0, 0}},
    {CellType::pyra5, {1, 0, 0, 0, -1, 0, -1, 0, 0, 0, 1, 0, 0, 0, 1}},
    {CellType::penta6, {-1, 1, 0, -1, 0, 0, -1, 0, 1, 1, 1, 0, 1, 0, 0, 1, 0, 1}},
    {CellType::hexa8, {-1, -1, -1, -1, 1, -1, 1, 1, -1, 1, -1, -1, -1, -1, 1, -1, 1, 1, 1, 1, 1, 1, -1, 1}}};

double reference_measure(CellType linear) {
  const std::map<CellType, double> measures{{CellType::tria3, 0.5},     {CellType::quad4, 4},
                                            {CellType::tetra4, 1. / 6}, {CellType::pyra5, 2. / 3},
                                            {CellType::penta6, 1},      {CellType::hexa8, 8}};
  return measures.at(linear);
}

TEST(GaussPointsInMed, StandOnReferenceCellsThatReadersKnow) {
  for (const auto& cell : cell::all_topologies()) {
    if (cell.dimension < 2 || !cell::has_reference_cell(cell.type))
      continue;
    SCOPED_TRACE(cell.name);
    const auto gauss = med_gauss(cell.type);
    const auto& corners = corners_of_medcoupling.at(cell::linear_type(cell.type));
    ASSERT_EQ(gauss.nodes.size(), static_cast<std::size_t>(cell.node_count * cell.dimension));
    for (std::size_t i = 0; i < corners.size(); ++i)
      EXPECT_NEAR(gauss.nodes[i], corners[i], 1e-14) << i;
    const double sum = std::accumulate(gauss.weights.begin(), gauss.weights.end(), 0.0);
    EXPECT_NEAR(sum, reference_measure(cell::linear_type(cell.type)), 1e-13);
  }
}

/// Affine cells: a point stands where the same combination of nodes does.
TEST(GaussPointsInMed, StandWhereStressesAreComputed) {
  for (const auto& cell : cell::all_topologies()) {
    if (cell.dimension < 2 || !cell::has_reference_cell(cell.type))
      continue;
    SCOPED_TRACE(cell.name);
    const auto gauss = med_gauss(cell.type);
    const auto d = static_cast<Eigen::Index>(cell.dimension);
    const auto order = mesh::med::node_order(cell.type);
    const auto& reference = cell::reference_cell(cell.type);
    Eigen::MatrixXd in_med(cell.node_count, d + 1);
    Eigen::MatrixXd ours(cell.node_count, d);
    for (Eigen::Index i = 0; i < cell.node_count; ++i) {
      const auto at = order.empty() ? i : Eigen::Index{order[static_cast<std::size_t>(i)]};
      in_med.row(at).head(d) = Eigen::Map<const Eigen::RowVectorXd>(gauss.nodes.data() + at * d, d);
      in_med(at, d) = 1;
      ours.row(at) = reference.nodes[static_cast<std::size_t>(i)].head(d).transpose();
    }
    const Eigen::MatrixXd map = test::pseudo_inverse(in_med) * ours;
    const auto rule = cell::stiffness_rule(cell.type);
    ASSERT_EQ(gauss.weights.size(), rule.size());
    for (std::size_t q = 0; q < rule.size(); ++q) {
      Eigen::RowVectorXd x(d + 1);
      x << Eigen::Map<const Eigen::RowVectorXd>(gauss.points.data() + static_cast<Eigen::Index>(q) * d, d), 1;
      EXPECT_LT((x * map - rule[q].xi.head(d).transpose()).norm(), 1e-13) << q;
    }
  }
}

/// What an independent reader of MED finds.
struct InMed {
  Values values;
  int places = 0;
  std::string localisation;
};

InMed read(const std::filesystem::path& file, const std::string& field, med_entity_type entity,
           med_geometry_type geometry) {
  const auto id = MEDfileOpen(file.c_str(), MED_ACC_RDONLY);
  EXPECT_GE(id, 0);
  std::string profile(MED_NAME_SIZE + 1, '\0');
  std::string localisation(MED_NAME_SIZE + 1, '\0');
  med_int profile_size = 0;
  med_int places = 0;
  const auto cells =
      MEDfieldnValueWithProfile(id, field.c_str(), 4, MED_NO_IT, entity, geometry, 1, MED_COMPACT_STMODE,
                                profile.data(), &profile_size, localisation.data(), &places);
  InMed found{Values(static_cast<std::size_t>(std::max<med_int>(cells, 0) * places * 6)),
              static_cast<int>(places), localisation.substr(0, localisation.find('\0'))};
  EXPECT_GE(MEDfieldValueWithProfileRd(id, field.c_str(), 4, MED_NO_IT, entity, geometry, MED_COMPACT_STMODE,
                                       profile.c_str(), MED_FULL_INTERLACE, MED_ALL_CONSTITUENT,
                                       reinterpret_cast<unsigned char*>(found.values.data())),
            0);
  MEDfileClose(id);
  return found;
}

TEST(FieldsInMed, AreAtGaussPointsAndAtElementNodes) {
  const std::map<std::string, std::pair<CellType, med_geometry_type>> kinds{
      {"hexa8", {CellType::hexa8, MED_HEXA8}},
      {"hexa20", {CellType::hexa20, MED_HEXA20}},
      {"penta6", {CellType::penta6, MED_PENTA6}},
      {"tetra10", {CellType::tetra10, MED_TETRA10}}};
  for (const auto& [name, kind] : kinds) {
    SCOPED_TRACE(name);
    auto deck = solid_block;
    deck.replace(deck.find("CELLS"), 5, name);
    const auto model = test::model_of(deck);
    auto state = stretched(model);
    for (Eigen::Index i = 0; i < state.motion.u.size(); ++i)
      state.motion.u[i] *= 1 + 0.1 * std::sin(static_cast<double>(i)); // each place its own value
    const auto fields = cell_fields(model, state, with_only({"stress_elga", "strain_elno"}));
    const test::ScratchFolder folder;
    mesh::write_med(folder / "a.med", model.mesh, "mesh");
    append_med_fields(folder / "a.med", "mesh", {0, 0.0}, {}, "", fields);
    append_med_fields(folder / "a.med", "mesh", {4, 0.5}, {}, "", fields);

    const auto stored = med_fields(folder / "a.med");
    ASSERT_EQ(stored.size(), 2U);
    EXPECT_FALSE(stored[0].at_nodes);
    EXPECT_EQ(stored[0].component_names, (std::vector<std::string>{"xx", "yy", "zz", "xy", "yz", "xz"}));
    const auto& elno = *std::ranges::find(fields, "strain_elno", &CellField::name);
    const auto& elga = *std::ranges::find(fields, "stress_elga", &CellField::name);
    const auto at_points = read(folder / "a.med", "stress_elga", MED_CELL, kind.second);
    EXPECT_EQ(at_points.values, elga.parts.at(0).values);
    EXPECT_EQ(at_points.localisation, "gauss_" + std::string(cell::topology(kind.first).name));
    EXPECT_EQ(at_points.places, static_cast<int>(cell::stiffness_rule(kind.first).size()));

    const auto at_nodes = read(folder / "a.med", "strain_elno", MED_NODE_ELEMENT, kind.second);
    const auto order = mesh::med::node_order(kind.first);
    ASSERT_EQ(at_nodes.values.size(), elno.parts.at(0).values.size());
    const auto nodes = order.size();
    for (std::size_t i = 0; i < at_nodes.values.size(); i += 6)
      EXPECT_EQ(elno.parts[0].values[i], at_nodes.values[(i / 6 / nodes * nodes + order[i / 6 % nodes]) * 6]);
  }
}

} // namespace
} // namespace rubato::results::cell_fields_test
