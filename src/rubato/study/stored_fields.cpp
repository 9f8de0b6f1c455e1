// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/study/stored_fields.hpp"

#include "rubato/study/words.hpp"

#include <algorithm>

namespace rubato::study {
namespace {

std::vector<std::string> axes_of(int dimension) {
  return {axis_words.begin(), axis_words.begin() + dimension};
}

} // namespace

namespace {

using Names = std::vector<std::string>;

Names of_tensor() {
  return {"xx", "yy", "zz", "xy", "yz", "xz"};
}
Names of_principal() {
  return {"1", "2", "3"};
}

/// What cells have at their Gauss points.
constexpr std::array<ProbeField, 9> fields_of_cells{
    ProbeField::stress,         ProbeField::strain,
    ProbeField::plastic_strain, ProbeField::cumulated_plastic_strain,
    ProbeField::von_mises,      ProbeField::tresca,
    ProbeField::mean_stress,    ProbeField::principal_stress,
    ProbeField::temperature};

Names components_in_cells(ProbeField field) {
  switch (field) {
  case ProbeField::stress:
  case ProbeField::strain:
  case ProbeField::plastic_strain:
    return of_tensor();
  case ProbeField::principal_stress:
    return of_principal();
  default:
    return {};
  }
}

/// How Code_Aster ends the names of such fields.
struct Ending {
  FieldPlace place;
  std::string_view text;
};
constexpr std::array<Ending, 3> endings{{{FieldPlace::element_nodes, "_elno"},
                                         {FieldPlace::gauss_points, "_elga"},
                                         {FieldPlace::cells, "_elem"}}};

std::vector<StoredField> fields_at_nodes(int dimension) {
  const bool flat = dimension == 2;
  const auto axes = axes_of(dimension);
  const auto named = [](std::string name, Names components) {
    return StoredField{std::move(name), std::move(components), FieldPlace::nodes, false};
  };
  return {{"displacement", axes},
          {"velocity", axes},
          {"acceleration", axes},
          {"stress", of_tensor()},
          {"von_mises", {}},
          {"cumulated_plastic_strain", {}},
          named("reaction", axes),
          named("internal_force", axes),
          named("contact_force", axes),
          {"temperature", {}},
          {"contact_pressure", {}},
          {"contact_gap", {}},
          {"contact_slip", flat ? Names{"t"} : Names{"t1", "t2"}},
          {"contact_status", {}},
          {"contact_cumulated_slip", {}},
          {"contact_friction_work", {}},
          named("strain", of_tensor()),
          named("plastic_strain", of_tensor()),
          named("tresca", {}),
          named("mean_stress", {}),
          named("principal_stress", of_principal())};
}

} // namespace

std::vector<StoredField> stored_fields(int dimension) {
  auto fields = fields_at_nodes(dimension);
  for (const auto& ending : endings)
    for (const auto field : fields_of_cells)
      fields.push_back({std::string(word_of(probe_field_words, field)) + std::string(ending.text),
                        components_in_cells(field), ending.place, false});
  return fields;
}

std::string_view quantity_of(const StoredField& field) {
  const auto ending = std::ranges::find(endings, field.place, &Ending::place);
  const std::string_view name = field.name;
  return ending == endings.end() ? name : name.substr(0, name.size() - ending->text.size());
}

std::vector<std::string> stored_field_names() {
  static const auto names = [] { // asked for by every part of a deck that names fields
    Names found;
    for (const auto& field : stored_fields(3))
      found.push_back(field.name);
    return found;
  }();
  return names;
}

bool is_written(const FieldOutput& output, const StoredField& field) {
  const auto has = [&](const std::vector<std::string>& names) {
    return std::ranges::find(names, field.name) != names.end();
  };
  return output.only.empty() ? field.usual || has(output.also) : has(output.only);
}

std::vector<std::string> components_of(ProbeField field, int dimension) {
  if (field == ProbeField::rotation)
    return dimension == 3 ? axes_of(dimension) : std::vector<std::string>{"z"};
  const auto fields = fields_at_nodes(dimension);
  const auto found = std::ranges::find(fields, word_of(probe_field_words, field), &StoredField::name);
  return found->components;
}

std::vector<std::string> components_of(const Probe& probe, const Study& study) {
  if (!probe.minus.empty()) {
    const auto first = std::ranges::find(study.probes, probe.minus.front(), &Probe::name);
    const bool is_plain = first != study.probes.end() && first->minus.empty();
    return is_plain ? components_of(*first, study) : std::vector<std::string>{};
  }
  const int dimension = dimension_of(study.physics);
  if (probe.contact || probe.about)
    return force_and_moment(dimension);
  return probe.section ? cut_quantities(dimension) : components_of(probe.field, dimension);
}

std::vector<std::string> force_and_moment(int dimension) {
  auto quantities = axes_of(dimension);
  for (const auto& axis : dimension == 3 ? axes_of(dimension) : std::vector<std::string>{"z"})
    quantities.push_back("m" + axis);
  return quantities;
}

std::vector<std::string> cut_quantities(int dimension) {
  auto quantities = force_and_moment(dimension);
  quantities.insert(quantities.end(), {"normal", "shear"});
  return quantities;
}

bool is_force(ProbeField field) {
  return field == ProbeField::reaction || field == ProbeField::internal_force ||
         field == ProbeField::contact_force;
}

bool is_of_reference(ProbeField field) {
  return field == ProbeField::displacement || field == ProbeField::velocity ||
         field == ProbeField::acceleration || field == ProbeField::rotation;
}

bool is_of_cells(ProbeField field) {
  return std::ranges::find(fields_of_cells, field) != fields_of_cells.end();
}

bool is_of_contact(ProbeField field) {
  return word_of(probe_field_words, field).starts_with("contact_");
}

std::vector<std::string> resultant_quantities(int dimension) {
  std::vector<std::string> quantities{"in_contact", "sticking"};
  for (const auto& axis : axes_of(dimension))
    quantities.push_back("force." + axis);
  quantities.insert(quantities.end(), {"normal", "friction", "largest_pressure", "smallest_gap"});
  return quantities;
}

} // namespace rubato::study
