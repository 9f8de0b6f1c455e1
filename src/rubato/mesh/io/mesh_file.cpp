// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/mesh/io/mesh_file.hpp"

#include "rubato/core/error.hpp"
#include "rubato/mesh/io/gmsh.hpp"
#include "rubato/mesh/io/med.hpp"
#include "rubato/mesh/io/msh.hpp"
#include "rubato/mesh/io/vtu.hpp"
#include "rubato/mesh/rounding.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>

namespace rubato::mesh {
namespace {

enum class Format { med, msh, geo, vtu, unknown };

std::string lower_extension(const std::filesystem::path& path) {
  auto extension = path.extension().string();
  std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return std::tolower(c); });
  return extension;
}

Format format_by_name(const std::filesystem::path& path) {
  const auto extension = lower_extension(path);
  if (extension == ".med" || extension == ".rmed" || extension == ".mmed")
    return Format::med;
  if (extension == ".msh")
    return Format::msh;
  if (extension == ".geo")
    return Format::geo;
  return extension == ".vtu" ? Format::vtu : Format::unknown;
}

Format format_by_content(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  std::string head(16, '\0');
  stream.read(head.data(), static_cast<std::streamsize>(head.size()));
  if (head.starts_with("\x89HDF\r\n"))
    return Format::med;
  return head.starts_with("$MeshFormat") ? Format::msh : Format::unknown;
}

[[noreturn]] void refuse_reading(const std::filesystem::path& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  const auto why = !std::filesystem::exists(status) ? std::string("does not exist")
                   : std::filesystem::is_directory(status)
                       ? std::string("is a directory, a mesh file was expected")
                       : fmt::format("is of no format that this program reads: {}", readable_endings());
  throw InputError(fmt::format("mesh file '{}' {}", path.string(), why));
}

Mesh read_as_written(const std::filesystem::path& path, const std::string& mesh_name) {
  auto format = format_by_name(path);
  if (format == Format::unknown)
    format = format_by_content(path);
  switch (format) {
  case Format::med:
    return read_med(path, mesh_name);
  case Format::msh:
    return read_msh(path);
  case Format::geo:
    return read_geo(path);
  default:
    refuse_reading(path);
  }
}

} // namespace

Mesh read_mesh(const std::filesystem::path& path, const std::string& mesh_name) {
  auto mesh = read_as_written(path, mesh_name);
  lay_flat(mesh);
  return mesh;
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
  static constexpr std::array<FormatEntry, 4> entries{
      {{".med, .rmed, .mmed", "MED, read and written", true, true},
       {".msh", "Gmsh 2 and 4.1, text and binary, read", true, false},
       {".vtu", "VTK, written", false, true},
       {".geo", "Gmsh geometry, meshed by Gmsh's library and read", true, false}}};
  return std::span(entries).first(is_gmsh_built_in() ? 4 : 3);
}

std::string readable_endings() {
  std::string endings;
  for (const auto& format : all_formats())
    if (format.is_read)
      endings += fmt::format("{}{}", endings.empty() ? "" : ", ", format.extension);
  return endings;
}

} // namespace rubato::mesh
