// SPDX-License-Identifier: LGPL-3.0-or-later
/// One reader for each part of a deck. Each fills its part of the study and adds what is wrong to the faults
/// of the value; targets of faulty values keep their defaults. Words, types and keys are judged here, what
/// the values may be by study/validate.hpp.
#pragma once

#include "rubato/deck/values.hpp"

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace rubato::deck {

/// What readers must know of other parts. Unset where those were faulty: nothing is judged by them then.
struct Context {
  std::filesystem::path folder; ///< of the deck
  std::optional<study::Physics> physics;
  std::optional<study::SchemeKind> scheme;
};

void read_mesh(const Found& value, const Context& context, study::MeshSource& mesh);
/// Groups that are made, in the order of the file.
void read_groups(const Found& value, const Context& context, std::vector<study::MadeGroup>& groups);
/// The list of bodies of `mesh.generate`.
void read_bodies(const Found& value, std::vector<study::Body>& bodies);

void read_materials(const Found& value, const Context& context, std::vector<study::Material>& materials);
/// What a material has beside the numbers of its law: `hardening`, `kinematic`, `terms`, `volumetric`,
/// `strain`, `formulation`; refuses what the law does not take.
void read_law_words(MapReader& map, study::Material& material);
/// The same of a law that is not known.
void pass_law_words(MapReader& map);
/// `expansion` and `reference_temperature` of a material.
void read_expansion(MapReader& material, std::optional<study::ThermalExpansion>& expansion);
void read_temperatures(const Found& value, const Context& context,
                       std::vector<study::Temperature>& temperatures);
void read_functions(const Found& value, const Context& context, std::map<std::string, Function>& functions);
void read_supports(const Found& value, const Context& context, std::vector<study::Support>& supports);
void read_base_motion(const Found& value, const Context& context,
                      std::optional<study::BaseMotion>& base_motion);
void read_preload(const Found& value, const Context& context, std::vector<study::Preload>& preloads);
/// A plane and the cells that it cuts; who calls finishes the map.
study::Cut read_cut(MapReader& map, const Context& context);
void read_relations(const Found& value, const Context& context, std::vector<study::Relation>& relations);
void read_loads(const Found& value, const Context& context, std::vector<study::Load>& loads);
void read_modal_damping(const Found& value, std::optional<study::ModalDamping>& damping);
void read_springs(const Found& value, std::vector<study::Springs>& springs);
void read_connectors(const Found& value, const Context& context, std::vector<study::Connector>& connectors);
void read_masses(const Found& value, std::vector<study::PointMasses>& masses);
void read_initial(const Found& value, std::vector<study::InitialMotion>& initial);

/// Two numbers; nothing and a fault when the list has another length.
bool read_pair(const Found& value, std::array<double, 2>& pair);
/// Coordinates in as many directions as the physics has, at most three.
bool read_point(const Found& value, const Context& context, std::array<double, 3>& point);

/// A number, or a number times a named function of time.
study::Amplitude read_amplitude(const Value& value);
/// A number, an expression, a table along an axis or a field of a file; whether there is one that can be
/// read.
bool read_field_value(const Found& value, const Context& context, study::FieldValue& target);
/// The same, or one of them times a named function of time.
study::Field read_field(const Value& value, const Context& context);
/// The same of a displacement, for which a velocity or an acceleration may stand.
study::Field read_motion(const Value& value, const Context& context);

/// A line and an angle about it; in the plane there is one axis.
study::Rotation read_rotation(const Value& value, const Context& context);

void read_contact(const Found& value, const Context& context, std::vector<study::ContactZone>& zones);
/// The rigid surface that stands for a zone's master.
study::Obstacle read_obstacle(const Value& value, const Context& context);

/// Also tells the context the scheme.
void read_time(const Found& value, Context& context, study::TimeStepping& time);
void read_newton(const Found& value, study::NewtonSettings& newton);

void read_probes(const Found& value, const Context& context, std::vector<study::Probe>& probes);
void read_fields(const Found& value, study::FieldOutput& fields);
void read_checkpoint(const Found& value, study::CheckpointOutput& checkpoint);
void read_checks(const Found& value, std::vector<study::Check>& checks);

} // namespace rubato::deck
