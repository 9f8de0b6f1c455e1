// SPDX-License-Identifier: LGPL-3.0-or-later
// Format: VTK file formats, "XML file formats", UnstructuredGrid with appended data in raw encoding. Each
// array is compressed in pieces (vtkXMLDataParser, vtkZLibDataCompressor): the number of pieces, the size of
// a piece, the size of the last one if it is shorter, else 0, the compressed size of each, all 64 bits, then
// the compressed pieces; found by its offset from the underscore.
#include "rubato/mesh/io/vtu.hpp"

#include "rubato/core/error.hpp"
#include "rubato/core/writing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <fstream>
#include <stdexcept>
#include <zlib.h>

namespace rubato::mesh {
namespace {

template <class T> constexpr std::string_view vtk_name{};
template <> constexpr std::string_view vtk_name<double> = "Float64";
template <> constexpr std::string_view vtk_name<std::int32_t> = "Int32";
template <> constexpr std::string_view vtk_name<std::int64_t> = "Int64";
template <> constexpr std::string_view vtk_name<std::uint8_t> = "UInt8";

constexpr std::size_t piece_size = std::size_t{1} << 18;

/// Adds the bytes compressed by zlib; how many they are then. Higher levels than the fastest take several
/// times as long and gain next to nothing on numbers.
std::uint64_t append_compressed(std::span<const std::byte> bytes, std::string& to) {
  auto size = compressBound(bytes.size());
  const auto start = to.size();
  to.resize(start + size);
  if (compress2(reinterpret_cast<Bytef*>(to.data() + start), &size,
                reinterpret_cast<const Bytef*>(bytes.data()), bytes.size(), Z_BEST_SPEED) != Z_OK)
    throw std::bad_alloc(); // the only reason there can be, as there is room for the result
  to.resize(start + size);
  return size;
}

/// The XML text and the binary blocks it points to, side by side.
class Document {
public:
  void line(std::string_view text) { fmt::format_to(std::back_inserter(xml_), "{}\n", text); }

  template <class T>
  void array(const std::string& name, int components, std::span<const T> values,
             const std::vector<std::string>& component_names = {}) {
    fmt::format_to(std::back_inserter(xml_),
                   R"(<DataArray type="{}" Name="{}" NumberOfComponents="{}" format="appended" offset="{}")",
                   vtk_name<T>, xml_escaped(name), components, data_.size());
    for (std::size_t i = 0; i < component_names.size(); ++i)
      fmt::format_to(std::back_inserter(xml_), R"( ComponentName{}="{}")", i,
                     xml_escaped(component_names[i]));
    line("/>");
    append(std::as_bytes(values));
  }

  void write(std::ostream& to) const {
    constexpr std::string_view order =
        std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian";
    to << "<?xml version=\"1.0\"?>\n"
       << fmt::format(
              R"(<VTKFile type="UnstructuredGrid" version="1.0" byte_order="{}" header_type="UInt64" compressor="vtkZLibDataCompressor">)",
              order)
       << "\n<UnstructuredGrid>\n"
       << xml_ << "</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_";
    to.write(data_.data(), static_cast<std::streamsize>(data_.size()));
    to << "\n</AppendedData>\n</VTKFile>\n";
  }

private:
  void append(std::span<const std::byte> bytes) {
    const auto pieces = (bytes.size() + piece_size - 1) / piece_size;
    std::vector<std::uint64_t> head{pieces, piece_size, bytes.size() % piece_size};
    std::string content;
    for (std::size_t start = 0; start < bytes.size(); start += piece_size)
      head.push_back(
          append_compressed(bytes.subspan(start, std::min(piece_size, bytes.size() - start)), content));
    data_.append(reinterpret_cast<const char*>(head.data()), head.size() * sizeof head[0]);
    data_ += content;
  }

  std::string xml_;
  std::string data_;
};

void add_points(Document& document, std::span<const Eigen::Vector3d> points) {
  static_assert(sizeof(Eigen::Vector3d) == 3 * sizeof(double));
  const auto* const first = points.empty() ? nullptr : points.front().data();
  document.line("<Points>");
  document.array<double>("Points", 3, std::span(first, 3 * points.size()));
  document.line("</Points>");
}

void add_cells(Document& document, const VtkCells& cells) {
  document.line("<Cells>");
  document.array<std::int32_t>("connectivity", 1, cells.connectivity);
  document.array<std::int64_t>("offsets", 1, cells.ends);
  document.array<std::uint8_t>("types", 1, cells.types);
  document.line("</Cells>");
}

void add_values(Document& document, std::span<const VtuArray> arrays, bool of_cells, int digits) {
  for (const auto& array : arrays)
    if (array.of_cells == of_cells)
      document.array<double>(array.name, array.components, with_digits(array.values, digits),
                             array.component_names);
}

void add_groups(Document& document, const std::vector<VtkGroup>& groups) {
  for (const auto& group : groups)
    document.array<std::uint8_t>(group.name, 1, group.members);
}

void check_sizes(const Mesh& mesh, std::span<const VtuArray> arrays, std::span<const Eigen::Vector3d> points,
                 std::size_t cells) {
  if (points.size() != mesh.points.size())
    throw std::invalid_argument(fmt::format("{} points for {} nodes", points.size(), mesh.points.size()));
  for (const auto& array : arrays) {
    const auto places = array.of_cells ? cells : mesh.points.size();
    if (array.components < 1 || array.values.size() != places * static_cast<std::size_t>(array.components))
      throw std::invalid_argument(
          fmt::format("array '{}' has {} values, {} {} of {} components were expected", array.name,
                      array.values.size(), places, array.of_cells ? "cells" : "nodes", array.components));
  }
}

} // namespace

void write_vtu(const std::filesystem::path& path, const Mesh& mesh, std::span<const VtuArray> arrays,
               const VtuSettings& settings) {
  const auto points =
      settings.points.empty() ? std::span<const Eigen::Vector3d>(mesh.points) : settings.points;
  const auto cells = vtk_cells(mesh, settings.which);
  check_sizes(mesh, arrays, points, cells.types.size());
  const auto groups = vtk_groups(mesh, cells);

  Document document;
  document.line(
      fmt::format(R"(<Piece NumberOfPoints="{}" NumberOfCells="{}">)", points.size(), cells.types.size()));
  document.line("<PointData>");
  add_values(document, arrays, false, settings.digits);
  if (mesh.node_numbers.size() == mesh.points.size())
    document.array<std::int64_t>("node_number", 1, mesh.node_numbers);
  add_groups(document, groups.of_points);
  document.line("</PointData>\n<CellData>");
  add_values(document, arrays, true, settings.digits);
  if (!cells.numbers.empty())
    document.array<std::int64_t>("cell_number", 1, cells.numbers);
  add_groups(document, groups.of_cells);
  document.line("</CellData>");
  add_points(document, points);
  add_cells(document, cells);
  document.line("</Piece>");

  write_whole(path, [&](const std::filesystem::path& beside) {
    std::ofstream stream(beside, std::ios::binary);
    if (!stream)
      throw InputError(fmt::format(
          "file '{}' cannot be written: is there such a folder, and may you write into it?", path.string()));
    document.write(stream);
    finish_writing(stream, path);
  });
}

std::string xml_escaped(const std::string& text) {
  std::string escaped;
  for (const char letter : text) {
    switch (letter) {
    case '&':
      escaped += "&amp;";
      break;
    case '<':
      escaped += "&lt;";
      break;
    case '>':
      escaped += "&gt;";
      break;
    case '"':
      escaped += "&quot;";
      break;
    default:
      escaped += letter;
    }
  }
  return escaped;
}

} // namespace rubato::mesh
