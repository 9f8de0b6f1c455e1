// SPDX-License-Identifier: LGPL-3.0-or-later
// Materials, supports, loads, relations and parts that are no cells.
#include "record.hpp"

namespace rubato::python {

using namespace study;

template <> struct Description<CylindricalAxes> {
  static constexpr std::string_view name = "CylindricalAxes";
  static constexpr std::string_view meaning =
      "Axes that turn with the place about a line: x' points away from it, y' around it, z' along it.";
  static constexpr auto members =
      std::tuple(Member{"point", &CylindricalAxes::point, "of the line [length]"},
                 Member{"direction", &CylindricalAxes::direction, "of any length > 0; in the plane z"});
};
template struct RecordCodec<CylindricalAxes>;

template <> struct Description<Orthotropy> {
  static constexpr std::string_view name = "Orthotropy";
  static constexpr std::string_view meaning =
      "Orthotropic elasticity: moduli along axes x', y', z' and the turn of these.";
  static constexpr auto members = std::tuple(
      Member{"young_x", &Orthotropy::young_x, "> 0 [pressure]"},
      Member{"young_y", &Orthotropy::young_y, "> 0 [pressure]"},
      Member{"young_z", &Orthotropy::young_z, "> 0 [pressure]; not in plane stress"},
      Member{"poisson_xy", &Orthotropy::poisson_xy, "-eps_yy/eps_xx under a stress along x'"},
      Member{"poisson_yz", &Orthotropy::poisson_yz, "-eps_zz/eps_yy under a stress along y'"},
      Member{"poisson_xz", &Orthotropy::poisson_xz, "-eps_zz/eps_xx under a stress along x'"},
      Member{"shear_xy", &Orthotropy::shear_xy, "> 0 [pressure]"},
      Member{"shear_yz", &Orthotropy::shear_yz, "> 0, of solids [pressure]"},
      Member{"shear_xz", &Orthotropy::shear_xz, "> 0, of solids [pressure]"},
      Member{"angle_z", &Orthotropy::angle_z, "turn about z, the first [degrees]"},
      Member{"angle_y", &Orthotropy::angle_y, "then about the new y [degrees]"},
      Member{"angle_x", &Orthotropy::angle_x, "then about the new x [degrees]"},
      Member{"cylindrical", &Orthotropy::cylindrical, "axes that the angles turn; None: those of the model"});
};
template struct RecordCodec<Orthotropy>;

template <> struct Description<DampingRatios> {
  static constexpr std::string_view name = "DampingRatios";
  static constexpr std::string_view meaning =
      "Parts of critical damping at two frequencies, from which Rayleigh's coefficients follow.";
  static constexpr auto members =
      std::tuple(Member{"ratio", &DampingRatios::ratio, "each at least 0"},
                 Member{"at", &DampingRatios::at, "two different frequencies > 0 [1/time]"});
};
template struct RecordCodec<DampingRatios>;

template <> struct Description<ModalDamping> {
  static constexpr std::string_view name = "ModalDamping";
  static constexpr std::string_view meaning =
      "Damping of the lowest natural modes of the bodies without contact.";
  static constexpr auto members = std::tuple(
      Member{"modes", &ModalDamping::modes, "at least 1"},
      Member{"ratios", &ModalDamping::ratios, "parts of critical damping, one for all modes or one each"});
};
template struct RecordCodec<ModalDamping>;

template <> struct Description<ThermalExpansion> {
  static constexpr std::string_view name = "ThermalExpansion";
  static constexpr std::string_view meaning =
      "Strains along (T - reference) of a material that nothing stresses.";
  static constexpr auto members = std::tuple(
      Member{"along", &ThermalExpansion::along,
             "of the axes of the material, all three equal when elastic "
             "[1/temperature]"},
      Member{"reference", &ThermalExpansion::reference, "temperature at which nothing is expanded"});
};
template struct RecordCodec<ThermalExpansion>;

template <> struct Description<BackStress> {
  static constexpr std::string_view name = "BackStress";
  static constexpr std::string_view meaning = "A term of kinematic hardening, 2/3 C alpha.";
  static constexpr auto members = std::tuple(
      Member{"modulus", &BackStress::modulus, "C, at least 0 [pressure]"},
      Member{"recall", &BackStress::recall, "gamma of Armstrong and Frederick, at least 0; 0: Prager's"});
};
template struct RecordCodec<BackStress>;

template <> struct Description<Plasticity> {
  static constexpr std::string_view name = "Plasticity";
  static constexpr std::string_view meaning =
      "The yield surface of von Mises, how it grows and how it moves.";
  static constexpr auto members = std::tuple(
      Member{"hardening", &Plasticity::hardening, "how the yield stress R grows with plastic strain p"},
      Member{"yield_stress", &Plasticity::yield_stress,
             "> 0 [pressure]; tables have it in their first point"},
      Member{"modulus", &Plasticity::modulus, "linear, voce: slope of R, at least 0 [pressure]"},
      Member{"points", &Plasticity::points, "table: (p, R); tension_table: (strain, stress)"},
      Member{"saturation", &Plasticity::saturation,
             "voce: Q of R = yield_stress + Q (1 - exp(-b p)) + modulus p, at least 0 [pressure]"},
      Member{"rate", &Plasticity::rate, "voce: b, at least 0"},
      Member{"factor", &Plasticity::factor,
             "johnson_cook: B of (yield_stress + B p^n)(1 + C ln(rate/reference_rate)) [pressure]"},
      Member{"exponent", &Plasticity::exponent, "johnson_cook: n > 0"},
      Member{"rate_factor", &Plasticity::rate_factor, "johnson_cook: C, at least 0"},
      Member{"reference_rate", &Plasticity::reference_rate, "johnson_cook: > 0 [1/time]"},
      Member{"kinematic", &Plasticity::kinematic, "at most three back stresses"});
};
template struct RecordCodec<Plasticity>;

template <> struct Description<PronyTerm> {
  static constexpr std::string_view name = "PronyTerm";
  static constexpr std::string_view meaning = "A shear modulus that relaxes.";
  static constexpr auto members =
      std::tuple(Member{"shear", &PronyTerm::shear, "> 0 [pressure]"},
                 Member{"time", &PronyTerm::time, "in which it relaxes, > 0 [time]"});
};
template struct RecordCodec<PronyTerm>;

template <> struct Description<OgdenTerm> {
  static constexpr std::string_view name = "OgdenTerm";
  static constexpr std::string_view meaning = "A term of Ogden's law.";
  static constexpr auto members =
      std::tuple(Member{"shear", &OgdenTerm::shear, "its part of the shear modulus [pressure]"},
                 Member{"exponent", &OgdenTerm::exponent, "of the principal stretches, not 0"});
};
template struct RecordCodec<OgdenTerm>;

template <> struct Description<Hyperelasticity> {
  static constexpr std::string_view name = "Hyperelasticity";
  static constexpr std::string_view meaning = "The stored energy of rubber.";
  static constexpr auto members = std::tuple(
      Member{"c10", &Hyperelasticity::c10, "hyperelastic, yeoh: of I1 - 3 [pressure]"},
      Member{"c01", &Hyperelasticity::c01, "hyperelastic: of I2 - 3 [pressure]; 0: neo-Hookean"},
      Member{"c20", &Hyperelasticity::c20, "yeoh: of (I1 - 3)^2 [pressure]"},
      Member{"c30", &Hyperelasticity::c30, "yeoh: of (I1 - 3)^3, at least 0 [pressure]"},
      Member{"terms", &Hyperelasticity::terms, "ogden"},
      Member{"bulk", &Hyperelasticity::bulk, "bulk modulus > 0 [pressure]; None: by poisson of the material"},
      Member{"volume", &Hyperelasticity::volume, "energy of changes of volume"});
};
template struct RecordCodec<Hyperelasticity>;

template <> struct Description<Material> {
  static constexpr std::string_view name = "Material";
  static constexpr std::string_view meaning = "A material and the cells that have it.";
  static constexpr auto members = std::tuple(
      Member{"name", &Material::name, "of the material"},
      Member{"law", &Material::law, "stresses from strains"},
      Member{"young", &Material::young, "elastic, plastic, prony (after a long time): > 0 [pressure]"},
      Member{"poisson", &Material::poisson,
             "likewise, and of hyperelastic laws without bulk: above -1, below 0.5"},
      Member{"orthotropy", &Material::orthotropy, "orthotropic: its numbers"},
      Member{"plasticity", &Material::plasticity, "plastic: its numbers"},
      Member{"prony", &Material::prony, "prony: its terms"},
      Member{"hyperelasticity", &Material::hyperelasticity, "hyperelastic, yeoh, ogden: their numbers"},
      Member{"strain", &Material::strain, "None: small, and green_lagrange of hyperelastic laws"},
      Member{"formulation", &Material::formulation,
             "None: mean_dilatation of plastic and hyperelastic cells, but not of TRIA3, TETRA4 and pyramids "
             "and "
             "not in plane stress, else full"},
      Member{"density", &Material::density, "at least 0 [mass/volume]; None: it has none"},
      Member{
          "in_place", &Material::in_place,
          "numbers of the law and \"density\" that depend on the undeformed place, by their keys: they count "
          "instead of the members"},
      Member{"rayleigh_stiffness", &Material::rayleigh_stiffness, "of the stiffness in the damping [time]"},
      Member{"rayleigh_mass", &Material::rayleigh_mass, "of the mass in the damping [1/time]"},
      Member{"damping", &Material::damping, "instead of the two coefficients"},
      Member{"expansion", &Material::expansion, "by temperature"},
      Member{"everywhere", &Material::everywhere, "whether all cells have it"},
      Member{"cells", &Material::cells, "groups of cells, when not everywhere"});
};
template struct RecordCodec<Material>;

template <> struct Description<ObliqueSupport> {
  static constexpr std::string_view name = "ObliqueSupport";
  static constexpr std::string_view meaning =
      "A direction across the axes along which a displacement is held or imposed.";
  static constexpr auto members = std::tuple(
      Member{"normal", &ObliqueSupport::normal, "along the outward normal of the faces of the group"},
      Member{"direction", &ObliqueSupport::direction, "else along this one, of any length > 0"},
      Member{"value", &ObliqueSupport::value, "[length]"});
};
template struct RecordCodec<ObliqueSupport>;

template <> struct Description<Rotation> {
  static constexpr std::string_view name = "Rotation";
  static constexpr std::string_view meaning =
      "A rigid rotation about a line that stays where it is, by an angle that changes with time.";
  static constexpr auto members =
      std::tuple(Member{"about", &Rotation::about, "a place on the line [length]"},
                 Member{"axis", &Rotation::axis, "along the line, of any length > 0; in the plane z"},
                 Member{"angle", &Rotation::angle, "by the right-hand rule [radians], without the place"});
};
template struct RecordCodec<Rotation>;

template <> struct Description<Support> {
  static constexpr std::string_view name = "Support";
  static constexpr std::string_view meaning = "Displacements that are held at 0 or imposed.";
  static constexpr auto members = std::tuple(
      Member{"on", &Support::on, "a group, a node or a reference"},
      Member{"components", &Support::components, "displacement along each axis [length]; None: free"},
      Member{"along", &Support::along, "a direction across the axes"},
      Member{"turns", &Support::turns, "of a reference about each axis [radians]; None: free"},
      Member{"rotate", &Support::rotate, "of every node of a group, all components held; None: not"},
      Member{"until", &Support::until, "instant at which it lets go [time]; None: never"});
};
template struct RecordCodec<Support>;

template <> struct Description<BaseMotion> {
  static constexpr std::string_view name = "BaseMotion";
  static constexpr std::string_view meaning =
      "How the ground moves that supports, obstacles and springs stand on.";
  static constexpr auto members = std::tuple(
      Member{"components", &BaseMotion::components, "along each axis, numbers or expressions of t"},
      Member{"frame", &BaseMotion::frame, "where displacements are counted from"});
};
template struct RecordCodec<BaseMotion>;

template <> struct Description<Load> {
  static constexpr std::string_view name = "Load";
  static constexpr std::string_view meaning = "A force on bodies.";
  static constexpr auto members = std::tuple(
      Member{"kind", &Load::kind,
             "nodal_force [force], moment [force length], line_force [force/length], "
             "surface_force and pressure [force/area], gravity [acceleration]"},
      Member{"on", &Load::on, "a group, a node or a reference; gravity: empty for every cell"},
      Member{"components", &Load::components,
             "along each axis; pressure: the first, > 0 pushes into the body"},
      Member{"function", &Load::function, "name of a function of time that multiplies them; empty: 1"},
      Member{"follower", &Load::follower, "pressure: turns and grows with the faces"});
};
template struct RecordCodec<Load>;

template <> struct Description<Springs> {
  static constexpr std::string_view name = "Springs";
  static constexpr std::string_view meaning = "Springs between the nodes of a group and the ground.";
  static constexpr auto members = std::tuple(
      Member{"on", &Springs::on, "a group or a node"},
      Member{"stiffness", &Springs::stiffness, "of each node along each axis [force/length], 0: none"});
};
template struct RecordCodec<Springs>;

template <> struct Description<Connector> {
  static constexpr std::string_view name = "Connector";
  static constexpr std::string_view meaning = "A spring and a dashpot side by side.";
  static constexpr auto members = std::tuple(
      Member{"on", &Connector::on, "a node or a reference; to the ground also a group"},
      Member{"to", &Connector::to, "a node or a reference; empty: the ground"},
      Member{"along", &Connector::along, "direction of any length > 0; None: from one place to the other"},
      Member{"rotates", &Connector::rotates, "whether it acts along the current line between its ends"},
      Member{"anchor", &Connector::anchor, "place of the end at the ground where it rotates [length]"},
      Member{"stiffness", &Connector::stiffness, "at least 0 [force/length]"},
      Member{"damping", &Connector::damping, "at least 0 [force time/length]"},
      Member{"force", &Connector::force,
             "instead of the stiffness: force [force] against elongation [length]"},
      Member{"damper", &Connector::damper,
             "instead of the damping: force [force] by the rate of elongation"});
};
template struct RecordCodec<Connector>;

template <> struct Description<PointMasses> {
  static constexpr std::string_view name = "PointMasses";
  static constexpr std::string_view meaning = "Masses at the nodes of a group, or of a reference.";
  static constexpr auto members =
      std::tuple(Member{"on", &PointMasses::on, "a group, a node or a reference"},
                 Member{"mass", &PointMasses::mass, "of each node, at least 0 [mass]"},
                 Member{"inertia", &PointMasses::inertia, "of a reference, about the axes [mass length^2]"});
};
template struct RecordCodec<PointMasses>;

template <> struct Description<RelationTerm> {
  static constexpr std::string_view name = "RelationTerm";
  static constexpr std::string_view meaning = "A sum of coefficients times displacements of one node.";
  static constexpr auto members =
      std::tuple(Member{"on", &RelationTerm::on, "a node, or a group of one"},
                 Member{"coefficients", &RelationTerm::coefficients, "of the displacement along each axis"});
};
template struct RecordCodec<RelationTerm>;

template <> struct Description<Relation> {
  static constexpr std::string_view name = "Relation";
  static constexpr std::string_view meaning = "What ties displacements to one another, exactly.";
  static constexpr auto members = std::tuple(
      Member{"name", &Relation::name, "of the relation, and of its reference"},
      Member{"kind", &Relation::kind, "what it says"}, Member{"terms", &Relation::terms, "equation: its sum"},
      Member{"value", &Relation::value, "equation: of the sum"},
      Member{"on", &Relation::on, "group of the others; embedded: none with at"},
      Member{"with_", &Relation::with, "pairs: the other group"},
      Member{"components", &Relation::components, "equal, pairs: the axes that are meant"},
      Member{"difference", &Relation::difference, "pairs: displacement of on less that of with_ [length]"},
      Member{"cells", &Relation::cells, "embedded: group of the cells; empty: all"},
      Member{"at", &Relation::at, "place of the reference [length]; None: the mean of the group's nodes"});
};
template struct RecordCodec<Relation>;

template <> struct Description<Temperature> {
  static constexpr std::string_view name = "Temperature";
  static constexpr std::string_view meaning =
      "The temperature of nodes; the last entry counts where they share some.";
  static constexpr auto members = std::tuple(Member{"on", &Temperature::on, "a group, a node, or \"all\""},
                                             Member{"value", &Temperature::value, "[temperature]"});
};
template struct RecordCodec<Temperature>;

template <> struct Description<InitialMotion> {
  static constexpr std::string_view name = "InitialMotion";
  static constexpr std::string_view meaning = "Where nodes are and how they move when the run begins.";
  static constexpr auto members =
      std::tuple(Member{"on", &InitialMotion::on, "a group, a node, or \"all\""},
                 Member{"displacement", &InitialMotion::displacement,
                        "along each axis [length]; None: 0 or the support's"},
                 Member{"velocity", &InitialMotion::velocity,
                        "along each axis [length/time]; None: 0 or the support's"});
};
template struct RecordCodec<InitialMotion>;

std::vector<RecordEntry> solid_records() {
  return {record_entry<CylindricalAxes>(),  record_entry<Orthotropy>(),
          record_entry<DampingRatios>(),    record_entry<ModalDamping>(),
          record_entry<ThermalExpansion>(), record_entry<BackStress>(),
          record_entry<Plasticity>(),       record_entry<PronyTerm>(),
          record_entry<OgdenTerm>(),        record_entry<Hyperelasticity>(),
          record_entry<Material>(),         record_entry<ObliqueSupport>(),
          record_entry<Rotation>(),         record_entry<Support>(),
          record_entry<BaseMotion>(),       record_entry<Load>(),
          record_entry<Springs>(),          record_entry<Connector>(),
          record_entry<PointMasses>(),      record_entry<RelationTerm>(),
          record_entry<Relation>(),         record_entry<Temperature>(),
          record_entry<InitialMotion>()};
}

} // namespace rubato::python
