// SPDX-License-Identifier: LGPL-3.0-or-later
/// The fields that runs store at nodes, by their names.
#pragma once

#include <string>
#include <vector>

namespace rubato::study {

struct StoredField {
  std::string name;
  std::vector<std::string> components; ///< empty for a scalar
};

/// `dimension` is that of space, 2 or 3. Contact fields are there only in runs with contact.
std::vector<StoredField> stored_fields(int dimension);

} // namespace rubato::study
