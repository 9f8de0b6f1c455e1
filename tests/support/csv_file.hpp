// SPDX-License-Identifier: LGPL-3.0-or-later
/// Files of numbers, separated by commas, below one heading.
#pragma once

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace rubato::test {

/// Row by row; nothing where there is no such file.
inline std::vector<std::vector<double>> csv_rows(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::vector<std::vector<double>> rows;
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::istringstream cells(line);
    auto& row = rows.emplace_back();
    for (std::string cell; std::getline(cells, cell, ',');)
      row.push_back(std::stod(cell));
  }
  return rows;
}

} // namespace rubato::test
