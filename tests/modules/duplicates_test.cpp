// SPDX-License-Identifier: LGPL-3.0-or-later
// No logic has two homes: no two modules share six lines of code that are the same.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace rubato::duplicates_test {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t shared_lines = 6;

/// A line of code, white space folded.
struct Line {
  std::string text;
  int number = 0;
};

struct Source {
  std::string module;
  std::string path;
  std::vector<Line> lines;
};

std::string folded(std::string_view line) {
  std::string text;
  for (const unsigned char letter : line) {
    if (!std::isspace(letter))
      text += static_cast<char>(letter);
    else if (!text.empty() && text.back() != ' ')
      text += ' ';
  }
  if (text.ends_with(' '))
    text.pop_back();
  return text;
}

bool is_code(std::string_view text) {
  return !text.starts_with('#') && std::ranges::any_of(text, [](unsigned char letter) {
    return std::isalnum(letter) || letter == '_';
  });
}

/// The lines that count: comments, preprocessor lines and lone punctuation are passed over.
std::vector<Line> code_lines(std::istream& text) {
  std::vector<Line> lines;
  int number = 0;
  for (std::string line; std::getline(text, line);) {
    ++number;
    const auto code = folded(line.substr(0, line.find("//")));
    if (is_code(code))
      lines.push_back({code, number});
  }
  return lines;
}

/// "a.cpp:10 ~ b.cpp:20" for every run of lines that stands in two modules.
std::set<std::string> shared_between_rooms(const std::vector<Source>& sources) {
  struct Stand {
    const Source* source;
    int line;
  };
  std::map<std::string, std::vector<Stand>> stands;
  for (const auto& source : sources)
    for (std::size_t i = 0; i + shared_lines <= source.lines.size(); ++i) {
      std::string run;
      for (std::size_t k = 0; k < shared_lines; ++k)
        run += source.lines[i + k].text + '\n';
      stands[run].push_back({&source, source.lines[i].number});
    }
  std::set<std::string> pairs;
  for (const auto& [run, at] : stands)
    for (const auto& one : at)
      for (const auto& other : at)
        if (one.source->module < other.source->module)
          pairs.insert(one.source->path + ":" + std::to_string(one.line) + " ~ " + other.source->path + ":" +
                       std::to_string(other.line));
  return pairs;
}

void read_sources(const fs::path& root, const std::string& whole, std::vector<Source>& sources) {
  for (const auto& entry : fs::recursive_directory_iterator(root)) {
    const auto extension = entry.path().extension();
    if (extension != ".cpp" && extension != ".hpp")
      continue;
    const auto path = fs::relative(entry.path(), root).generic_string();
    std::ifstream file(entry.path());
    sources.push_back({whole.empty() ? path.substr(0, path.find('/')) : whole, path, code_lines(file)});
  }
}

Source source(const std::string& module, const std::string& text) {
  std::istringstream stream(text);
  return {module, module + ".cpp", code_lines(stream)};
}

constexpr std::string_view six = "a = 1;\nb = 2;\nc = 3;\nd = 4;\ne = 5;\nf = 6;\n";

TEST(SharedLines, AreFoundWhateverStandsBetweenThem) {
  const auto one = source("one", "int x;\n" + std::string(six));
  const auto other = source(
      "other", "// why\n  a   = 1;\n\n{\nb = 2; // two\n#include <map>\nc = 3;\n}\nd = 4;\ne = 5;\nf = 6;");
  EXPECT_EQ(shared_between_rooms({one, other}), std::set<std::string>{"one.cpp:2 ~ other.cpp:2"});
}

TEST(SharedLines, AreNoneOfOneRoomOrOfFiveLinesOrOfOtherNames) {
  const auto one = source("one", std::string(six));
  EXPECT_TRUE(shared_between_rooms({one, source("one", std::string(six))}).empty());
  EXPECT_TRUE(shared_between_rooms({one, source("other", std::string(six.substr(7)))}).empty());
  EXPECT_TRUE(shared_between_rooms({one, source("other", "a = 0;" + std::string(six.substr(6)))}).empty());
}

TEST(Modules, ShareNoSixLinesOfCode) {
  const fs::path root(RUBATO_SOURCE_DIR);
  std::vector<Source> sources;
  read_sources(root / "src/rubato", "", sources);
  read_sources(root / "apps", "apps", sources);
  ASSERT_GT(sources.size(), 300U);
  for (const auto& pair : shared_between_rooms(sources))
    ADD_FAILURE() << pair << ": the same " << shared_lines << " lines; give them one home";
}

} // namespace
} // namespace rubato::duplicates_test
