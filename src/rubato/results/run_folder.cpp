// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/results/run_folder.hpp"

#include "rubato/core/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>
#include <vector>

namespace rubato::results {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view resultants_prefix = "resultants_";
constexpr std::string_view contact_prefix = "contact_";
constexpr std::size_t step_digits = 6;
constexpr std::string_view copy_prefix = "checkpoint_";

bool is_vtu_file(const std::string& name) {
  const fs::path path(name);
  const auto stem = path.stem().string();
  return path.extension() == ".vtu" && stem.size() >= step_digits &&
         std::ranges::all_of(stem, [](unsigned char letter) { return std::isdigit(letter) != 0; });
}

bool is_copy_of_fields(const std::string& name) {
  return name.starts_with(copy_prefix) && (name.ends_with(".med") || name.ends_with(".vtkhdf"));
}

bool is_file_of_a_run(const std::string& name) {
  constexpr std::array known{probes_file, energy_file, steps_file,  pvd_file,        med_file,
                             vtkhdf_file, frd_file,    tables_file, checkpoint_file, report_file};
  return std::ranges::find(known, name) != known.end() || is_copy_of_fields(name) ||
         ((name.starts_with(resultants_prefix) || name.starts_with(contact_prefix)) &&
          name.ends_with(".csv"));
}

template <class Predicate>
void collect(const fs::path& folder, const Predicate& is_wanted, std::vector<fs::path>& files) {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (entry.is_regular_file() && is_wanted(entry.path().filename().string()))
      files.push_back(entry.path());
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error)
    throw InputError(
        fmt::format("{}: the folder of results cannot be made ({})", folder.string(), error.message()));
}

/// The summary comes last: as long as it is there, the folder is known as a run's.
std::vector<fs::path> former_files(const fs::path& folder) {
  std::vector<fs::path> files;
  collect(folder / vtu_folder, is_vtu_file, files);
  collect(folder, is_file_of_a_run, files);
  if (holds_run(folder))
    files.push_back(folder / summary_file);
  return files;
}

} // namespace

std::string resultants_file(std::string_view zone) {
  return fmt::format("{}{}.csv", resultants_prefix, zone);
}

std::string contact_file(std::string_view zone) {
  return fmt::format("{}{}.csv", contact_prefix, zone);
}

std::vector<std::string> contact_zones(const std::filesystem::path& folder) {
  constexpr std::string_view ending = ".csv";
  std::vector<std::string> zones;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const auto name = entry.path().filename().string();
    if (name.starts_with(resultants_prefix) && name.ends_with(ending))
      zones.push_back(
          name.substr(resultants_prefix.size(), name.size() - resultants_prefix.size() - ending.size()));
  }
  std::ranges::sort(zones);
  return zones;
}

std::string vtu_file(int step) {
  return fmt::format("{:0{}}.vtu", step, step_digits);
}

std::string copy_of_fields(std::string_view file, int step) {
  return fmt::format("{}{:0{}}{}", copy_prefix, step, step_digits, fs::path(file).extension().string());
}

void remove_copies_of_fields(const fs::path& folder, std::span<const std::string> kept) {
  std::vector<fs::path> files;
  collect(
      folder,
      [&](const auto& name) {
        return is_copy_of_fields(name) && std::ranges::find(kept, name) == kept.end();
      },
      files);
  std::error_code ignored;
  for (const auto& file : files)
    fs::remove(file, ignored);
}

void remove_vtu_files_but(const fs::path& folder, std::span<const std::string> kept) {
  std::vector<fs::path> files;
  collect(
      folder / vtu_folder,
      [&](const auto& name) { return is_vtu_file(name) && std::ranges::find(kept, name) == kept.end(); },
      files);
  std::error_code ignored;
  for (const auto& file : files)
    fs::remove(file, ignored);
}

bool holds_run(const fs::path& folder) {
  return fs::exists(folder / summary_file);
}

void prepare_run_folder(const fs::path& folder) {
  make_folder(folder);
  if (!holds_run(folder))
    return;
  const auto former = folder / former_folder;
  std::error_code error;
  for (const auto& file : former_files(former))
    fs::remove(file, error);
  fs::create_directories(former / vtu_folder, error);
  for (const auto& file : former_files(folder)) {
    fs::rename(file, former / file.lexically_relative(folder), error);
    if (error)
      throw InputError(fmt::format("{}: cannot be moved to make room for new results ({})", file.string(),
                                   error.message()));
  }
  fs::remove(former / vtu_folder, error); // when it is empty
}

FolderClaim::FolderClaim(fs::path folder) : folder_(std::move(folder)) {
  take();
}

FolderClaim::~FolderClaim() {
  if (handle_ >= 0)
    close(handle_);
}

void FolderClaim::make() {
  make_folder(folder_);
  if (handle_ < 0)
    take();
}

/// File systems that know no locks leave the folder unclaimed.
void FolderClaim::take() {
  handle_ = open(folder_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (handle_ >= 0 && flock(handle_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    throw InputError(fmt::format("{}: another run is writing into this folder; expected another one (-o), or "
                                 "patience until that run has ended",
                                 folder_.string()));
}

} // namespace rubato::results
