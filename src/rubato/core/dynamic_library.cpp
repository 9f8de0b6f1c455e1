// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/core/dynamic_library.hpp"

#include "rubato/core/error.hpp"

#include <fmt/format.h>

#include <dlfcn.h>
#include <string>
#include <string_view>

namespace rubato {
namespace {

/// Throws InputError with the reason that the loader reported last.
[[noreturn]] void refuse(const LibraryName& name) {
  const std::string_view package = name.package;
  const auto installed = package.empty() ? std::string("it") : fmt::format("the Debian package {}", package);
  throw InputError(fmt::format("{} need the library {}, which cannot be loaded ({}); install {}{}",
                               name.users, name.soname, dlerror(), installed, name.otherwise));
}

} // namespace

DynamicLibrary::DynamicLibrary(const LibraryName& name)
    : name_(name), handle_(dlopen(name.soname, RTLD_LAZY | RTLD_LOCAL)) {
  if (handle_ == nullptr)
    refuse(name_);
}

LibrarySymbol DynamicLibrary::symbol(const char* name) const {
  void* address = dlsym(handle_, name);
  if (address == nullptr)
    refuse(name_);
  return LibrarySymbol(address);
}

} // namespace rubato
