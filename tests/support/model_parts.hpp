// SPDX-License-Identifier: LGPL-3.0-or-later
/// The parts of a model, for tests: a test includes the headers of the parts that it reads, not all of them.
#pragma once

#include "rubato/mesh/mesh.hpp"
#include "rubato/model/fwd.hpp"
#include "rubato/model/sparse_matrix.hpp"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace rubato::constraint {
class Reduction;
} // namespace rubato::constraint

namespace rubato::contact {
struct PointOfZone;
struct Zone;
} // namespace rubato::contact

namespace rubato::domain {
struct Bulk;
struct CutForces;
class Domain;
struct DofMap;
} // namespace rubato::domain

namespace rubato::model {
struct PreloadedCut;
} // namespace rubato::model

namespace rubato::study {
struct Study;
} // namespace rubato::study

namespace rubato::test {

/// Members of a model that the caller keeps, by their names there.
struct ModelParts {
  ModelParts(const model::Model& model);

  operator const model::Model&() const { return whole; }
  mesh::NodeIndex node_of(int dof) const;

  const model::Model& whole;
  const study::Study& study;
  const mesh::Mesh& mesh;
  const domain::Bulk& bulk;
  const domain::DofMap& dofs;
  const domain::Domain& domain;
  const model::SparseMatrix& mass;
  const model::SparseMatrix& damping;
  const Eigen::VectorXd& lumped_mass;
  const constraint::Reduction& reduction;
  const std::vector<contact::Zone>& zones;
  const std::vector<std::vector<contact::PointOfZone>>& shared_nodes;
  const std::vector<model::PreloadedCut>& preloads;
  const std::vector<domain::CutForces>& probe_cuts;
  const std::vector<mesh::NodeIndex>& massless_nodes;
  const std::vector<mesh::NodeIndex>& free_body_nodes;
  const std::vector<std::string>& notes;
};

} // namespace rubato::test
