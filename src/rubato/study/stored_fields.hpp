// SPDX-License-Identifier: LGPL-3.0-or-later
/// What runs store, by its names: fields at nodes, columns of tables.
#pragma once

#include "rubato/study/study.hpp"

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace rubato::study {

/// Where a field has its values.
enum class FieldPlace {
  nodes,
  element_nodes, ///< of each cell its own
  gauss_points,  ///< the points of cell::stiffness_rule
  cells          ///< the mean of the points of each cell by volume
};

struct StoredField {
  std::string name;
  std::vector<std::string> components; ///< empty for a scalar
  FieldPlace place = FieldPlace::nodes;
  bool usual = true; ///< whether it is written unless the deck says otherwise
};

/// `dimension` is that of space, 2 or 3. Contact fields are there only in runs with contact.
std::vector<StoredField> stored_fields(int dimension);
/// Their names, whatever the dimension.
std::vector<std::string> stored_field_names();

/// What it is of, wherever it is: "stress" of stress_elga.
std::string_view quantity_of(const StoredField& field);

/// Whether a run writes the field.
bool is_written(const FieldOutput& output, const StoredField& field);

/// Components of what a probe has, empty for a scalar.
std::vector<std::string> components_of(ProbeField field, int dimension);
/// The same of a probe of the study; of a difference those of the probe that it begins with.
std::vector<std::string> components_of(const Probe& probe, const Study& study);
/// Of forces and their moments: force along the axes, moment about them.
std::vector<std::string> force_and_moment(int dimension);
/// Of a cut: force along the axes, moment about them, force along the normal, magnitude of the rest of it.
std::vector<std::string> cut_quantities(int dimension);
/// Whether it is a force on nodes: over a group it is summed when nothing else is asked for.
bool is_force(ProbeField field);
/// Whether references have it.
bool is_of_reference(ProbeField field);
/// Whether it is known in runs with contact only.
bool is_of_contact(ProbeField field);
/// Whether cells have it at their Gauss points.
bool is_of_cells(ProbeField field);

/// Columns of the energy ledger's table after the instant.
inline constexpr std::array<std::string_view, 18> energy_quantities{
    "kinetic",   "strain",  "external_work", "support_work", "overlap_work", "heat",
    "damping",   "contact", "friction",      "plastic",      "back_stress",  "viscous",
    "hourglass", "impact",  "numerical",     "bulk_scheme",  "unbalanced",   "balance"};
/// Columns of the table of a contact zone's resultants after the instant.
std::vector<std::string> resultant_quantities(int dimension);

} // namespace rubato::study
