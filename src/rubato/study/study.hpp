// SPDX-License-Identifier: LGPL-3.0-or-later
/// What the user asked for: plain data without behaviour, comparable, echoed whole into the results.
/// Units are the user's own, consistent ones (SI unless the deck says otherwise).
#pragma once

#include "rubato/core/function.hpp"
#include "rubato/study/discrete.hpp"
#include "rubato/study/mesh_source.hpp"
#include "rubato/study/outputs.hpp"
#include "rubato/study/relations.hpp"
#include "rubato/study/solids.hpp"
#include "rubato/study/supports.hpp"
#include "rubato/study/temperature.hpp"
#include "rubato/study/values.hpp"

#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace rubato::study {

// ---- physics ---------------------------------------------------------------------------------------------

enum class Physics { solid, plane_stress, plane_strain, axisymmetric };

/// What gives stresses from strains; study/material_laws.hpp has a row for each.
enum class LawKind { elastic, orthotropic, plastic, prony, hyperelastic, yeoh, ogden };

/// Axes that turn with the place about a line: x' points away from it, y' around it, z' along it. In the
/// plane the line stands on the plane at `point`.
struct CylindricalAxes {
  std::array<double, 3> point{};            ///< of the line [length]
  std::array<double, 3> direction{0, 0, 1}; ///< of any length > 0; in the plane z
  bool operator==(const CylindricalAxes&) const = default;
};

/// Orthotropic elasticity: moduli along axes x', y', z' and the turn of these. poisson_xy is the contraction
/// along y' under a stress along x'. Plane stress needs nothing of z', only solids need shear_yz and
/// shear_xz.
struct Orthotropy {
  double young_x = 0; ///< E_x [pressure] > 0
  double young_y = 0;
  std::optional<double> young_z;
  double poisson_xy = 0; ///< ν_xy = −ε_yy/ε_xx under σ_xx
  std::optional<double> poisson_yz;
  std::optional<double> poisson_xz;
  double shear_xy = 0; ///< G_xy [pressure] > 0
  std::optional<double> shear_yz;
  std::optional<double> shear_xz;
  double angle_z = 0; ///< [degrees] of the turn about z, the first; about the new y, about the new x
  double angle_y = 0;
  double angle_x = 0;
  /// Axes that the angles turn, at each place; those of the model when not given.
  std::optional<CylindricalAxes> cylindrical;
  bool operator==(const Orthotropy&) const = default;
};

/// Damping as parts of critical damping at two frequencies, from which Rayleigh's coefficients follow
/// (study/damping.hpp).
struct DampingRatios {
  std::array<double, 2> ratio{}; ///< ξ ≥ 0
  std::array<double, 2> at{};    ///< f > 0, two different ones [1/time]
  bool operator==(const DampingRatios&) const = default;
};

/// Damping of the lowest natural modes of the bodies, as they are without contact: parts of critical damping.
struct ModalDamping {
  int modes = 0;              ///< ≥ 1
  std::vector<double> ratios; ///< ξ ≥ 0, one for all modes or one each
  bool operator==(const ModalDamping&) const = default;
};

struct Material {
  std::string name;
  LawKind law = LawKind::elastic;
  double young = 0;                ///< elastic, plastic, prony (after a long time): E [pressure] > 0
  double poisson = 0;              ///< likewise, and of hyperelastic laws without `bulk`: −1 < ν < 0.5
  Orthotropy orthotropy;           ///< orthotropic
  Plasticity plasticity;           ///< plastic
  std::vector<PronyTerm> prony;    ///< prony
  Hyperelasticity hyperelasticity; ///< hyperelastic, yeoh, ogden
  /// small, and green_lagrange of hyperelastic laws, when not given.
  std::optional<StrainKind> strain;
  std::optional<Formulation> formulation; ///< study/formulation.hpp has the choice when not given
  std::optional<double> density;
  /// Numbers of the law, and "density", that depend on the undeformed place, by their keys: they count
  /// instead of the members.
  std::map<std::string, FieldValue> in_place;
  double rayleigh_stiffness = 0;        ///< [time]; C = rayleigh_stiffness K + rayleigh_mass M
  double rayleigh_mass = 0;             ///< [1/time]
  std::optional<DampingRatios> damping; ///< instead of the two coefficients
  std::optional<ThermalExpansion> expansion;
  bool everywhere = true;         ///< `cells: all`
  std::vector<std::string> cells; ///< groups, when not everywhere
  bool operator==(const Material&) const = default;
};

/// Where displacements are counted from.
enum class BaseFrame {
  relative, ///< the base: what it stands on is at rest, every mass has the force −m a(t)
  absolute  ///< the place where the base was: supports and obstacles move with it
};

/// How the ground moves that supports, obstacles, springs and dashpots stand on.
struct BaseMotion {
  std::array<std::optional<Field>, 3> components; ///< numbers or expressions of t
  BaseFrame frame = BaseFrame::relative;
  bool operator==(const BaseMotion&) const = default;
};

enum class LoadKind {
  nodal_force,   ///< [force] on each node of the group, or on a reference
  moment,        ///< [force · length] on a reference
  line_force,    ///< [force/length] on edges
  surface_force, ///< [force/area] on faces (2D: on edges, the thickness multiplies it)
  pressure,      ///< [force/area] on faces, positive pushes into the body
  gravity        ///< [acceleration] on the mass
};

struct Load {
  LoadKind kind = LoadKind::nodal_force;
  std::string on;                         ///< gravity: empty means every cell
  std::array<FieldValue, 3> components{}; ///< pressure: the first
  std::string function;
  bool follower = false; ///< pressure: whether it turns with the faces, else it is that of undeformed ones
  bool operator==(const Load&) const = default;
};

/// Springs between the nodes of a group and the ground, without force where the nodes are undeformed.
struct Springs {
  std::string on;
  std::array<double, 3> stiffness{}; ///< of each node's spring along an axis [force/length], 0: none
  bool operator==(const Springs&) const = default;
};

/// A bolt that is tightened: it is cut through, and the sides of the cut approach each other.
struct Preload {
  std::string name;
  Cut cut;                    ///< the normal points towards the part that approaches; `on` is empty
  bool by_force = true;       ///< else by the shortening
  Amplitude value;            ///< [force], > 0 tightens, or [length], > 0 shortens
  std::optional<double> lock; ///< instant from which on the shortening stays what it is then
  bool operator==(const Preload&) const = default;
};

/// Where nodes are and how they move when the run begins. What isn't given is 0, or the support's.
struct InitialMotion {
  std::string on;                                    ///< a group, a node, or "all"
  std::array<std::optional<double>, 3> displacement; ///< [length]
  std::array<std::optional<double>, 3> velocity;     ///< [length/time]
  bool operator==(const InitialMotion&) const = default;
};

/// `on: all`, `cells: all`.
inline constexpr std::string_view everywhere = "all";

// ---- contact ---------------------------------------------------------------------------------------------

enum class ContactMethod {
  augmented_lagrangian, ///< exact, multipliers on the slave nodes
  penalty,              ///< pressure grows with penetration
  nodal_lagrange,       ///< exact, one force a slave node
  nodal_penalty,        ///< force a slave node grows with penetration
  nodal_pcg,            ///< as nodal_lagrange without friction, by projected conjugate gradients
  exponential           ///< pressure grows exponentially, from a clearance on
};
enum class FrictionMethod {
  augmented_lagrangian, ///< semi-multipliers on the slave nodes
  penalty,              ///< μ p times a slip measured in saturation slips
  nodal_penalty         ///< spring from the start of the step, at most μ N
};
enum class ContactNormal { master, slave, average };
enum class ClampedNormal { projection, code_aster };
/// Whose law exponential pressures follow (contact/exponential.hpp).
enum class ExponentialCurve { abaqus, calculix };
enum class Iteration { newton, fixed_point };

/// One of the three nested levels: part of every Newton iteration, or a loop of its own around them.
struct Level {
  Iteration by = Iteration::newton;
  double tolerance = 0; ///< of the loop; the status has none: it must not change
  int max_loops = 0;
  bool operator==(const Level&) const = default;
};

enum class ObstacleKind { plane, cylinder, sphere };
/// Where the bodies are that an obstacle touches: around it, or in its hole.
enum class ObstacleSide { outside, inside };

/// A rigid surface given by a formula, where the deck puts it and moved from there as functions of time. In
/// plane physics a cylinder is a circle; in axisymmetric ones it has the axis of revolution.
struct Obstacle {
  ObstacleKind kind = ObstacleKind::plane;
  std::array<double, 3> point{};     ///< of the plane, of the axis, or the centre [length]
  std::array<double, 3> direction{}; ///< normal out of the plane's obstacle, or axis; of any length > 0
  double radius = 0;                 ///< > 0 unless it is a plane [length]
  ObstacleSide side = ObstacleSide::outside;
  std::array<std::optional<Amplitude>, 3> move{}; ///< [length]
  /// As a rigid body about a line; `move` is added and takes the line along.
  std::optional<Rotation> rotate = {};
  bool operator==(const Obstacle&) const = default;
};

/// Where contact points stand on a slave face.
enum class ContactIntegration {
  nodes,   ///< on the slave nodes
  gauss,   ///< Gauss points, `order` a direction
  simpson, ///< ends and middles of `order` parts a direction
  mortar   ///< a relation a slave node, from integrals over what faces of both sides share
};
struct ContactRule {
  ContactIntegration by = ContactIntegration::nodes;
  int order = 0; ///< of those that have one
  bool operator==(const ContactRule&) const = default;
};

struct ContactZone {
  std::string name;
  std::string master;               ///< empty with an obstacle
  std::optional<Obstacle> obstacle; ///< instead of a master
  std::string slave;
  /// Instead of master and slave one of these three.
  std::vector<std::string> between; ///< two surfaces; the model chooses which is the slave
  std::string self;                 ///< a surface that touches itself
  bool all = false;                 ///< every two surfaces of different bodies that can touch
  double friction = 0;              ///< Coulomb's μ ≥ 0
  /// μ ≥ 0 as a function of the undeformed place; `friction` is 1 then.
  std::optional<FieldValue> friction_in_place;
  Field interference;       ///< how much larger a body is than its mesh: taken from the gap [length], ≥ 0
  Field gap;                ///< added to the gap that the mesh has [length]
  bool bilateral = false;   ///< points that have touched at the end of a step do not open any more
  bool freeze = false;      ///< what faces what, and along which normals, is as in the undeformed bodies
  bool nodal_pairs = false; ///< slave nodes face the nearest node of their master face, along its normal
  bool tie = false;         ///< what faces each other undeformed moves together, in every direction
  ContactMethod method = ContactMethod::augmented_lagrangian;
  FrictionMethod friction_method = FrictionMethod::augmented_lagrangian;
  ContactNormal normal = ContactNormal::master;
  ClampedNormal clamped_normal = ClampedNormal::projection;
  /// True: normals are averaged at the nodes of their surface and interpolated over its faces.
  bool smoothing = false;
  ContactRule integration;
  /// How far outside a master face a point may lie that still faces it, in reference lengths of the face: a
  /// SEG or QUAD is 2 long, a TRIA 1. A quarter of a face when not given. Not of mortar.
  std::optional<double> projection_tolerance;
  std::vector<std::string> exclude_nodes;
  /// Augmentation or penalty, as the method has it; chosen per point from the effective matrix when not
  /// given.
  std::optional<double> normal_coefficient;     ///< c, k_n [pressure/length]; nodal methods [force/length]
  std::optional<double> tangential_coefficient; ///< c_t, k_t [1/length]; nodal methods [force/length]
  std::optional<double> pressure;               ///< exponential: p0 > 0 at gap 0 [pressure]
  std::optional<double> clearance; ///< exponential: c0 > 0, the gap at which pressure begins [length]
  ExponentialCurve curve = ExponentialCurve::abaqus;
  /// First guess of the contact set: nothing given means the whole surface.
  std::optional<bool> initially_active;
  Level geometry{Iteration::newton, 1e-2, 10};
  Level threshold{Iteration::newton, 1e-4, 10}; ///< of friction
  Level status{Iteration::newton, 0, 30};
  /// Whether contact forces at the start of a step enter its equilibrium with the scheme's weight.
  bool history_force = true;
  double restitution = 0; ///< schemes with jumps: part of the approach velocity that comes back, in 0…1
  bool operator==(const ContactZone&) const = default;
};

// ---- time and solver
// ---------------------------------------------------------------------------------------

enum class SchemeKind {
  newmark,
  hht,
  modified_average_acceleration,
  generalized_alpha,
  wbz_alpha,
  moreau_jean,     ///< velocities jump where bodies hit
  energy_momentum, ///< the same; elastic bodies keep energy and momenta in finite strain
  static_steps,
  central_difference
};

/// Whether steps follow from forces at their start, with nothing to solve and a largest stable length.
constexpr bool is_explicit(SchemeKind scheme) {
  return scheme == SchemeKind::central_difference;
}

/// Whether velocities jump where bodies hit: contact is a law of velocities then.
constexpr bool has_jumps(SchemeKind scheme) {
  return scheme == SchemeKind::moreau_jean || scheme == SchemeKind::energy_momentum;
}

/// What the slave surfaces weigh.
enum class ContactMass {
  consistent,   ///< what the elements give them
  redistributed ///< nothing: the inside of their bodies carries it
};

enum class StartKind {
  consistent,       ///< a0 from equilibrium, history bracket evaluated at the start (default)
  at_rest_unloaded, ///< Code_Aster's first step: history bracket taken as zero
  from_run          ///< the end of another run of the same deck
};

/// Static steps whose lengths are measured along the path of equilibrium.
struct ArcLength {
  double length = 0;     ///< of the whole run, root mean square over the nodes [length], > 0
  std::string on{"all"}; ///< group whose nodes are measured
  bool operator==(const ArcLength&) const = default;
};

struct TimeStepping {
  SchemeKind scheme = SchemeKind::moreau_jean;
  double alpha = 0;             ///< hht −1/3…0, modified_average_acceleration ≤ 0, wbz_alpha −1…0
  std::optional<double> beta;   ///< newmark only
  std::optional<double> gamma;  ///< newmark only
  double spectral_radius = 0.5; ///< generalized_alpha: ρ_∞ in 0…1
  double theta = 0.5;           ///< moreau_jean: in 1/2…1
  /// Schemes with jumps have it redistributed unless the deck says otherwise: contact never gives energy
  /// then.
  ContactMass contact_mass = ContactMass::redistributed;
  double begin = 0;
  /// > 0 unless instants are listed. central_difference: 0 stands for the stable step times `safety`.
  double step = 0;
  double end = 0;               ///< the last of the instants when they are listed
  std::vector<double> instants; ///< ascending, after begin; instead of step and end
  std::vector<double> stops;    ///< instants that a step must end at, too: those at which fields are wanted
  double safety = 0.9;          ///< central_difference: part of the stable step that is taken, in 0…1
  double record = 0;            ///< central_difference: > 0, the time between results
  StartKind start = StartKind::consistent;
  std::string start_run; ///< with from_run
  int cut_parts = 2;
  int cut_levels = 12;
  /// Nonlinear bodies: steps grow and shrink with their iterations, up to this one [time].
  std::optional<double> max_step;
  /// Nonlinear bodies: steps whose cumulated plastic strain grows by more anywhere are cut.
  std::optional<double> max_plastic_step;
  /// central_difference: cells that would allow only shorter steps get more mass, so that all of them allow
  /// this one [time].
  std::optional<double> mass_scaling;
  /// static: loads without a function are multiplied by a factor, which follows from how far the bodies are
  /// to move.
  std::optional<ArcLength> arc_length = {};
  bool operator==(const TimeStepping&) const = default;
};

/// How implicit steps are solved: with the bulk factored once a step length, whole in every iteration, or as
/// the first with conjugate gradients in place of the factor.
enum class Solver { automatic, condensed, full, iterative };

/// When nonlinear bodies have their effective matrix factored anew.
enum class TangentChoice {
  automatic, ///< when a new factor is less work than the further iterations with the old one
  full,      ///< in every iteration
  kept       ///< at the start of a step, and when an iteration leaves more than 0.3 of the residual
};

struct NewtonSettings {
  int max_iterations = 40;
  double residual = 1e-8; ///< relative, as docs/theory/time-integration.md defines it
  TangentChoice tangent = TangentChoice::automatic;
  bool operator==(const NewtonSettings&) const = default;
};

// ---- the whole -------------------------------------------------------------------------------------------

/// One run: the deck with that run's changes laid over it.
struct Study {
  std::string name; ///< of the run
  std::string title;
  std::string units = "SI";
  MeshSource mesh;
  Physics physics = Physics::solid;
  double thickness = 1; ///< plane stress and plane strain
  std::vector<Material> materials;
  std::vector<Support> supports;
  std::optional<BaseMotion> base_motion;
  std::vector<Preload> preload;
  std::vector<Relation> relations;
  std::vector<Springs> springs;
  std::vector<Connector> connectors;
  std::vector<PointMasses> masses;
  std::vector<Load> loads;
  std::vector<Temperature> temperatures;
  std::vector<InitialMotion> initial;
  std::map<std::string, Function> functions;
  std::optional<ModalDamping> modal_damping;
  std::vector<ContactZone> contact;
  TimeStepping time;
  NewtonSettings newton;
  Solver solver = Solver::automatic;
  std::vector<Probe> probes;
  FieldOutput fields;
  CheckpointOutput checkpoint;
  std::vector<Check> checks;
  bool operator==(const Study&) const = default;
};

} // namespace rubato::study
