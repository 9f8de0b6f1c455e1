// SPDX-License-Identifier: LGPL-3.0-or-later
/// Whether the cells of materials suit what the materials do.
#pragma once

#include "rubato/core/error.hpp"
#include "rubato/model/fwd.hpp"

#include <string>
#include <vector>

namespace rubato::domain {
struct Bulk;
} // namespace rubato::domain

namespace rubato::mesh {
struct Mesh;
} // namespace rubato::mesh

namespace rubato::study {
struct Study;
} // namespace rubato::study

namespace rubato::model {

/// A fault for each material whose formulation none of its cells has.
void check_formulations(const study::Study& study, const mesh::Mesh& mesh, const domain::Bulk& bulk,
                        std::vector<Fault>& faults);

/// Parts of few layers of linear cells that are longer, in thicknesses, bend too stiffly.
inline constexpr double slender = 5;

struct CellFindings {
  std::vector<std::string> notes; ///< sentences that name what to write
  int locking = 0;        ///< materials whose cells, integrated in full, keep their volume and so lock
  double slenderness = 0; ///< length over thickness of the first part that bends too stiffly; 0: none does
};

/// Returns notes on the cells of a model that has its reduction. They name fully integrated cells whose
/// material keeps its volume (not in plane stress). They also name slender parts of few QUAD4 or HEXA8, which
/// are too stiff in bending, and reduced cells that can deform without stress.
CellFindings examine_formulations(const Model& model);

} // namespace rubato::model
