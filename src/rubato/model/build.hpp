// SPDX-License-Identifier: LGPL-3.0-or-later
/// The parts of build_model. Each collects what is wrong with the study on this mesh instead of stopping at
/// the first.
#pragma once

#include "rubato/core/error.hpp"
#include "rubato/domain/assembly.hpp"
#include "rubato/model/force.hpp"
#include "rubato/model/fwd.hpp"
#include "rubato/model/initial_motion.hpp"
#include "rubato/model/modal_damping.hpp"
#include "rubato/model/preloads.hpp"
#include "rubato/model/probed_cells.hpp"
#include "rubato/model/products.hpp"
#include "rubato/model/references.hpp"
#include "rubato/model/sparse_matrix.hpp"
#include "rubato/model/springs.hpp"

#include <limits>
#include <span>
#include <string_view>
#include <vector>

namespace rubato::contact {
struct Zone;
} // namespace rubato::contact

namespace rubato::domain {
struct CutForces;
class Heat;
struct LawSpring;
struct LineSpring;
} // namespace rubato::domain

namespace rubato::load {
struct FollowerPressure;
} // namespace rubato::load

namespace rubato::model {

/// From when on a model holds.
struct Stage {
  double released = -std::numeric_limits<double>::infinity(); ///< supports that end by then are gone
  Eigen::VectorXd shortening = {}; ///< of each preload that is locked by then [length]
};

/// The cells that deform and their materials; a cell that got none has the first one.
domain::Bulk make_bulk(const study::Study& study, const mesh::Mesh& mesh, std::vector<Fault>& faults);

/// Reads the fields of files that the study names, for its mesh: the values of FileField. Faults at the paths
/// of those that cannot be had.
void read_field_files(study::Study& study, const mesh::Mesh& mesh, std::vector<Fault>& faults);

/// Evaluates laws that depend on the place at all points of their cells, which must be sound: a fault for the
/// first place where each is not valid, and for a cell that the line crosses about which its axes turn.
/// `bulk.laws` get each such law at one place.
void check_law_fields(const study::Study& study, const mesh::Mesh& mesh, domain::Bulk& bulk,
                      std::vector<Fault>& faults);

/// Faults for cells that cannot be computed with.
void check_shapes(const study::Study& study, const mesh::Mesh& mesh, std::span<const mesh::CellIndex> cells,
                  std::vector<Fault>& faults);

/// What supports and relations say of the displacements, and which ones are left unknown; faults where they
/// contradict one another, a note where some of a relation's equations follow from others. Supports that
/// have ended in the stage are left out, preloads that are locked then keep their shortening. Zones with a
/// tie among `ties` are equations with multipliers, in their order the first of Reduction::multipliers.
constraint::Reduction make_reduction(const study::Study& study, const mesh::Mesh& mesh,
                                     const domain::DofMap& dofs, std::span<const Reference> references,
                                     std::vector<Fault>& faults, std::vector<std::string>& notes,
                                     std::span<const PreloadedCut> preloads = {}, const Stage& stage = {},
                                     std::span<const contact::Zone> ties = {});

/// How a base moves that displacements are not counted from, s(t); nothing on axes along which it is at rest.
constraint::Reduction::Base make_base(const study::Study& study, std::vector<Fault>& faults);
/// Lets the obstacles of the zones move with such a base.
void carry_obstacles(Model& model);
/// Lets springs and dashpots to the ground, and damping by the mass, move with such a base; the model has its
/// matrices.
void move_ground(Model& model);
/// Adds −M r a(t), of a base that displacements are counted from; the model has its masses.
void add_base_inertia(Model& model);

/// Stiffness, mass and damping of a model that has everything else: of explicit runs what their steps
/// multiply with.
void assemble_matrices(Model& model);

/// Null without temperatures.
std::shared_ptr<const domain::Heat> make_heat(const study::Study& study, const mesh::Mesh& mesh,
                                              const domain::DofMap& dofs, const domain::Bulk& bulk,
                                              std::vector<Fault>& faults);

/// Of a model with stiffness and mass. Throws InputError where it has not as many modes as are asked for.
ModalDamping make_modal_damping(const Model& model);

/// Springs to the ground.
std::vector<Spring> make_springs(const study::Study& study, const mesh::Mesh& mesh,
                                 const domain::DofMap& dofs, std::vector<Fault>& faults);

/// Springs and dashpots between places, masses of references.
std::vector<Connector> make_connectors(const study::Study& study, const mesh::Mesh& mesh,
                                       const domain::DofMap& dofs, std::span<const Reference> references,
                                       std::vector<Fault>& faults);
/// Adds their stiffness.
void add_connectors(const Model& model, SparseMatrix& stiffness);
/// The masses of references, beside the matrix, and added to it.
std::vector<AttachedMass> attached_masses(const Model& model);
void add_reference_masses(const Model& model, SparseMatrix& mass);
/// Their masses alone: a matrix with a row a dof, without entries where no reference has a mass.
SparseMatrix reference_masses(const Model& model);
/// Springs and dashpots by tables.
std::vector<domain::LawSpring> law_springs(const Model& model);
std::vector<domain::LawSpring> law_dampers(const Model& model);
/// Connectors that act along the current line between their ends.
std::vector<domain::LineSpring> line_springs(const Model& model);
/// Adds `factor` times the tangent of these connectors in the undeformed model. A factor of 0 adds entries of
/// value 0 at its places.
void add_lines(std::span<const domain::LineSpring> lines, double factor, SparseMatrix& stiffness);
/// Adds to a matrix of stiffness what it lacks of the slopes of springs at rest.
void add_slopes_at_rest(const Model& model, SparseMatrix& stiffness);
/// Adds their damping.
void add_dashpots(const Model& model, SparseMatrix& damping);

std::vector<PointMass> make_point_masses(const study::Study& study, const mesh::Mesh& mesh,
                                         const domain::DofMap& dofs, std::span<const Reference> references,
                                         std::vector<Fault>& faults);
/// A fault where a mass is put on a surface that has none.
void check_point_masses(const Model& model, std::vector<Fault>& faults);

/// How the run begins; faults where two entries, or an entry and a support, say different things of one dof.
InitialMotion make_initial_motion(const study::Study& study, const mesh::Mesh& mesh,
                                  const domain::DofMap& dofs, const constraint::Reduction& reduction,
                                  std::vector<Fault>& faults);

/// The nodes that study::ArcLength measures, which the study has.
std::vector<mesh::NodeIndex> make_arc_nodes(const study::Study& study, const mesh::Mesh& mesh,
                                            const domain::DofMap& dofs, std::vector<Fault>& faults);

/// Loads as nodal forces, but for those that follow faces.
std::vector<Force> make_forces(const study::Study& study, const mesh::Mesh& mesh, const domain::DofMap& dofs,
                               const domain::Bulk& bulk, std::span<const Reference> references,
                               std::vector<Fault>& faults);

/// Pressures that follow the faces they act on.
std::vector<load::FollowerPressure> make_followers(const study::Study& study, const mesh::Mesh& mesh,
                                                   const domain::DofMap& dofs, const domain::Bulk& bulk,
                                                   std::vector<Fault>& faults);

/// Contact zones on oriented surfaces.
std::vector<contact::Zone> make_zones(const study::Study& study, const mesh::Mesh& mesh,
                                      const domain::Bulk& bulk, const domain::DofMap& dofs,
                                      const constraint::Reduction& reduction, std::vector<Fault>& faults);

/// Faces of masters that bound no cell: rigid surfaces drawn as a mesh, whose nodes supports hold or move.
std::vector<mesh::CellIndex> rigid_faces(const study::Study& study, const mesh::Mesh& mesh);

/// The nodes of each probe: those of its group when something is taken of them, else one. A note for each
/// point that several nodes are equally near to. None of references, and of probes in cells.
std::vector<std::vector<mesh::NodeIndex>> make_probe_nodes(const study::Study& study, const mesh::Mesh& mesh,
                                                           const domain::DofMap& dofs,
                                                           std::span<const Reference> references,
                                                           std::vector<Fault>& faults,
                                                           std::vector<std::string>& notes);

/// The cells of those probes that have values in cells: of their group, or the one of the Gauss point nearest
/// to a place, with a note when several are equally near.
std::vector<ProbedCells> make_probe_cells(const study::Study& study, const mesh::Mesh& mesh,
                                          const domain::Bulk& bulk, std::vector<Fault>& faults,
                                          std::vector<std::string>& notes);

/// Faults for probes and tables of contact zones, and for tables of groups, that there are not.
void check_probed_zones(const Model& model, std::vector<Fault>& faults);

/// The cuts of those probes that are sections, empty ones for the others.
std::vector<domain::CutForces> make_probe_cuts(const study::Study& study, const mesh::Mesh& mesh,
                                               const domain::DofMap& dofs, const domain::Bulk& bulk,
                                               const domain::Heat* heat, std::vector<Fault>& faults,
                                               std::span<const PreloadedCut> preloads = {});

/// Adds the forces of preloads that are given by a force and not locked in the stage.
void add_preload_forces(Model& model, const Stage& stage);
/// Whether a preload is locked in a stage.
bool is_locked(const study::Preload& preload, const Stage& stage);

/// Faults for checks on groups or nodes that there are not.
void check_compared_places(const study::Study& study, const mesh::Mesh& mesh, std::vector<Fault>& faults);

/// A static run needs bodies that cannot move as rigid ones: supports must hold them, or contact with what is
/// held.
void check_supported(const Model& model, std::vector<Fault>& faults);

/// A run with inertia needs a positive density wherever nodes can move: faults for cells without one whose
/// nodes are not all held in every component.
void check_masses(const Model& model, std::vector<Fault>& faults);

/// A name that must mean something in the mesh, and the path of the value of the study that has it.
struct Mention {
  std::string name;
  std::string path;
};

/// The cells of a group, or a fault that names the nearest group; nullptr then.
const mesh::Group* cells_named(const mesh::Mesh& mesh, const Mention& name, std::vector<Fault>& faults);

/// The nodes of a group or a numbered node; empty and a fault when there is none.
std::vector<mesh::NodeIndex> nodes_or_fault(const mesh::Mesh& mesh, const Mention& name,
                                            std::vector<Fault>& faults);

/// Those of them that deforming cells have; empty and a fault when there is none. `use` completes "expected a
/// part of a body …".
std::vector<mesh::NodeIndex> body_nodes_or_fault(const mesh::Mesh& mesh, const domain::DofMap& dofs,
                                                 const Mention& name, std::string_view use,
                                                 std::vector<Fault>& faults);

/// The function of that name; nothing when the name is empty.
std::optional<Function> function_named(const study::Study& study, const std::string& name);

} // namespace rubato::model
