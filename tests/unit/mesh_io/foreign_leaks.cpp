// SPDX-License-Identifier: LGPL-3.0-or-later
// HDF5 and Gmsh lose memory of their own when they meet damaged files; the leak sanitizer asks the first
// function. No file of these tests needs a gigabyte; the address sanitizer ends a program that asks for one
// at once.
extern "C" const char* __lsan_default_suppressions(); // NOLINT(bugprone-reserved-identifier)

extern "C" const char* __lsan_default_suppressions() { // NOLINT(bugprone-reserved-identifier)
  return "leak:hdf5\nleak:libgmsh\n";
}

extern "C" const char* __asan_default_options(); // NOLINT(bugprone-reserved-identifier)

extern "C" const char* __asan_default_options() { // NOLINT(bugprone-reserved-identifier)
  return "max_allocation_size_mb=1024";
}
