// SPDX-License-Identifier: LGPL-3.0-or-later
/// What is kept of a run, and what must come out.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace rubato::study {

/// study/stored_fields.hpp has their components.
enum class ProbeField {
  displacement,
  velocity,
  acceleration,
  rotation, ///< of a reference [radians]
  reaction,
  internal_force, ///< by which cells, springs and connectors resist, as Code_Aster's FORC_NODA [force]
  contact_force,  ///< of contact on the nodes [force]
  temperature,    ///< of a study with temperatures
  stress,         ///< Cauchy's
  von_mises,
  strain, ///< that the law of the material sees
  plastic_strain,
  cumulated_plastic_strain, ///< Code_Aster's V1, Abaqus' PEEQ
  tresca,                   ///< σ₁ − σ₃
  mean_stress,              ///< a third of the trace
  principal_stress,         ///< the largest first
  contact_pressure,
  contact_gap,
  contact_slip,
  contact_status,
  contact_cumulated_slip,
  contact_friction_work
};

/// What is taken of the nodes of a group, of each component by itself; or of its cells.
enum class ProbeTake { node, sum, mean, least, largest };

/// Where a probe has its values.
enum class ProbePlace {
  nodes,
  cells,       ///< the mean of each cell by volume
  gauss_points ///< of cells
};

/// Where bodies are cut to find the force and the moment that they transmit: by a plane, between the cells
/// whose centres lie on its two sides; or at the nodes of a group, which the cells behind the plane have.
struct Cut {
  std::array<double, 3> point{};  ///< of the plane; moments are about it [length]
  std::array<double, 3> normal{}; ///< out of the part that the forces act on; of any length > 0
  std::string on;                 ///< group of faces or nodes; empty: the plane itself
  std::string cells;              ///< the group that is cut; empty: all cells
  bool operator==(const Cut&) const = default;
};

/// The force that a contact zone's master exerts on its slave, and its moment about a point.
struct ContactForce {
  std::string zone;
  std::array<double, 3> about{}; ///< [length]
  bool operator==(const ContactForce&) const = default;
};

/// A history at a node: given by name ("N90", a group of one node) or as the node nearest to a point; or of
/// the nodes of a group; or of its cells; or in a cut; or of a contact zone; or the difference of two others.
struct Probe {
  std::string name;
  std::string node; ///< or the group, when something is taken of its nodes
  std::optional<std::array<double, 3>> point;
  std::optional<Cut> section;
  std::optional<ContactForce> contact;
  std::vector<std::string> minus; ///< two other probes, the first minus the second; else empty
  ProbeField field = ProbeField::displacement;
  ProbeTake take = ProbeTake::node;     ///< `node`: there is one node
  ProbePlace place = ProbePlace::nodes; ///< else of a group of cells, or nearest to the point
  /// Of a sum of forces: their moment about this place beside it [length].
  std::optional<std::array<double, 3>> about;
  bool operator==(const Probe&) const = default;
};

/// The objects that a table has lines of.
enum class TableOf {
  nodes,
  cells, ///< their Gauss points, or each cell
  faces, ///< of a group of faces, one force
  zones  ///< points of contact
};

enum class TableTotals { none, also, only };

/// A table of tables.dat, in the layout of CalculiX's .dat file.
struct PrintedTable {
  TableOf of = TableOf::nodes;
  std::string on;                      ///< group, node or zone; empty: all of them
  std::string label;                   ///< that the heading has; empty: `on`
  std::vector<std::string> quantities; ///< by CalculiX's words: "U", "RF", "S" (table_words.hpp)
  TableTotals totals = TableTotals::none;
  int every = 1; ///< every n-th step, and the last one
  bool operator==(const PrintedTable&) const = default;
};

struct FieldOutput {
  bool vtu = false;
  bool med = false;
  bool vtkhdf = false;
  bool frd = false;
  bool frd_binary = false;          ///< else ASCII
  int step = 1;                     ///< number of the step that .frd files have
  std::vector<std::string> only;    ///< fields that are written instead of the usual ones; empty: these
  std::vector<std::string> also;    ///< fields that are written beside the usual ones
  int digits = 9;                   ///< that .vtu and VTKHDF files keep of numbers at nodes and in cells
  std::vector<double> at;           ///< instants
  int every = 0;                    ///< and every n-th step; 0: none
  bool last = true;                 ///< and the last one
  std::vector<PrintedTable> tables; ///< of tables.dat, at steps of their own
  bool operator==(const FieldOutput&) const = default;
};

/// When the state is stored that `--resume` goes on from.
struct CheckpointOutput {
  std::vector<double> at; ///< instants
  int every = 0;          ///< and every n-th step, of an explicit run every n-th record; 0: none
  bool last = true;       ///< and when the run ends, however it does
  bool operator==(const CheckpointOutput&) const = default;
};

enum class CheckSource { external, analytic, other_code, other_run };

/// A field at the nodes of a group, as a check compares it.
struct CheckedField {
  std::string name;      ///< "displacement"
  std::string component; ///< "y"; empty: every component
  std::string on;        ///< a group or a node; empty: every node
  bool operator==(const CheckedField&) const = default;
};

/// A resultant of a contact zone.
struct CheckedResultant {
  std::string zone;
  std::string quantity; ///< a column of its table, "normal", "force.x"
  bool operator==(const CheckedResultant&) const = default;
};

/// When a checked history has its value: at an instant, or where it is largest or least of the whole run.
enum class CheckedTime { instant, largest, least, largest_magnitude };

/// A number that must come out: a value of a probe, of the energy ledger or of a contact zone's resultants,
/// held against a reference; or its difference from another run's, or a field's, held against 0.
struct Check {
  std::string probe;     ///< "tip"; empty when something else is checked
  std::string component; ///< of the probe: "y", "xx"; empty for scalars
  std::string energy;    ///< a column of the energy ledger, "friction"
  std::optional<CheckedResultant> resultant;
  std::optional<CheckedField> field; ///< only with `run`
  std::string run;                   ///< an earlier run of the deck, which is subtracted; empty: none
  CheckedTime when = CheckedTime::instant;
  double at = 0;        ///< instant; without meaning for others
  double reference = 0; ///< 0 with `run`
  double tolerance = 0;
  bool relative = true; ///< to the reference; with `run` to what the other run has
  CheckSource source = CheckSource::external;
  std::string note; ///< where the number comes from
  bool operator==(const Check&) const = default;
};

} // namespace rubato::study
