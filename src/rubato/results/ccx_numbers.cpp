// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/results/ccx_numbers.hpp"

#include "rubato/cell/topology.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace rubato::results {
namespace {

std::vector<std::int32_t> fitting_numbers(const std::vector<std::int64_t>& numbers) {
  auto sorted = numbers;
  std::ranges::sort(sorted);
  const bool fit = !sorted.empty() && sorted.front() >= 1 &&
                   sorted.back() <= std::numeric_limits<std::int32_t>::max() &&
                   std::ranges::adjacent_find(sorted) == sorted.end();
  std::vector<std::int32_t> result(numbers.size());
  if (fit)
    std::ranges::transform(numbers, result.begin(),
                           [](std::int64_t number) { return static_cast<std::int32_t>(number); });
  else
    std::iota(result.begin(), result.end(), 1);
  return result;
}

} // namespace

CcxNumbers ccx_numbers(const mesh::Mesh& mesh) {
  auto nodes = mesh.node_numbers;
  nodes.resize(mesh.points.size(), 0);
  std::vector<std::int64_t> cells;
  for (const auto& block : mesh.blocks) {
    auto numbers = block.numbers;
    numbers.resize(static_cast<std::size_t>(block.cell_count()), 0);
    cells.insert(cells.end(), numbers.begin(), numbers.end());
  }
  return {fitting_numbers(nodes), fitting_numbers(cells)};
}

std::string fortran_e(double value, int digits) {
  if (value == 0 || !std::isfinite(value))
    return value == 0 ? fmt::format("0.{:0>{}}E+00", "", digits) : fmt::format("{}", value);
  const auto text = fmt::format("{:.{}E}", std::abs(value), digits - 1); // d.dddE±xx
  const auto e = text.find('E');
  const int exponent = std::stoi(text.substr(e + 1)) + 1;
  return fmt::format("{}0.{}{}E{}{:02}", value < 0 ? "-" : "", text.substr(0, 1), text.substr(2, e - 2),
                     exponent < 0 ? '-' : '+', std::abs(exponent));
}

bool is_shown(const mesh::Mesh& mesh, CellType type) {
  const int dimension = cell::topology(type).dimension;
  return std::ranges::all_of(mesh.blocks, [&](const mesh::CellBlock& block) {
    return block.cell_count() == 0 || cell::topology(block.type).dimension <= dimension;
  });
}

} // namespace rubato::results
