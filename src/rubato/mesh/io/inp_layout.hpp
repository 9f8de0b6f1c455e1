// SPDX-License-Identifier: LGPL-3.0-or-later
/// Inside the project only: parts and instances of an .inp file resolved.
#pragma once

#include "rubato/mesh/io/inp_blocks.hpp"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace rubato::mesh::inp {

/// Where labels and numbers are looked up: the file itself (the first scope) or an instance.
struct Scope {
  std::string name; ///< of the instance; empty: the file itself
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  Eigen::Vector3d shift = Eigen::Vector3d::Zero(); ///< point = turn · (that of the part) + shift
};

/// A keyword in a scope; one of a part occurs once for each instance.
struct Placed {
  const Block* block = nullptr;
  int scope = 0;
};

struct Layout {
  std::vector<Scope> scopes{{}};
  std::vector<Placed> blocks; ///< all that stands in a known place, in order, without the structure of parts

  /// The scope of that name, in any case; nothing when there is none.
  std::optional<int> scope_named(std::string_view name) const;
};

/// `source` must outlive it.
Layout lay_out(const Source& source, Faults& faults);

} // namespace rubato::mesh::inp
