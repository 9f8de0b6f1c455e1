// SPDX-License-Identifier: LGPL-3.0-or-later
// A build with RUBATO_RUNS_ONLY compiles this source in place of those of .msh, .mail and .inp.
#include "rubato/core/error.hpp"
#include "rubato/mesh/io/inp.hpp"
#include "rubato/mesh/io/mail.hpp"
#include "rubato/mesh/io/msh.hpp"
#include "rubato/mesh/io/other_formats.hpp"

#include <fmt/format.h>

namespace rubato::mesh {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& path) {
  throw InputError(fmt::format("mesh file '{}': its format is not in this program, which was built with "
                               "RUBATO_RUNS_ONLY, as `make demo` does; `make build` builds all formats",
                               path.string()));
}

} // namespace

bool are_other_formats_built_in() {
  return false;
}

Mesh read_msh(const std::filesystem::path& path, const std::filesystem::path&) {
  refuse(path);
}

Mesh read_mail(const std::filesystem::path& path) {
  refuse(path);
}

void write_mail(const std::filesystem::path& path, const Mesh&) {
  refuse(path);
}

Mesh read_inp(const std::filesystem::path& path) {
  refuse(path);
}

} // namespace rubato::mesh
