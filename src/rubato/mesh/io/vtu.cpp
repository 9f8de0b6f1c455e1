// SPDX-License-Identifier: LGPL-3.0-or-later
// Format: VTK file formats, "XML file formats", UnstructuredGrid with appended data in raw encoding: each
// block is a 64-bit byte count and its bytes, found by its offset from the underscore.
#include "rubato/mesh/io/vtu.hpp"

#include "rubato/cell/parts.hpp"
#include "rubato/core/error.hpp"
#include "rubato/core/writing.hpp"
#include "rubato/mesh/orientation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <fstream>
#include <stdexcept>

namespace rubato::mesh {
namespace {

/// VTK's cell type numbers (vtkCellType.h), in the order of CellType.
constexpr std::array<std::uint8_t, 19> vtk_types{1,  3,  21, 5,  22, 34, 9,  23, 28, 10,
                                                 24, 14, 27, 13, 26, 32, 12, 25, 29};

template <class T> constexpr std::string_view vtk_name{};
template <> constexpr std::string_view vtk_name<double> = "Float64";
template <> constexpr std::string_view vtk_name<std::int32_t> = "Int32";
template <> constexpr std::string_view vtk_name<std::int64_t> = "Int64";
template <> constexpr std::string_view vtk_name<std::uint8_t> = "UInt8";

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
              R"(<VTKFile type="UnstructuredGrid" version="1.0" byte_order="{}" header_type="UInt64">)",
              order)
       << "\n<UnstructuredGrid>\n"
       << xml_ << "</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_";
    to.write(data_.data(), static_cast<std::streamsize>(data_.size()));
    to << "\n</AppendedData>\n</VTKFile>\n";
  }

private:
  void append(std::span<const std::byte> bytes) {
    const std::uint64_t size = bytes.size();
    data_.append(reinterpret_cast<const char*>(&size), sizeof size);
    data_.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  }

  std::string xml_;
  std::string data_;
};

std::vector<const CellBlock*> chosen_blocks(const Mesh& mesh, VtuCells which) {
  int highest = 0;
  for (const auto& block : mesh.blocks)
    highest = std::max(highest, cell::topology(block.type).dimension);
  std::vector<const CellBlock*> chosen;
  for (const auto& block : mesh.blocks)
    if (which == VtuCells::all || cell::topology(block.type).dimension == highest)
      chosen.push_back(&block);
  return chosen;
}

void add_points(Document& document, std::span<const Eigen::Vector3d> points) {
  static_assert(sizeof(Eigen::Vector3d) == 3 * sizeof(double));
  const auto* const first = points.empty() ? nullptr : points.front().data();
  document.line("<Points>");
  document.array<double>("Points", 3, std::span(first, 3 * points.size()));
  document.line("</Points>");
}

/// The nodes of a block as VTK orders them. The base of VTK's wedges, 0 1 2, turns so that its normal points
/// out of the cell (vtkWedge.h, vtkQuadraticWedge.h): our prism mirrored. So volumes are positive and faces
/// turn outward in VTK, quadratic wedges included; vtkCellValidator alone wants the faces of those inward.
/// All other cells are VTK's.
void append_in_vtk_order(const CellBlock& block, std::vector<std::int32_t>& nodes) {
  if (cell::linear_type(block.type) != CellType::penta6) {
    nodes.insert(nodes.end(), block.nodes.begin(), block.nodes.end());
    return;
  }
  const auto order = mirrored_numbering(block.type);
  for (CellIndex cell = 0; cell < block.cell_count(); ++cell)
    for (const auto local : order)
      nodes.push_back(block.cell(cell)[local]);
}

void add_cells(Document& document, const std::vector<const CellBlock*>& blocks) {
  std::vector<std::int32_t> nodes;
  std::vector<std::int64_t> ends;
  std::vector<std::uint8_t> types;
  for (const auto* block : blocks) {
    append_in_vtk_order(*block, nodes);
    types.insert(types.end(), static_cast<std::size_t>(block->cell_count()),
                 vtk_types[static_cast<std::size_t>(block->type)]);
    for (CellIndex cell = 0; cell < block->cell_count(); ++cell)
      ends.push_back((ends.empty() ? 0 : ends.back()) + cell::topology(block->type).node_count);
  }
  document.line("<Cells>");
  document.array<std::int32_t>("connectivity", 1, nodes);
  document.array<std::int64_t>("offsets", 1, ends);
  document.array<std::uint8_t>("types", 1, types);
  document.line("</Cells>");
}

void add_cell_numbers(Document& document, const std::vector<const CellBlock*>& blocks) {
  std::vector<std::int64_t> numbers;
  for (const auto* block : blocks) {
    if (block->numbers.size() != static_cast<std::size_t>(block->cell_count()))
      return;
    numbers.insert(numbers.end(), block->numbers.begin(), block->numbers.end());
  }
  document.line("<CellData>");
  document.array<std::int64_t>("cell_number", 1, numbers);
  document.line("</CellData>");
}

void add_node_arrays(Document& document, const Mesh& mesh, std::span<const VtuArray> arrays) {
  document.line("<PointData>");
  for (const auto& array : arrays)
    document.array<double>(array.name, array.components, array.values, array.component_names);
  if (mesh.node_numbers.size() == mesh.points.size())
    document.array<std::int64_t>("node_number", 1, mesh.node_numbers);
  document.line("</PointData>");
}

void check_sizes(const Mesh& mesh, std::span<const VtuArray> arrays,
                 std::span<const Eigen::Vector3d> points) {
  if (points.size() != mesh.points.size())
    throw std::invalid_argument(fmt::format("{} points for {} nodes", points.size(), mesh.points.size()));
  for (const auto& array : arrays)
    if (array.components < 1 ||
        array.values.size() != mesh.points.size() * static_cast<std::size_t>(array.components))
      throw std::invalid_argument(
          fmt::format("array '{}' has {} values, {} nodes of {} components were expected", array.name,
                      array.values.size(), mesh.points.size(), array.components));
}

} // namespace

void write_vtu(const std::filesystem::path& path, const Mesh& mesh, std::span<const VtuArray> arrays,
               VtuCells which, std::span<const Eigen::Vector3d> points) {
  if (points.empty())
    points = mesh.points;
  check_sizes(mesh, arrays, points);
  const auto blocks = chosen_blocks(mesh, which);
  CellIndex cells = 0;
  for (const auto* block : blocks)
    cells += block->cell_count();

  Document document;
  document.line(fmt::format(R"(<Piece NumberOfPoints="{}" NumberOfCells="{}">)", points.size(), cells));
  add_node_arrays(document, mesh, arrays);
  add_cell_numbers(document, blocks);
  add_points(document, points);
  add_cells(document, blocks);
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

std::optional<CellType> cell_type_of_vtk(int number) {
  const auto* const found = std::ranges::find(vtk_types, number);
  if (found == vtk_types.end())
    return std::nullopt;
  return static_cast<CellType>(found - vtk_types.begin());
}

std::vector<NodeIndex> from_vtk_order(CellType type, std::span<const NodeIndex> nodes) {
  std::vector<NodeIndex> ordered(nodes.begin(), nodes.end());
  if (cell::linear_type(type) == CellType::penta6) {
    const auto order = mirrored_numbering(type); // its own inverse
    std::ranges::transform(order, ordered.begin(), [&](auto local) { return nodes[local]; });
  }
  return ordered;
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
