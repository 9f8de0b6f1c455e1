// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/mesh/io/other_formats.hpp"

namespace rubato::mesh {

bool are_other_formats_built_in() {
  return true;
}

} // namespace rubato::mesh
