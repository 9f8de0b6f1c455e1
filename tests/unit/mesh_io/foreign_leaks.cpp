// SPDX-License-Identifier: LGPL-3.0-or-later
// HDF5 and Gmsh lose memory of their own when they meet damaged files; the leak sanitizer asks this function.
extern "C" const char* __lsan_default_suppressions(); // NOLINT(bugprone-reserved-identifier)

extern "C" const char* __lsan_default_suppressions() { // NOLINT(bugprone-reserved-identifier)
  return "leak:libhdf5\nleak:libgmsh\n";
}
