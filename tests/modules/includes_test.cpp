// SPDX-License-Identifier: LGPL-3.0-or-later
// The order of the modules, read from every #include of the sources.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace rubato::includes_test {
namespace {

namespace fs = std::filesystem;

/// Each module may include those before it. `deck` and `inp` are front ends, beside the mechanics: they see
/// the study and what a study needs, `inp` also the mesh that its files have, and only programs see them.
constexpr std::array<std::string_view, 22> order{
    "core",       "cell",       "study",   "mesh", "linalg", "material", "element", "domain",
    "load",       "constraint", "contact", "time", "model",  "modes",    "ccx",     "step",
    "simulation", "results",    "plot",    "run",  "report", "apps"};
constexpr std::array<std::string_view, 3> seen_by_deck{"core", "cell", "study"};
constexpr std::array<std::string_view, 4> seen_by_inp{"core", "cell", "study", "mesh"};
/// Libraries of matrices know of no mechanics, only how work is dealt out to threads.
constexpr std::array<std::string_view, 1> seen_by_linalg{"core"};
/// Folders in modules whose headers all may include.
constexpr std::array<std::string_view, 2> open_folders{"mesh/io", "step/explicit"};

struct Include {
  std::string from; ///< path of the file below src/rubato, or "apps/…"
  std::string to;   ///< path below src/rubato
};

std::string room_of(const std::string& path) {
  return path.substr(0, path.find('/'));
}

std::string folder_of(const std::string& path) {
  return fs::path(path).parent_path().generic_string();
}

std::optional<std::string> included_by(const std::string& line) {
  constexpr std::string_view start = "#include \"rubato/";
  if (!line.starts_with(start))
    return std::nullopt;
  return line.substr(start.size(), line.rfind('"') - start.size());
}

void read_includes(const fs::path& root, const std::string& prefix, std::vector<Include>& includes) {
  for (const auto& entry : fs::recursive_directory_iterator(root)) {
    const auto extension = entry.path().extension();
    if (extension != ".cpp" && extension != ".hpp")
      continue;
    std::ifstream file(entry.path());
    for (std::string line; std::getline(file, line);)
      if (const auto to = included_by(line); to && to->find('/') != std::string::npos)
        includes.push_back({prefix + fs::relative(entry.path(), root).generic_string(), *to});
  }
}

std::vector<Include> every_include() {
  const fs::path source(RUBATO_SOURCE_DIR);
  std::vector<Include> includes;
  read_includes(source / "src/rubato", "", includes);
  read_includes(source / "apps", "apps/", includes);
  return includes;
}

bool may_see(const std::string& module, const std::string& other) {
  if (module == other)
    return true;
  if (module == "deck")
    return std::ranges::find(seen_by_deck, other) != seen_by_deck.end();
  if (module == "inp")
    return std::ranges::find(seen_by_inp, other) != seen_by_inp.end();
  if (module == "linalg")
    return std::ranges::find(seen_by_linalg, other) != seen_by_linalg.end();
  if (other == "deck" || other == "inp")
    return module == "apps";
  return std::ranges::find(order, other) < std::ranges::find(order, module);
}

TEST(Modules, AreAllNamedInTheirOrder) {
  std::set<std::string> modules;
  for (const auto& entry : fs::directory_iterator(fs::path(RUBATO_SOURCE_DIR) / "src/rubato"))
    if (entry.is_directory())
      modules.insert(entry.path().filename().string());
  std::set<std::string> named(order.begin(), order.end());
  named.erase("apps");
  named.insert("deck");
  named.insert("inp");
  EXPECT_EQ(modules, named);
}

TEST(Modules, IncludeOnlyWhatComesBeforeThem) {
  const auto includes = every_include();
  EXPECT_GT(includes.size(), 300U);
  for (const auto& [from, to] : includes)
    EXPECT_TRUE(may_see(room_of(from), room_of(to))) << from << " includes " << to;
}

TEST(Modules, KeepTheirInsideToThemselves) {
  for (const auto& [from, to] : every_include()) {
    const auto folder = folder_of(to);
    const bool inside = folder.find('/') != std::string::npos &&
                        std::ranges::find(open_folders, folder) == open_folders.end();
    EXPECT_TRUE(!inside || room_of(from) == room_of(to)) << from << " includes " << to;
  }
}

TEST(Files, HaveAtMostFiveHundredLines) {
  for (const auto* folder : {"src", "apps", "tests", "bench"})
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(RUBATO_SOURCE_DIR) / folder)) {
      const auto extension = entry.path().extension();
      if (extension != ".cpp" && extension != ".hpp" && extension != ".py")
        continue;
      std::ifstream file(entry.path());
      const auto lines = std::count(std::istreambuf_iterator<char>(file), {}, '\n');
      EXPECT_LE(lines, 500) << entry.path();
    }
}

} // namespace
} // namespace rubato::includes_test
