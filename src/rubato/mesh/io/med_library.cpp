// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/mesh/io/med_library.hpp"

namespace rubato::mesh::med {

const Calls& library() {
  static const Calls calls{
      DynamicLibrary({.soname = RUBATO_MED_LIBRARY, .package = RUBATO_MED_PACKAGE, .users = "MED files"})};
  return calls;
}

} // namespace rubato::mesh::med
