// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/mesh/io/gmsh.hpp"

#include "rubato/core/error.hpp"

#include <fmt/format.h>

#ifndef RUBATO_HAS_GMSH

namespace rubato::mesh {

bool is_gmsh_built_in() {
  return false;
}

bool has_gmsh() {
  return false;
}

Mesh read_geo(const std::filesystem::path& path) {
  throw InputError(
      fmt::format("geometry '{}' must be meshed by Gmsh's library, and this program was built without it: "
                  "mesh it by `gmsh -3 {} -o mesh.msh` (-2 in a plane) and read that",
                  path.string(), path.string()));
}

} // namespace rubato::mesh

#else

#include "rubato/mesh/io/gmsh_library.hpp"
#include "rubato/mesh/io/msh.hpp"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <stdexcept>

namespace rubato::mesh {
namespace {

namespace fs = std::filesystem;

/// A new folder among the system's temporary files, removed when it goes.
class TemporaryFolder {
public:
  TemporaryFolder() {
    auto pattern = (fs::temp_directory_path() / "rubato-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr)
      throw InputError("no folder for temporary files can be made (TMPDIR says where)");
    path_ = pattern;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const fs::path& path() const { return path_; }

private:
  fs::path path_;
};

// Gmsh drops statements of a last line without an end, and doesn't say so.
void check_last_line(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  stream.seekg(0, std::ios::end);
  if (stream.tellg() == 0)
    return;
  stream.seekg(-1, std::ios::end);
  if (stream.get() != '\n')
    throw InputError("its last line has no line end, Gmsh would drop a part of it");
}

void mesh_with_gmsh(const fs::path& path, const fs::path& result) {
  check_last_line(path);
  const gmsh::Session session;
  session.open(path);
  if (!session.is_meshed())
    session.generate(std::max(0, session.dimension()));
  if (const auto error = session.first_error(); !error.empty())
    throw InputError(error);
  if (!session.is_meshed())
    throw InputError("it holds no cells");
  session.write(result);
}

[[noreturn]] void refuse(const fs::path& path, const std::string& why) {
  throw InputError(fmt::format("mesh file '{}' cannot be read by Gmsh: {}", path.string(), why));
}

} // namespace

bool is_gmsh_built_in() {
  return true;
}

bool has_gmsh() {
  try {
    gmsh::library();
    return true;
  } catch (const InputError&) {
    return false;
  }
}

Mesh read_geo(const fs::path& path) {
  if (!fs::is_regular_file(path))
    throw InputError(
        fmt::format("mesh file '{}' {}", path.string(),
                    fs::exists(path) ? "is a directory, a Gmsh geometry was expected" : "does not exist"));
  const TemporaryFolder folder;
  const auto meshed = folder.path() / "mesh.msh";
  try {
    mesh_with_gmsh(path, meshed);
  } catch (const InputError& error) {
    refuse(path, error.faults().front().text);
  } catch (const std::runtime_error& error) {
    refuse(path, error.what());
  }
  return read_msh(meshed, path);
}

} // namespace rubato::mesh

#endif
