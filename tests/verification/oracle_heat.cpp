// SPDX-License-Identifier: LGPL-3.0-or-later
#include "verification/oracle_heat.hpp"

#include "rubato/domain/dof_map.hpp"
#include "rubato/mesh/mesh.hpp"
#include "rubato/mesh/names.hpp"
#include "rubato/study/study.hpp"

#include <fmt/format.h>

#include "support/walk.hpp"
#include "verification/oracle_files.hpp"
#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>

namespace rubato::verification {
namespace {

using Eigen::VectorXd;

OracleHeat study_of(const std::string& physics, const std::string& code, bool gradient, bool rubs) {
  const bool solid = physics == "solid";
  OracleHeat study;
  study.file = fmt::format("thermal_{}_{}{}", code, gradient ? "grad" : "uni", rubs ? "_mu02" : "");
  study.what = fmt::format("{}, {}{}",
                           physics == "solid"          ? "solid"
                           : physics == "plane_stress" ? "plane stress"
                                                       : "plane strain",
                           gradient ? "temperature linear over the height" : "uniform temperature",
                           rubs ? ", friction 0.2" : "");
  if (!has_oracle_file(study.file))
    return study;
  study.deck = fmt::format(R"(mesh: {{generate: {}}}
physics: {}
materials: {{steel: {{young: 200e9, poisson: 0.3, expansion: 1.2e-5}}}}
functions: {{grows: {{ramp: {{begin: 0, end: 1}}}}}}
temperature: [{{on: Bas, value: 0}}, {{on: Haut, value: "{}", function: grows}}]
supports: [{{on: Haut_Encastre, fix: [x, y{}]}}, {{on: Bas_Encastre, fix: [x, y{}]}}]
contact: {{interface: {{master: Haut_Contact, slave: Bas_Contact, integration: nodes, projection_tolerance: 0.5, friction: {},
  exclude_nodes: [Bas_Encastre]}}}}
newton: {{residual: 1e-10}}
time: {{scheme: static, instants: {}}}
)",
                           oracle_beams(solid), physics, gradient ? "1000*y" : "100", solid ? ", z" : "",
                           solid ? ", z" : "", rubs ? 0.2 : 0, oracle_instants(study.file));
  return study;
}

/// Of a group of nodes, component by component.
VectorXd reaction_of(const test::Walk& walk, const std::string& group) {
  const auto& model = walk.model;
  VectorXd sum = VectorXd::Zero(model.dofs.components);
  for (const auto node : mesh::find_nodes(model.mesh, group).nodes)
    sum += walk.state().reaction.segment(model.dofs.dof(node, 0), model.dofs.components);
  return sum;
}

} // namespace

std::vector<OracleHeat> oracle_heat() {
  std::vector<OracleHeat> studies;
  for (const auto& [physics, code] :
       {std::pair("solid", "c"), std::pair("plane_stress", "fcp"), std::pair("plane_strain", "fdp")})
    for (const bool gradient : {false, true})
      for (const bool rubs : {false, true})
        if (auto study = study_of(physics, code, gradient, rubs); !study.deck.empty())
          studies.push_back(std::move(study));
  return studies;
}

HeatDeviation compare(const OracleHeat& study) {
  const auto table = oracle_table(study.file);
  test::Walk walk(study.deck);
  const int d = walk.model.dofs.components;
  const auto tip = mesh::find_nodes(walk.model.mesh, "tip").nodes.front();
  double peak = 0;
  double strongest = 0;
  HeatDeviation found;
  for (const auto& row : std::span(table).subspan(1)) {
    if (!walk.advance())
      throw std::runtime_error(study.file + " did not come to its end");
    const VectorXd expected = Eigen::Map<const VectorXd>(row.data() + 1, d);
    const VectorXd force = Eigen::Map<const VectorXd>(row.data() + 1 + d, 2);
    const VectorXd u = walk.state().motion.u.segment(walk.model.dofs.dof(tip, 0), d);
    const VectorXd reaction = reaction_of(walk, "Bas_Encastre").head(2);
    peak = std::max(peak, expected.lpNorm<Eigen::Infinity>());
    strongest = std::max(strongest, force.lpNorm<Eigen::Infinity>());
    found.displacement = std::max(found.displacement, (u - expected).lpNorm<Eigen::Infinity>());
    found.reaction = std::max(found.reaction, (reaction - force).lpNorm<Eigen::Infinity>());
    found.others += static_cast<int>(row.back());
    ++found.rows;
  }
  for (const auto& report : walk.reports)
    found.iterations += report.iterations;
  found.displacement /= peak;
  found.reaction /= strongest;
  return found;
}

} // namespace rubato::verification
