// SPDX-License-Identifier: LGPL-3.0-or-later
/// Inside the module only: what lines of loads and supports have in common.
#pragma once

#include "rubato/inp/steps.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rubato::inp {

/// What the parameters of a block of loads say.
struct Options {
  bool sound = true;
  bool replace_all = false;
  const Curve* curve = nullptr;
};
Options options_of(Reading& reading, const Block& block);

/// OP=NEW takes all of the kind away that earlier steps gave, at its first keyword of the step.
void begin_block(const Block& block, const Options& options, const Step& step, std::string_view kind,
                 std::vector<Active>& actives, History& history, Reading& reading);

/// The value that what has this key had at the end of the step before.
std::optional<double> value_before(const History& history, const std::string& key);

/// Keeps a support or a force of an earlier step at the nodes that `taken` does not have: at a group made of
/// both, or at single nodes.
void keep_rest(Reading& reading, const Active& other, const Active& taken, std::vector<Active>& actives);

/// Puts a line in: it replaces those of former steps with its key and adds to those of the step.
void put(Reading& reading, Active active, const Options& options, const Step& step, double magnitude,
         std::vector<Active>& actives, const History& history);

/// Whether nodes have the degree of freedom, from 0; of nodes of bodies rotations are nothing to hold.
enum class Has { yes, nothing, never };
Has has_dof(const Reading& reading, const Target& target, int dof);

} // namespace rubato::inp
