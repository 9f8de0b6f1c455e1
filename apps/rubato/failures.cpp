// SPDX-License-Identifier: LGPL-3.0-or-later
#include "failures.hpp"

#include "rubato/core/error.hpp"
#include "rubato/linalg/memory.hpp"

#include <fmt/format.h>

#include "commands.hpp"
#include <cstdio>
#include <cstdlib>
#include <new>
#include <sys/resource.h>

namespace rubato::app {
namespace {

/// What the memory was, and what else could be done. By now what the run had is given back.
std::string out_of_memory() {
  constexpr double gigabyte = 1e9;
  constexpr double kibibyte = 1024;
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return fmt::format(
      "the memory does not suffice: {:.2g} GB were taken, {:.2g} GB can be had now; a coarser mesh, "
      "cells of lower order or a machine with more memory may help (ulimit -v limits it too)",
      static_cast<double>(usage.ru_maxrss) * kibibyte / gigabyte,
      static_cast<double>(linalg::available_memory()) / gigabyte);
}

void print(const InputError& error) {
  for (const auto& fault : error.faults()) {
    const auto place = place_of(fault);
    fmt::print(stderr, "error: {}{}{}\n", place, place.empty() ? "" : ": ", fault.text);
  }
}

} // namespace

int reported(const std::function<int()>& work) {
  try {
    return work();
  } catch (const InputError& error) {
    print(error);
    return bad_input;
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "error: {}\n", out_of_memory());
  } catch (const std::exception& error) {
    fmt::print(stderr, "error: {}\n", error.what());
  }
  return other_failure;
}

void leave(int code) {
  std::fflush(nullptr);
  std::_Exit(code);
}

} // namespace rubato::app
