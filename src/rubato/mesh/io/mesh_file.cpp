// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/mesh/io/mesh_file.hpp"

#include "rubato/core/error.hpp"
#include "rubato/mesh/io/gmsh.hpp"
#include "rubato/mesh/io/inp.hpp"
#include "rubato/mesh/io/mail.hpp"
#include "rubato/mesh/io/med.hpp"
#include "rubato/mesh/io/msh.hpp"
#include "rubato/mesh/io/other_formats.hpp"
#include "rubato/mesh/io/vtu.hpp"
#include "rubato/mesh/rounding.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iterator>

namespace rubato::mesh {
namespace {

namespace fs = std::filesystem;

/// One row a format: all that the rest of the program knows of it.
const std::vector<Format>& formats() {
  static const std::vector<Format> rows{
      {{".med", ".rmed", ".mmed"},
       {"\x89HDF\r\n"},
       [](const fs::path& path, const std::string& mesh_name) { return read_med(path, mesh_name); },
       [](const fs::path& path, const Mesh& mesh) { write_med(path, mesh); },
       "MED, read and written"},
      {{".msh"},
       {"$MeshFormat"},
       [](const fs::path& path, const std::string&) { return read_msh(path); },
       nullptr,
       "Gmsh 2 and 4.1, text and binary, read",
       are_other_formats_built_in()},
      {{".mail"},
       {"TITRE", "COOR_2D", "COOR_3D"},
       [](const fs::path& path, const std::string&) { return read_mail(path); },
       [](const fs::path& path, const Mesh& mesh) { write_mail(path, mesh); },
       "Code_Aster, read and written",
       are_other_formats_built_in()},
      {{".inp"},
       {"*HEADING", "*Heading", "*NODE", "*Node"},
       [](const fs::path& path, const std::string&) { return read_inp(path); },
       nullptr,
       "Abaqus and CalculiX, read",
       are_other_formats_built_in()},
      {{".vtu"},
       {},
       nullptr,
       [](const fs::path& path, const Mesh& mesh) { write_vtu(path, mesh, {}, {.which = VtuCells::all}); },
       "VTK, written"},
      {{".geo"},
       {},
       [](const fs::path& path, const std::string&) { return read_geo(path); },
       nullptr,
       "Gmsh geometry, meshed by Gmsh's library and read",
       is_gmsh_built_in()}};
  return rows;
}

std::string lower_extension(const fs::path& path) {
  auto extension = path.extension().string();
  std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return std::tolower(c); });
  return extension;
}

/// nullptr when no format has the file's ending.
const Format* format_by_name(const fs::path& path) {
  const auto extension = lower_extension(path);
  const auto found = std::ranges::find_if(formats(), [&](const Format& format) {
    return std::ranges::find(format.endings, extension) != format.endings.end();
  });
  return found == formats().end() ? nullptr : &*found;
}

/// nullptr when the file begins as no format does.
const Format* format_by_content(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  std::string head(16, '\0');
  stream.read(head.data(), static_cast<std::streamsize>(head.size()));
  const auto found = std::ranges::find_if(formats(), [&](const Format& format) {
    return std::ranges::any_of(format.openings,
                               [&](std::string_view opening) { return head.starts_with(opening); });
  });
  return found == formats().end() ? nullptr : &*found;
}

/// ".med or .vtu": the first ending of every format that is written.
std::string writable_endings() {
  std::vector<std::string_view> endings;
  for (const auto& format : formats())
    if (format.write != nullptr)
      endings.push_back(format.endings.front());
  const auto last = endings.back();
  endings.pop_back();
  return fmt::format("{} or {}", fmt::join(endings, ", "), last);
}

[[noreturn]] void refuse_reading(const fs::path& path) {
  std::error_code error;
  const auto status = fs::status(path, error);
  const auto why = !fs::exists(status) ? std::string("does not exist")
                   : fs::is_directory(status)
                       ? std::string("is a directory, a mesh file was expected")
                       : fmt::format("is of no format that this program reads: {}", readable_endings());
  throw InputError(fmt::format("mesh file '{}' {}", path.string(), why));
}

Mesh read_as_written(const fs::path& path, const std::string& mesh_name) {
  const auto* format = format_by_name(path);
  if (format == nullptr)
    format = format_by_content(path);
  if (format == nullptr || format->read == nullptr)
    refuse_reading(path);
  return format->read(path, mesh_name);
}

} // namespace

Mesh read_mesh(const fs::path& path, const std::string& mesh_name) {
  auto mesh = read_as_written(path, mesh_name);
  lay_flat(mesh);
  return mesh;
}

void write_mesh(const fs::path& path, const Mesh& mesh) {
  const auto* format = format_by_name(path);
  if (format == nullptr || format->write == nullptr)
    throw InputError(fmt::format("mesh file '{}' cannot be written: its ending is '{}', {} was expected",
                                 path.string(), path.extension().string(), writable_endings()));
  format->write(path, mesh);
}

std::vector<Format> all_formats() {
  std::vector<Format> built_in;
  std::ranges::copy_if(formats(), std::back_inserter(built_in), &Format::is_built_in);
  return built_in;
}

std::string readable_endings() {
  std::vector<std::string_view> endings;
  for (const auto& format : all_formats())
    if (format.read != nullptr)
      endings.insert(endings.end(), format.endings.begin(), format.endings.end());
  return fmt::format("{}", fmt::join(endings, ", "));
}

} // namespace rubato::mesh
