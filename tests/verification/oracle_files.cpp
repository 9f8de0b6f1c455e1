// SPDX-License-Identifier: LGPL-3.0-or-later
#include "verification/oracle_files.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "support/shared_files.hpp"
#include <fstream>
#include <sstream>

namespace rubato::verification {

std::filesystem::path oracle_file(const std::string& name) {
  return test::shared_file("oracle/" + name + ".csv");
}

bool has_oracle_file(const std::string& name) {
  return std::filesystem::exists(oracle_file(name));
}

OracleTable oracle_table(const std::string& name) {
  std::ifstream stream(oracle_file(name));
  std::string line;
  std::getline(stream, line);
  OracleTable table;
  while (std::getline(stream, line)) {
    std::istringstream cells(line);
    table.emplace_back();
    for (std::string cell; std::getline(cells, cell, ',');)
      table.back().push_back(std::stod(cell));
  }
  return table;
}

std::string oracle_instants(const std::string& name) {
  std::vector<double> instants;
  for (const auto& row : oracle_table(name))
    if (row.front() > 0)
      instants.push_back(row.front());
  return fmt::format("[{}]", fmt::join(instants, ", "));
}

std::string oracle_beams(bool solid) {
  if (solid)
    return R"([{name: Haut, box: {from: [0, 0, 0], to: [1, 0.1, 0.1]}, divisions: [20, 2, 1], cells: hexa8,
    sides: {left: Haut_Encastre, bottom: Haut_Contact}, edges: {right_top: edge}, points: {right_top_back: tip}},
    {name: Bas, box: {from: [0, -0.1, 0], to: [1, 0, 0.1]}, divisions: [20, 2, 1], cells: hexa8,
    sides: {left: Bas_Encastre, top: Bas_Contact}}])";
  return R"([{name: Haut, rectangle: {from: [0, 0], to: [1, 0.1]}, divisions: [20, 2], cells: quad4,
    sides: {left: Haut_Encastre, bottom: Haut_Contact}, points: {right_top: tip}},
    {name: Bas, rectangle: {from: [0, -0.1], to: [1, 0]}, divisions: [20, 2], cells: quad4,
    sides: {left: Bas_Encastre, top: Bas_Contact}}])";
}

} // namespace rubato::verification
