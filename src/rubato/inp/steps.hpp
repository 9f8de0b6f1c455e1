// SPDX-License-Identifier: LGPL-3.0-or-later
/// Inside the module only: loads and supports that go on from step to step.
#pragma once

#include "rubato/inp/reading.hpp"

#include <span>
#include <string>
#include <vector>

namespace rubato::inp {

/// How a magnitude goes: a straight line over the step in which it was given, or a curve times a factor.
struct Course {
  double from = 0;
  double to = 0;
  const Curve* curve = nullptr; ///< instead
  double scale = 1;
  double origin = 0; ///< total time at which the step began that gave it
  double rise = 0;   ///< of the straight line; 0: the whole step
};

/// A load or a support of one kind on one target.
struct Active {
  std::string key;   ///< kind, target and direction: what a later line replaces
  std::string kind;  ///< the keyword
  std::string label; ///< what of the kind: "P3", "GRAV", the axis of a force
  std::string on;
  std::vector<std::int32_t> items; ///< nodes or elements it acts on, ascending
  Course course;
  int step = 0; ///< that gave it
  Word at;
  study::LoadKind load = study::LoadKind::nodal_force;
  std::array<study::FieldValue, 3> direction{}; ///< of a load, for the magnitude 1
  bool follows = false;                         ///< a traction that turns with its surface
  int dof = 0;                                  ///< of a support: 0 to 2 displacements, 3 to 5 rotations
  std::optional<std::array<double, 3>> along;   ///< of a support across the axes: its direction
  study::Given given = study::Given::displacement;
};

enum class Procedure { none, steps, explicit_steps, dynamic, modes };

/// What is asked for of results.
struct Requests {
  std::vector<study::Probe> probes;
  study::FieldOutput fields;        ///< with the tables
  const Block* of_fields = nullptr; ///< the last request of files of fields
  std::set<study::TableOf> tables;  ///< the objects that the step has tables or histories of
};

struct Step {
  int number = 0; ///< from 1
  Word at;        ///< *STEP
  std::string name;
  Procedure procedure = Procedure::none;
  Word procedure_at;
  study::TimeStepping time;
  bool ramp = true;              ///< default of loads
  bool viscous = false;          ///< *VISCO
  bool direct = false;           ///< the file gives the increments
  double largest = 0;            ///< increment; 0: none given
  std::optional<bool> nonlinear; ///< NLGEOM of *STEP
  Word nonlinear_at;             ///< its place
  bool perturbation = false;
  ModesAsked modes;
  Requests requests;
  std::optional<bool> of_fields; ///< whether the last *OUTPUT is one of fields; none: there is none
  int output_every = 1;          ///< FREQUENCY of the last *OUTPUT of histories
};

/// What goes on from step to step.
struct History {
  bool nonlinear = false;       ///< NLGEOM, which stays on
  bool nonlinear_later = false; ///< in this step or a later one
  Word nonlinear_at;            ///< where it begins
  bool explicit_steps = false;  ///< some step is explicit
  double time = 0;              ///< total, at the begin of the step
  std::vector<Active> loads;
  std::vector<Active> supports;
  std::vector<Active> temperatures;
  std::vector<Active> before; ///< all of these at the end of the step before
  Requests requests;
  std::set<std::string> replaced_by_new; ///< keywords with OP=NEW in this step
};

// ---- keywords of a step

void read_static(Reading& reading, const Placed& placed, Step& step);
void read_visco(Reading& reading, const Placed& placed, Step& step);
void read_dynamic(Reading& reading, const Placed& placed, Step& step);
void read_frequency(Reading& reading, const Placed& placed, Step& step);

void read_boundary(Reading& reading, const Placed& placed, const Step& step, History& history);
void read_cload(Reading& reading, const Placed& placed, const Step& step, History& history);
void read_dload(Reading& reading, const Placed& placed, const Step& step, History& history);
void read_dsload(Reading& reading, const Placed& placed, const Step& step, History& history);
void read_temperature(Reading& reading, const Placed& placed, const Step& step, History& history);

void read_print(Reading& reading, const Placed& placed, Step& step);
void read_output(Reading& reading, const Placed& placed, Step& step);
void read_field_request(Reading& reading, const Placed& placed, Step& step);
/// Requests of a step replace earlier ones of the same kind: nodes, cells, faces, contact, files of fields.
/// Other earlier requests remain.
void renew_requests(Reading& reading, const Step& step, Requests& requests);
/// Sets when fields are written: at time points, at equal parts of the step, or at every n-th increment.
void read_instants(Reading& reading, const Block& block, const Step& step, study::FieldOutput& fields);
/// Instants within the step of the *TIME POINTS that a request names [total time]; none without.
std::vector<double> time_points(Reading& reading, const Block& block, const Step& step);
/// Reads the quantities of a request of fields. A note names those that are not available.
void add_field_words(Reading& reading, const Block& block, Step& step);
/// Adds probes named after the set or node. Returns false if probes do not have the quantity there.
bool add_probes(Reading& reading, const Placed& placed, const Word& set, std::string_view word, Step& step);

/// The value of an active load or support at the end of a step.
double value_at_end(const Course& course, double begin, double end);
/// Its value and the name of its function in a run from `begin` to `end`, which the study gets.
std::pair<double, std::string> value_in(study::Study& study, const Course& course, double begin, double end,
                                        int step);

/// Forces and displacements of the nodes of pre-tension sections become preloads.
void add_pretensions(Reading& reading, study::Study& study);
/// Explicit steps take contact by penalty on the nodes alone; steps beside them have it on the nodes, too.
void fit_contact(Reading& reading, study::Study& study, const History& history, const Step& step);
/// Materials get the formulations that the types of their elements have.
void fit_formulations(Reading& reading, study::Study& study, Places& places);
/// *CHANGE FRICTION, SURFACE BEHAVIOR, MATERIAL: what the keywords below it complete is looked up by it.
void read_change(Reading& reading, std::size_t index);
void read_change_plastic(Reading& reading, std::size_t index);
void read_model_change(Reading& reading, std::size_t index);
/// Zones get the numbers of interactions that have changed.
void apply_changes(Reading& reading);
/// Zones that *MODEL CHANGE has taken away stay so far apart that they never touch.
void open_removed(const Reading& reading, study::Study& study);
/// Elements that *MODEL CHANGE has taken away get a material of next to no stiffness.
void weaken_removed(Reading& reading, study::Study& study, const Step& step);
/// Zones with friction in some runs have next to none in the others: a run starts from another one only where
/// both have friction.
void keep_friction(std::vector<study::Study>& runs);

/// Gives the materials of a study, which has the loads of the step already, the numbers and strains of the
/// step.
void set_bodies(Reading& reading, study::Study& study, const History& history, const Step& step);

/// Every step as a study of its own.
void read_steps(Reading& reading, Purpose purpose, Input& input);

} // namespace rubato::inp
