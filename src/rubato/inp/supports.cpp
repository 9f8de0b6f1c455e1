// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/core/naming.hpp"
#include "rubato/core/transformed.hpp"
#include "rubato/inp/load_lines.hpp"
#include "rubato/inp/points.hpp"
#include "rubato/mesh/index_lists.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

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

/// Values of a data line of *BOUNDARY.
struct HeldLine {
  double value = 0;
  Word at;
  const Options& options;
  study::Given given = study::Given::displacement;
  bool fixed = false; ///< the displacement stays as it is
};

/// The displacement that these nodes had at the end of the step before; a fault where they had several.
std::optional<double> held_before(Reading& reading, const Active& wanted, const History& history) {
  if (const auto before = value_before(history, wanted.key))
    return before;
  std::vector<std::int32_t> held;
  std::optional<double> value;
  for (const auto& other : history.before) {
    if (other.kind != wanted.kind || other.dof != wanted.dof || other.along != wanted.along ||
        !share(other.items, wanted.items))
      continue;
    if (value.value_or(other.course.to) != other.course.to)
      reading.faults.add(wanted.at,
                         fmt::format("found a support of nodes that had the displacements {} and {} "
                                     "in the step before, expected lines with one of them each",
                                     *value, other.course.to));
    value = other.course.to;
    std::ranges::set_intersection(other.items, wanted.items, std::back_inserter(held));
  }
  mesh::sort_without_repeats(held);
  if (value.value_or(0) != 0 && held.size() < wanted.items.size())
    reading.faults.add(wanted.at,
                       fmt::format("found a support of nodes of which some had the displacement {} "
                                   "in the step before and others none, expected a line for each",
                                   *value));
  return value;
}

/// Replaces supports of earlier steps at the nodes of `wanted`.
void replace_held(Reading& reading, const Active& wanted, History& history) {
  std::vector<Active> kept;
  for (auto& other : history.supports) {
    const bool replaced = other.step != wanted.step && other.dof == wanted.dof &&
                          other.along == wanted.along &&
                          (other.key == wanted.key || share(other.items, wanted.items));
    if (!replaced)
      kept.push_back(std::move(other));
    else if (other.key != wanted.key)
      keep_rest(reading, other, wanted, kept);
  }
  history.supports = std::move(kept);
}

/// Returns the course from the displacement before to that of the line; nothing after a fault.
std::optional<Course> course_of(Reading& reading, const Active& active, const HeldLine& line,
                                std::optional<double> before, const Step& step, const History& history) {
  const double value = line.fixed ? before.value_or(0) : line.value;
  Course course{before.value_or(0), value, line.options.curve, value, history.time};
  const bool is_static = step.procedure == Procedure::steps || step.procedure == Procedure::modes;
  if (step.number > 1 && !before && !is_static) {
    reading.faults.add(
        line.at, fmt::format("found a support of {} that begins in the dynamic step {}, which holds a "
                             "displacement that is not known before the run; expected it in the first step",
                             shown(active.on), step.number));
    return std::nullopt;
  }
  if (step.number > 1 && !before && line.fixed) {
    reading.faults.add(line.at, fmt::format("found FIXED with nodes of {}, whose displacements are not known "
                                            "before the run, expected nodes that a support has held before",
                                            shown(active.on)));
    return std::nullopt;
  }
  if (step.number > 1 && !before && step.procedure == Procedure::steps)
    note(reading, line.at,
         fmt::format(
             "the support of {} begins in step {}: its nodes go to the line from 0 to the value of the "
             "line at the first increment; Abaqus and CalculiX go there from where they are. The end "
             "of the step is the same where the order of loads does not matter",
             active.on, step.number));
  if (step.ramp || line.options.curve != nullptr || value == course.from)
    return course;
  if (is_static) {
    course.from = value;
    return course;
  }
  if (step.time.step == 0) {
    reading.faults.add(line.at,
                       fmt::format("found the displacement {} at once, a jump, expected AMPLITUDE= in "
                                   "an explicit step",
                                   value));
    return std::nullopt;
  }
  course.rise = step.time.step;
  note(reading, line.at,
       fmt::format("the displacement {} of {}, which begins at once, is reached over the first "
                   "increment, {}",
                   value, active.on, step.time.step));
  return course;
}

void hold(Reading& reading, Target target, int dof, HeldLine line, const Step& step, History& history) {
  turn_to_rotation(reading, target, dof);
  const int of_axes = dof;
  const auto along = direction_of(reading, target, dof, line.value);
  const auto has = has_dof(reading, target, dof);
  if (has != Has::yes) {
    if (line.value != 0 || has == Has::never)
      reading.faults.add(
          line.at, fmt::format("found the degree of freedom {}, which these nodes do not have", dof + 1));
    return;
  }
  Active active;
  active.kind = "BOUNDARY";
  active.on = target.name;
  active.items = target.nodes;
  active.step = step.number;
  active.at = line.at;
  active.given = line.given;
  active.dof = target.reference != nullptr && target.reference->rotations ? dof + 3 : dof;
  active.along = along;
  active.key =
      fmt::format("BOUNDARY {} {}{}", folded(target.name), along ? "'" : "", along ? of_axes : active.dof);
  if (line.given != study::Given::displacement && (step.number > 1 || step.procedure == Procedure::steps))
    return reading.faults.add(
        line.at, "found a velocity or an acceleration of a support in a static step or after the first "
                 "one, expected a displacement");
  std::optional<Course> course = Course{line.value, line.value, line.options.curve, line.value, history.time};
  if (line.given == study::Given::displacement)
    course = course_of(reading, active, line, held_before(reading, active, history), step, history);
  if (!course)
    return;
  active.course = *course;
  replace_held(reading, active, history);
  const auto same = std::ranges::find(history.supports, active.key, &Active::key);
  if (same == history.supports.end())
    history.supports.push_back(std::move(active));
  else if (same->course.to != course->to || same->course.curve != course->curve || same->given != line.given)
    reading.faults.add(
        line.at, fmt::format("found a second value of this displacement of {}, expected one; the other is in "
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

void hold_named(Reading& reading, const std::vector<Word>& fields, const Target& target, const HeldLine& line,
                const Step& step, History& history) {
  const auto word = compact(fields[1].text);
  const auto* const found = std::ranges::find(named_supports, std::string_view(word), &NamedSupport::word);
  if (found == named_supports.end() || fields.size() > 2) {
    const auto words = transformed<std::string>(named_supports, &NamedSupport::word);
    return reading.faults.add(fields[1],
                              fmt::format("found {}, expected a degree of freedom or a named support{}",
                                          shown(std::string(fields[1].text)),
                                          suggestion(std::string(fields[1].text.substr(0, 100)), words)));
  }
  const HeldLine still{0, fields[1], line.options, study::Given::displacement, line.fixed};
  const bool whole = found->held[0] && found->held[1] && found->held[2];
  for (const auto& part : whole ? std::vector{target} : with_equal_axes(reading, target))
    for (int dof = 0; dof < 6; ++dof)
      if (found->held.at(static_cast<std::size_t>(dof)))
        hold(reading, part, dof, still, step, history);
}

void read_support(Reading& reading, const std::vector<Word>& fields, int scope, HeldLine asked,
                  const Step& step, History& history) {
  const auto target = find_target(reading, scope, fields[0]);
  const auto second = field(fields, 1, fields[0]);
  if (!target || is_unused(reading, *target, fields[0]))
    return;
  if (!second.empty() && !mesh::inp::integer_in(second.text))
    return hold_named(reading, fields, *target, asked, step, history);
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
  asked.value = *value;
  asked.at = fields[0];
  const bool whole =
      *value == 0 && asked.options.curve == nullptr && *first == 1 && *last >= reading.dimension();
  const auto targets = whole ? std::vector{*target} : with_equal_axes(reading, *target);
  for (const auto& part : targets)
    for (auto dof = *first; dof <= *last; ++dof)
      hold(reading, part, static_cast<int>(dof) - 1, asked, step, history);
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
  const bool fixed = placed.block->find("FIXED") != nullptr;
  begin_block(*placed.block, options, step, "BOUNDARY", history.supports, history, reading);
  for (const auto& line : placed.block->lines)
    if (const auto fields = mesh::inp::fields_of(line); !fields.empty())
      read_support(reading, fields, placed.scope, {0, fields[0], options, *given, fixed}, step, history);
}

} // namespace rubato::inp
