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
  return {{"displacement", axes},
          {"velocity", axes},
          {"acceleration", axes},
          {"stress", {"xx", "yy", "zz", "xy", "yz", "xz"}},
          {"von_mises", {}},
          {"contact_pressure", {}},
          {"contact_gap", {}},
          {"contact_slip", flat ? std::vector<std::string>{"t"} : std::vector<std::string>{"t1", "t2"}},
          {"contact_status", {}},
          {"contact_cumulated_slip", {}},
          {"contact_friction_work", {}}};
}

std::vector<std::string> components_of(ProbeField field, int dimension) {
  const auto fields = stored_fields(dimension);
  const auto found = std::ranges::find(fields, word_of(probe_field_words, field), &StoredField::name);
  return found == fields.end() ? axes_of(dimension) : found->components; // reactions are not stored
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
