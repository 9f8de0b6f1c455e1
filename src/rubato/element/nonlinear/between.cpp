// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/cell/reference_cell.hpp"
#include "rubato/element/energy_momentum.hpp"
#include "rubato/element/nonlinear/between_kernel.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>

namespace rubato::element {
namespace {

constexpr std::size_t most_numbers = 81;
using Numbers = std::array<double, most_numbers>;

/// The forces at {u}, with half their tangent.
CellResult evaluate_middle(const CellKind& kind, const PointLaws& laws, const BetweenInput& input,
                           const BetweenOutput& output) {
  Numbers middle;
  for (std::size_t i = 0; i < input.before.size(); ++i)
    middle[i] = 0.5 * (input.before[i] + input.after[i]);
  const auto tangent = output.tangent.empty() ? output.exact_tangent : output.tangent;
  const auto result = evaluate(kind, laws,
                               {input.points, std::span(middle).first(input.before.size()), input.old,
                                input.step, input.modes, input.free_strain},
                               {output.now, output.force, tangent});
  for (double& value : tangent)
    value /= 2;
  if (!output.tangent.empty() && !output.exact_tangent.empty())
    std::ranges::copy(output.tangent, output.exact_tangent.begin());
  return result;
}

/// An end of the step.
CellResult evaluate_end(const CellKind& kind, const PointLaws& laws, const BetweenInput& input,
                        std::span<const double> displacement, std::span<double> now,
                        std::span<PointRecord> records) {
  Numbers force;
  return evaluate(kind, laws,
                  {input.points, displacement, input.old, input.step, input.modes, input.free_strain},
                  {now, std::span(force).first(displacement.size()), {}, records});
}

BetweenResult evaluate_between_small(const CellKind& kind, const PointLaws& laws, const BetweenInput& input,
                                     const BetweenOutput& output) {
  BetweenResult result{evaluate_middle(kind, laws, input, output), 0};
  if (!result)
    return result;
  result.after = evaluate_end(kind, laws, input, input.before, output.now, {});
  if (!result)
    return result;
  result.stored_before = result.after.stored;
  result.after = evaluate_end(kind, laws, input, input.after, output.now, output.records);
  return result;
}

} // namespace

bool is_offered_between(const CellKind& kind) {
  if (!is_offered(kind))
    return false;
  return kind.formulation != Formulation::reduced;
}

BetweenResult evaluate_between(const CellKind& kind, const PointLaws& laws, const BetweenInput& input,
                               const BetweenOutput& output) {
  if (!is_offered_between(kind))
    throw std::invalid_argument(std::string(cell::topology(kind.type).name) +
                                " has no such forces over a step in this formulation");
  if (kind.strain == StrainKind::small)
    return evaluate_between_small(kind, laws, input, output);
  return evaluate_between_large(kind, laws, input, output);
}

} // namespace rubato::element
