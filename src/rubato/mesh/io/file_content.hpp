// SPDX-License-Identifier: LGPL-3.0-or-later
/// Inside the project only: a file as one string.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace rubato::mesh {

/// Every byte of a file. `called`: what faults call it. `expected`: what it should be, "a Gmsh file". Throws
/// InputError when the file is absent, not a regular file, or cannot be read.
std::string file_content(const std::filesystem::path& path, const std::filesystem::path& called,
                         std::string_view expected);

} // namespace rubato::mesh
