// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/core/naming.hpp"
#include "rubato/core/transformed.hpp"
#include "rubato/inp/load_lines.hpp"
#include "rubato/inp/points.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace rubato::inp {
namespace {

using mesh::inp::compact;
using mesh::inp::field;
using mesh::inp::folded;

struct NamedSupport {
  std::string_view word;
  std::array<bool, 6> held;
};
constexpr std::array named_supports{NamedSupport{"ENCASTRE", {true, true, true, true, true, true}},
                                    NamedSupport{"PINNED", {true, true, true, false, false, false}},
                                    NamedSupport{"XSYMM", {true, false, false, false, true, true}},
                                    NamedSupport{"YSYMM", {false, true, false, true, false, true}},
                                    NamedSupport{"ZSYMM", {false, false, true, true, true, false}},
                                    NamedSupport{"XASYMM", {false, true, true, true, false, false}},
                                    NamedSupport{"YASYMM", {true, false, true, false, true, false}},
                                    NamedSupport{"ZASYMM", {true, true, false, false, false, true}}};

/// Along the axes of the nodes: the axis of the model that this is, or a direction across these.
std::optional<std::array<double, 3>> direction_of(const Reading& reading, const Target& target, int& dof,
                                                  double& value) {
  if (target.reference != nullptr || dof >= 3)
    return std::nullopt;
  const Eigen::Vector3d direction = axes_of(reading, target.nodes.front()).col(dof);
  for (int axis = 0; axis < 3; ++axis)
    if (std::abs(direction[axis]) == 1) {
      dof = axis;
      value *= direction[axis];
      return std::nullopt;
    }
  return std::array{direction[0], direction[1], direction[2]};
}

void hold(Reading& reading, Target target, int dof, double value, const Word& at, const Options& options,
          study::Given given, const Step& step, History& history) {
  turn_to_rotation(reading, target, dof);
  const int of_axes = dof;
  const auto along = direction_of(reading, target, dof, value);
  const auto has = has_dof(reading, target, dof);
  if (has != Has::yes) {
    if (value != 0 || has == Has::never)
      reading.faults.add(
          at, fmt::format("found the degree of freedom {}, which these nodes do not have", dof + 1));
    return;
  }
  Active active;
  active.kind = "BOUNDARY";
  active.on = target.name;
  active.items = target.nodes;
  active.step = step.number;
  active.at = at;
  active.given = given;
  active.dof = target.reference != nullptr && target.reference->rotations ? dof + 3 : dof;
  active.along = along;
  active.key =
      fmt::format("BOUNDARY {} {}{}", folded(target.name), along ? "'" : "", along ? of_axes : active.dof);
  const auto before = value_before(history, active.key);
  const bool moves = value != 0 || options.curve != nullptr;
  if (step.number > 1 && !before)
    return reading.faults.add(
        at, fmt::format("found a support of {} that begins in step {}, which holds a displacement "
                        "that is not known before the run; expected it in the first step",
                        shown(target.name), step.number));
  if (moves && !step.ramp && options.curve == nullptr && given == study::Given::displacement &&
      value != before.value_or(0))
    return reading.faults.add(
        at, fmt::format("found the displacement {} at once, a jump, expected AMPLITUDE= in a "
                        "dynamic step",
                        value));
  if (given != study::Given::displacement && (step.number > 1 || step.procedure == Procedure::steps))
    return reading.faults.add(
        at, "found a velocity or an acceleration of a support in a static step or after the first "
            "one, expected a displacement");
  std::erase_if(history.supports,
                [&](const Active& other) { return other.key == active.key && other.step != step.number; });
  const auto same = std::ranges::find(history.supports, active.key, &Active::key);
  active.course = {step.ramp && given == study::Given::displacement ? before.value_or(0) : value, value,
                   options.curve, value, history.time};
  if (same == history.supports.end())
    history.supports.push_back(std::move(active));
  else if (same->course.to != value || same->course.curve != options.curve || same->given != given)
    reading.faults.add(
        at, fmt::format("found a second value of this displacement of {}, expected one; the other is in "
                        "line {}",
                        shown(target.name), same->at.line));
}

std::optional<study::Given> given_by(Reading& reading, const Block& block) {
  const auto* const type = block.find("TYPE");
  const auto word = type == nullptr ? std::string("DISPLACEMENT") : compact(type->value.text);
  if (word == "DISPLACEMENT")
    return study::Given::displacement;
  if (word == "VELOCITY")
    return study::Given::velocity;
  if (word == "ACCELERATION")
    return study::Given::acceleration;
  reading.faults.add(
      type->value,
      fmt::format("found TYPE={}, expected DISPLACEMENT, VELOCITY or ACCELERATION", type->value.text));
  return std::nullopt;
}

void hold_named(Reading& reading, const std::vector<Word>& fields, const Target& target,
                const Options& options, const Step& step, History& history) {
  const auto word = compact(fields[1].text);
  const auto* const found = std::ranges::find(named_supports, std::string_view(word), &NamedSupport::word);
  if (found == named_supports.end() || fields.size() > 2) {
    const auto words = transformed<std::string>(named_supports, &NamedSupport::word);
    return reading.faults.add(fields[1],
                              fmt::format("found {}, expected a degree of freedom or a named support{}",
                                          shown(std::string(fields[1].text)),
                                          suggestion(std::string(fields[1].text.substr(0, 100)), words)));
  }
  const bool whole = found->held[0] && found->held[1] && found->held[2];
  for (const auto& part : whole ? std::vector{target} : with_equal_axes(reading, target))
    for (int dof = 0; dof < 6; ++dof)
      if (found->held.at(static_cast<std::size_t>(dof)))
        hold(reading, part, dof, 0, fields[1], options, study::Given::displacement, step, history);
}

void read_support(Reading& reading, const std::vector<Word>& fields, int scope, const Options& options,
                  study::Given given, const Step& step, History& history) {
  const auto target = find_target(reading, scope, fields[0]);
  const auto second = field(fields, 1, fields[0]);
  if (!target || is_unused(reading, *target, fields[0]))
    return;
  if (!second.empty() && !mesh::inp::integer_in(second.text))
    return hold_named(reading, fields, *target, options, step, history);
  const auto first = mesh::inp::require_integer(second, "a degree of freedom, 1 to 6", reading.faults);
  const auto third = field(fields, 2, second);
  const auto last = third.empty()
                        ? first
                        : mesh::inp::require_integer(third, "a degree of freedom, 1 to 6", reading.faults);
  const auto value =
      mesh::inp::require_number(field(fields, 3, third), "the displacement", reading.faults, 0);
  if (!first || !last || !value)
    return;
  if (*first < 1 || *last > 6 || *last < *first || fields.size() > 4)
    return reading.faults.add(
        second,
        fmt::format("found the degrees of freedom {} to {}, expected some from 1 to 6", *first, *last));
  if (step.number == 0 && *value != 0)
    return reading.faults.add(fields.back(),
                              fmt::format("found the displacement {} outside of a step, expected it in "
                                          "one",
                                          *value));
  const bool whole = *value == 0 && options.curve == nullptr && *first == 1 && *last >= reading.dimension();
  const auto targets = whole ? std::vector{*target} : with_equal_axes(reading, *target);
  for (const auto& part : targets)
    for (auto dof = *first; dof <= *last; ++dof)
      hold(reading, part, static_cast<int>(dof) - 1, *value, fields[0], options, given, step, history);
}

} // namespace

Has has_dof(const Reading& reading, const Target& target, int dof) {
  if (target.reference != nullptr && target.reference->rotations)
    return dof < 3 && (reading.dimension() == 3 || dof == 2) ? Has::yes : dof < 3 ? Has::nothing : Has::never;
  if (dof < 3)
    return dof < reading.dimension() ? Has::yes : Has::nothing;
  if (target.reference == nullptr)
    return Has::nothing;
  return reading.dimension() == 3 || dof == 5 ? Has::yes : Has::nothing;
}

void read_boundary(Reading& reading, const Placed& placed, const Step& step, History& history) {
  const auto options = options_of(reading, *placed.block);
  const auto given = given_by(reading, *placed.block);
  if (!options.sound || !given)
    return;
  begin_block(*placed.block, options, step, "BOUNDARY", history.supports, history, reading);
  for (const auto& line : placed.block->lines)
    if (const auto fields = mesh::inp::fields_of(line); !fields.empty())
      read_support(reading, fields, placed.scope, options, *given, step, history);
}

} // namespace rubato::inp
