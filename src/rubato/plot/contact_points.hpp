// SPDX-License-Identifier: LGPL-3.0-or-later
/// contact_ZONE.csv, read back.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace rubato::plot {

struct ContactPoints {
  std::vector<double> t; ///< one a row, ascending
  /// The columns of numbers but t; not a number where the table has nothing.
  std::vector<std::string> names;
  std::vector<std::vector<double>> columns; ///< one value a row each
};

/// Throws InputError when the run has no table of such a zone, with the nearest one, when the table cannot be
/// read, and when it has no row.
ContactPoints read_contact_points(const std::filesystem::path& run, const std::string& zone);

} // namespace rubato::plot
