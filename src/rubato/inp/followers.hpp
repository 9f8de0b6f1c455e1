// SPDX-License-Identifier: LGPL-3.0-or-later
/// Inside the module only: the nodes that follow a reference node.
#pragma once

#include "rubato/inp/reading.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rubato::inp {

/// The group that a body or a surface is in a study.
struct Followers {
  std::string group;
  std::vector<std::int32_t> nodes;           ///< ascending
  std::vector<mesh::inp::ElementFace> faces; ///< of a surface of faces
};
std::optional<Followers> surface_followers(Reading& reading, int scope, const Word& word);
std::optional<Followers> set_followers(Reading& reading, int scope, const Word& word, bool of_elements);

/// A relation with a reference where the node is; its name, empty after a fault. Faults where the node is one
/// of the group or of an element: it is no point of its own.
std::string add_reference(Reading& reading, study::RelationKind kind, const Followers& followers,
                          std::int32_t node, const Word& at, std::string_view label);

LocalAxes local_axes(const Axes& axes);

} // namespace rubato::inp
