// SPDX-License-Identifier: LGPL-3.0-or-later
// Where modules are looked for.
#include "rubato/core/module_file.hpp"

#include <gtest/gtest.h>

#include <fstream>

namespace rubato::module_file_test {
namespace {

namespace fs = std::filesystem;

TEST(Modules, AreFoundBelowAFolderAboveTheProgram) {
  const auto folder = fs::canonical("/proc/self/exe").parent_path() / "lib";
  fs::create_directories(folder / "rubato");
  const auto file = folder / "rubato" / "rubato_module_file_test.so";
  std::ofstream(file) << "module\n";
  EXPECT_EQ(module_path("rubato_module_file_test.so"), file);
  fs::remove_all(folder);
}

TEST(Modules, HaveAnEmptyPathWhereThereIsNone) {
  EXPECT_EQ(module_path("rubato_missing.so"), fs::path());
}

} // namespace
} // namespace rubato::module_file_test
