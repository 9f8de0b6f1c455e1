// SPDX-License-Identifier: LGPL-3.0-or-later
#include "inp_comments.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <optional>
#include <sstream>
#include <string_view>
#include <vector>

namespace rubato::app {
namespace {

/// Parts of a deck whose entries come from keywords of their own.
constexpr std::array<std::string_view, 12> parts_with_entries{
    "materials", "supports", "preload",     "relations", "springs", "connectors",
    "masses",    "loads",    "temperature", "initial",   "contact", "probes"};

/// A keyword's block and the comments before and within it.
struct CommentedBlock {
  int first = 0; ///< line of the keyword
  int last = 0;
  std::vector<std::string> comments;
};

/// Without the stars; nothing of lines that only draw.
std::optional<std::string> comment_in(std::string_view line) {
  const auto begin = line.find_first_not_of("* \t");
  if (begin == std::string_view::npos ||
      std::ranges::none_of(line, [](unsigned char c) { return std::isalnum(c) != 0 || c >= 0x80; }))
    return std::nullopt;
  line = line.substr(begin, line.find_last_not_of(" \t\r") - begin + 1);
  std::string text(line);
  std::ranges::replace_if(
      text, [](unsigned char c) { return c < ' '; }, ' ');
  return text;
}

/// The blocks of a file, the first one for what precedes all keywords, and one for what follows all data.
std::vector<CommentedBlock> blocks_of(const std::filesystem::path& inp) {
  std::vector<CommentedBlock> blocks(1);
  std::vector<std::string> pending;
  std::ifstream file(inp, std::ios::binary);
  int number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    const auto begin = std::min(line.find_first_not_of(" \t\r"), line.size());
    const auto rest = std::string_view(line).substr(begin);
    if (rest.starts_with("**")) {
      if (auto comment = comment_in(rest))
        pending.push_back(std::move(*comment));
      continue;
    }
    if (rest.starts_with('*'))
      blocks.push_back({number, number, {}});
    auto& comments = blocks.back().comments;
    comments.insert(comments.end(), pending.begin(), pending.end());
    pending.clear();
    blocks.back().last = number;
  }
  blocks.push_back({0, 0, std::move(pending)});
  return blocks;
}

/// Writes the lines of a deck, with the comments of each block before its entry.
class CommentWriter {
public:
  CommentWriter(const deck::Deck& deck, const std::filesystem::path& inp)
      : deck_(deck), file_(inp.string()), blocks_(blocks_of(inp)) {}

  std::string written(const std::string& text) {
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);)
      add(line);
    std::string head;
    for (const auto& block : blocks_)
      head += comment_lines(block, 0);
    return head + body_;
  }

private:
  struct Frame {
    std::string path;
    bool is_list = false;
    int next = 0;
    bool of_runs = false;
  };

  void add(const std::string& line) {
    const auto indentation = std::min(line.find_first_not_of(' '), line.size());
    const auto rest = std::string_view(line).substr(indentation);
    if (rest.starts_with('}') || rest.starts_with(']')) {
      if (!frames_.empty())
        frames_.pop_back();
    } else if (rest == R"({"runs": {)") {
      frames_.push_back({"", false, 0, true});
    } else if (frames_.empty()) {
      frames_.push_back({});
    } else {
      add_entry(rest, indentation);
    }
    body_ += line + "\n";
  }

  void add_entry(std::string_view rest, std::size_t indentation) {
    auto& frame = frames_.back();
    const auto key =
        frame.is_list ? std::to_string(frame.next++) : std::string(rest.substr(1, rest.find("\": ") - 1));
    if (frame.of_runs) {
      enter_run(key);
      frames_.push_back({});
      return;
    }
    const auto path = frame.path.empty() ? key : frame.path + "." + key;
    comment(path, indentation);
    if (rest.ends_with('{') || rest.ends_with('['))
      frames_.push_back({path, rest.ends_with('['), 0, false});
  }

  void enter_run(const std::string& name) {
    const auto run = std::ranges::find(deck_.runs, name, &study::Study::name);
    run_ = static_cast<std::size_t>(run - deck_.runs.begin());
    write_block_at(deck_.places[run_].of(""), 0);
  }

  void comment(const std::string& path, std::size_t indentation) {
    const auto dots = std::ranges::count(path, '.');
    const auto part = path.substr(0, path.find('.'));
    const bool has_entries = std::ranges::find(parts_with_entries, part) != parts_with_entries.end();
    if (dots != (has_entries ? 1 : 0))
      return;
    const auto& places = deck_.places[run_];
    const auto at = places.of(path);
    const auto whole = places.of("");
    if (at.line != whole.line || at.file != whole.file)
      write_block_at(at, indentation);
  }

  void write_block_at(const Location& at, std::size_t indentation) {
    if (at.file != file_ || at.line == 0)
      return;
    const auto block = std::ranges::find_if(
        blocks_, [&](const CommentedBlock& one) { return one.first <= at.line && at.line <= one.last; });
    if (block == blocks_.end())
      return;
    body_ += comment_lines(*block, indentation);
    block->comments.clear();
  }

  static std::string comment_lines(const CommentedBlock& block, std::size_t indentation) {
    std::string text;
    for (const auto& comment : block.comments)
      text += std::string(indentation, ' ') + "# " + comment + "\n";
    return text;
  }

  const deck::Deck& deck_;
  std::string file_;
  std::vector<CommentedBlock> blocks_;
  std::vector<Frame> frames_;
  std::size_t run_ = 0;
  std::string body_;
};

} // namespace

std::string with_comments(const std::string& text, const deck::Deck& deck, const std::filesystem::path& inp) {
  return CommentWriter(deck, inp).written(text);
}

} // namespace rubato::app
