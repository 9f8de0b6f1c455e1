// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/results/hdf5_library.hpp"

namespace rubato::results {

const Hdf5Calls& hdf5() {
  static const Hdf5Calls calls = [] {
    Hdf5Calls made{DynamicLibrary({.soname = RUBATO_HDF5_LIBRARY,
                                   .package = RUBATO_HDF5_PACKAGE,
                                   .users = "checkpoints and VTKHDF files"})};
    made.open();
    return made;
  }();
  return calls;
}

} // namespace rubato::results
