// SPDX-License-Identifier: LGPL-3.0-or-later
/// The discrete problem of one run: numbered unknowns, matrices, loads as functions of time, contact zones.
#pragma once

#include "rubato/constraint/reduction.hpp"
#include "rubato/core/ranks.hpp"
#include "rubato/domain/bulk.hpp"
#include "rubato/domain/dof_map.hpp"
#include "rubato/domain/domain.hpp"
#include "rubato/domain/law_springs.hpp"
#include "rubato/mesh/mesh.hpp"
#include "rubato/model/force.hpp"
#include "rubato/model/gauge.hpp"
#include "rubato/model/ground_pull.hpp"
#include "rubato/model/initial_motion.hpp"
#include "rubato/model/modal_damping.hpp"
#include "rubato/model/preloads.hpp"
#include "rubato/model/probed_cells.hpp"
#include "rubato/model/products.hpp"
#include "rubato/model/references.hpp"
#include "rubato/model/sparse_matrix.hpp"
#include "rubato/model/springs.hpp"
#include "rubato/study/study.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace rubato::contact {
struct PointOfZone;
struct Zone;
} // namespace rubato::contact

namespace rubato::domain {
struct CutForces;
class Heat;
class RankParts;
} // namespace rubato::domain

namespace rubato::load {
struct FollowerPressure;
} // namespace rubato::load

namespace rubato::model {

/// Where a type is only declared here, sources that use its member include its header.
struct Model {
  Model();
  Model(const Model& other);
  Model(Model&& other) noexcept;
  Model& operator=(const Model& other);
  Model& operator=(Model&& other) noexcept;
  ~Model();

  study::Study study;
  Threads threads; ///< that the run may use
  Ranks ranks;     ///< that work on it
  Workers workers() const { return {threads, ranks}; }
  /// Which cells this rank evaluates; matrices are its part of a sum over ranks then
  /// (linalg/ranked_matrix.hpp), of those of the domain too. Null where each rank has all of them.
  std::shared_ptr<const domain::RankParts> parts;
  /// Those that have parts; this one alone without.
  Ranks sharing() const { return parts ? ranks : Ranks(); }
  /// Whether what all ranks know of a dof stands in the matrices of this one.
  bool counts(int dof) const;
  mesh::Mesh mesh;
  domain::Bulk bulk; ///< the cells that deform and their materials
  domain::DofMap dofs;
  std::shared_ptr<const domain::Heat> heat; ///< of the domain; null without temperatures
  domain::Domain domain;                    ///< the cells, the springs, the connectors and the gauges
  SparseMatrix mass;                        ///< empty (no entries) in a static or explicit run
  /// Ascending; on contact surfaces when their mass is redistributed.
  std::vector<mesh::NodeIndex> massless_nodes;
  Eigen::VectorXd lumped_mass; ///< one a dof, in an explicit run; else empty
  SparseMatrix damping;        ///< no entries without Rayleigh coefficients and dashpots
  bool has_damping = false;    ///< whether that of any rank has entries
  ModalDamping modal_damping;
  std::vector<domain::LawSpring> dampers; ///< by tables
  Products products;                      ///< with the mass, in an implicit run
  std::vector<Force> forces;
  std::vector<load::FollowerPressure> followers;
  std::vector<load::FollowerPressure> own_followers; ///< with `parts`: the faces whose tangents stand here
  constraint::Reduction reduction; ///< which displacements are unknown, and what supports prescribe
  std::vector<Reference> references;
  std::vector<Spring> springs;
  std::vector<Connector> connectors;
  std::vector<PointMass> point_masses;
  /// Of each axis along which a base moves that displacements are not counted from, where springs, dashpots
  /// or damping by the mass act against it.
  std::vector<GroundPull> ground;
  std::vector<PreloadedCut> preloads; ///< of each preload of the study
  /// Instants of the run at which supports end or preloads are locked, ascending; steps end at them.
  std::vector<double> releases;
  std::vector<mesh::NodeIndex> arc_nodes; ///< study::ArcLength::on, ascending; none without
  std::vector<Gauge> gauges;              ///< of bodies that in a static run only contact holds
  InitialMotion initial;
  /// Nodes of bodies that in a static run only contact holds, ascending.
  std::vector<mesh::NodeIndex> free_body_nodes;
  std::vector<contact::Zone> zones;
  /// The points of each slave node that has several.
  std::vector<std::vector<contact::PointOfZone>> shared_nodes;
  /// Of each probe of the study, at least one; none of cuts, differences and references, and in cells.
  std::vector<std::vector<mesh::NodeIndex>> probe_nodes;
  std::vector<ProbedCells> probe_cells;      ///< of each probe; none of those at nodes
  std::vector<domain::CutForces> probe_cuts; ///< of each probe of the study; empty where it is no cut
  int locking_materials = 0; ///< whose cells, integrated in full, keep their volume (formulation_notes.hpp)
  double added_mass = 0;     ///< by mass_scaling, in parts of the mass of the cells
  double slenderness = 0;    ///< of a part of few layers that bends too stiffly; 0: none does
  std::vector<std::string> notes;      ///< sentences that whoever runs the model should read
  std::vector<int> multiplier_offsets; ///< first multiplier of each zone
  int multiplier_count = 0;

  /// The node a dof belongs to, and its direction.
  mesh::NodeIndex node_of(int dof) const { return node_of_dof[static_cast<std::size_t>(dof)]; }
  std::vector<mesh::NodeIndex> node_of_dof;
};

} // namespace rubato::model
