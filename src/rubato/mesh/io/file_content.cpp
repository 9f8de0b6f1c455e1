// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/mesh/io/file_content.hpp"

#include "rubato/core/error.hpp"

#include <fmt/format.h>

#include <fstream>

namespace rubato::mesh {

std::string file_content(const std::filesystem::path& path, const std::filesystem::path& called,
                         std::string_view expected) {
  const auto refuse = [&](std::string_view why) {
    throw InputError(fmt::format("mesh file '{}' {}", called.string(), why));
  };
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status))
    refuse("does not exist");
  if (!std::filesystem::is_regular_file(status))
    refuse(fmt::format("is {}, {} was expected",
                       std::filesystem::is_directory(status) ? "a directory" : "not a regular file",
                       expected));
  std::ifstream stream(path, std::ios::binary);
  if (!stream)
    refuse("cannot be read: permission denied");
  std::string text(std::filesystem::file_size(path), '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (stream.gcount() != static_cast<std::streamsize>(text.size()))
    refuse("cannot be read to its end");
  return text;
}

} // namespace rubato::mesh
