// SPDX-License-Identifier: LGPL-3.0-or-later
// Format: Code_Aster documentation U3.01.00, "Code_Aster mesh file description".
#include "rubato/mesh/io/mail.hpp"

#include "rubato/core/error.hpp"
#include "rubato/core/naming.hpp"
#include "rubato/core/writing.hpp"
#include "rubato/mesh/builder.hpp"
#include "rubato/mesh/io/mail_cells.hpp"
#include "rubato/mesh/io/mail_words.hpp"
#include "rubato/mesh/names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <unordered_map>
#include <unordered_set>

namespace rubato::mesh {
namespace {

using mail::Word;
using mail::Words;

struct FoundCell {
  const mail::KnownType* type;
  Word name;
  std::vector<Word> nodes; ///< in Code_Aster's order
};

struct FoundGroup {
  Word name;
  std::vector<Word> members;
};

/// What the file says, before names are looked up: blocks come in any order.
struct MailContent {
  Word coordinates; ///< the first keyword COOR_2D or COOR_3D; empty: none yet
  int dimension = 0;
  std::vector<Word> node_names;
  std::vector<Eigen::Vector3d> points;
  std::vector<FoundCell> cells;
  std::vector<FoundGroup> node_groups;
  std::vector<FoundGroup> cell_groups;
};

std::string quoted(Word word) {
  return shown(std::string(word));
}

std::vector<std::string> keywords() {
  std::vector<std::string> all{"TITRE", "COOR_2D", "COOR_3D", "GROUP_NO", "GROUP_MA", "FINSF", "FIN"};
  for (const auto& type : mail::all_types())
    all.emplace_back(type.name);
  return all;
}

bool is_keyword(Word word) {
  static const auto all = [] {
    const auto words = keywords();
    return std::unordered_set<std::string>(words.begin(), words.end());
  }();
  return all.contains(std::string(word));
}

/// What follows a block's keyword on its line: KEY = value pairs, of which only NOM matters. NBLIGE is how
/// many lines the pairs take. Returns the value of NOM.
Word read_header(Words& words, Word keyword) {
  Word name;
  int lines = 0;
  for (auto key = words.next_on_line(); !key.empty(); key = words.next_on_line()) {
    const auto equals = words.next_on_line();
    const auto value = equals == "=" ? words.next_on_line() : Word();
    if (value.empty())
      words.refuse(key, fmt::format("found {} on the line of {}, expected KEY = value there, or the words of "
                                    "the block on the next line",
                                    quoted(key), keyword));
    if (key == "NOM")
      name = value;
    if (key == "NBLIGE" && std::from_chars(value.begin(), value.end(), lines).ec != std::errc())
      words.refuse(value, fmt::format("found {}, expected a number of lines", quoted(value)));
  }
  words.skip_lines(lines);
  return name;
}

/// The name that begins the next item of a block; empty at the block's end.
Word next_item(Words& words, Word keyword) {
  const auto name = words.next();
  if (name == "FINSF")
    return {};
  if (name.empty() || is_keyword(name))
    words.refuse(name, fmt::format("found {} in the block {} of line {}, expected FINSF before it",
                                   name.empty() ? "the end of the file" : quoted(name), keyword,
                                   words.line_of(keyword)));
  return name;
}

/// A number in one of Fortran's forms: 1, .1E1, +10.D-1.
double number_in(const Words& words, Word word, int axis, Word node) {
  std::string text(word.substr(word.starts_with('+') ? 1 : 0));
  std::ranges::replace_if(
      text, [](char letter) { return letter == 'D' || letter == 'd'; }, 'E');
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
    words.refuse(word, fmt::format("found {}, expected a number, coordinate {} of node {}", quoted(word),
                                   axis + 1, quoted(node)));
  return value;
}

void read_coordinates(Words& words, Word keyword, MailContent& content) {
  const int dimension = keyword == "COOR_2D" ? 2 : 3;
  if (content.dimension != 0 && content.dimension != dimension)
    words.refuse(keyword, fmt::format("found {}, expected {} as in line {}", keyword, content.coordinates,
                                      words.line_of(content.coordinates)));
  content.coordinates = content.dimension == 0 ? keyword : content.coordinates;
  content.dimension = dimension;
  for (auto name = next_item(words, keyword); !name.empty(); name = next_item(words, keyword)) {
    Eigen::Vector3d point = Eigen::Vector3d::Zero();
    for (int axis = 0; axis < dimension; ++axis)
      point[axis] = number_in(words, words.next(), axis, name);
    content.node_names.push_back(name);
    content.points.push_back(point);
  }
}

void read_cells(Words& words, Word keyword, const mail::KnownType& type, MailContent& content) {
  const auto count = static_cast<std::size_t>(cell::topology(type.ours).node_count);
  for (auto name = next_item(words, keyword); !name.empty(); name = next_item(words, keyword)) {
    auto& cell = content.cells.emplace_back(FoundCell{&type, name, {}});
    cell.nodes.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      const auto node = words.next();
      if (node.empty() || node == "FINSF")
        words.refuse(
            node,
            fmt::format("found {} after {} nodes of cell {}, expected {} nodes of each cell of the block {}",
                        node.empty() ? "the end of the file" : quoted(node), i, quoted(name), count,
                        type.name));
      cell.nodes.push_back(node);
    }
  }
}

void read_group(Words& words, Word keyword, Word name, std::vector<FoundGroup>& groups) {
  // A group may be called as a keyword is: QUAD4.
  if (name.empty())
    name = words.next();
  if (name.empty() || name == "FINSF")
    words.refuse(name, fmt::format("found {}, expected the name of the {} of line {}",
                                   name.empty() ? "the end of the file" : quoted(name), keyword,
                                   words.line_of(keyword)));
  auto& group = groups.emplace_back(FoundGroup{name, {}});
  for (auto member = next_item(words, keyword); !member.empty(); member = next_item(words, keyword))
    group.members.push_back(member);
}

/// Free text up to the line that begins with FINSF.
void skip_title(Words& words, Word keyword) {
  for (words.skip_lines(1); !words.begins_line("FINSF"); words.skip_lines(1))
    if (words.is_at_end())
      words.refuse({}, fmt::format("found the end of the file in the block TITRE of line {}, expected FINSF "
                                   "before it",
                                   words.line_of(keyword)));
  words.skip_lines(1);
}

void read_block(Words& words, Word keyword, MailContent& content) {
  if (keyword == "TITRE") {
    skip_title(words, keyword);
  } else if (const auto* const type = mail::type_named(keyword)) {
    read_header(words, keyword);
    read_cells(words, keyword, *type, content);
  } else if (keyword == "COOR_2D" || keyword == "COOR_3D") {
    read_header(words, keyword);
    read_coordinates(words, keyword, content);
  } else if (keyword == "GROUP_NO" || keyword == "GROUP_MA") {
    const auto name = read_header(words, keyword);
    read_group(words, keyword, name, keyword == "GROUP_NO" ? content.node_groups : content.cell_groups);
  } else {
    words.refuse(keyword, fmt::format("found {}, expected FIN, or a block that this program knows{}",
                                      quoted(keyword), suggestion(std::string(keyword), keywords())));
  }
}

MailContent content_of(Words& words) {
  MailContent content;
  for (auto keyword = words.next(); keyword != "FIN"; keyword = words.next()) {
    if (keyword.empty())
      words.refuse({}, "found the end of the file, expected FIN before it");
    read_block(words, keyword, content);
  }
  return content;
}

/// Where each name stands in a list that must not repeat one.
class Places {
public:
  /// `what`: "node", "cell", "group of nodes".
  Places(const Words& words, std::string_view what) : words_(words), what_(what) {}

  void add(Word name) {
    const auto [first, is_new] = places_.try_emplace(name, static_cast<std::int32_t>(places_.size()));
    if (!is_new)
      words_.refuse(name, fmt::format("found {} {} a second time, expected each name once: it stands in line "
                                      "{} too",
                                      what_, quoted(name), words_.line_of(first->first)));
  }

  /// `owner`: of the name, for the message.
  std::int32_t of(Word name, const std::string& owner) const {
    const auto found = places_.find(name);
    if (found == places_.end())
      refuse_unknown(name, owner);
    return found->second;
  }

private:
  [[noreturn]] void refuse_unknown(Word name, const std::string& owner) const {
    std::vector<std::string> known;
    for (const auto& [other, place] : places_)
      known.emplace_back(other);
    std::ranges::sort(known);
    const auto nearest = nearest_word(std::string(name), known);
    words_.refuse(name,
                  fmt::format("found {} in {}, expected the name of a {} of the file{}", quoted(name), owner,
                              what_, nearest.empty() ? "" : fmt::format("; did you mean '{}'?", nearest)));
  }

  const Words& words_;
  std::string_view what_;
  std::unordered_map<Word, std::int32_t> places_;
};

Places places_of(const Words& words, std::string_view what, std::span<const Word> names) {
  Places places(words, what);
  for (const auto name : names)
    places.add(name);
  return places;
}

std::vector<std::int32_t> members_of(const FoundGroup& group, const Places& places) {
  std::vector<std::int32_t> items;
  const auto owner = fmt::format("group {}", quoted(group.name));
  for (const auto member : group.members)
    items.push_back(places.of(member, owner));
  return items;
}

void add_cell(const FoundCell& found, const Places& nodes, MeshBuilder& builder) {
  const auto& [type, name, theirs] = found;
  const auto owner = fmt::format("{} cell {}", type->name, quoted(name));
  std::vector<NodeIndex> ours;
  for (std::size_t i = 0; i < theirs.size(); ++i)
    ours.push_back(nodes.of(theirs[type->order.empty() ? i : type->order[i]], owner));
  builder.add_cell(type->ours, ours, builder.cell_count() + 1, std::string(name));
}

Mesh assembled(const Words& words, const MailContent& content) {
  if (content.points.empty() || content.cells.empty())
    words.refuse({}, fmt::format("found no {} in the file, expected some",
                                 content.points.empty() ? "nodes (COOR_2D or COOR_3D)" : "cells"));
  MeshBuilder builder(content.dimension);
  for (std::size_t i = 0; i < content.points.size(); ++i)
    builder.add_node(content.points[i], static_cast<std::int64_t>(i) + 1, std::string(content.node_names[i]));
  const auto nodes = places_of(words, "node", content.node_names);
  Places cells(words, "cell");
  for (const auto& cell : content.cells) {
    cells.add(cell.name);
    add_cell(cell, nodes, builder);
  }
  Places node_groups(words, "group of nodes");
  for (const auto& group : content.node_groups) {
    node_groups.add(group.name);
    builder.add_to_node_group(std::string(group.name), members_of(group, nodes));
  }
  Places cell_groups(words, "group of cells");
  for (const auto& group : content.cell_groups) {
    cell_groups.add(group.name);
    builder.add_to_cell_group(std::string(group.name), members_of(group, cells));
  }
  return std::move(builder).build();
}

/// Writes blocks of items; an item begins a line and goes on in the next where it would pass column 80.
class Blocks {
public:
  void begin(std::string_view keyword) { text_ += fmt::format("{}\n", keyword); }
  void end() { text_ += "FINSF\n%\n"; }

  void begin_item(std::string_view name) {
    width_ = 0;
    add(name);
  }
  void add(std::string_view word) {
    constexpr std::size_t line_width = 80;
    if (width_ > 0 && width_ + 1 + word.size() > line_width) {
      text_ += '\n';
      width_ = 0;
    }
    text_ += ' ';
    text_ += word;
    width_ += 1 + word.size();
  }
  void end_item() { text_ += '\n'; }

  std::string whole() && { return std::move(text_) + "FIN\n"; }

private:
  std::string text_;
  std::size_t width_ = 0;
};

void check_name(const std::string& name, std::size_t longest, std::string_view what) {
  if (name.empty() || name.size() > longest || is_keyword(name) ||
      std::ranges::any_of(
          name, [](unsigned char c) { return c <= ' ' || c > '~' || c == ',' || c == '%' || c == '='; }))
    throw InputError(
        fmt::format("{} {} cannot be written as a mesh file of Code_Aster, expected a name of 1 to "
                    "{} letters without blanks, commas, %, = and keywords of the format",
                    what, shown(name), longest));
}

/// A copy in which every node and cell has a name.
Mesh named(Mesh mesh) {
  if (mesh.node_names.empty())
    mesh.node_names = {node_name(mesh, 0)};
  if (!mesh.blocks.empty() && std::ranges::all_of(mesh.blocks, [](const auto& b) { return b.names.empty(); }))
    mesh.blocks.front().names = {fmt::format("M{}", mesh.blocks.front().numbers.front())};
  name_the_rest(mesh);
  constexpr std::size_t longest = 8;
  for (const auto& name : mesh.node_names)
    check_name(name, longest, "node");
  for (const auto& block : mesh.blocks)
    for (const auto& name : block.names)
      check_name(name, longest, "cell");
  return mesh;
}

void write_nodes(const Mesh& mesh, Blocks& blocks) {
  blocks.begin(mesh.dimension == 2 ? "COOR_2D" : "COOR_3D");
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    blocks.begin_item(mesh.node_names[i]);
    for (int axis = 0; axis < mesh.dimension; ++axis)
      blocks.add(fmt::format("{:.16E}", mesh.points[i][axis]));
    blocks.end_item();
  }
  blocks.end();
}

void write_cells(const Mesh& mesh, const CellBlock& block, Blocks& blocks) {
  const auto& [name, ours, order] = mail::all_types()[static_cast<std::size_t>(block.type)];
  std::vector<NodeIndex> theirs;
  blocks.begin(name);
  for (CellIndex cell = 0; cell < block.cell_count(); ++cell) {
    const auto nodes = block.cell(cell);
    theirs.assign(nodes.begin(), nodes.end());
    for (std::size_t i = 0; i < order.size(); ++i)
      theirs[order[i]] = nodes[i];
    blocks.begin_item(block.names[static_cast<std::size_t>(cell)]);
    for (const auto node : theirs)
      blocks.add(mesh.node_names[static_cast<std::size_t>(node)]);
    blocks.end_item();
  }
  blocks.end();
}

template <class NameOf>
void write_groups(std::string_view keyword, const std::vector<Group>& groups, NameOf name_of,
                  Blocks& blocks) {
  constexpr std::size_t longest = 24;
  for (const auto& group : groups) {
    check_name(group.name, longest, "group");
    blocks.begin(fmt::format("{} NOM = {}", keyword, group.name));
    blocks.begin_item({});
    for (const auto item : group.in_order())
      blocks.add(name_of(item));
    blocks.end_item();
    blocks.end();
  }
}

} // namespace

Mesh read_mail(const std::filesystem::path& path) {
  Words words(path);
  const auto content = content_of(words);
  return assembled(words, content);
}

void write_mail(const std::filesystem::path& path, const Mesh& mesh) {
  const auto all = named(mesh);
  Blocks blocks;
  write_nodes(all, blocks);
  for (const auto& block : all.blocks)
    write_cells(all, block, blocks);
  write_groups(
      "GROUP_NO", all.node_groups, [&](NodeIndex node) { return node_name(all, node); }, blocks);
  write_groups(
      "GROUP_MA", all.cell_groups, [&](CellIndex cell) { return cell_name(all, cell); }, blocks);
  const auto text = std::move(blocks).whole();
  write_whole(path, [&](const std::filesystem::path& beside) {
    std::ofstream stream(beside, std::ios::binary);
    if (!stream)
      throw InputError(fmt::format(
          "file '{}' cannot be written: is there such a folder, and may you write into it?", path.string()));
    stream << text;
    finish_writing(stream, path);
  });
}

} // namespace rubato::mesh
