// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/results/growing_file.hpp"

#include "rubato/core/error.hpp"
#include "rubato/core/writing.hpp"
#include "rubato/results/run_folder.hpp"

#include <fmt/format.h>

#include <string_view>
#include <utility>

namespace rubato::results {
namespace {

void move_over(const std::filesystem::path& from, const std::filesystem::path& to) {
  std::error_code error;
  std::filesystem::rename(from, to, error);
  if (error)
    throw WriteError(to, error.value());
}

/// Copies a file so that the other is there whole or not at all.
void copy_whole(const std::filesystem::path& from, const std::filesystem::path& to) {
  write_whole(to, [&](const std::filesystem::path& beside) {
    require_room(beside, std::filesystem::file_size(from));
    std::filesystem::copy_file(from, beside, std::filesystem::copy_options::overwrite_existing);
  });
}

} // namespace

GrowingFile::GrowingFile(std::filesystem::path folder, std::string_view name, std::string copy)
    : folder_(std::move(folder)), name_(name), copy_(std::move(copy)) {}

const std::string& GrowingFile::name_copy(int step) {
  if (copy_.empty())
    copy_ = copy_of_fields(name_, step);
  return copy_;
}

void GrowingFile::keep_copy() {
  if (!copy_.empty())
    copy_whole(path(), folder_ / copy_);
  copy_.clear();
}

void GrowingFile::restore() const {
  const auto copy = folder_ / copy_;
  if (!copy_.empty() && std::filesystem::exists(copy))
    move_over(copy, path());
  else if (!std::filesystem::exists(path()))
    throw InputError(fmt::format("{}: does not exist, but the checkpoint counts on it", path().string()));
}

} // namespace rubato::results
