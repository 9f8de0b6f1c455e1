// SPDX-License-Identifier: LGPL-3.0-or-later
#include "verification/oracle_statics.hpp"

#include <fmt/format.h>

#include "support/model_parts.hpp"
#include "support/shared_files.hpp"
#include "support/walk.hpp"
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace rubato::verification {
namespace {

constexpr double same_place = 1e-8;

/// A wedge of the oracle's own mesh under pressure.
std::string wedge(const std::string& mesh, const std::string& physics, const std::string& more) {
  return fmt::format(R"(mesh: {{file: "{}"}}
physics: {}
materials: {{any: {{young: 200e9, poisson: 0.3}}}}
loads: [{{pressure: {{on: Y1, value: 1e8}}}}]
time: {{scheme: static, step: 1, end: 1}}
{})",
                     test::shared_file("oracle/" + mesh).string(), physics, more);
}

/// The upper beam of SDNL140 C alone, clamped.
std::string beam_in_space(const std::string& material, const std::string& load,
                          const std::string& more = "") {
  return fmt::format(
      R"(mesh: {{generate: [{{name: beam, box: {{from: [0, 0, 0], to: [1, 0.1, 0.1]}}, divisions: [20, 2, 1], cells: hexa8,
  sides: {{left: clamped, right: end_nodes}}, edges: {{right_top: pushed}}, points: {{right_top_back: corner}}}}]}}
physics: solid
materials: {{any: {}}}
supports: [{{on: clamped, fix: [x, y, z]}}]
loads: [{}]
time: {{scheme: static, step: 1, end: 1}}
{})",
      material, load, more);
}

/// The same of F.
std::string beam_in_plane(const std::string& physics, const std::string& material) {
  return fmt::format(
      R"(mesh: {{generate: [{{name: beam, rectangle: {{from: [0, 0], to: [1, 0.1]}}, divisions: [20, 2], cells: quad4,
  sides: {{left: clamped}}, points: {{right_top: corner}}}}]}}
physics: {}
materials: {{any: {}}}
supports: [{{on: clamped, fix: [x, y]}}]
loads: [{{nodal_force: {{on: corner, y: -1e7}}}}]
time: {{scheme: static, step: 1, end: 1}}
)",
      physics, material);
}

const std::string elastic = "{young: 200e9, poisson: 0.3}";

std::string orthotropic(int degrees, bool in_space, bool is_strain) {
  std::string numbers = "young_x: 200e9, young_y: 100e9, poisson_xy: 0.3, shear_xy: 60e9";
  if (in_space || is_strain)
    numbers += ", young_z: 80e9, poisson_xz: 0.25, poisson_yz: 0.2";
  if (in_space)
    numbers += ", shear_xz: 50e9, shear_yz: 40e9";
  return fmt::format("{{law: orthotropic, {}, angle_z: {}}}", numbers, degrees);
}

std::vector<OracleStatic> all() {
  const std::string rigid = "relations: {end: {rigid: {on: end_nodes}}}\n";
  const auto at_corner = [](const std::string& force) {
    return "{nodal_force: {on: corner, " + force + "}}";
  };
  std::vector<OracleStatic> studies{
      {"static_incl2d_ddl",
       "an equation between two nodes; a node held at 30° (LIAISON_DDL, LIAISON_OBLIQUE)",
       wedge("incl2d.mail", "plane_strain",
             "supports: [{on: D, fix: [x, y]}, {on: Cn, along: [-0.5, 0.86602540378443864676]}]\nrelations: "
             "{lift: "
             "{equation: {terms: [{on: A, y: 1}, {on: Bn, x: -2}], value: 1e-4}}}\n")},
      {"static_incl2d_dnor", "an inclined face held along its normal (FACE_IMPO, DNOR)",
       wedge("incl2d.mail", "plane_strain",
             "supports: [{on: X0, fix: x}, {on: Y0, fix: y}, {on: X1, along: normal}]\n")},
      {"static_incl3d_dnor", "the same in space",
       wedge("incl3d.mail", "solid",
             "supports: [{on: X0, fix: x}, {on: Y0, fix: y}, {on: Z0, fix: z}, {on: X1, along: normal}]\n")},
      {"static_c_rigid_end_a", "a beam with a rigid end (LIAISON_SOLIDE), bent about z",
       beam_in_space(elastic, at_corner("y: -1e5"), rigid)},
      {"static_c_rigid_end_b", "the same, bent about y", beam_in_space(elastic, at_corner("z: 1e5"), rigid)},
      {"static_c_rigid_end_c", "the same, pulled", beam_in_space(elastic, at_corner("x: 1e5"), rigid)},
      {"static_c_rigid_end_d", "the same, all together",
       beam_in_space(elastic, at_corner("x: 3e4, y: -1e5, z: 2e4"), rigid)},
      {"static_c_rigid_end_n", "the same without the rigid end",
       beam_in_space(elastic, at_corner("x: 3e4, y: -1e5, z: 2e4"))}};
  for (const int degrees : {0, 30}) {
    const auto what = fmt::format("orthotropic beam, axes turned by {}°, ", degrees);
    studies.push_back(
        {fmt::format("static_c_orth{}", degrees), what + "solid",
         beam_in_space(orthotropic(degrees, true, false), "{line_force: {on: pushed, y: -1e7}}")});
    studies.push_back({fmt::format("static_fdp_orth{}", degrees), what + "plane strain",
                       beam_in_plane("plane_strain", orthotropic(degrees, false, true))});
  }
  studies.push_back({"static_fcp_orth30", "orthotropic beam, axes turned by 30°, plane stress",
                     beam_in_plane("plane_stress", orthotropic(30, false, false))});
  return studies;
}

struct Row {
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  Eigen::Vector3d displacement = Eigen::Vector3d::Zero();
};

std::vector<Row> rows_of(const std::filesystem::path& file, int dimension) {
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line);
  std::vector<Row> rows;
  while (std::getline(stream, line)) {
    std::istringstream cells(line);
    std::vector<std::string> values;
    for (std::string cell; std::getline(cells, cell, ',');)
      values.push_back(cell);
    Row row;
    for (int i = 0; i < dimension; ++i) {
      row.place[i] = std::stod(values.at(static_cast<std::size_t>(3 + i)));
      row.displacement[i] = std::stod(values.at(static_cast<std::size_t>(3 + dimension + i)));
    }
    rows.push_back(row);
  }
  return rows;
}

mesh::NodeIndex node_at(const test::ModelParts& model, const Eigen::Vector3d& place) {
  const auto distance = [&](mesh::NodeIndex node) {
    return (model.mesh.points[static_cast<std::size_t>(node)] - place).norm();
  };
  const auto nearest = *std::ranges::min_element(model.dofs.nodes, {}, distance);
  if (distance(nearest) > same_place)
    throw std::runtime_error("no node where the file has one");
  return nearest;
}

} // namespace

std::vector<OracleStatic> oracle_statics() {
  auto studies = all();
  std::erase_if(studies, [](const OracleStatic& study) {
    return !std::filesystem::exists(test::shared_file("oracle/" + study.file + ".csv"));
  });
  return studies;
}

OracleDeviation compare(const OracleStatic& study) {
  test::Walk walk(study.deck);
  if (!walk.to_end())
    throw std::runtime_error(study.file + " did not come to its end");
  OracleDeviation found;
  const int d = walk.model.dofs.components;
  for (const auto& row : rows_of(test::shared_file("oracle/" + study.file + ".csv"), d)) {
    const auto node = node_at(walk.model, row.place);
    const Eigen::VectorXd u = walk.state().motion.u.segment(walk.model.dofs.dof(node, 0), d);
    ++found.nodes;
    found.peak = std::max(found.peak, row.displacement.lpNorm<Eigen::Infinity>());
    found.largest = std::max(found.largest, (u - row.displacement.head(d)).lpNorm<Eigen::Infinity>());
  }
  found.largest /= found.peak;
  return found;
}

} // namespace rubato::verification
