// SPDX-License-Identifier: LGPL-3.0-or-later
/// The discrete problem of one run: numbered unknowns, matrices, loads as functions of time, contact zones.
#pragma once

#include "rubato/constraint/reduction.hpp"
#include "rubato/contact/shared_nodes.hpp"
#include "rubato/contact/zone.hpp"
#include "rubato/core/ranks.hpp"
#include "rubato/domain/bulk.hpp"
#include "rubato/domain/cut.hpp"
#include "rubato/domain/dof_map.hpp"
#include "rubato/domain/domain.hpp"
#include "rubato/domain/heat.hpp"
#include "rubato/load/field_forces.hpp"
#include "rubato/load/follower_pressure.hpp"
#include "rubato/mesh/mesh.hpp"
#include "rubato/model/modal_damping.hpp"
#include "rubato/model/preloads.hpp"
#include "rubato/model/products.hpp"
#include "rubato/model/references.hpp"
#include "rubato/study/study.hpp"

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace rubato::domain {
class RankParts;
} // namespace rubato::domain

namespace rubato::model {

using SparseMatrix = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;

/// A force pattern times a function of time (1 when there is none), and what of the load changes otherwise.
struct Force {
  Eigen::VectorXd pattern; ///< [force], one a dof
  std::optional<Function> function;
  std::vector<load::FieldForce> fields = {}; ///< expressions of t
  bool is_controlled = false;                ///< multiplied by the factor of the loads
};

/// A spring from a dof to the ground, slack at displacement 0.
struct Spring {
  int dof = 0;
  double stiffness = 0; ///< [force/length] > 0
  bool soft = false;    ///< too soft to say where a body in contact is (model/soft_springs.hpp)
};

/// A spring, a dashpot and a mass side by side on the displacement Σ row · u. Where tables give forces, the
/// numbers are their steepest slopes, which matrices have.
struct Connector {
  std::vector<constraint::Term> row;
  double stiffness = 0; ///< [force/length]
  double damping = 0;   ///< [force · time/length]
  double mass = 0;      ///< [mass]
  std::optional<LinearTable> force = {};
  std::optional<LinearTable> damper = {};
};

/// What springs and dashpots to the ground do to the bodies when it moves by s along an axis: the force
/// stiffness s + damping ṡ.
struct GroundPull {
  FieldFunction displacement; ///< s [length]
  Eigen::VectorXd along;      ///< r: 1 on dofs along the axis
  Eigen::VectorXd stiffness;  ///< K r [force/length], one a dof
  Eigen::VectorXd damping;    ///< C r [force · time/length], one a dof; empty without damping

  double at(double t) const;   ///< s [length]
  double rate(double t) const; ///< ṡ [length/time]
};

struct PointMass {
  mesh::NodeIndex node = -1;
  double mass = 0;
};

/// Holds a motion of a body that nothing resists, and neither the body's other rigid motions nor, but for
/// places near its nodes, deformations: a spring on g·u, slack at 0.
struct Gauge {
  std::vector<mesh::NodeIndex> nodes;
  Eigen::VectorXd values; ///< of g, node by node
};

/// Displacements and velocities the deck gives the bodies at the first instant, one a dof; supports count
/// before them.
struct InitialMotion {
  Eigen::VectorXd displacement; ///< [length]
  Eigen::VectorXd velocity;     ///< [length/time]
};

/// Cells that a probe has values of, by their places in the bulk.
struct ProbedCells {
  std::vector<std::size_t> cells;
  int point = -1; ///< the Gauss point of the one cell; −1: every point of each
};

struct Model {
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
  std::vector<std::string> notes;            ///< sentences that whoever runs the model should read
  std::vector<int> multiplier_offsets;       ///< first multiplier of each zone
  int multiplier_count = 0;

  /// The node a dof belongs to, and its direction.
  mesh::NodeIndex node_of(int dof) const { return node_of_dof[static_cast<std::size_t>(dof)]; }
  std::vector<mesh::NodeIndex> node_of_dof;
};

/// Builds the discrete problem. Throws InputError with every rule that the study breaks, else with every
/// fault that shows against the mesh; faults have the path of the value in the study.
Model build_model(const study::Study& study, mesh::Mesh mesh, const Workers& workers = {});

/// The discrete problem from one of the releases on: the supports that end by then are gone, preloads that
/// are locked by then have their shortening. Its dofs and contact points are those of `first`, the model at
/// the begin of the run. `shortening`: one a preload [length].
Model build_stage(const Model& first, double release, const Eigen::VectorXd& shortening);

/// What preloads that are locked at one of the releases are shortened by, u being the displacements then;
/// leaves the others alone.
void lock_preloads(const Model& first, double release, const Eigen::VectorXd& u, Eigen::VectorXd& shortening);

/// A sentence for each zone whose sides the model has chosen: which one is the slave, and why.
std::vector<std::string> chosen_sides(std::span<const contact::Zone> zones);

/// The faults of each study that show against its mesh, without assembling anything: whoever is about to run
/// several learns first whether one of them is bad.
std::vector<std::vector<Fault>> faults_of(std::span<const study::Study> studies);

/// The mesh a study names or describes: read or generated, mended, converted and refined. Throws InputError;
/// what is wrong with a mesh file is told at the path that names it.
mesh::Mesh load_mesh(const study::MeshSource& source);

/// build_model on that mesh.
inline Model build_model(const study::Study& study, const Workers& workers = {}) {
  return build_model(study, load_mesh(study.mesh), workers);
}

/// Of loads that do not depend on displacements [force], one a dof. `load_factor`: multiplies those without
/// a function of time where the study follows a path (study::ArcLength), and 1 elsewhere.
Eigen::VectorXd external_force(const Model& model, double t, double load_factor = 1);

/// Adds the forces of pressures that follow their faces at displacements u to `force`, both with an entry a
/// dof [force].
void add_follower_forces(const Model& model, double t, const Eigen::VectorXd& u, Eigen::VectorXd& force,
                         double load_factor = 1);
/// Adds `factor` times the symmetric part of their −∂f/∂u to a compressed matrix with the places of the
/// stiffness.
void add_follower_tangent(const Model& model, double t, const Eigen::VectorXd& u, double factor,
                          SparseMatrix& matrix, double load_factor = 1);
/// What the loads that have the factor do at a factor of one [force], one a dof.
Eigen::VectorXd controlled_force(const Model& model, double t, const Eigen::VectorXd& u);

/// Whether velocities are resisted.
bool is_damped(const Model& model);
/// What resists them: C v, with the damping of modes [force].
Eigen::VectorXd damping_force(const Model& model, const Eigen::VectorXd& v);

/// "N90 (1, 0.1, 0.05)": how messages name a node.
std::string node_label(const mesh::Mesh& mesh, mesh::NodeIndex node);

} // namespace rubato::model
