// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/core/error.hpp"
#include "rubato/core/writing.hpp"
#include "rubato/results/frd.hpp"

#include <fmt/format.h>

#include <fstream>
#include <string>
#include <string_view>

namespace rubato::results {
namespace {

constexpr std::string_view block_begin = "    1PSTEP";
constexpr std::string_view mode_begin = "    1PMODE"; ///< of natural modes alone
constexpr std::string_view instant_begin = "  100CL";

/// Goes through a file of FrdFile and writes its blocks with other numbers.
class FrdCopier {
public:
  FrdCopier(const std::filesystem::path& path, std::ofstream& to)
      : path_(path), from_(path, std::ios::binary), to_(to) {
    if (!from_)
      throw InputError(fmt::format("{}: cannot be read", path.string()));
  }

  /// Head and mesh, up to the first block.
  void head(bool copied) {
    std::string line;
    while (next(line) && !is_end(line)) {
      if (line.starts_with(block_begin))
        return pending(line);
      if (copied)
        to_ << line << '\n';
      if (line.starts_with("    2C") || line.starts_with("    3C"))
        mesh_part(line, copied);
    }
    ended_ = true;
  }

  void blocks(int first_instant, int& blocks, int& instants) {
    std::string line = pending_;
    for (; !ended_ && line.starts_with(block_begin); ended_ = !next(line) || is_end(line))
      block(line, first_instant, blocks, instants);
    if (!ended_)
      throw InputError(fmt::format("{}: found '{}', expected a block of values", path_.string(), line));
  }

private:
  static bool is_end(const std::string& line) { return line.starts_with(" 9999"); }
  bool next(std::string& line) { return static_cast<bool>(std::getline(from_, line)); }
  void pending(const std::string& line) { pending_ = line; }

  /// An integer of `width` characters from `begin` on.
  int number(const std::string& line, std::size_t begin, std::size_t width) const {
    try {
      return std::stoi(line.substr(std::min(begin, line.size()), width));
    } catch (const std::exception&) {
      throw InputError(
          fmt::format("{}: found '{}', expected a number at column {}", path_.string(), line, begin + 1));
    }
  }

  void bytes(std::size_t count, bool copied) {
    constexpr std::size_t most = 1 << 16;
    std::string buffer;
    for (; count > 0; count -= buffer.size()) {
      buffer.resize(std::min(count, most));
      if (!from_.read(buffer.data(), static_cast<std::streamsize>(buffer.size())))
        throw InputError(fmt::format("{}: ends within its numbers", path_.string()));
      if (copied)
        to_ << buffer;
    }
  }

  void lines_to_end_of_block(bool copied) {
    std::string line;
    while (next(line)) {
      if (copied)
        to_ << line << '\n';
      if (line == " -3")
        return;
    }
  }

  /// Nodes are an integer and three numbers of 8 bytes; cells four integers and their nodes.
  void mesh_part(const std::string& line, bool copied) {
    constexpr int binary_nodes = 3;
    constexpr int binary_cells = 2;
    const int count = number(line, 24, 12);
    const int format = number(line, line.size() - 1, 1);
    if (line.starts_with("    2C") && format == binary_nodes)
      return bytes(static_cast<std::size_t>(count) * 28, copied);
    if (line.starts_with("    3C") && format == binary_cells) {
      for (int i = 0; i < count; ++i)
        binary_cell(copied);
      return;
    }
    lines_to_end_of_block(copied);
  }

  void binary_cell(bool copied) {
    constexpr std::array<std::size_t, 13> nodes{0, 8, 6, 4, 20, 15, 10, 3, 6, 4, 8, 2, 3};
    std::array<std::int32_t, 4> first{};
    from_.read(reinterpret_cast<char*>(first.data()), sizeof first);
    if (!from_ || first[1] < 1 || first[1] >= static_cast<int>(nodes.size()))
      throw InputError(fmt::format("{}: found an element of an unknown type", path_.string()));
    if (copied)
      to_.write(reinterpret_cast<const char*>(first.data()), sizeof first);
    bytes(nodes.at(static_cast<std::size_t>(first[1])) * sizeof(std::int32_t), copied);
  }

  void block(const std::string& begin, int first_instant, int& blocks, int& instants) {
    std::string line;
    next(line);
    std::string mode;
    if (line.starts_with(mode_begin)) {
      mode = line + '\n';
      next(line);
    }
    if (!line.starts_with(instant_begin))
      throw InputError(fmt::format("{}: found '{}', expected {}", path_.string(), line, instant_begin));
    instants = first_instant + number(line, 58, 5);
    const auto nodes = static_cast<std::size_t>(number(line, 24, 12));
    const bool binary = number(line, line.size() - 1, 1) == 2;
    to_ << block_begin << fmt::format("{:26}", ++blocks) << begin.substr(block_begin.size() + 26) << '\n'
        << mode << instant_begin << fmt::format("{:5}", 100 + instants) << line.substr(12, 46)
        << fmt::format("{:5}", instants) << line.substr(63) << '\n';
    std::string name;
    next(name);
    to_ << name << '\n';
    std::size_t values = 0;
    for (int i = number(name, 13, 5); i > 0; --i) {
      next(line);
      to_ << line << '\n';
      values += line.find(" -5  ALL ") == 0 ? 0U : 1U;
    }
    if (binary)
      bytes(nodes * (sizeof(std::int32_t) + values * sizeof(float)), true);
    else
      lines_to_end_of_block(true);
  }

  std::filesystem::path path_;
  std::ifstream from_;
  std::ofstream& to_;
  std::string pending_;
  bool ended_ = false;
};

} // namespace

void join_frd(std::span<const std::filesystem::path> files, const std::filesystem::path& joined) {
  write_whole(joined, [&](const std::filesystem::path& beside) {
    std::ofstream all(beside, std::ios::binary);
    int blocks = 0;
    int instants = 0;
    for (const auto& file : files) {
      FrdCopier copier(file, all);
      copier.head(&file == &files.front());
      copier.blocks(instants, blocks, instants);
    }
    all << " 9999\n";
    finish_writing(all, beside);
  });
}

} // namespace rubato::results
