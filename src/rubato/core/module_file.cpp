// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/core/module_file.hpp"

#include <dlfcn.h>
#include <system_error>

namespace rubato {
namespace {

namespace fs = std::filesystem;

constexpr const char* module_folder = "lib/rubato";

fs::path resolved(const fs::path& file) {
  std::error_code failed;
  const auto whole = fs::canonical(file, failed);
  return failed ? fs::path() : whole;
}

/// The module below the nearest folder above `place`.
fs::path module_above(const fs::path& place, const std::string& file) {
  for (auto folder = place.parent_path(); folder.has_relative_path(); folder = folder.parent_path()) {
    std::error_code failed;
    if (auto path = folder / module_folder / file; fs::exists(path, failed))
      return path;
  }
  return {};
}

} // namespace

fs::path module_path(const std::string& file) {
  Dl_info here{};
  if (dladdr(module_folder, &here) != 0 && here.dli_fname != nullptr)
    if (auto path = module_above(resolved(here.dli_fname), file); !path.empty())
      return path;
  // The loader reports a program that was started by its bare name without its folder.
  return module_above(resolved("/proc/self/exe"), file);
}

} // namespace rubato
