// SPDX-License-Identifier: LGPL-3.0-or-later
/// How much of a move of nonlinear bodies to take, where the whole of it leaves more out of balance than
/// there was, as of bodies that flow at a constant stress.
#pragma once

#include <functional>
#include <optional>

namespace rubato::step {

struct SearchedPart {
  double best = 1;  ///< of the move: what leaves least out of balance
  double tried = 1; ///< last
};

/// Tries halves, one after the other, up to the first that is good enough. `before`: the largest unbalanced
/// force at the start of the move, `whole`: at its end [force]. `unbalanced_at`: at a part of it. Nothing
/// where a cell has no forces.
SearchedPart search_along_move(double before, std::optional<double> whole,
                               const std::function<std::optional<double>(double part)>& unbalanced_at);

} // namespace rubato::step
