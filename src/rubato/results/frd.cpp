// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/results/frd.hpp"

#include "rubato/cell/topology.hpp"
#include "rubato/core/error.hpp"
#include "rubato/core/writing.hpp"
#include "rubato/results/ccx_numbers.hpp"
#include "rubato/results/csv.hpp"
#include "rubato/version.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <iterator>
#include <utility>

namespace rubato::results {
namespace {

constexpr std::string_view end_of_frd = " 9999\n";
constexpr std::string_view end_of_block = " -3\n";

/// A type of .frd files and the local nodes of the cell in its order.
struct FrdCell {
  int type = 0;
  std::vector<int> nodes;
};

std::vector<int> first_nodes(int count) {
  std::vector<int> nodes(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i)
    nodes[static_cast<std::size_t>(i)] = i;
  return nodes;
}

/// Nodes at the middles of vertical edges stand before those of the top.
FrdCell frd_cell(CellType type) {
  switch (type) {
  case CellType::hexa8:
    return {1, first_nodes(8)};
  case CellType::penta6:
    return {2, first_nodes(6)};
  case CellType::tetra4:
    return {3, first_nodes(4)};
  case CellType::hexa20:
  case CellType::hexa27:
    return {4, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 16, 17, 18, 19, 12, 13, 14, 15}};
  case CellType::penta15:
  case CellType::penta18:
    return {5, {0, 1, 2, 3, 4, 5, 6, 7, 8, 12, 13, 14, 9, 10, 11}};
  case CellType::tetra10:
    return {6, first_nodes(10)};
  case CellType::pyra5:
    return {1, {0, 1, 2, 3, 4, 4, 4, 4}};
  case CellType::pyra13:
    return {4, {0, 1, 2, 3, 4, 4, 4, 4, 5, 6, 7, 8, 9, 10, 11, 12, 4, 4, 4, 4}};
  case CellType::tria3:
    return {7, first_nodes(3)};
  case CellType::tria6:
  case CellType::tria7:
    return {8, first_nodes(6)};
  case CellType::quad4:
    return {9, first_nodes(4)};
  case CellType::quad8:
  case CellType::quad9:
    return {10, first_nodes(8)};
  case CellType::seg2:
    return {11, first_nodes(2)};
  case CellType::seg3:
    return {12, first_nodes(3)};
  default:
    return {};
  }
}

template <class Number> void put_binary(std::string& text, Number value) {
  const auto* bytes = reinterpret_cast<const char*>(&value);
  text.append(bytes, sizeof value);
}

template <class... Values>
void put_text(std::string& text, fmt::format_string<Values...> form, Values&&... values) {
  fmt::format_to(std::back_inserter(text), form, std::forward<Values>(values)...);
}

/// Twelve characters wide; exponents of three digits have no room.
void put_number(std::string& text, double value) {
  constexpr double least = 1e-99;
  put_text(text, "{:12.5E}", std::abs(value) < least ? 0.0 : std::clamp(value, -9e99, 9e99));
}

std::string frd_head(const FrdSettings& settings) {
  constexpr std::array months{"january", "february", "march",     "april",   "may",      "june",
                              "july",    "august",   "september", "october", "november", "december"};
  const auto now = fmt::localtime(std::time(nullptr));
  std::string text = "    1C\n";
  const auto line = [&](std::string_view key, std::string_view value) {
    put_text(text, "    1U{:<18}{:<48}\n", key, value);
  };
  line("USER", "");
  line("DATE", fmt::format("{:02}.{}.{}", now.tm_mday, months.at(static_cast<std::size_t>(now.tm_mon)),
                           now.tm_year + 1900));
  line("TIME", fmt::format("{:02}:{:02}:{:02}", now.tm_hour, now.tm_min, now.tm_sec));
  line("HOST", "");
  line("PGM", "rubato");
  line("VERSION", fmt::format("Version {}", version));
  for (std::size_t i = 0; i < settings.materials.size(); ++i)
    put_text(text, "    1UMAT{:5}{:<58}\n", i + 1, settings.materials[i]);
  return text;
}

void put_nodes(std::string& text, const mesh::Mesh& mesh, std::span<const mesh::NodeIndex> nodes,
               std::span<const std::int32_t> numbers, bool binary) {
  put_text(text, "    2C{:30}{:38}\n", nodes.size(), binary ? 3 : 1);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const auto& place = mesh.points[static_cast<std::size_t>(nodes[i])];
    if (binary)
      put_binary(text, numbers[i]);
    else
      put_text(text, " -1{:10}", numbers[i]);
    for (const double x : place)
      binary ? put_binary(text, x) : put_number(text, x);
    if (!binary)
      text += '\n';
  }
  if (!binary)
    text += end_of_block;
}

void put_cell(std::string& text, const FrdCell& form, std::int32_t number, std::int32_t material,
              std::span<const std::int32_t> nodes, bool binary) {
  if (binary) {
    for (const std::int32_t value : {number, form.type, std::int32_t{0}, material})
      put_binary(text, value);
    for (const int local : form.nodes)
      put_binary(text, nodes[static_cast<std::size_t>(local)]);
    return;
  }
  constexpr std::size_t in_a_line = 10;
  put_text(text, " -1{:10}{:5}{:5}{:5}\n", number, form.type, 0, material);
  for (std::size_t i = 0; i < form.nodes.size(); ++i) {
    if (i % in_a_line == 0)
      text += i == 0 ? " -2" : "\n -2";
    put_text(text, "{:10}", nodes[static_cast<std::size_t>(form.nodes[i])]);
  }
  text += '\n';
}

bool is_written(const mesh::Mesh& mesh, const mesh::CellBlock& block) {
  return is_shown(mesh, block.type) && frd_cell(block.type).type != 0;
}

void put_cells(std::string& text, const mesh::Mesh& mesh, const CcxNumbers& numbers,
               const FrdSettings& settings) {
  std::size_t count = 0;
  for (const auto& block : mesh.blocks)
    count += is_written(mesh, block) ? static_cast<std::size_t>(block.cell_count()) : 0;
  put_text(text, "    3C{:30}{:38}\n", count, settings.binary ? 2 : 1);
  std::size_t cell = 0;
  std::vector<std::int32_t> nodes;
  for (const auto& block : mesh.blocks) {
    const auto form = frd_cell(block.type);
    for (mesh::CellIndex i = 0; i < block.cell_count(); ++i, ++cell) {
      if (!is_written(mesh, block))
        continue;
      nodes.clear();
      for (const auto node : block.cell(i))
        nodes.push_back(numbers.nodes[static_cast<std::size_t>(node)]);
      const auto material = settings.of_cell.empty() ? 0 : settings.of_cell[cell];
      put_cell(text, form, numbers.cells[cell], material + 1, nodes, settings.binary);
    }
  }
  if (!settings.binary)
    text += end_of_block;
}

/// Nodes of cells that are written, ascending by number.
std::vector<mesh::NodeIndex> written_nodes(const mesh::Mesh& mesh, const CcxNumbers& numbers) {
  std::vector<bool> used(mesh.points.size(), false);
  for (const auto& block : mesh.blocks)
    if (is_written(mesh, block))
      for (const auto node : block.nodes)
        used[static_cast<std::size_t>(node)] = true;
  std::vector<mesh::NodeIndex> nodes;
  for (std::size_t i = 0; i < used.size(); ++i)
    if (used[i])
      nodes.push_back(static_cast<mesh::NodeIndex>(i));
  std::ranges::sort(nodes, {}, [&](auto node) { return numbers.nodes[static_cast<std::size_t>(node)]; });
  return nodes;
}

/// Ten digits, as CalculiX writes instants from 1 on.
std::string frd_time(double t) {
  constexpr int digits = 9;
  constexpr double largest = 1e9;
  if (t < 1 || t >= largest)
    return fmt::format("{:12.5E}", t);
  return fmt::format("{:12.{}f}", t, digits - static_cast<int>(std::log10(t)));
}

struct BlockHead {
  int block = 0;
  int instant = 0;
  int increment = 0;
  int step = 0;
  bool modal = false;
};

/// Lines before the values of a block. A mode has its number, too.
std::string first_lines(const BlockHead& head) {
  auto text = fmt::format("    1PSTEP{:26}{:12}{:12}          \n", head.block, head.increment, head.step);
  return head.modal ? text + fmt::format("    1PMODE{:26}\n", head.increment) : text;
}

void put_block_head(std::string& text, const BlockHead& head, double t, const FrdBlock& block,
                    std::size_t nodes, bool binary) {
  text += first_lines(head);
  put_text(text, "  100CL{:5}{}{:12}{:22}{:5}{}{:2}\n", 100 + head.instant, frd_time(t), nodes,
           head.modal ? 2 : 0, head.instant, head.modal ? "MODAL     " : "          ", binary ? 2 : 1);
  const auto size = block.components.size();
  put_text(text, " -4  {:<8}{:5}{:5}\n", block.name, size + (block.kind == FrdKind::vector ? 1 : 0), 1);
  constexpr std::array<std::array<int, 2>, 6> places{{{1, 1}, {2, 2}, {3, 3}, {1, 2}, {2, 3}, {3, 1}}};
  for (std::size_t i = 0; i < size; ++i)
    if (block.kind == FrdKind::vector)
      put_text(text, " -5  {:<8}{:5}{:5}{:5}{:5}\n", block.components[i], 1, 2, i + 1, 0);
    else if (block.kind == FrdKind::tensor)
      put_text(text, " -5  {:<8}{:5}{:5}{:5}{:5}\n", block.components[i], 1, 4, places.at(i)[0],
               places.at(i)[1]);
    else
      put_text(text, " -5  {:<8}{:5}{:5}{:5}{:5}\n", block.components[i], 1, 1, 0, 0);
  if (block.kind == FrdKind::vector)
    put_text(text, " -5  ALL     {:5}{:5}{:5}{:5}{:5}ALL\n", 1, 2, 0, 0, 1);
}

void put_values(std::string& text, const FrdBlock& block, std::span<const mesh::NodeIndex> nodes,
                std::span<const std::int32_t> numbers, bool binary) {
  const auto size = block.components.size();
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const auto values = std::span(block.values).subspan(static_cast<std::size_t>(nodes[i]) * size, size);
    if (binary)
      put_binary(text, numbers[i]);
    else
      put_text(text, " -1{:10}", numbers[i]);
    for (const double value : values)
      binary ? put_binary(text, static_cast<float>(value)) : put_number(text, value);
    if (!binary)
      text += '\n';
  }
  if (!binary)
    text += end_of_block;
}

} // namespace

FrdFile::FrdFile(std::filesystem::path path, const mesh::Mesh& mesh, FrdSettings settings)
    : FrdFile(std::move(path), mesh, std::move(settings), FrdPosition{}) {
  const auto numbers = ccx_numbers(mesh);
  auto text = frd_head(settings_);
  put_nodes(text, mesh, nodes_, numbers_, settings_.binary);
  put_cells(text, mesh, numbers, settings_);
  std::ofstream file(path_, std::ios::trunc | std::ios::binary);
  if (!file)
    throw InputError(fmt::format("{}: cannot be written", path_.string()));
  file << text << end_of_frd;
  finish_writing(file, path_);
  position_.bytes = text.size();
}

FrdFile::FrdFile(std::filesystem::path path, const mesh::Mesh& mesh, FrdSettings settings,
                 const FrdPosition& position)
    : path_(std::move(path)), settings_(std::move(settings)), position_(position) {
  const auto numbers = ccx_numbers(mesh);
  nodes_ = written_nodes(mesh, numbers);
  for (const auto node : nodes_)
    numbers_.push_back(numbers.nodes[static_cast<std::size_t>(node)]);
  if (position.bytes > 0)
    cut(position);
}

void FrdFile::add(double t, int increment, std::span<const FrdBlock> blocks) {
  add_blocks(t, increment, false, blocks);
}

void FrdFile::add_mode(double frequency, int number, std::span<const FrdBlock> blocks) {
  add_blocks(frequency, number, true, blocks);
}

void FrdFile::add_blocks(double value, int increment, bool modal, std::span<const FrdBlock> blocks) {
  const auto before = position_;
  std::filesystem::resize_file(path_, before.bytes);
  try {
    std::ofstream file(path_, std::ios::app | std::ios::binary);
    ++position_.instants;
    for (const auto& block : blocks) {
      ++position_.blocks;
      std::string text;
      put_block_head(text, {position_.blocks, position_.instants, increment, settings_.step, modal}, value,
                     block, nodes_.size(), settings_.binary);
      put_values(text, block, nodes_, numbers_, settings_.binary);
      file << text;
      position_.bytes += text.size();
    }
    file << end_of_frd;
    finish_writing(file, path_);
  } catch (...) {
    cut(before);
    throw;
  }
}

void FrdFile::cut(const FrdPosition& position) {
  position_ = position;
  LineFile(path_, position.bytes).add(end_of_frd.substr(0, end_of_frd.size() - 1));
}

} // namespace rubato::results
