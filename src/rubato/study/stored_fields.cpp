// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/study/stored_fields.hpp"

namespace rubato::study {

std::vector<StoredField> stored_fields(int dimension) {
  const bool flat = dimension == 2;
  const auto axes = flat ? std::vector<std::string>{"x", "y"} : std::vector<std::string>{"x", "y", "z"};
  return {{"displacement", axes},
          {"velocity", axes},
          {"acceleration", axes},
          {"stress", {"xx", "yy", "zz", "xy", "yz", "xz"}},
          {"von_mises", {}},
          {"contact_pressure", {}},
          {"contact_gap", {}},
          {"contact_slip", flat ? std::vector<std::string>{"t"} : std::vector<std::string>{"t1", "t2"}},
          {"contact_status", {}}};
}

} // namespace rubato::study
