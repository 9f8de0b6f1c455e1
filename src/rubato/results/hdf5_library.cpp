// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/results/hdf5_library.hpp"

#include "rubato/core/error.hpp"
#include "rubato/core/module_file.hpp"

#include <string>

namespace rubato::results {
namespace {

Hdf5Calls calls_of(const char* file) {
  return {DynamicLibrary(
      {.soname = file, .package = RUBATO_HDF5_PACKAGE, .users = "checkpoints and VTKHDF files"})};
}

/// HDF5 as a module of rubato (hdf5/CMakeLists.txt), otherwise the shared library of the system.
Hdf5Calls loaded() {
  static const std::string own = module_path("rubato_hdf5.so").string();
  if (!own.empty())
    try {
      return calls_of(own.c_str());
    } catch (const InputError&) { // the module of another version, which uses other functions
    }
  return calls_of(RUBATO_HDF5_LIBRARY);
}

} // namespace

const Hdf5Calls& hdf5() {
  static const Hdf5Calls calls = [] {
    auto made = loaded();
    made.open();
    return made;
  }();
  return calls;
}

} // namespace rubato::results
