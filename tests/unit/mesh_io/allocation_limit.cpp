// SPDX-License-Identifier: LGPL-3.0-or-later
// No file of these tests needs a gigabyte: the address sanitizer ends a program that asks for one at once.
extern "C" const char* __asan_default_options(); // NOLINT(bugprone-reserved-identifier)

extern "C" const char* __asan_default_options() { // NOLINT(bugprone-reserved-identifier)
  return "max_allocation_size_mb=1024";
}
