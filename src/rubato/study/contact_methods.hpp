// SPDX-License-Identifier: LGPL-3.0-or-later
/// What sets the methods of contact and friction and the places of contact points apart: a row each. Rules,
/// deck and solver ask the rows.
#pragma once

#include "rubato/study/number.hpp"
#include "rubato/study/study.hpp"

#include <array>
#include <span>
#include <string_view>

namespace rubato::study {

/// Multipliers that a method adds to a slave node, and how its forces are measured.
struct ContactMethodEntry {
  ContactMethod method;
  std::string_view name;
  std::string_view code_aster;
  std::string_view summary;
  bool exact;            ///< gaps close exactly, by a multiplier λ; else its springs are part of the answer
  bool nodal;            ///< one relation a slave node without regard to areas, held while Newton iterates
  bool exact_prediction; ///< Newton starts from exact forces: of all zones together, without friction
  bool between_nodes;    ///< takes points between the nodes
  Iteration geometry;    ///< how it follows the surfaces unless the study says so
  bool status_loop;      ///< takes statuses from a loop
  bool explicit_steps;   ///< forces follow from the motion alone
  bool impulses;         ///< forces may be impulses
  ContactMethod softer;  ///< the one whose gaps need not close
  std::array<FrictionMethod, 2> friction;       ///< the methods it goes with, the usual one first
  std::span<const Number<ContactZone>> numbers; ///< its coefficients
};

/// c or k_n.
inline constexpr std::array stiffness_numbers{number<ContactZone, &ContactZone::normal_coefficient>(
    "normal",
    "augmentation or stiffness of contact [force/length³; nodal methods force/length]; chosen at each point "
    "when not given",
    above(0))};
inline constexpr std::array exponential_numbers{
    number<ContactZone, &ContactZone::pressure>(
        "pressure", "exponential: the pressure at gap 0 [force/length²]", above(0), true),
    number<ContactZone, &ContactZone::clearance>(
        "clearance", "exponential: the gap at which pressure begins [length]", above(0), true)};

struct FrictionMethodEntry {
  FrictionMethod method;
  std::string_view name;
  std::string_view code_aster;
  std::string_view summary;
  bool exact;          ///< sticks exactly, by semi-multipliers Λ; else its springs are part of the answer
  bool nodal;          ///< a spring a slave node that the pressure does not change
  bool explicit_steps; ///< forces follow from the motion alone
};

inline constexpr std::array<ContactMethodEntry, 6> contact_methods{{
    {.method = ContactMethod::augmented_lagrangian,
     .name = "augmented_lagrangian",
     .code_aster = "CONTINUE, ALGO_CONT='STANDARD'",
     .summary = "exact contact by pressures on the slave side",
     .exact = true,
     .nodal = false,
     .exact_prediction = false,
     .between_nodes = true,
     .geometry = Iteration::newton,
     .status_loop = true,
     .explicit_steps = false,
     .impulses = true,
     .softer = ContactMethod::penalty,
     .friction = {FrictionMethod::augmented_lagrangian, FrictionMethod::penalty},
     .numbers = stiffness_numbers},
    {.method = ContactMethod::penalty,
     .name = "penalty",
     .code_aster = "CONTINUE, ALGO_CONT='PENALISATION'",
     .summary = "pressure grows with penetration",
     .exact = false,
     .nodal = false,
     .exact_prediction = false,
     .between_nodes = true,
     .geometry = Iteration::newton,
     .status_loop = true,
     .explicit_steps = true,
     .impulses = false,
     .softer = ContactMethod::penalty,
     .friction = {FrictionMethod::penalty, FrictionMethod::augmented_lagrangian},
     .numbers = stiffness_numbers},
    {.method = ContactMethod::nodal_lagrange,
     .name = "nodal_lagrange",
     .code_aster = "DISCRETE, ALGO_CONT='LAGRANGIEN'",
     .summary = "exact contact by one force a slave node",
     .exact = true,
     .nodal = true,
     .exact_prediction = false,
     .between_nodes = false,
     .geometry = Iteration::fixed_point,
     .status_loop = true,
     .explicit_steps = false,
     .impulses = true,
     .softer = ContactMethod::nodal_penalty,
     .friction = {FrictionMethod::nodal_penalty, FrictionMethod::nodal_penalty},
     .numbers = stiffness_numbers},
    {.method = ContactMethod::nodal_penalty,
     .name = "nodal_penalty",
     .code_aster = "DISCRETE, ALGO_CONT='PENALISATION'",
     .summary = "a slave node's force grows with penetration",
     .exact = false,
     .nodal = true,
     .exact_prediction = false,
     .between_nodes = false,
     .geometry = Iteration::fixed_point,
     .status_loop = true,
     .explicit_steps = false,
     .impulses = false,
     .softer = ContactMethod::nodal_penalty,
     .friction = {FrictionMethod::nodal_penalty, FrictionMethod::nodal_penalty},
     .numbers = stiffness_numbers},
    {.method = ContactMethod::nodal_pcg,
     .name = "nodal_pcg",
     .code_aster = "DISCRETE, ALGO_CONT='GCP'",
     .summary = "nodal_lagrange without friction by projected conjugate gradients",
     .exact = true,
     .nodal = true,
     .exact_prediction = true,
     .between_nodes = false,
     .geometry = Iteration::fixed_point,
     .status_loop = false,
     .explicit_steps = false,
     .impulses = true,
     .softer = ContactMethod::nodal_penalty,
     .friction = {FrictionMethod::nodal_penalty, FrictionMethod::nodal_penalty},
     .numbers = stiffness_numbers},
    {.method = ContactMethod::exponential,
     .name = "exponential",
     .code_aster = "",
     .summary = "pressure grows exponentially, from a clearance on",
     .exact = false,
     .nodal = false,
     .exact_prediction = false,
     .between_nodes = true,
     .geometry = Iteration::newton,
     .status_loop = true,
     .explicit_steps = false,
     .impulses = false,
     .softer = ContactMethod::exponential,
     .friction = {FrictionMethod::penalty, FrictionMethod::augmented_lagrangian},
     .numbers = exponential_numbers},
}};

inline constexpr std::array<FrictionMethodEntry, 3> friction_methods{{
    {.method = FrictionMethod::augmented_lagrangian,
     .name = "augmented_lagrangian",
     .code_aster = "CONTINUE, ALGO_FROT='STANDARD'",
     .summary = "exact stick and slip by multipliers",
     .exact = true,
     .nodal = false,
     .explicit_steps = false},
    {.method = FrictionMethod::penalty,
     .name = "penalty",
     .code_aster = "CONTINUE, ALGO_FROT='PENALISATION'",
     .summary = "friction grows with slip up to Coulomb's limit",
     .exact = false,
     .nodal = false,
     .explicit_steps = true},
    {.method = FrictionMethod::nodal_penalty,
     .name = "nodal_penalty",
     .code_aster = "DISCRETE, ALGO_FROT='PENALISATION'",
     .summary = "a slave node's spring since the start of the step, up to Coulomb's limit",
     .exact = false,
     .nodal = true,
     .explicit_steps = false},
}};

struct ContactIntegrationEntry {
  ContactIntegration method;
  std::string_view name;
  std::string_view code_aster;
  std::string_view summary;
  int most_order;      ///< orders go from 1 to that; 0: it has none
  bool explicit_steps; ///< forces of single points follow from the motion alone
  bool chooses_normal; ///< normals may be the master's, the slave's or their average
  bool ties;           ///< each slave node may have relations of its own in every direction
};

inline constexpr std::array<ContactIntegrationEntry, 4> contact_integrations{{
    {.method = ContactIntegration::nodes,
     .name = "nodes",
     .code_aster = "INTEGRATION='AUTO'",
     .summary = "contact points on the slave nodes",
     .most_order = 0,
     .explicit_steps = true,
     .chooses_normal = true,
     .ties = true},
    {.method = ContactIntegration::gauss,
     .name = "gauss",
     .code_aster = "INTEGRATION='GAUSS'",
     .summary = "n Gauss points a direction",
     .most_order = 7,
     .explicit_steps = true,
     .chooses_normal = true,
     .ties = false},
    {.method = ContactIntegration::simpson,
     .name = "simpson",
     .code_aster = "INTEGRATION='SIMPSON'",
     .summary = "ends and middles of n parts a direction",
     .most_order = 4,
     .explicit_steps = true,
     .chooses_normal = true,
     .ties = false},
    {.method = ContactIntegration::mortar,
     .name = "mortar",
     .code_aster = "ALGO_CONT='LAC'",
     .summary = "segment-to-segment integrals, a pressure a slave node",
     .most_order = 0,
     .explicit_steps = false,
     .chooses_normal = false,
     .ties = true},
}};

/// Rows stand in the order of the methods.
constexpr const ContactMethodEntry& entry_of(ContactMethod method) {
  return contact_methods[static_cast<std::size_t>(method)];
}
constexpr const FrictionMethodEntry& entry_of(FrictionMethod method) {
  return friction_methods[static_cast<std::size_t>(method)];
}

constexpr const ContactIntegrationEntry& entry_of(ContactIntegration integration) {
  return contact_integrations[static_cast<std::size_t>(integration)];
}

/// The friction method that goes with a contact method where none is asked for.
constexpr FrictionMethod usual_friction_method(ContactMethod method) {
  return entry_of(method).friction.front();
}

/// Where the contact points of a zone stand where nothing is asked for. By mortar pressures depend neither on
/// how the two meshes meet nor much on which side is the slave. An obstacle has no mesh: before it points
/// stand on the nodes, with its curvature in the tangent. So they do where mortar is not possible: for nodal
/// methods, explicit steps and where the surface of the normal is chosen. Ties take mortar in any case.
constexpr ContactRule usual_integration(const ContactZone& zone, SchemeKind scheme) {
  const auto& mortar = entry_of(ContactIntegration::mortar);
  const bool own_normal = zone.normal != ContactNormal::master ||
                          zone.clamped_normal != ClampedNormal::projection || zone.smoothing;
  const bool possible = entry_of(zone.method).between_nodes &&
                        (mortar.explicit_steps || !is_explicit(scheme)) &&
                        (mortar.chooses_normal || !own_normal);
  const bool meshed = !zone.obstacle;
  return {zone.tie || (possible && meshed) ? ContactIntegration::mortar : ContactIntegration::nodes, 0};
}

} // namespace rubato::study
