// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/core/naming.hpp"
#include "rubato/inp/load_lines.hpp"
#include "rubato/inp/points.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

namespace rubato::inp {
namespace {

using mesh::inp::compact;
using mesh::inp::field;
using mesh::inp::folded;

// ---- loads

std::array<study::FieldValue, 3> unit(int axis) {
  std::array<study::FieldValue, 3> direction{};
  direction.at(static_cast<std::size_t>(axis)) = 1.0;
  return direction;
}

struct LoadLine {
  const std::vector<Word>& fields;
  const Found* elements; ///< nullptr: all
  double magnitude;
  const Word& label;
};

Active active_load(const LoadLine& line, study::LoadKind kind, std::string on, std::string_view of,
                   const Step& step) {
  Active active;
  active.kind = of;
  active.load = kind;
  active.on = std::move(on);
  active.label = compact(line.label.text);
  active.items = line.elements == nullptr ? std::vector<std::int32_t>{} : line.elements->items;
  active.step = step.number;
  active.at = line.fields[0].empty() ? line.label : line.fields[0];
  return active;
}

/// The components from the fourth field on, of length 1.
std::optional<std::array<study::FieldValue, 3>>
direction_in(Reading& reading, const std::vector<Word>& fields, std::size_t first) {
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto component = mesh::inp::require_number(field(fields, first + axis, fields[0]),
                                                     "a component of the "
                                                     "direction",
                                                     reading.faults, 0);
    if (!component)
      return std::nullopt;
    direction[static_cast<Eigen::Index>(axis)] = *component;
  }
  if (direction.norm() == 0 || (reading.dimension() == 2 && direction[2] != 0)) {
    reading.faults.add(fields[0],
                       "found no direction of the load in the model, expected one of length above 0");
    return std::nullopt;
  }
  direction.normalize();
  return std::array<study::FieldValue, 3>{direction[0], direction[1], direction[2]};
}

/// Loads in different directions are different loads.
std::string shown_direction(const std::array<study::FieldValue, 3>& direction) {
  std::string text;
  for (const auto& component : direction)
    text += component.number() != nullptr ? fmt::format("{} ", *component.number())
                                          : component.formula()->text + " ";
  return text;
}

/// ω² times the distance from the axis, as expressions of the place.
std::optional<std::array<study::FieldValue, 3>> centrifugal(Reading& reading,
                                                            const std::vector<Word>& fields) {
  std::array<double, 6> numbers{};
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const auto number = mesh::inp::require_number(field(fields, i + 3, fields[0]),
                                                  "a point or direction of the axis", reading.faults, 0);
    if (!number)
      return std::nullopt;
    numbers.at(i) = *number;
  }
  Eigen::Vector3d axis(numbers[3], numbers[4], numbers[5]);
  const bool plane = reading.dimension() == 2;
  const bool axisymmetric = reading.study.physics == study::Physics::axisymmetric;
  const int expected = axisymmetric ? 1 : 2;
  if (axis.norm() == 0 ||
      (plane && axis.cross(Eigen::Vector3d::Unit(expected)).norm() > 1e-12 * axis.norm())) {
    reading.faults.add(fields[0],
                       "found an axis of rotation that the model does not have, expected one of length above "
                       "0, in the plane along z, axisymmetric along y");
    return std::nullopt;
  }
  axis.normalize();
  const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - axis * axis.transpose();
  std::array<study::FieldValue, 3> direction{};
  constexpr std::string_view names = "xyz";
  for (int row = 0; row < reading.dimension(); ++row) {
    std::string text;
    for (int column = 0; column < reading.dimension(); ++column)
      if (const double factor = across(row, column); std::abs(factor) > 1e-15)
        text += fmt::format("{}({})*({}-({}))", text.empty() ? "" : "+", factor,
                            names[static_cast<std::size_t>(column)],
                            numbers.at(static_cast<std::size_t>(column)));
    if (!text.empty())
      direction.at(static_cast<std::size_t>(row)) = study::Formula{text};
  }
  return direction;
}

/// A force by volume as an acceleration: the cells must have one density.
std::optional<double> density_of(Reading& reading, const LoadLine& line) {
  std::optional<double> density;
  const auto& materials = reading.study.materials;
  if (line.elements != nullptr && reading.densities.contains(line.elements->name))
    density = reading.densities.at(line.elements->name);
  else if (!materials.empty() && std::ranges::all_of(materials, [&](const auto& m) {
             return m.density == materials.front().density;
           }))
    density = materials.front().density;
  if (density && *density > 0)
    return density;
  reading.faults.add(line.label,
                     "found a force by volume on cells that do not have one density above 0, expected GRAV");
  return std::nullopt;
}

/// Of bodies.
void add_body_load(Reading& reading, const LoadLine& line, const Options& options, const Step& step,
                   History& history) {
  const auto word = compact(line.label.text);
  if (line.elements != nullptr && !line.elements->is_set)
    return reading.faults.add(line.fields[0], "found a single element with a load by volume, expected a set");
  auto active = active_load(line, study::LoadKind::gravity,
                            line.elements == nullptr ? "" : line.elements->name, "DLOAD", step);
  if (line.elements == nullptr) {
    active.items.resize(reading.content.elements.size());
    std::iota(active.items.begin(), active.items.end(), 0);
  }
  double magnitude = line.magnitude;
  std::optional<std::array<study::FieldValue, 3>> direction;
  if (word == "GRAV") {
    direction = direction_in(reading, line.fields, 3);
  } else if (word == "CENTRIF") {
    direction = centrifugal(reading, line.fields);
  } else {
    const auto axis = word == "BX" || word == "BR"                                 ? 0
                      : word == "BY" || (word == "BZ" && reading.dimension() == 2) ? 1
                                                                                   : 2;
    const auto density = density_of(reading, line);
    if (!density || axis >= reading.dimension())
      return;
    magnitude /= *density;
    direction = unit(axis);
  }
  if (!direction)
    return;
  active.direction = *direction;
  active.key = fmt::format("DLOAD {} {} {}", folded(active.on), word, shown_direction(*direction));
  put(reading, std::move(active), options, step, magnitude, history.loads, history);
}

struct Magnitude {
  double value;
  const Options* options;
};

/// A force or moment along a degree of freedom, from 0, of nodes with the same axes.
void add_nodal_force(Reading& reading, Target target, int dof, const std::vector<Word>& fields,
                     const Magnitude& magnitude, const Step& step, History& history) {
  turn_to_rotation(reading, target, dof);
  const auto has = dof >= 0 && dof < 6 ? has_dof(reading, target, dof) : Has::never;
  const auto second = field(fields, 1, fields[0]);
  if (has != Has::yes || fields.size() > 3)
    return reading.faults.add(
        second, fmt::format("found a force along the degree of freedom {}, which these nodes do not have",
                            second.text));
  const bool moment = dof >= 3 || (target.reference != nullptr && target.reference->rotations);
  Active active;
  active.kind = "CLOAD";
  active.load = moment ? study::LoadKind::moment : study::LoadKind::nodal_force;
  active.on = target.name;
  active.items = target.nodes;
  active.step = step.number;
  active.at = fields[0];
  active.direction = unit(dof % 3);
  if (!moment && target.reference == nullptr) {
    const Eigen::Vector3d along = axes_of(reading, target.nodes.front()).col(dof);
    active.direction = {along[0], along[1], along[2]};
  }
  active.label = fmt::format("{} {}", moment, dof % 3);
  active.key = fmt::format("CLOAD {} {}", folded(target.name), active.label);
  put(reading, std::move(active), *magnitude.options, step, magnitude.value, history.loads, history);
}

constexpr std::array<std::string_view, 6> body_labels{"GRAV", "CENTRIF", "BX", "BY", "BZ", "BR"};

} // namespace

void read_cload(Reading& reading, const Placed& placed, const Step& step, History& history) {
  const auto options = options_of(reading, *placed.block);
  if (!options.sound)
    return;
  begin_block(*placed.block, options, step, "CLOAD", history.loads, history, reading);
  for (const auto& line : placed.block->lines) {
    const auto fields = mesh::inp::fields_of(line);
    if (fields.empty())
      continue;
    const auto target = find_target(reading, placed.scope, fields[0]);
    const auto second = field(fields, 1, fields[0]);
    const auto dof = mesh::inp::require_integer(second, "a degree of freedom, 1 to 6", reading.faults);
    const auto magnitude =
        mesh::inp::require_number(field(fields, 2, second), "the force", reading.faults, 0);
    if (!target || !dof || !magnitude)
      continue;
    if (is_unused(reading, *target, fields[0]))
      continue;
    const int number = static_cast<int>(std::clamp<std::int64_t>(*dof, 0, 7)) - 1;
    for (const auto& part : with_equal_axes(reading, *target))
      add_nodal_force(reading, part, number, fields, {*magnitude, &options}, step, history);
  }
}

void read_dload(Reading& reading, const Placed& placed, const Step& step, History& history) {
  const auto options = options_of(reading, *placed.block);
  if (!options.sound)
    return;
  begin_block(*placed.block, options, step, "DLOAD", history.loads, history, reading);
  for (const auto& data : placed.block->lines) {
    const auto fields = mesh::inp::fields_of(data);
    if (fields.empty())
      continue;
    const auto label = field(fields, 1, fields[0]);
    const auto elements = fields[0].empty() ? std::nullopt
                                            : mesh::inp::find_elements(reading.content, placed.scope,
                                                                       fields[0], reading.faults);
    const auto magnitude =
        mesh::inp::require_number(field(fields, 2, label), "the magnitude", reading.faults, 0);
    if ((!elements && !fields[0].empty()) || !magnitude)
      continue;
    const LoadLine line{fields, elements ? &*elements : nullptr, *magnitude, label};
    const auto word = compact(label.text);
    if (std::ranges::find(body_labels, std::string_view(word)) != body_labels.end()) {
      add_body_load(reading, line, options, step, history);
    } else if (word.size() == 2 && word[0] == 'P' && word[1] >= '1' && word[1] <= '6' && elements) {
      auto active = active_load(line, study::LoadKind::pressure,
                                mesh::inp::loaded_group(*elements, word[1] - '0'), "DLOAD", step);
      active.direction = unit(0);
      active.key = fmt::format("DLOAD {}", folded(active.on));
      put(reading, std::move(active), options, step, *magnitude, history.loads, history);
    } else {
      reading.faults.add(
          label, fmt::format("found the load {}, expected P1 to P6 of a set, GRAV, CENTRIF, BX, BY or BZ",
                             shown(std::string(label.text))));
    }
  }
}

void read_dsload(Reading& reading, const Placed& placed, const Step& step, History& history) {
  const auto options = options_of(reading, *placed.block);
  if (!options.sound)
    return;
  if (const auto* resultant = placed.block->find("CONSTANTRESULTANT");
      resultant != nullptr && compact(resultant->value.text) == "YES")
    return reading.faults.add(resultant->name,
                              "found CONSTANT RESULTANT=YES, which rubato does not do, expected NO");
  begin_block(*placed.block, options, step, "DSLOAD", history.loads, history, reading);
  for (const auto& data : placed.block->lines) {
    const auto fields = mesh::inp::fields_of(data);
    if (fields.empty())
      continue;
    const auto* const surface =
        mesh::inp::find_surface(reading.content, placed.scope, fields[0], reading.faults);
    const auto label = field(fields, 1, fields[0]);
    const auto magnitude =
        mesh::inp::require_number(field(fields, 2, label), "the magnitude", reading.faults, 0);
    if (surface == nullptr || !magnitude)
      continue;
    const auto word = compact(label.text);
    if (surface->of_nodes || (word != "P" && word != "TRVEC")) {
      reading.faults.add(surface->of_nodes ? fields[0] : label,
                         surface->of_nodes ? "found a surface of nodes with a pressure, expected one of faces"
                                           : fmt::format("found the load {}, expected P or TRVEC",
                                                         shown(std::string(label.text))));
      continue;
    }
    const LoadLine line{fields, nullptr, *magnitude, label};
    auto active = active_load(line, word == "P" ? study::LoadKind::pressure : study::LoadKind::surface_force,
                              surface->group, "DSLOAD", step);
    for (const auto& face : surface->faces)
      active.items.push_back(face.element * 6 + face.side);
    std::ranges::sort(active.items);
    const auto direction = word == "P" ? std::optional(unit(0)) : direction_in(reading, fields, 3);
    if (!direction)
      continue;
    active.direction = *direction;
    const auto* const follower = placed.block->find("FOLLOWER");
    active.follows = word == "TRVEC" && (follower == nullptr || compact(follower->value.text) != "NO");
    active.key = fmt::format("DSLOAD {} {} {}", folded(active.on), word, shown_direction(*direction));
    put(reading, std::move(active), options, step, *magnitude, history.loads, history);
  }
}

namespace {

/// The temperature of the nodes at the end of the step before; nothing where they had several. Of entries
/// that share nodes the last one counts.
std::optional<double> temperature_before(const Reading& reading, const History& history,
                                         const std::vector<std::int32_t>& nodes) {
  std::map<std::int32_t, double> values;
  for (const auto node : nodes)
    values[node] = reading.initial_temperature.value_or(0);
  for (const auto& active : history.before)
    if (active.kind == "TEMPERATURE")
      for (const auto node : active.items)
        if (const auto found = values.find(node); found != values.end())
          found->second = active.course.to;
  const double first = values.begin()->second;
  const bool same = std::ranges::all_of(values, [&](const auto& entry) { return entry.second == first; });
  return same ? std::optional(first) : std::nullopt;
}

} // namespace

void read_temperature(Reading& reading, const Placed& placed, const Step& step, History& history) {
  const auto options = options_of(reading, *placed.block);
  if (!options.sound)
    return;
  if (options.replace_all)
    return reading.faults.add(placed.block->at,
                              "found OP=NEW with temperatures, expected the temperatures that they get");
  for (const auto& line : placed.block->lines) {
    const auto fields = mesh::inp::fields_of(line);
    if (fields.empty())
      continue;
    const auto target = find_target(reading, placed.scope, fields[0]);
    const auto value =
        mesh::inp::require_number(field(fields, 1, fields[0]), "the temperature", reading.faults);
    if (!target || !value)
      continue;
    Active active;
    active.kind = "TEMPERATURE";
    active.on = target->name;
    active.items = target->nodes;
    active.step = step.number;
    active.at = fields[0];
    active.key = fmt::format("TEMPERATURE {}", folded(target->name));
    const auto before = temperature_before(reading, history, active.items);
    if (!before && step.ramp && options.curve == nullptr) {
      reading.faults.add(fields[0],
                         "found temperatures of nodes that had several in the step before, expected "
                         "sets whose nodes had one");
      continue;
    }
    std::erase_if(history.temperatures, [&](const Active& other) { return other.key == active.key; });
    active.course = {step.ramp ? before.value_or(*value) : *value, *value, options.curve, *value,
                     history.time};
    history.temperatures.push_back(std::move(active));
  }
}

} // namespace rubato::inp
