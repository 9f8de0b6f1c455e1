// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/deck/parts.hpp"
#include "rubato/deck/rows.hpp"
#include "rubato/study/formulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rubato::deck {
namespace {

/// Judged as a whole only where both lists are there.
void read_damping(const Value& value, study::Material& material) {
  MapReader map(value);
  study::DampingRatios damping;
  const bool has_ratios = read_pair(map.require("ratio"), damping.ratio);
  const bool has_frequencies = read_pair(map.require("at"), damping.at);
  map.finish();
  if (has_ratios && has_frequencies)
    material.damping = damping;
}

/// Keeps what depends on the place under its key. Whether there is a number.
bool read_in_place(const Found& value, const Context& context, std::string_view key,
                   study::Material& material, double& number) {
  study::FieldValue read;
  if (!read_field_value(value, context, read))
    return false;
  if (const auto* alone = read.number()) {
    number = *alone;
    return true;
  }
  material.in_place[std::string(key)] = std::move(read);
  return false;
}

void read_law_numbers(MapReader& map, const Context& context, study::Material& material) {
  const auto& law = study::entry_of(material.law);
  refuse_numbers_of_others(map, study::material_laws, law, "the law");
  for (const auto& number : law.numbers) {
    double value = 0;
    const auto given = number.required ? map.require(number.key) : map.find(number.key);
    if (read_in_place(given, context, number.key, material, value))
      number.set(material, value);
  }
}

/// One of the two says how the volume changes.
void read_volume(MapReader& map, const study::Material& material) {
  if (material.hyperelasticity.bulk)
    map.refuse("poisson", "'bulk' is given already, expected one of the two");
  else if (!map.find("bulk") && !map.find("poisson"))
    map.value().fault(fmt::format("neither 'bulk' nor 'poisson' is given, expected one of them: the law {} "
                                  "does not hold the volume by itself",
                                  study::entry_of(material.law).name));
}

void read_law(MapReader& map, const Context& context, study::Material& material) {
  read_law_numbers(map, context, material);
  if (study::is_hyperelastic(material.law))
    read_volume(map, material);
  read_law_words(map, material);
}

/// Nothing is known of what the law takes.
void pass_law(MapReader& map) {
  pass_numbers(map, study::material_laws);
  pass_law_words(map);
}

/// In the plane the line is a point.
study::CylindricalAxes read_cylindrical(const Value& value, const Context& context) {
  study::CylindricalAxes axes;
  MapReader map(value);
  if (!read_point(map.require("point"), context, axes.point))
    map.spoil("point");
  if (context.physics && study::dimension_of(*context.physics) == 2)
    map.refuse("direction", fmt::format("in {} the axes turn about z, expected 'point' alone",
                                        study::word_of(study::physics_words, *context.physics)));
  else if (!read_point(map.require("direction"), context, axes.direction))
    map.spoil("direction");
  map.finish();
  return axes;
}

void read_axes(const Value& value, const Context& context, study::Material& material) {
  if (material.law != study::LawKind::orthotropic)
    return value.fault(fmt::format("the law {} takes no axes, orthotropic takes them; a run removes them by "
                                   "'axes: ~'",
                                   study::entry_of(material.law).name));
  MapReader map(value);
  if (const auto cylindrical = map.require("cylindrical"))
    material.orthotropy.cylindrical = read_cylindrical(*cylindrical, context);
  map.finish();
}

study::Material read_material(const NamedValue& entry, const Context& context) {
  study::Material material;
  material.name = entry.name.text;
  MapReader map(entry.value);
  if (const auto law = map.find("law"); !law || read(law, material.law, study::law_words))
    read_law(map, context, material);
  else
    pass_law(map);
  if (double density = 0; read_in_place(map.find("density"), context, "density", material, density))
    material.density = density;
  if (const auto axes = map.find("axes"))
    read_axes(*axes, context, material);
  if (const auto rayleigh = map.find("rayleigh")) {
    MapReader damping(*rayleigh);
    read(damping.find("stiffness"), material.rayleigh_stiffness);
    read(damping.find("mass"), material.rayleigh_mass);
    damping.finish();
  }
  if (const auto damping = map.find("damping"))
    read_damping(*damping, material);
  read_expansion(map, material.expansion);
  const auto cells = map.find("cells");
  read_names(cells, material.cells);
  material.everywhere = !cells || (material.cells.size() == 1 && material.cells[0] == study::everywhere);
  if (material.everywhere)
    material.cells.clear();
  map.finish();
  return material;
}

} // namespace

bool read_pair(const Found& value, std::array<double, 2>& pair) {
  std::vector<double> numbers;
  if (!read(value, numbers))
    return false;
  if (numbers.size() != pair.size()) {
    value->fault(fmt::format("found {} numbers, expected two", numbers.size()));
    return false;
  }
  std::ranges::copy(numbers, pair.begin());
  return true;
}

void read_materials(const Found& value, const Context& context, std::vector<study::Material>& materials) {
  for (const auto& entry : named_entries(value))
    materials.push_back(read_material(entry, context));
}

} // namespace rubato::deck
