// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/mesh/io/mesh_file.hpp"

#include "rubato/error.hpp"
#include "rubato/mesh/io/gmsh.hpp"
#include "rubato/mesh/io/med.hpp"
#include "rubato/mesh/io/vtu.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>

namespace rubato::mesh {
namespace {

enum class Format { med, gmsh, vtu, unknown };

std::string lower_extension(const std::filesystem::path& path) {
  auto extension = path.extension().string();
  std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return std::tolower(c); });
  return extension;
}

Format format_by_name(const std::filesystem::path& path) {
  const auto extension = lower_extension(path);
  if (extension == ".med" || extension == ".rmed" || extension == ".mmed")
    return Format::med;
  if (extension == ".msh" || extension == ".geo")
    return Format::gmsh;
  return extension == ".vtu" ? Format::vtu : Format::unknown;
}

Format format_by_content(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  std::string head(16, '\0');
  stream.read(head.data(), static_cast<std::streamsize>(head.size()));
  if (head.starts_with("\x89HDF\r\n"))
    return Format::med;
  return head.starts_with("$MeshFormat") ? Format::gmsh : Format::unknown;
}

[[noreturn]] void refuse_reading(const std::filesystem::path& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  const std::string_view why = !std::filesystem::exists(status) ? "does not exist"
                               : std::filesystem::is_directory(status)
                                   ? "is a directory, a mesh file was expected"
                                   : "is of no known format: .med (.rmed, .mmed), .msh and .geo are";
  throw InputError(fmt::format("mesh file '{}' {}", path.string(), why));
}

} // namespace

Mesh read_mesh(const std::filesystem::path& path, const std::string& mesh_name) {
  auto format = format_by_name(path);
  if (format == Format::unknown)
    format = format_by_content(path);
  switch (format) {
  case Format::med:
    return read_med(path, mesh_name);
  case Format::gmsh:
    return read_gmsh(path);
  default:
    refuse_reading(path);
  }
}

void write_mesh(const std::filesystem::path& path, const Mesh& mesh) {
  switch (format_by_name(path)) {
  case Format::med:
    return write_med(path, mesh);
  case Format::vtu:
    return write_vtu(path, mesh, {}, VtuCells::all);
  default:
    throw InputError(
        fmt::format("mesh file '{}' cannot be written: its ending is '{}', .med or .vtu was expected",
                    path.string(), path.extension().string()));
  }
}

std::span<const FormatEntry> all_formats() {
#ifdef RUBATO_HAS_GMSH
  static constexpr std::array<FormatEntry, 4> entries{{{".med, .rmed, .mmed", "MED, read and written"},
                                                       {".msh", "Gmsh, read"},
                                                       {".geo", "Gmsh geometry, meshed and read"},
                                                       {".vtu", "VTK, written"}}};
#else
  static constexpr std::array<FormatEntry, 2> entries{
      {{".med, .rmed, .mmed", "MED, read and written"}, {".vtu", "VTK, written"}}};
#endif
  return entries;
}

} // namespace rubato::mesh
