// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/linalg/petsc_module.hpp"

#include "rubato/core/error.hpp"
#include "rubato/core/module_file.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cstdlib>
#include <dlfcn.h>
#include <string_view>

namespace rubato::linalg {
namespace {

constexpr const char* module_file = "rubato_petsc.so";

/// Never unloaded: libraries it brings keep what cannot be taken down before the program's end.
void* load_module() {
  const auto path = module_path(module_file);
  void* handle = dlopen(path.empty() ? module_file : path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle == nullptr)
    throw ModuleMissing(dlerror());
  return handle;
}

/// What a process manager says of its processes, in the environment of each: Open MPI, then MPICH and those
/// that speak its protocol.
struct Names {
  const char* count;
  const char* index;
};
constexpr std::array managers{Names{"OMPI_COMM_WORLD_SIZE", "OMPI_COMM_WORLD_RANK"},
                              Names{"PMI_SIZE", "PMI_RANK"}};

/// −1 where there is no such number.
int number_in_environment(const char* name) {
  const char* text = std::getenv(name);
  if (text == nullptr)
    return -1;
  const std::string_view digits(text);
  int number = -1;
  std::from_chars(digits.data(), digits.data() + digits.size(), number);
  return number;
}

} // namespace

void* petsc_function(const char* name) {
  static void* const module = load_module();
  void* function = dlsym(module, name);
  if (function == nullptr)
    throw ModuleMissing("its library is that of another version");
  return function;
}

int started_ranks() {
  for (const auto& names : managers)
    if (const int count = number_in_environment(names.count); count > 0)
      return count;
  return 1;
}

int started_index() {
  for (const auto& names : managers)
    if (const int index = number_in_environment(names.index); index >= 0)
      return index;
  return 0;
}

Ranks join_ranks() {
  try {
    std::shared_ptr<Channel> channel;
    reinterpret_cast<MakeChannel*>(petsc_function(make_channel_name))(channel);
    return Ranks(std::move(channel));
  } catch (const ModuleMissing& error) {
    throw InputError(fmt::format("{} processes were started for one run, which needs PETSc: {}; expected one "
                                 "process, or a rubato that is built with it (make deps build PETSC=1)",
                                 started_ranks(), error.what()));
  }
}

} // namespace rubato::linalg
