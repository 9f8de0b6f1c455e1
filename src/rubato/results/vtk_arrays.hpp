// SPDX-License-Identifier: LGPL-3.0-or-later
/// Inside the module only: fields as VTK's files take them.
#pragma once

#include "rubato/mesh/io/vtu.hpp"
#include "rubato/results/cell_fields.hpp"
#include "rubato/results/field.hpp"

#include <deque>
#include <span>
#include <vector>

namespace rubato::results {

/// Vectors of the plane get a third component of zeros, fields in cells their means over each cell.
class VtkArrays {
public:
  /// Fields at nodes must outlive this.
  VtkArrays(std::span<const NodalField> fields, std::span<const CellField> cell_fields);
  VtkArrays(const VtkArrays&) = delete;
  VtkArrays& operator=(const VtkArrays&) = delete;

  std::span<const mesh::VtuArray> all() const { return arrays_; }

private:
  std::deque<std::vector<double>> made_;
  std::vector<mesh::VtuArray> arrays_;
};

} // namespace rubato::results
