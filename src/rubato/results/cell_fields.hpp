// SPDX-License-Identifier: LGPL-3.0-or-later
/// Stresses, strains and the like of each cell by itself, at its nodes, at its Gauss points and as their
/// mean.
#pragma once

#include "rubato/model/fwd.hpp"
#include "rubato/step/state.hpp"
#include "rubato/study/stored_fields.hpp"

#include <string>
#include <vector>

namespace rubato::results {

/// A field with values of its own in every cell of highest dimension.
struct CellField {
  /// The cells of one type.
  struct Part {
    CellType type = CellType::point1;
    int places = 0;             ///< a cell: its nodes, the points of cell::stiffness_rule, or 1
    std::vector<double> values; ///< cell by cell, place by place, component by component
  };

  std::string name;
  int components = 1;
  std::vector<std::string> component_names;
  study::FieldPlace place = study::FieldPlace::gauss_points;
  std::vector<Part> parts;     ///< in the order of the mesh
  std::vector<double> volumes; ///< of Gauss points, as the values; empty at nodes
};

/// stress_elno, stress_elga, stress_elem, strain_elno and so on (study::stored_fields), as far as `output`
/// writes them. Of tensors components are xx yy zz xy yz xz, strains those of the tensor. At the nodes:
/// extrapolated from the Gauss points in each cell; what is made of stresses, from stresses there. In cells:
/// the mean of the Gauss points by volume. Temperatures are left out of a model without any.
std::vector<CellField> cell_fields(const model::Model& model, const step::State& now,
                                   const study::FieldOutput& output);

/// Of each cell the mean over its volume, at nodes the mean of their values; cell by cell, component by
/// component.
std::vector<double> cell_means(const CellField& field);

} // namespace rubato::results
