// SPDX-License-Identifier: LGPL-3.0-or-later
// Format: VTK file formats, "XML file formats". Binary data begins with its byte count, or, compressed, with
// the number of blocks, the size of each but the last, that of the last (0: as the others) and the compressed
// size of each. In base64 the counts of compressed data are encoded apart from the data (vtkXMLDataParser).
#include "rubato/mesh/io/vtu_reader.hpp"

#include "rubato/core/base64.hpp"
#include "rubato/core/error.hpp"
#include "rubato/mesh/builder.hpp"
#include "rubato/mesh/io/file_content.hpp"
#include "rubato/mesh/io/vtk_grid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstring>
#include <optional>
#include <pugixml.hpp>
#include <stdexcept>
#include <string_view>
#include <zlib.h>

namespace rubato::mesh::vtk {
namespace {

namespace fs = std::filesystem;
using Bytes = std::vector<std::byte>;

/// What is wrong with a file, without its name.
class Damage : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

/// The document and the data that stand behind its tags, which need not be XML.
struct Document {
  std::string content;
  pugi::xml_document xml;
  std::string_view appended; ///< behind the underscore
  bool appended_as_text = false;
  bool compressed = false;
  std::size_t count_size = 4; ///< bytes of a count

  pugi::xml_node root() const { return xml.document_element(); }
};

void take_appended(Document& document, std::size_t tag) {
  const std::string_view all = document.content;
  const auto end = all.find('>', tag);
  const auto start = all.find('_', end);
  if (end == std::string_view::npos || start == std::string_view::npos)
    throw Damage("the appended data do not begin");
  document.appended = all.substr(start + 1);
  document.appended_as_text = all.substr(tag, end - tag).find("base64") != std::string_view::npos;
}

void parse(Document& document, std::string_view type) {
  constexpr std::string_view root_end = "</VTKFile>";
  const auto tag = document.content.find("<AppendedData");
  auto xml = document.content.substr(0, tag);
  if (tag != std::string::npos) {
    xml += root_end;
    take_appended(document, tag);
  }
  if (const auto result = document.xml.load_buffer(xml.data(), xml.size()); !result)
    throw Damage(fmt::format("found no valid XML ({})", result.description()));
  const auto root = document.root();
  if (root.attribute("type").value() != type)
    throw Damage(
        fmt::format("found a file of type '{}', expected '{}'", root.attribute("type").value(), type));
  const std::string_view order = std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian";
  if (const std::string_view found = root.attribute("byte_order").as_string(order.data()); found != order)
    throw Damage(fmt::format("its bytes are {}, expected {}", found, order));
  const std::string_view compressor = root.attribute("compressor").value();
  document.compressed = !compressor.empty();
  if (document.compressed && compressor != "vtkZLibDataCompressor")
    throw Damage(fmt::format("compressed by {}, expected vtkZLibDataCompressor", compressor));
  if (std::string_view(root.attribute("header_type").value()) == "UInt64")
    document.count_size = sizeof(std::uint64_t);
}

std::size_t letters_for(std::size_t bytes) {
  return (bytes + 2) / 3 * 4;
}

/// Raw bytes or text in base64, read from their beginning on.
class Source {
public:
  Source(std::string_view data, bool as_text) : data_(data), as_text_(as_text) {}

  /// The next bytes; in base64 each call reads what was encoded by itself.
  Bytes take(std::size_t bytes) {
    const auto size = as_text_ ? letters_for(bytes) : bytes;
    if (size > data_.size())
      throw Damage("the data end before their end");
    const auto part = data_.substr(0, size);
    data_.remove_prefix(size);
    if (!as_text_) {
      const auto* const first = reinterpret_cast<const std::byte*>(part.data());
      return {first, first + size};
    }
    auto decoded = from_base64(part);
    if (decoded.size() < bytes)
      throw Damage("the data end before their end");
    decoded.resize(bytes);
    return decoded;
  }

  /// The first bytes, which stay.
  Bytes look(std::size_t bytes) const { return Source(*this).take(bytes); }

private:
  std::string_view data_;
  bool as_text_;
};

std::size_t count_at(const Bytes& bytes, std::size_t index, std::size_t size) {
  std::uint64_t value = 0;
  if (size == sizeof value)
    std::memcpy(&value, bytes.data() + index * size, size);
  else {
    std::uint32_t small = 0;
    std::memcpy(&small, bytes.data() + index * size, sizeof small);
    value = small;
  }
  return value;
}

Bytes plain(Source source, std::size_t count_size) {
  const auto size = count_at(source.look(count_size), 0, count_size);
  auto bytes = source.take(count_size + size);
  bytes.erase(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(count_size));
  return bytes;
}

Bytes inflated(Source source, std::size_t count_size) {
  constexpr std::size_t counts_before_blocks = 3;
  const auto blocks = count_at(source.look(count_size), 0, count_size);
  if (blocks == 0)
    return {};
  const auto header = source.take((counts_before_blocks + blocks) * count_size);
  const auto block_size = count_at(header, 1, count_size);
  const auto last_size = count_at(header, 2, count_size);
  std::size_t compressed_size = 0;
  for (std::size_t i = 0; i < blocks; ++i)
    compressed_size += count_at(header, counts_before_blocks + i, count_size);
  const auto compressed = source.take(compressed_size);
  Bytes bytes((blocks - 1) * block_size + (last_size > 0 ? last_size : block_size));
  std::size_t from = 0;
  for (std::size_t i = 0; i < blocks; ++i) {
    const auto size = count_at(header, counts_before_blocks + i, count_size);
    auto room = static_cast<uLongf>(bytes.size() - i * block_size);
    if (uncompress(reinterpret_cast<Bytef*>(bytes.data() + i * block_size), &room,
                   reinterpret_cast<const Bytef*>(compressed.data() + from),
                   static_cast<uLong>(size)) != Z_OK)
      throw Damage("a block cannot be decompressed");
    from += size;
  }
  return bytes;
}

template <class T, class To> std::vector<To> converted(const Bytes& bytes) {
  std::vector<To> values(bytes.size() / sizeof(T));
  for (std::size_t i = 0; i < values.size(); ++i) {
    T value{};
    std::memcpy(&value, bytes.data() + i * sizeof value, sizeof value);
    values[i] = static_cast<To>(value);
  }
  return values;
}

template <class To> std::vector<To> converted(const Bytes& bytes, std::string_view type) {
  if (type == "Float64")
    return converted<double, To>(bytes);
  if (type == "Float32")
    return converted<float, To>(bytes);
  if (type == "Int64")
    return converted<std::int64_t, To>(bytes);
  if (type == "Int32")
    return converted<std::int32_t, To>(bytes);
  if (type == "UInt8")
    return converted<std::uint8_t, To>(bytes);
  throw Damage(
      fmt::format("found numbers of type '{}', expected Float64, Float32, Int64, Int32 or UInt8", type));
}

template <class To> std::vector<To> numbers_in(std::string_view text) {
  std::vector<To> values;
  constexpr std::string_view blanks = " \t\r\n";
  for (auto at = text.find_first_not_of(blanks); at != std::string_view::npos;
       at = text.find_first_not_of(blanks, at)) {
    To value{};
    const auto [end, error] = std::from_chars(text.data() + at, text.data() + text.size(), value);
    if (error != std::errc())
      throw Damage("found a word that is no number");
    values.push_back(value);
    at = static_cast<std::size_t>(end - text.data());
  }
  return values;
}

template <class To> std::vector<To> values_of(const Document& document, pugi::xml_node array) {
  const std::string_view format = array.attribute("format").as_string("ascii");
  if (format == "ascii")
    return numbers_in<To>(array.child_value());
  const bool appended = format == "appended";
  std::string_view data = appended ? document.appended : std::string_view(array.child_value());
  const auto offset = appended ? array.attribute("offset").as_ullong() : data.find_first_not_of(" \t\r\n");
  if (offset >= data.size())
    throw Damage(fmt::format("the data of '{}' are missing", array.attribute("Name").value()));
  data.remove_prefix(offset);
  const Source source(data, !appended || document.appended_as_text);
  const auto bytes =
      document.compressed ? inflated(source, document.count_size) : plain(source, document.count_size);
  return converted<To>(bytes, array.attribute("type").value());
}

pugi::xml_node array_named(pugi::xml_node parent, const char* name) {
  const auto found = parent.find_child_by_attribute("DataArray", "Name", name);
  if (!found)
    throw Damage(fmt::format("holds no '{}'", name));
  return found;
}

std::vector<std::string> components_of(pugi::xml_node array) {
  const auto count = std::max(1U, array.attribute("NumberOfComponents").as_uint(1));
  std::vector<std::string> names;
  for (unsigned i = 0; i < count; ++i) {
    const auto name = array.attribute(fmt::format("ComponentName{}", i).c_str());
    if (name)
      names.emplace_back(name.value());
    else if (count == 1)
      names.emplace_back();
    else
      names.push_back(count == 3 ? std::string(1, "xyz"[i]) : std::to_string(i + 1));
  }
  return names;
}

/// The cells of a piece, into the builder; the nodes of prisms turned back into this project's order.
void add_cells(const Document& document, pugi::xml_node piece, mesh::NodeIndex node_count,
               mesh::MeshBuilder& builder) {
  const auto cells = piece.child("Cells");
  const auto nodes = values_of<mesh::NodeIndex>(document, array_named(cells, "connectivity"));
  const auto ends = values_of<std::int64_t>(document, array_named(cells, "offsets"));
  const auto types = values_of<int>(document, array_named(cells, "types"));
  if (ends.size() != types.size())
    throw Damage(fmt::format("found {} ends of cells and {} types", ends.size(), types.size()));
  if (std::ranges::any_of(nodes, [&](auto node) { return node < 0 || node >= node_count; }))
    throw Damage("a cell has a node that does not exist");
  std::size_t begin = 0;
  for (std::size_t i = 0; i < types.size(); ++i) {
    const auto type = mesh::cell_type_of_vtk(types[i]);
    if (!type)
      throw Damage(fmt::format("found cells of VTK's type {}, which rubato does not know", types[i]));
    const auto end = static_cast<std::size_t>(ends[i]);
    const auto size = static_cast<std::size_t>(cell::topology(*type).node_count);
    if (end != begin + size || end > nodes.size())
      throw Damage(fmt::format("cell {} has other than its {} nodes", i + 1, size));
    builder.add_cell(*type, mesh::from_vtk_order(*type, std::span(nodes).subspan(begin, size)));
    begin = end;
  }
}

int highest_dimension(const std::vector<int>& types) {
  int highest = 0;
  for (const int number : types)
    if (const auto type = mesh::cell_type_of_vtk(number))
      highest = std::max(highest, cell::topology(*type).dimension);
  return highest;
}

mesh::Mesh mesh_of(const Document& document, pugi::xml_node piece) {
  constexpr std::size_t of_a_point = 3;
  const auto points = values_of<double>(document, piece.child("Points").child("DataArray"));
  const auto types = values_of<int>(document, array_named(piece.child("Cells"), "types"));
  const auto numbers_node = piece.child("PointData").find_child_by_attribute("Name", "node_number");
  const auto numbers =
      numbers_node ? values_of<std::int64_t>(document, numbers_node) : std::vector<std::int64_t>();
  mesh::MeshBuilder builder(highest_dimension(types));
  const auto count = points.size() / of_a_point;
  if (!numbers.empty() && numbers.size() != count)
    throw Damage(fmt::format("found {} numbers for {} nodes", numbers.size(), count));
  for (std::size_t i = 0; i < count; ++i)
    builder.add_node({points[of_a_point * i], points[of_a_point * i + 1], points[of_a_point * i + 2]},
                     numbers.empty() ? 0 : numbers[i]);
  add_cells(document, piece, static_cast<mesh::NodeIndex>(count), builder);
  return std::move(builder).build();
}

pugi::xml_node piece_of(const Document& document) {
  const auto piece = document.root().child("UnstructuredGrid").child("Piece");
  if (!piece || piece.next_sibling("Piece"))
    throw Damage("expected a grid of one piece");
  return piece;
}

/// Numbers and groups of nodes, which meshes have in files for ParaView.
bool is_of_the_mesh(std::string_view array) {
  return array == "node_number" || array.starts_with(mesh::vtk_group_prefix);
}

std::vector<VtuArray> arrays_of(const Document& document) {
  const auto piece = piece_of(document);
  const auto nodes = piece.attribute("NumberOfPoints").as_ullong();
  std::vector<VtuArray> arrays;
  for (const auto node : piece.child("PointData").children("DataArray")) {
    if (is_of_the_mesh(node.attribute("Name").value()))
      continue;
    VtuArray array{node.attribute("Name").value(), components_of(node), values_of<double>(document, node)};
    if (array.values.size() != nodes * array.component_names.size())
      throw Damage(fmt::format("'{}' has {} values for {} nodes of {} components", array.name,
                               array.values.size(), nodes, array.component_names.size()));
    arrays.push_back(std::move(array));
  }
  return arrays;
}

Document opened_document(const fs::path& path) {
  Document document;
  document.content = mesh::file_content(path, path, "a file of fields (.vtu)");
  parse(document, "UnstructuredGrid");
  return document;
}

/// Runs `read`; what is wrong is told with the file's name.
template <class Read> auto reading(const fs::path& path, Read read) {
  try {
    return read();
  } catch (const InputError&) {
    throw;
  } catch (const std::exception& error) {
    throw InputError(fmt::format("{}: {}", path.string(), error.what()));
  }
}

} // namespace

VtuContent read_vtu(const fs::path& path) {
  return reading(path, [&] {
    const auto document = opened_document(path);
    VtuContent content{mesh_of(document, piece_of(document)), arrays_of(document)};
    if (content.mesh.points.size() != piece_of(document).attribute("NumberOfPoints").as_ullong())
      throw Damage("found other than its number of points");
    return content;
  });
}

std::vector<VtuArray> read_vtu_arrays(const fs::path& path) {
  return reading(path, [&] { return arrays_of(opened_document(path)); });
}

std::vector<PvdEntry> read_pvd(const fs::path& path) {
  if (!fs::exists(path))
    return {};
  return reading(path, [&] {
    Document document;
    document.content = mesh::file_content(path, path, "a collection of files of fields (.pvd)");
    parse(document, "Collection");
    std::vector<PvdEntry> entries;
    for (const auto set : document.root().child("Collection").children("DataSet"))
      entries.push_back(
          {set.attribute("timestep").as_double(), path.parent_path() / set.attribute("file").value()});
    return entries;
  });
}

} // namespace rubato::mesh::vtk
