// SPDX-License-Identifier: LGPL-3.0-or-later
// These tests allocate less than a gigabyte at once. Beyond it the address sanitizer aborts the program.
extern "C" const char* __asan_default_options(); // NOLINT(bugprone-reserved-identifier)

extern "C" const char* __asan_default_options() { // NOLINT(bugprone-reserved-identifier)
  return "max_allocation_size_mb=1024";
}
