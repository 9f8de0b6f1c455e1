// SPDX-License-Identifier: LGPL-3.0-or-later
// Contact.
#include "record.hpp"

namespace rubato::python {

using namespace study;

template <> struct Description<Level> {
  static constexpr std::string_view name = "Level";
  static constexpr std::string_view meaning =
      "One of the three nested levels: part of every Newton iteration, or a loop of its own around them.";
  static constexpr auto members =
      std::tuple(Member{"by", &Level::by, "newton or fixed_point"},
                 Member{"tolerance", &Level::tolerance, "of the loop, between 0 and 1; the status has none"},
                 Member{"max_loops", &Level::max_loops, "of the loop, at least 1"});
};
template struct RecordCodec<Level>;

template <> struct Description<Obstacle> {
  static constexpr std::string_view name = "Obstacle";
  static constexpr std::string_view meaning = "A rigid surface given by a formula.";
  static constexpr auto members = std::tuple(
      Member{"kind", &Obstacle::kind, "its shape"},
      Member{"point", &Obstacle::point, "of the plane, of the axis, or the centre [length]"},
      Member{"direction", &Obstacle::direction, "normal out of the obstacle, or axis; of any length > 0"},
      Member{"radius", &Obstacle::radius, "> 0 unless it is a plane [length]"},
      Member{"side", &Obstacle::side, "where the bodies are"},
      Member{"move", &Obstacle::move, "along each axis [length]; None: at rest"},
      Member{"rotate", &Obstacle::rotate, "about a line that move takes along, or None"});
};
template struct RecordCodec<Obstacle>;

template <> struct Description<ContactRule> {
  static constexpr std::string_view name = "ContactRule";
  static constexpr std::string_view meaning = "Where contact points stand on a slave face.";
  static constexpr auto members =
      std::tuple(Member{"by", &ContactRule::by, "nodes, gauss, simpson or mortar"},
                 Member{"order", &ContactRule::order, "of gauss and simpson: points or parts a direction"});
};
template struct RecordCodec<ContactRule>;

template <> struct Description<ContactZone> {
  static constexpr std::string_view name = "ContactZone";
  static constexpr std::string_view meaning = "Two surfaces that may touch, and how.";
  static constexpr auto members = std::tuple(
      Member{"name", &ContactZone::name, "of the zone"},
      Member{"master", &ContactZone::master, "group of faces; empty with an obstacle"},
      Member{"obstacle", &ContactZone::obstacle, "instead of a master"},
      Member{"slave", &ContactZone::slave, "group of faces"},
      Member{"between", &ContactZone::between, "instead: two surfaces; the model chooses the slave"},
      Member{"self_", &ContactZone::self, "instead: a surface that touches itself"},
      Member{"all", &ContactZone::all, "instead: every two surfaces of different bodies"},
      Member{"friction", &ContactZone::friction, "Coulomb's coefficient, at least 0"},
      Member{"friction_in_place", &ContactZone::friction_in_place,
             "the coefficient by the undeformed place; friction is 1 then"},
      Member{"interference", &ContactZone::interference, "taken from the gap, at least 0 [length]"},
      Member{"gap", &ContactZone::gap, "added to the gap that the mesh has [length]"},
      Member{"bilateral", &ContactZone::bilateral, "whether points that have touched do not open any more"},
      Member{"freeze", &ContactZone::freeze, "whether pairs and normals are those of the undeformed bodies"},
      Member{"nodal_pairs", &ContactZone::nodal_pairs,
             "whether slave nodes face the nearest node of the master"},
      Member{"tie", &ContactZone::tie, "whether what faces each other undeformed moves together"},
      Member{"method", &ContactZone::method, "of the normal direction"},
      Member{"friction_method", &ContactZone::friction_method, "of the tangential directions"},
      Member{"normal", &ContactZone::normal, "whose normals count"},
      Member{"clamped_normal", &ContactZone::clamped_normal, "of points beside the end of the master"},
      Member{"smoothing", &ContactZone::smoothing,
             "whether normals are averaged at the nodes of their surface and interpolated"},
      Member{"integration", &ContactZone::integration, "where contact points stand"},
      Member{"projection_tolerance", &ContactZone::projection_tolerance,
             "how far outside a master face points still face it, in its reference lengths; None: a quarter "
             "of it"},
      Member{"exclude_nodes", &ContactZone::exclude_nodes, "groups or nodes that are no contact points"},
      Member{
          "normal_coefficient", &ContactZone::normal_coefficient,
          "augmentation or penalty [pressure/length], nodal methods [force/length]; None: chosen per point"},
      Member{"tangential_coefficient", &ContactZone::tangential_coefficient,
             "the same along the surface [1/length], nodal methods [force/length]"},
      Member{"pressure", &ContactZone::pressure, "exponential: at gap 0, > 0 [pressure]"},
      Member{"clearance", &ContactZone::clearance, "exponential: gap at which pressure begins, > 0 [length]"},
      Member{"curve", &ContactZone::curve, "exponential: whose law the pressures follow"},
      Member{"initially_active", &ContactZone::initially_active,
             "first guess of the contact set; None: the whole surface"},
      Member{"geometry", &ContactZone::geometry, "level of pairs and normals"},
      Member{"threshold", &ContactZone::threshold, "level of friction"},
      Member{"status", &ContactZone::status, "level of the contact status"},
      Member{"history_force", &ContactZone::history_force,
             "whether contact forces at the start of a step enter its equilibrium with the scheme's weight"},
      Member{"restitution", &ContactZone::restitution,
             "moreau_jean and energy_momentum: part of the approach velocity that comes back, from 0 to 1"});
};
template struct RecordCodec<ContactZone>;

std::vector<RecordEntry> contact_records() {
  return {record_entry<Level>(), record_entry<Obstacle>(), record_entry<ContactRule>(),
          record_entry<ContactZone>()};
}

} // namespace rubato::python
