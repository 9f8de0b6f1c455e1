// SPDX-License-Identifier: LGPL-3.0-or-later
/// Every pair of cells whose faces may lie on one another, for tests with a parameter.
#pragma once

#include "rubato/cell/topology.hpp"

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <tuple>

namespace rubato::test {

inline constexpr std::array plane_cells{CellType::quad4, CellType::quad8, CellType::quad9,
                                        CellType::tria3, CellType::tria6, CellType::tria7};
inline constexpr std::array solid_cells{CellType::hexa8,  CellType::hexa20,  CellType::hexa27,
                                        CellType::tetra4, CellType::tetra10, CellType::penta6,
                                        CellType::penta15};

using CellPair = std::tuple<CellType, CellType>;

inline std::string name_of_pair(const testing::TestParamInfo<CellPair>& instance) {
  return std::string(cell::topology(std::get<0>(instance.param)).name) + "_on_" +
         std::string(cell::topology(std::get<1>(instance.param)).name);
}

} // namespace rubato::test
