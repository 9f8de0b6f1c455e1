// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/mesh/io/msh.hpp"
#include "rubato/mesh/io/msh_content.hpp"

#include <fmt/format.h>

#include <set>
#include <string_view>

namespace rubato::mesh {
namespace {

using msh::Content;
using msh::Input;

enum class Version { two, four };

[[noreturn]] void refuse_version(const Input& input, std::string_view found) {
  input.refuse(fmt::format("is of version {} of Gmsh's format, 2.2 or 4.1 was expected; Gmsh converts it: "
                           "gmsh old.msh -save -format msh41 -o new.msh",
                           found));
}

Version version_of(const Input& input, std::string_view word) {
  if (word == "4.1")
    return Version::four;
  if (word == "2" || word.starts_with("2."))
    return Version::two;
  refuse_version(input, word);
}

/// $MeshFormat: version, file type, data size, and a 1 as bytes that shows their order.
Version read_format(Input& input) {
  const auto version = version_of(input, input.word());
  msh::Encoding encoding;
  const auto kind = input.text_integer("the file type, 0 or 1,");
  if (kind != 0 && kind != 1)
    input.refuse_here(fmt::format("found file type {}, expected 0 (text) or 1 (binary)", kind));
  encoding.binary = kind == 1;
  encoding.size_bytes = static_cast<int>(input.text_integer("the data size"));
  if (encoding.size_bytes != 8 && (version == Version::two || encoding.size_bytes != 4))
    input.refuse_here(fmt::format("found data size {}, expected 8", encoding.size_bytes));
  input.rest_of_line();
  input.set_encoding(encoding);
  if (encoding.binary) {
    constexpr std::int64_t one_swapped = 1 << 24;
    const auto one = input.integer("the mark of the byte order");
    if (one != 1 && one != one_swapped)
      input.refuse_here("its mark of the byte order is not 1");
    encoding.swapped = one != 1;
    input.set_encoding(encoding);
  }
  input.end_section("MeshFormat");
  return version;
}

/// $PhysicalNames, text in binary files too: dimension, tag, name in quotes.
void read_names(Input& input, Content& content) {
  const auto count = input.text_integer("the number of physical groups");
  for (std::int64_t i = 0; i < count; ++i) {
    const auto dimension = input.text_integer("the dimension of a physical group");
    const auto tag = input.text_integer("the tag of a physical group");
    auto name = input.rest_of_line();
    if (name.size() >= 2 && name.front() == '"' && name.back() == '"')
      name = name.substr(1, name.size() - 2);
    content.names[{static_cast<int>(dimension), tag}] = name;
  }
}

/// One section of a known version; false for one that says nothing of the mesh.
bool read_section(Input& input, Version version, std::string_view name, msh::Physicals& physicals,
                  Content& content) {
  const bool four = version == Version::four;
  if (name == "PhysicalNames")
    read_names(input, content);
  else if (four && (name == "Entities" || name == "PartitionedEntities"))
    msh::read_entities_4(input, name != "Entities", physicals);
  else if (four && name == "Nodes")
    msh::read_nodes_4(input, physicals, content);
  else if (four && name == "Elements")
    msh::read_cells_4(input, physicals, content);
  else if (!four && (name == "Nodes" || name == "ParametricNodes"))
    msh::read_nodes_2(input, name != "Nodes", content);
  else if (!four && name == "Elements")
    msh::read_cells_2(input, content);
  else
    return false;
  return true;
}

Version read_head(Input& input) {
  auto name = input.next_section();
  for (; name == "Comments"; name = input.next_section())
    input.skip_section(name);
  if (name == "NOD")
    refuse_version(input, "1");
  if (name != "MeshFormat")
    input.refuse("is not a Gmsh mesh: it does not begin with $MeshFormat");
  return read_format(input);
}

} // namespace

Mesh read_msh(const std::filesystem::path& path, const std::filesystem::path& called) {
  Input input(path, called);
  const auto version = read_head(input);
  Content content;
  msh::Physicals physicals;
  std::set<std::string, std::less<>> read;
  for (auto name = input.next_section(); !name.empty(); name = input.next_section()) {
    if (!read_section(input, version, name, physicals, content)) {
      input.skip_section(name);
      continue;
    }
    input.end_section(name);
    if (!read.emplace(name).second)
      input.refuse(fmt::format("is damaged: it has two sections ${}", name));
  }
  if (!read.contains("Nodes") && !read.contains("ParametricNodes"))
    input.refuse("is truncated or damaged: it has no section $Nodes");
  return assembled(input, std::move(content));
}

} // namespace rubato::mesh
