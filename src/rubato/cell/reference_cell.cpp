// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/cell/reference_cell.hpp"

#include "rubato/cell/families/families.hpp"

#include <array>
#include <stdexcept>
#include <string>

namespace rubato::cell {
namespace {

using Table = std::array<const ReferenceCell*, cell_type_count>;

/// Runs once: apart from the look-up, which is called for every contact point and saves no registers then.
[[gnu::cold, gnu::noinline]] Table every_reference_cell() noexcept {
  Table table{};
  for (const auto family :
       {seg_cells(), tria_cells(), quad_cells(), tetra_cells(), pyra_cells(), penta_cells(), hexa_cells()})
    for (const auto& cell : family)
      table[static_cast<std::size_t>(cell.type)] = &cell;
  return table;
}

[[gnu::noinline]] const Table& reference_cells() {
  static const Table table = every_reference_cell();
  return table;
}

const ReferenceCell* find(CellType type) {
  return reference_cells()[static_cast<std::size_t>(type)];
}

[[noreturn, gnu::cold, gnu::noinline]] void throw_without_mechanics(CellType type) {
  throw std::invalid_argument("no mechanics on cells of type " + std::string(cell::topology(type).name));
}

} // namespace

const ReferenceCell& reference_cell(CellType type) {
  const auto* cell = find(type);
  if (cell == nullptr)
    throw_without_mechanics(type);
  return *cell;
}

bool has_reference_cell(CellType type) {
  return find(type) != nullptr;
}

} // namespace rubato::cell
