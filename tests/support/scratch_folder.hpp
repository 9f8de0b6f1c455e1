// SPDX-License-Identifier: LGPL-3.0-or-later
/// A folder of its own for a test that writes files; gone with the test.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <stdlib.h> // mkdtemp is POSIX's
#include <string>

namespace rubato::test {

class ScratchFolder {
public:
  ScratchFolder() {
    auto pattern = (std::filesystem::temp_directory_path() / "rubato_test_XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr)
      throw std::runtime_error("no scratch folder");
    path_ = pattern;
  }
  ~ScratchFolder() { std::filesystem::remove_all(path_); }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  const std::filesystem::path& path() const { return path_; }

private:
  std::filesystem::path path_;
};

} // namespace rubato::test
