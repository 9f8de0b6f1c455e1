// SPDX-License-Identifier: LGPL-3.0-or-later
/// The real meshes and reference histories of SDNL140, which stand beside the project on some machines only.
#pragma once

#include <cstdlib>
#include <filesystem>

namespace rubato::test {

/// `relative` below the folder of shared files: the environment's RUBATO_SHARED, else ../shared beside the
/// sources. An empty RUBATO_SHARED says that nothing is shared: then no file of that name exists. CTest gives
/// it to every test that is not labelled `shared`.
inline std::filesystem::path shared_file(const std::filesystem::path& relative) {
  const char* variable = std::getenv("RUBATO_SHARED");
  const std::filesystem::path folder = variable != nullptr ? variable : RUBATO_SHARED_DIR;
  const std::filesystem::path nothing_is_below = "/dev/null";
  return (folder.empty() ? nothing_is_below : folder) / relative;
}

} // namespace rubato::test
