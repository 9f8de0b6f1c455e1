// SPDX-License-Identifier: LGPL-3.0-or-later
// Time, results and the whole study.
#include "record.hpp"

namespace rubato::python {

using namespace study;

template <> struct Description<ArcLength> {
  static constexpr std::string_view name = "ArcLength";
  static constexpr std::string_view meaning =
      "Static steps along the path of equilibrium: loads without a function get a factor that is found.";
  static constexpr auto members =
      std::tuple(Member{"length", &ArcLength::length,
                        "how far the nodes move in the whole run, root mean square [length], > 0"},
                 Member{"on", &ArcLength::on, "group whose nodes are measured"});
};
template struct RecordCodec<ArcLength>;

template <> struct Description<TimeStepping> {
  static constexpr std::string_view name = "TimeStepping";
  static constexpr std::string_view meaning = "The time scheme and its instants.";
  static constexpr auto members = std::tuple(
      Member{"scheme", &TimeStepping::scheme, "how steps are made"},
      Member{"alpha", &TimeStepping::alpha, "of hht, modified_average_acceleration and wbz_alpha, at most 0"},
      Member{"beta", &TimeStepping::beta, "of newmark"}, Member{"gamma", &TimeStepping::gamma, "of newmark"},
      Member{"spectral_radius", &TimeStepping::spectral_radius, "of generalized_alpha, from 0 to 1"},
      Member{"theta", &TimeStepping::theta, "of moreau_jean, from 0.5 to 1"},
      Member{"contact_mass", &TimeStepping::contact_mass, "what the slave surfaces weigh"},
      Member{"begin", &TimeStepping::begin, "first instant [time]"},
      Member{"step", &TimeStepping::step,
             "> 0 unless instants are listed [time]; central_difference: 0 is the stable step times safety"},
      Member{"end", &TimeStepping::end, "last instant [time]"},
      Member{"instants", &TimeStepping::instants, "ascending, after begin, instead of step and end [time]"},
      Member{"stops", &TimeStepping::stops, "instants that a step must end at, too [time]"},
      Member{"safety", &TimeStepping::safety, "central_difference: part of the stable step, above 0 to 1"},
      Member{"record", &TimeStepping::record, "central_difference: time between results, > 0 [time]"},
      Member{"start", &TimeStepping::start, "how the run begins"},
      Member{"start_run", &TimeStepping::start_run, "with from_run: name of that run"},
      Member{"cut_parts", &TimeStepping::cut_parts, "parts that a step which fails is cut into"},
      Member{"cut_levels", &TimeStepping::cut_levels, "how often it is cut"},
      Member{"max_step", &TimeStepping::max_step,
             "nonlinear bodies: steps grow up to this one, > 0 [time]; None: they do not grow"},
      Member{"max_plastic_step", &TimeStepping::max_plastic_step,
             "plastic bodies: steps in which plastic strain grows by more are cut, > 0; None: any"},
      Member{"mass_scaling", &TimeStepping::mass_scaling,
             "central_difference: the step that every cell shall allow, those that do not get more mass, > 0 "
             "[time]; None: no mass is added"},
      Member{"arc_length", &TimeStepping::arc_length,
             "static, nonlinear bodies: loads without a function get a factor that is found; None: loads are "
             "what they are"});
};
template struct RecordCodec<TimeStepping>;

template <> struct Description<NewtonSettings> {
  static constexpr std::string_view name = "NewtonSettings";
  static constexpr std::string_view meaning = "When Newton's iterations end.";
  static constexpr auto members =
      std::tuple(Member{"max_iterations", &NewtonSettings::max_iterations, "a step, at least 1"},
                 Member{"residual", &NewtonSettings::residual, "relative, between 0 and 1"},
                 Member{"tangent", &NewtonSettings::tangent, "when nonlinear bodies are factored anew"});
};
template struct RecordCodec<NewtonSettings>;

template <> struct Description<Cut> {
  static constexpr std::string_view name = "Cut";
  static constexpr std::string_view meaning = "Where bodies are cut to find the force that they transmit.";
  static constexpr auto members =
      std::tuple(Member{"point", &Cut::point, "of the plane; moments are about it [length]"},
                 Member{"normal", &Cut::normal, "out of the part that the forces act on; of any length > 0"},
                 Member{"on", &Cut::on, "group of faces or nodes; empty: the plane itself"},
                 Member{"cells", &Cut::cells, "group that is cut; empty: all cells"});
};
template struct RecordCodec<Cut>;

template <> struct Description<ContactForce> {
  static constexpr std::string_view name = "ContactForce";
  static constexpr std::string_view meaning = "The force of a zone's master on its slave, and its moment.";
  static constexpr auto members = std::tuple(Member{"zone", &ContactForce::zone, "name"},
                                             Member{"about", &ContactForce::about, "of the moment [length]"});
};
template struct RecordCodec<ContactForce>;

template <> struct Description<Preload> {
  static constexpr std::string_view name = "Preload";
  static constexpr std::string_view meaning =
      "A bolt that is tightened: it is cut through, and the sides of the cut approach each other.";
  static constexpr auto members = std::tuple(
      Member{"name", &Preload::name, "of the preload"},
      Member{"cut", &Preload::cut, "the normal points towards the part that approaches"},
      Member{"by_force", &Preload::by_force, "else by the shortening"},
      Member{"value", &Preload::value, "[force] or [length], > 0 tightens"},
      Member{"lock", &Preload::lock, "instant from which on the shortening stays [time]; None: never"});
};
template struct RecordCodec<Preload>;

template <> struct Description<Probe> {
  static constexpr std::string_view name = "Probe";
  static constexpr std::string_view meaning = "A history at a node, of the nodes of a group, in a cut, of a "
                                              "contact zone, or a difference of two others.";
  static constexpr auto members = std::tuple(
      Member{"name", &Probe::name, "of the probe"},
      Member{"node", &Probe::node, "name of the node, or of the group"},
      Member{"point", &Probe::point, "instead: the node nearest to this place [length]"},
      Member{"section", &Probe::section, "instead: a cut"},
      Member{"contact", &Probe::contact, "instead: a contact zone"},
      Member{"minus", &Probe::minus, "instead: two probes, the first minus the second"},
      Member{"field", &Probe::field, "what of it"},
      Member{"take", &Probe::take, "of the nodes or cells of a group, each component by itself"},
      Member{"place", &Probe::place, "nodes, cells (the mean of each by volume) or their Gauss points"},
      Member{"about", &Probe::about, "of a sum of forces: with their moment about it [length]"});
};
template struct RecordCodec<Probe>;

template <> struct Description<PrintedTable> {
  static constexpr std::string_view name = "PrintedTable";
  static constexpr std::string_view meaning = "A table of tables.dat, in the layout of CalculiX's .dat file.";
  static constexpr auto members =
      std::tuple(Member{"of", &PrintedTable::of, "what its lines are of"},
                 Member{"on", &PrintedTable::on, "group, node or zone; empty: all of them"},
                 Member{"label", &PrintedTable::label, "that the heading has; empty: the group"},
                 Member{"quantities", &PrintedTable::quantities, "by CalculiX's words, \"U\""},
                 Member{"totals", &PrintedTable::totals, "sums beside the lines or alone"},
                 Member{"every", &PrintedTable::every, "every n-th step, and the last one; 0: none"});
};
template struct RecordCodec<PrintedTable>;

template <> struct Description<FieldOutput> {
  static constexpr std::string_view name = "FieldOutput";
  static constexpr std::string_view meaning = "Which fields a run writes, when and how.";
  static constexpr auto members =
      std::tuple(Member{"vtu", &FieldOutput::vtu, "whether to write .vtu files"},
                 Member{"med", &FieldOutput::med, "whether to write fields.med"},
                 Member{"vtkhdf", &FieldOutput::vtkhdf, "whether to write VTKHDF"},
                 Member{"frd", &FieldOutput::frd, "whether to write fields.frd (CalculiX GraphiX)"},
                 Member{"frd_binary", &FieldOutput::frd_binary, "whether that has binary numbers"},
                 Member{"step", &FieldOutput::step, "number of the step in .frd files, at least 1"},
                 Member{"only", &FieldOutput::only, "fields instead of the usual ones; empty: these"},
                 Member{"also", &FieldOutput::also, "fields beside the usual ones"},
                 Member{"digits", &FieldOutput::digits, "of numbers in .vtu and VTKHDF files, from 6 to 17"},
                 Member{"at", &FieldOutput::at, "instants [time]"},
                 Member{"every", &FieldOutput::every, "and every n-th step; 0: none"},
                 Member{"last", &FieldOutput::last, "and the last one"},
                 Member{"tables", &FieldOutput::tables, "of tables.dat"});
};
template struct RecordCodec<FieldOutput>;

template <> struct Description<CheckpointOutput> {
  static constexpr std::string_view name = "CheckpointOutput";
  static constexpr std::string_view meaning = "When the state is stored that a resumed run goes on from.";
  static constexpr auto members =
      std::tuple(Member{"at", &CheckpointOutput::at, "instants [time]"},
                 Member{"every", &CheckpointOutput::every, "and every n-th step; 0: none"},
                 Member{"last", &CheckpointOutput::last, "and when the run ends, however it does"});
};
template struct RecordCodec<CheckpointOutput>;

template <> struct Description<CheckedField> {
  static constexpr std::string_view name = "CheckedField";
  static constexpr std::string_view meaning = "A field at the nodes of a group, as a check compares it.";
  static constexpr auto members =
      std::tuple(Member{"name", &CheckedField::name, "of the field"},
                 Member{"component", &CheckedField::component, "empty: every component"},
                 Member{"on", &CheckedField::on, "a group or a node; empty: every node"});
};
template struct RecordCodec<CheckedField>;

template <> struct Description<CheckedResultant> {
  static constexpr std::string_view name = "CheckedResultant";
  static constexpr std::string_view meaning = "A resultant of a contact zone.";
  static constexpr auto members =
      std::tuple(Member{"zone", &CheckedResultant::zone, "name"},
                 Member{"quantity", &CheckedResultant::quantity, "a column of its table, \"force.x\""});
};
template struct RecordCodec<CheckedResultant>;

template <> struct Description<Check> {
  static constexpr std::string_view name = "Check";
  static constexpr std::string_view meaning = "A number that must come out.";
  static constexpr auto members =
      std::tuple(Member{"probe", &Check::probe, "name; empty when something else is checked"},
                 Member{"component", &Check::component, "of the probe; empty for scalars"},
                 Member{"energy", &Check::energy, "instead: a column of the energy ledger"},
                 Member{"resultant", &Check::resultant, "instead: of a contact zone"},
                 Member{"field", &Check::field, "instead, with a run: a field"},
                 Member{"run", &Check::run, "an earlier run, which is subtracted; empty: none"},
                 Member{"when", &Check::when, "at an instant, or where it is largest or least"},
                 Member{"at", &Check::at, "the instant [time]"},
                 Member{"reference", &Check::reference, "the number; 0 with a run"},
                 Member{"tolerance", &Check::tolerance, "of the difference, > 0"},
                 Member{"relative", &Check::relative, "whether the tolerance is a part of the reference"},
                 Member{"source", &Check::source, "of the reference"},
                 Member{"note", &Check::note, "where the number comes from"});
};
template struct RecordCodec<Check>;

template <> struct Description<Study> {
  static constexpr std::string_view name = "Study";
  static constexpr std::string_view meaning =
      "One run: all that a deck says of it. Units are the user's own, consistent ones.";
  static constexpr auto members = std::tuple(
      Member{"name", &Study::name, "of the run"}, Member{"title", &Study::title, "a sentence about it"},
      Member{"units", &Study::units, "a note about the units"},
      Member{"mesh", &Study::mesh, "file or generated bodies"},
      Member{"physics", &Study::physics, "what the bodies are"},
      Member{"thickness", &Study::thickness, "of plane stress and plane strain, > 0 [length]"},
      Member{"materials", &Study::materials, "at least one"}, Member{"supports", &Study::supports, ""},
      Member{"base_motion", &Study::base_motion, "of the ground; None: at rest"},
      Member{"preload", &Study::preload, "bolts that are tightened"},
      Member{"relations", &Study::relations, "between displacements"},
      Member{"springs", &Study::springs, "to the ground"},
      Member{"connectors", &Study::connectors, "springs and dashpots between places"},
      Member{"masses", &Study::masses, "at nodes and references"}, Member{"loads", &Study::loads, ""},
      Member{"temperatures", &Study::temperatures, "of nodes"},
      Member{"initial", &Study::initial, "motion when the run begins"},
      Member{"functions", &Study::functions, "of time, by their names"},
      Member{"modal_damping", &Study::modal_damping, "of the lowest modes; None: none"},
      Member{"contact", &Study::contact, "zones"}, Member{"time", &Study::time, "scheme and instants"},
      Member{"newton", &Study::newton, "of implicit steps"},
      Member{"solver", &Study::solver, "of implicit steps"},
      Member{"probes", &Study::probes, "histories that are recorded"},
      Member{"fields", &Study::fields, "that are written"},
      Member{"checkpoint", &Study::checkpoint, "when the state is stored"},
      Member{"checks", &Study::checks, "numbers that must come out"});
};
template struct RecordCodec<Study>;

std::vector<RecordEntry> run_records() {
  return {record_entry<ArcLength>(), record_entry<TimeStepping>(), record_entry<NewtonSettings>(),
          record_entry<Study>()};
}

std::vector<RecordEntry> result_records() {
  return {record_entry<Cut>(),
          record_entry<ContactForce>(),
          record_entry<Preload>(),
          record_entry<Probe>(),
          record_entry<PrintedTable>(),
          record_entry<FieldOutput>(),
          record_entry<CheckpointOutput>(),
          record_entry<CheckedField>(),
          record_entry<CheckedResultant>(),
          record_entry<Check>()};
}

} // namespace rubato::python
