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

std::vector<StoredField> stored_fields(int dimension) {
  const bool flat = dimension == 2;
  const auto axes = axes_of(dimension);
  const std::vector<std::string> tensor{"xx", "yy", "zz", "xy", "yz", "xz"};
  return {{"displacement", axes},
          {"velocity", axes},
          {"acceleration", axes},
          {"stress", tensor},
          {"von_mises", {}},
          {"reaction", axes, FieldPlace::nodes, false},
          {"internal_force", axes, FieldPlace::nodes, false},
          {"contact_force", axes, FieldPlace::nodes, false},
          {"temperature", {}},
          {"contact_pressure", {}},
          {"contact_gap", {}},
          {"contact_slip", flat ? std::vector<std::string>{"t"} : std::vector<std::string>{"t1", "t2"}},
          {"contact_status", {}},
          {"contact_cumulated_slip", {}},
          {"contact_friction_work", {}},
          {"strain", tensor, FieldPlace::nodes, false},
          {"stress_elno", tensor, FieldPlace::element_nodes, false},
          {"strain_elno", tensor, FieldPlace::element_nodes, false},
          {"stress_elga", tensor, FieldPlace::gauss_points, false},
          {"strain_elga", tensor, FieldPlace::gauss_points, false}};
}

std::vector<std::string> stored_field_names() {
  std::vector<std::string> names;
  for (const auto& field : stored_fields(3))
    names.push_back(field.name);
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
  const auto fields = stored_fields(dimension);
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
