// SPDX-License-Identifier: LGPL-3.0-or-later
/// Groups that a command line makes.
#pragma once

#include "rubato/study/mesh_source.hpp"

#include <span>
#include <string>
#include <vector>

namespace rubato::deck {

/// Reads texts "NAME={normal: [0, 0, 1]}", the value as an entry of a deck's `mesh.groups`, for a mesh of
/// `dimension` 2 or 3. Throws one InputError with every fault, each at "--group NAME".
std::vector<study::MadeGroup> parse_groups(std::span<const std::string> options, int dimension);

} // namespace rubato::deck
