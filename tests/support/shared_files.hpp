// SPDX-License-Identifier: LGPL-3.0-or-later
/// The real meshes and reference histories of SDNL140, which stand beside the project on some machines only.
#pragma once

#include <cstdlib>
#include <filesystem>

namespace rubato::test {

/// `relative` below the folder of shared files: the environment's RUBATO_SHARED, else ../shared beside the
/// sources.
inline std::filesystem::path shared_file(const std::filesystem::path& relative) {
  const char* folder = std::getenv("RUBATO_SHARED");
  return std::filesystem::path(folder != nullptr ? folder : RUBATO_SHARED_DIR) / relative;
}

} // namespace rubato::test
