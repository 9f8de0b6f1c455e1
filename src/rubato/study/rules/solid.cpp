// SPDX-License-Identifier: LGPL-3.0-or-later
// Materials, supports, springs, loads, and how the bodies begin.
#include "rubato/study/damping.hpp"
#include "rubato/study/fields.hpp"
#include "rubato/study/formulation.hpp"
#include "rubato/study/rules/rules.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace rubato::study {
namespace {

/// A number of a material that depends on the place.
void check_in_place(Rules& rules, const FieldValue& value, const Range& range, const std::string& path) {
  if (const auto* number = value.number())
    return rules.number(path, *number, range);
  rules.field_value(path, value);
  Field field;
  field.value = value;
  if (value.formula() != nullptr && varies_in_time(field))
    rules.broken({path}, fmt::format("found t in {}, a number of a material depends on the place only",
                                     shown(value.formula()->text)));
}

/// What to write where Poisson's ratio is that of an incompressible material.
std::string_view advice_for(const Material& material, std::string_view key, double value) {
  return is_hyperelastic(material.law) && key == "poisson" && value >= 0.5
             ? "write 'bulk' instead, a large multiple of the shear modulus where the volume hardly changes"
             : "";
}

/// Numbers that depend on the place, and those of the law that do not.
void check_numbers(Rules& rules, const Material& material, const std::string& path) {
  const auto& law = entry_of(material.law);
  for (const auto& number : law.numbers)
    if (const auto value = number.get(material);
        value && !material.in_place.contains(std::string(number.key)))
      rules.number(path + "." + std::string(number.key), *value, number.range,
                   advice_for(material, number.key, *value));
  for (const auto& [key, value] : material.in_place) {
    const auto number_path = fmt::format("{}.{}", path, key);
    const auto number = std::ranges::find(law.numbers, key, &Number<Material>::key);
    if (number != law.numbers.end() && !law.in_place)
      rules.broken(
          {number_path, path + ".law"},
          fmt::format("depends on the place, but the law {} has the same numbers everywhere; expected "
                      "a number",
                      law.name));
    else if (number != law.numbers.end())
      check_in_place(rules, value, number->range, number_path);
    else if (key == "density")
      check_in_place(rules, value, bounds::density_in_place, number_path);
    else
      rules.broken({number_path, path + ".law"}, fmt::format("the law {} takes no {}", law.name, key));
  }
}

/// Lines about which the axes of orthotropy turn.
void check_axes(Rules& rules, const Material& material, const std::string& of_material) {
  const auto& axes = *material.orthotropy.cylindrical;
  const auto path = of_material + ".axes";
  const auto below = path + ".cylindrical";
  const auto physics = rules.study.physics;
  if (material.law != LawKind::orthotropic)
    rules.broken({path, of_material + ".law"},
                 fmt::format("the law {} takes no axes, orthotropic does", entry_of(material.law).name));
  if (physics == Physics::axisymmetric)
    rules.broken({path, "physics"}, "found cylindrical axes in axisymmetric, where x' is radial, y' axial "
                                    "and z' circumferential already, expected none");
  for (std::size_t axis = 0; axis < axes.point.size(); ++axis) {
    rules.number(fmt::format("{}.point.{}", below, axis), axes.point.at(axis));
    rules.number(fmt::format("{}.direction.{}", below, axis), axes.direction.at(axis));
  }
  if (std::ranges::all_of(axes.direction, [](double number) { return number == 0; }))
    rules.broken({below + ".direction"}, "found a direction without length");
  else if (dimension_of(physics) == 2 && (axes.direction[0] != 0 || axes.direction[1] != 0))
    rules.broken({below + ".direction", "physics"},
                 fmt::format("found a direction in the plane, in {} the axes turn about z",
                             word_of(physics_words, physics)));
}

void check_law(Rules& rules, const Material& material, const std::string& path) {
  const auto& law = entry_of(material.law);
  check_numbers(rules, material, path);
  if (material.orthotropy.cylindrical)
    check_axes(rules, material, path);
  if (law.faults == nullptr)
    return;
  for (const auto& fault : law.faults(material, rules.study.physics)) {
    std::vector<std::string> paths;
    if (fault.missing)
      paths.push_back(path);
    for (const auto key : fault.keys)
      paths.push_back(path + "." + std::string(key));
    paths.insert(paths.end(), {path + ".law", "physics"});
    rules.broken(paths, fault.text);
  }
}

/// Of ratios and frequencies within their bounds: neither coefficient may excite motions.
void check_coefficients(Rules& rules, const Material& material, const std::string& path) {
  const auto& damping = *material.damping;
  const auto [stiffness, mass] = rayleigh_coefficients(material);
  const auto refuse = [&](std::string_view of, double coefficient, std::string_view bound, double ratio) {
    if (coefficient < 0)
      rules.broken(
          {path + ".ratio", path + ".at"},
          fmt::format("the coefficient of the {} would be {:.4g} < 0, expected a ratio at the higher "
                      "frequency of at {} {:.4g}",
                      of, coefficient, bound, ratio));
  };
  refuse("stiffness", stiffness, "least", least_ratio_at_higher_frequency(damping));
  refuse("mass", mass, "most", largest_ratio_at_higher_frequency(damping));
}

void check_damping(Rules& rules, const Material& material, const std::string& of_material) {
  const auto path = of_material + ".damping";
  const auto& [ratios, frequencies] = *material.damping;
  bool sound = true;
  for (std::size_t i = 0; i < ratios.size(); ++i) {
    rules.number(fmt::format("{}.ratio.{}", path, i), ratios[i], bounds::damping_ratio);
    rules.number(fmt::format("{}.at.{}", path, i), frequencies[i], bounds::frequency);
    sound = sound && bounds::damping_ratio.contains(ratios[i]) && bounds::frequency.contains(frequencies[i]);
  }
  if (material.rayleigh_stiffness != 0 || material.rayleigh_mass != 0)
    rules.broken({path, of_material + ".rayleigh"},
                 "found damping ratios beside 'rayleigh', expected one of the two");
  if (sound && frequencies[0] == frequencies[1])
    rules.broken({path + ".at"},
                 fmt::format("found {} twice, expected two different frequencies", frequencies[0]));
  else if (sound)
    check_coefficients(rules, material, path);
}

void check_material(Rules& rules, const Material& material, const std::string& path) {
  check_law(rules, material, path);
  check_law_words(rules, material, path);
  check_bulk(rules, material, path);
  if (material.density && !material.in_place.contains("density"))
    rules.number(path + ".density", *material.density,
                 bounds::density); // where 0 is enough only the mesh tells
  else if (rules.study.time.scheme != SchemeKind::static_steps && !material.in_place.contains("density"))
    rules.broken({path, path + ".density", "time.scheme"},
                 fmt::format("'density' is missing: the scheme {} moves masses",
                             word_of(scheme_words, rules.study.time.scheme)));
  rules.number(path + ".rayleigh.stiffness", material.rayleigh_stiffness, bounds::rayleigh);
  rules.number(path + ".rayleigh.mass", material.rayleigh_mass, bounds::rayleigh);
  if (material.damping)
    check_damping(rules, material, path);
  check_expansion(rules, material, path);
  if (!material.everywhere && material.cells.empty())
    rules.broken({path + ".cells"}, "found an empty list, expected 'all' or groups of cells");
  rules.names(path + ".cells", material.cells);
}

/// No cell can have two materials; what groups share is only seen in the mesh.
void refuse_overlap(Rules& rules) {
  const auto& materials = rules.study.materials;
  std::map<std::string, const Material*> used;
  for (const auto& material : materials) {
    const auto path = "materials." + material.name;
    if (material.everywhere && materials.size() > 1)
      rules.broken({path, path + ".cells"},
                   "is on all cells, expected its own groups ('cells') beside other materials");
    for (std::size_t i = 0; i < material.cells.size(); ++i)
      if (used.emplace(material.cells[i], &material).first->second != &material)
        rules.broken({fmt::format("{}.cells.{}", path, i)},
                     fmt::format("the group {} has another material already", shown(material.cells[i])));
  }
}

/// A support that ends has held before.
void check_until(Rules& rules, const Support& support, const std::string& path) {
  if (!support.until)
    return;
  const auto at = path + ".until";
  const auto& time = rules.study.time;
  rules.number(at, *support.until);
  if (rules.has_time() && *support.until <= time.begin)
    rules.broken({at, "time.begin"},
                 fmt::format("found {}, expected an instant after the begin of the run, {}", *support.until,
                             time.begin));
}

/// Components of a vector that are given, along axes that the physics has.
template <class Component>
void check_components(Rules& rules, const std::array<std::optional<Component>, 3>& components,
                      const std::string& path) {
  for (std::size_t axis = 0; axis < components.size(); ++axis) {
    if (!components[axis])
      continue;
    const auto at = fmt::format("{}.{}", path, axis_words.at(axis));
    rules.axis(at, axis);
    if constexpr (std::is_same_v<Component, Field>)
      rules.motion(at, *components[axis]);
    else
      rules.number(at, *components[axis]);
  }
}

template <class Component> bool is_empty(const std::array<std::optional<Component>, 3>& components) {
  return std::ranges::none_of(components, [](const auto& component) { return component.has_value(); });
}

/// In the plane things turn about z.
void check_turn_axis(Rules& rules, const std::string& path, std::size_t axis) {
  if (dimension_of(rules.study.physics) == 2 && axis != 2)
    rules.broken({path, "physics"}, fmt::format("{} turns about z only, expected z",
                                                word_of(physics_words, rules.study.physics)));
}

void check_turns(Rules& rules, const Support& support, const std::string& path) {
  if (is_empty(support.turns))
    return;
  check_rotation(rules, support.on, {path + ".turn", path + ".on", "relations"});
  for (std::size_t axis = 0; axis < support.turns.size(); ++axis)
    if (const auto& turn = support.turns.at(axis)) {
      const auto at = fmt::format("{}.turn.{}", path, axis_words.at(axis));
      check_turn_axis(rules, at, axis);
      rules.motion(at, *turn);
    }
}

/// It holds every component of a group, and so leaves nothing to be held otherwise.
void check_rotated(Rules& rules, const Support& support, const std::string& path) {
  check_rotate(rules, *support.rotate, path + ".rotate");
  if (support.along)
    rules.broken({path + ".along", path + ".rotate"},
                 "found 'along' beside 'rotate', which holds every component, expected x, y or z");
  if (is_reference(rules.study, support.on))
    rules.broken(
        {path + ".rotate", path + ".on", "relations"},
        fmt::format("'{}' is a reference, which takes 'turn'; 'rotate' expects a group", support.on));
}

void check_along(Rules& rules, const Support& support, const std::string& path) {
  const auto& along = *support.along;
  rules.motion(path + ".value", along.value);
  if (along.normal)
    return;
  for (std::size_t axis = 0; axis < along.direction.size(); ++axis)
    rules.number(fmt::format("{}.along.{}", path, axis), along.direction.at(axis));
  if (std::ranges::all_of(along.direction, [](double number) { return number == 0; }))
    rules.broken({path + ".along"}, "found a direction without length");
}

void check_load(Rules& rules, const Load& load, const std::string& path) {
  if (load.kind != LoadKind::gravity)
    rules.name(path + ".on", load.on);
  if (load.kind == LoadKind::moment)
    check_rotation(rules, load.on, {path + ".on", "relations"});
  for (std::size_t axis = 0; axis < load.components.size(); ++axis) {
    const bool is_pressure = load.kind == LoadKind::pressure;
    const auto at = is_pressure ? path + ".value" : fmt::format("{}.{}", path, axis_words.at(axis));
    rules.field_value(at, load.components[axis]);
    if (is_pressure || load.components[axis] == 0.0)
      continue;
    if (load.kind == LoadKind::moment)
      check_turn_axis(rules, at, axis);
    else
      rules.axis(at, axis);
  }
  rules.function(path + ".function", load.function);
  if (load.follower && load.kind != LoadKind::pressure)
    rules.broken({path + ".follower", path},
                 fmt::format("found a {} that follows the faces, expected 'pressure': every other load keeps "
                             "its direction",
                             word_of(load_words, load.kind)));
  else if (load.follower && !takes_large_rotations(rules.study))
    rules.broken(
        {path + ".follower", path, "materials"},
        "found a pressure that follows the faces of bodies of small strain, expected a material with "
        "strain: green_lagrange or logarithmic");
}

/// Why a run begins in no other way than its own; empty when it may.
std::string_view own_beginning(const TimeStepping& time) {
  if (time.start == StartKind::from_run)
    return "the run starts from the end of another one, whose motion it has";
  if (time.start == StartKind::at_rest_unloaded)
    return "start: at_rest_unloaded begins at rest, expected start: consistent";
  if (time.scheme == SchemeKind::static_steps)
    return "the scheme static finds equilibrium wherever it begins";
  return {};
}

} // namespace

void check_materials(Rules& rules) {
  std::vector<std::string> names;
  for (const auto& material : rules.study.materials) {
    const auto path = "materials." + material.name;
    rules.chosen_name(path, material.name, names);
    check_material(rules, material, path);
    names.push_back(material.name);
  }
  refuse_overlap(rules);
  if (rules.study.materials.empty())
    rules.broken({"materials"}, "found no material, expected at least one");
}

void check_supports(Rules& rules) {
  for (std::size_t i = 0; i < rules.study.supports.size(); ++i) {
    const auto& support = rules.study.supports[i];
    const auto path = fmt::format("supports.{}", i);
    rules.name(path + ".on", support.on);
    check_components(rules, support.components, path);
    check_turns(rules, support, path);
    check_until(rules, support, path);
    if (support.along)
      check_along(rules, support, path);
    if (support.rotate)
      check_rotated(rules, support, path);
    if (is_empty(support.components) && !support.along && is_empty(support.turns) && !support.rotate)
      rules.broken({path, path + ".fix", path + ".x", path + ".y", path + ".z"},
                   "holds nothing, expected 'fix', a displacement x, y or z, 'along' or 'rotate'");
  }
}

void check_springs(Rules& rules) {
  for (std::size_t i = 0; i < rules.study.springs.size(); ++i) {
    const auto& springs = rules.study.springs[i];
    const auto path = fmt::format("springs.{}", i);
    rules.name(path + ".on", springs.on);
    for (std::size_t axis = 0; axis < springs.stiffness.size(); ++axis) {
      const auto at = fmt::format("{}.{}", path, axis_words.at(axis));
      rules.number(at, springs.stiffness[axis], at_least(0));
      if (springs.stiffness[axis] != 0)
        rules.axis(at, axis);
    }
    if (std::ranges::all_of(springs.stiffness, [](double stiffness) { return stiffness == 0; }))
      rules.broken({path, path + ".x", path + ".y", path + ".z"},
                   "has no stiffness, expected at least one of x, y, z");
  }
}

void check_loads(Rules& rules) {
  for (std::size_t i = 0; i < rules.study.loads.size(); ++i) {
    const auto& load = rules.study.loads[i];
    check_load(rules, load, fmt::format("loads.{}.{}", i, word_of(load_words, load.kind)));
  }
}

void check_initial(Rules& rules) {
  const auto& initial = rules.study.initial;
  for (std::size_t i = 0; i < initial.size(); ++i) {
    const auto path = fmt::format("initial.{}", i);
    rules.name(path + ".on", initial[i].on);
    check_components(rules, initial[i].displacement, path + ".displacement");
    check_components(rules, initial[i].velocity, path + ".velocity");
    if (is_empty(initial[i].displacement) && is_empty(initial[i].velocity))
      rules.broken({path, path + ".displacement", path + ".velocity"},
                   "says nothing, expected 'displacement' or 'velocity'");
  }
  if (const auto reason = own_beginning(rules.study.time); !reason.empty() && !initial.empty())
    rules.broken({"initial", "time.scheme", "time.start"}, std::string(reason));
}

} // namespace rubato::study
