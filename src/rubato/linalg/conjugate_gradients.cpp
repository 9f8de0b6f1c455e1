// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/linalg/conjugate_gradients.hpp"

#include "rubato/core/error.hpp"

#include <fmt/format.h>

#include <dlfcn.h>
#include <filesystem>
#include <string>
#include <system_error>

namespace rubato::linalg {
namespace {

namespace fs = std::filesystem;

constexpr const char* module_file = "rubato_petsc.so";
/// Where it is below a folder above the program: of the build and of an installation.
constexpr const char* module_folder = "lib/rubato";

[[noreturn]] void refuse_module(const std::string& why) {
  throw InputError(
      {fault_at("solver", fmt::format("found iterative, which needs PETSc: {}; expected auto, or "
                                      "a rubato that is built with it (make deps build PETSC=1)",
                                      why))});
}

fs::path resolved(const fs::path& file) {
  std::error_code failed;
  const auto whole = fs::canonical(file, failed);
  return failed ? fs::path() : whole;
}

/// In the folders above a file, the nearest first; nothing when it is in none.
fs::path module_above(const fs::path& file) {
  for (auto folder = file.parent_path(); folder.has_relative_path(); folder = folder.parent_path()) {
    std::error_code failed;
    if (const auto path = folder / module_folder / module_file; fs::exists(path, failed))
      return path;
  }
  return {};
}

/// Above what this code was linked into: a program, which may have been started by its bare name, or the
/// Python module. Else wherever the loader looks.
fs::path module_path() {
  Dl_info here{};
  if (dladdr(make_conjugate_gradients_name, &here) != 0 && here.dli_fname != nullptr)
    if (auto path = module_above(resolved(here.dli_fname)); !path.empty())
      return path;
  if (auto path = module_above(resolved("/proc/self/exe")); !path.empty())
    return path;
  return module_file;
}

MakeConjugateGradients* load_module() {
  // Never unloaded: libraries it brings keep what cannot be taken down before the program's end.
  void* handle = dlopen(module_path().c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle == nullptr)
    refuse_module(dlerror());
  void* entry = dlsym(handle, make_conjugate_gradients_name);
  if (entry == nullptr)
    refuse_module("its library is that of another version");
  return reinterpret_cast<MakeConjugateGradients*>(entry);
}

} // namespace

std::unique_ptr<ConjugateGradients> make_conjugate_gradients() {
  static MakeConjugateGradients* const make = load_module();
  std::unique_ptr<ConjugateGradients> made;
  make(made);
  return made;
}

bool has_conjugate_gradients() {
  try {
    make_conjugate_gradients();
    return true;
  } catch (const InputError&) {
    return false;
  }
}

} // namespace rubato::linalg
