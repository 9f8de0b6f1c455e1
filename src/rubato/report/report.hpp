// SPDX-License-Identifier: LGPL-3.0-or-later
/// The report of a run, or of two side by side: one HTML file that a browser opens from the disk.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace rubato::report {

/// A report is not larger than this [bytes]; where all fields would not fit, they are made coarser, and then
/// instants are left out (view_data.hpp).
inline constexpr std::size_t largest_report = 58'000'000;

struct Written {
  std::uintmax_t bytes = 0;
  std::vector<std::string> notes; ///< sentences about what is not in the report, or less fine than stored
};

/// Writes the report of one or two run folders, complete or not. A run without fields, or whose fields cannot
/// be read, has no view; the report says why. Throws InputError when a folder is no run's or the file cannot
/// be written, WriteError when it cannot be written to its end: the former one is still there then.
Written write_report(std::span<const std::filesystem::path> runs, const std::filesystem::path& file,
                     std::size_t largest = largest_report);

} // namespace rubato::report
