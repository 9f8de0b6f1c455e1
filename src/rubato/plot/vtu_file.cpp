// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/plot/vtu_file.hpp"

#include "rubato/core/error.hpp"
#include "rubato/mesh/io/file_content.hpp"
#include "rubato/mesh/io/vtu.hpp"
#include "rubato/mesh/orientation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <map>
#include <pugixml.hpp>
#include <span>
#include <string_view>

namespace rubato::plot {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& path, std::string_view what) {
  throw InputError(fmt::format("{}: {}, expected a file as rubato writes it", path.string(), what));
}

pugi::xml_document parse(const fs::path& path, std::string_view xml) {
  pugi::xml_document document;
  const auto result = document.load_buffer(xml.data(), xml.size());
  if (!result)
    refuse(path, fmt::format("found no valid XML ({})", result.description()));
  return document;
}

/// The text of the XML and the bytes that it points to.
class Appended {
public:
  explicit Appended(const fs::path& path)
      : path_(path), text_(mesh::file_content(path, path, "a .vtu file")) {
    constexpr std::string_view begin = "<AppendedData encoding=\"raw\">";
    const auto at = text_.find(begin);
    const auto underscore = at == std::string::npos ? at : text_.find('_', at + begin.size());
    if (underscore == std::string::npos)
      refuse(path_, "found no appended raw data");
    document_ = parse(path_, text_.substr(0, at) + "</VTKFile>");
    data_ = std::string_view(text_).substr(underscore + 1);
    constexpr auto order = std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian";
    if (std::string_view(root().attribute("byte_order").value()) != order)
      refuse(path_, "found numbers in another order of bytes");
  }

  pugi::xml_node root() const { return document_.child("VTKFile"); }
  pugi::xml_node piece() const { return root().child("UnstructuredGrid").child("Piece"); }

  template <class T> std::vector<T> values(pugi::xml_node array) const {
    const auto offset = array.attribute("offset").as_ullong();
    std::uint64_t size = 0;
    if (!array || offset > data_.size() || data_.size() - offset < sizeof size)
      refuse(path_, "found no values of an array");
    std::memcpy(&size, data_.data() + offset, sizeof size);
    if (data_.size() - offset - sizeof size < size)
      refuse(path_, "the file ends too early");
    std::vector<T> numbers(size / sizeof(T));
    std::memcpy(numbers.data(), data_.data() + offset + sizeof size, numbers.size() * sizeof(T));
    return numbers;
  }

  const fs::path& path() const { return path_; }

private:
  fs::path path_;
  std::string text_;
  std::string_view data_;
  pugi::xml_document document_;
};

pugi::xml_node array_named(pugi::xml_node parent, const char* name) {
  return parent.find_child_by_attribute("DataArray", "Name", name);
}

std::vector<Eigen::Vector3d> points_of(const Appended& file) {
  const auto numbers = file.values<double>(file.piece().child("Points").child("DataArray"));
  std::vector<Eigen::Vector3d> points(numbers.size() / 3);
  for (std::size_t i = 0; i < points.size(); ++i)
    points[i] = Eigen::Vector3d(numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]);
  return points;
}

/// A cell of the file in this project's order of nodes.
void append_cell(std::span<const std::int32_t> nodes, mesh::CellBlock& block) {
  const auto order = mesh::vtk_order(block.type);
  const auto first = block.nodes.size();
  block.nodes.insert(block.nodes.end(), nodes.begin(), nodes.end());
  for (std::size_t i = 0; i < order.size(); ++i)
    block.nodes[first + order[i]] = nodes[i];
}

std::vector<mesh::CellBlock> blocks_of(const Appended& file, std::size_t node_count) {
  const auto cells = file.piece().child("Cells");
  const auto nodes = file.values<std::int32_t>(array_named(cells, "connectivity"));
  const auto ends = file.values<std::int64_t>(array_named(cells, "offsets"));
  const auto types = file.values<std::uint8_t>(array_named(cells, "types"));
  const auto is_no_node = [&](std::int32_t node) {
    return node < 0 || static_cast<std::size_t>(node) >= node_count;
  };
  if (types.size() != ends.size() || std::ranges::any_of(nodes, is_no_node))
    refuse(file.path(), "found cells that do not fit together");
  std::map<CellType, mesh::CellBlock> blocks;
  std::int64_t begin = 0;
  for (std::size_t i = 0; i < types.size(); ++i) {
    const auto type = mesh::cell_type_of_vtk(types[i]);
    if (!type || ends[i] - begin != cell::topology(*type).node_count ||
        ends[i] > static_cast<std::int64_t>(nodes.size()))
      refuse(file.path(), fmt::format("found a cell of type {}", types[i]));
    auto& block = blocks[*type];
    block.type = *type;
    append_cell(
        std::span(nodes).subspan(static_cast<std::size_t>(begin), static_cast<std::size_t>(ends[i] - begin)),
        block);
    begin = ends[i];
  }
  std::vector<mesh::CellBlock> list;
  list.reserve(blocks.size());
  for (auto& [type, block] : blocks)
    list.push_back(std::move(block));
  return list;
}

NodeArray array_of(const Appended& file, pugi::xml_node node, std::size_t node_count) {
  NodeArray array{.name = node.attribute("Name").value(), .values = file.values<double>(node)};
  const auto width = node.attribute("NumberOfComponents").as_uint(1);
  for (unsigned c = 0; c < width; ++c) {
    const std::string name = node.attribute(fmt::format("ComponentName{}", c).c_str()).value();
    array.components.push_back(!name.empty() ? name
                               : width <= 3  ? std::string(1, "xyz"[c])
                                             : std::to_string(c + 1));
  }
  if (width == 0 || array.values.size() != node_count * width)
    refuse(file.path(), fmt::format("found another number of values of '{}' than nodes", array.name));
  return array;
}

} // namespace

std::vector<PvdEntry> read_pvd(const fs::path& path) {
  const auto document = parse(path, mesh::file_content(path, path, "a .pvd file"));
  std::vector<PvdEntry> entries;
  for (const auto set : document.child("VTKFile").child("Collection").children("DataSet"))
    entries.push_back(
        {set.attribute("timestep").as_double(), path.parent_path() / set.attribute("file").value()});
  return entries;
}

VtuContent read_vtu(const fs::path& path) {
  const Appended file(path);
  VtuContent content;
  content.mesh.points = points_of(file);
  content.mesh.blocks = blocks_of(file, content.mesh.points.size());
  for (const auto node : file.piece().child("PointData").children("DataArray"))
    if (std::string_view(node.attribute("type").value()) == "Float64")
      content.arrays.push_back(array_of(file, node, content.mesh.points.size()));
  return content;
}

} // namespace rubato::plot
