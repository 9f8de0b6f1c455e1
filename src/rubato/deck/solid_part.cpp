// SPDX-License-Identifier: LGPL-3.0-or-later
// Materials, functions of time, supports and loads.
#include "rubato/deck/parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

namespace rubato::deck {
namespace {

study::Material read_material(const NamedValue& entry, const Context& context) {
  study::Material material;
  material.name = entry.name.text;
  material.at = entry.name.at;
  MapReader map(entry.value);
  read(map.require("young"), material.young, above(0));
  read(map.require("poisson"), material.poisson, between(-1, 0.5));
  const auto density = map.find("density");
  read(density, material.density, at_least(0)); // where 0 is enough only the mesh tells
  if (!density && map.is_map() && context.scheme && *context.scheme != study::SchemeKind::static_steps)
    entry.value.fault(fmt::format("'density' is missing: the scheme {} moves masses",
                                  study::word_of(study::scheme_words, *context.scheme)),
                      entry.name.at);
  if (const auto rayleigh = map.find("rayleigh")) {
    MapReader damping(*rayleigh);
    read(damping.find("stiffness"), material.rayleigh_stiffness, at_least(0));
    read(damping.find("mass"), material.rayleigh_mass, at_least(0));
    damping.finish();
  }
  const auto cells = map.find("cells");
  if (read(cells, material.cells) && material.cells.empty())
    cells->fault("found an empty list, expected 'all' or groups of cells");
  material.everywhere = !cells || (material.cells.size() == 1 && material.cells[0].text == study::everywhere);
  if (material.everywhere)
    material.cells.clear();
  map.finish();
  return material;
}

/// No cell can have two materials; what groups share is only seen in the mesh.
void refuse_overlap(const std::vector<study::Material>& materials, const std::vector<NamedValue>& entries) {
  std::set<std::string> used;
  for (std::size_t i = 0; i < materials.size(); ++i) {
    if (materials[i].everywhere && materials.size() > 1)
      entries[i].value.fault("is on all cells, expected its own groups ('cells') beside other materials",
                             entries[i].name.at);
    for (const auto& group : materials[i].cells)
      if (!used.insert(group.text).second)
        entries[i].value.fault(fmt::format("the group {} has another material already", shown(group.text)),
                               group.at);
  }
}

Function read_function(const Value& value) {
  Function function;
  function.at = value.at();
  MapReader map(value);
  const auto times = map.require("times");
  const auto values = map.require("values");
  const bool times_read = read(times, function.times) && ascends(times, function.times);
  const bool values_read = read(values, function.values);
  const auto outside = map.find("outside");
  read(outside, function.outside, study::outside_words);
  map.finish();
  if (!times_read)
    return function;
  if (function.times.empty())
    times->fault("found an empty list, expected at least one instant");
  if (values_read && function.values.size() != function.times.size())
    values->fault(fmt::format("found {} values for {} times", function.values.size(), function.times.size()));
  if (function.outside == Function::Outside::linear && function.times.size() == 1)
    outside->fault("found 'linear' for one instant, expected at least two to go on from");
  return function;
}

/// The axis a word of `fix` means.
std::optional<std::size_t> read_axis(const Value& value, const Context& context) {
  const auto dimension = context.physics ? study::dimension_of(*context.physics) : 3;
  return read_choice(value, {study::axis_words.begin(), study::axis_words.begin() + dimension});
}

void read_fixed(const Value& fix, const Context& context, study::Support& support) {
  const bool is_list = fix.tree().is(Tree::Kind::list);
  for (const auto& word : is_list ? items(fix) : std::vector<Value>{fix}) {
    const auto axis = read_axis(word, context);
    if (!axis)
      continue;
    auto& component = support.components[*axis];
    if (component)
      word.fault(fmt::format("{} is given a second time", study::axis_words[*axis]));
    component = study::Amplitude{};
  }
}

study::Support read_support(const Value& value, const Context& context,
                            const std::map<std::string, Function>& functions) {
  study::Support support;
  support.at = value.at();
  MapReader map(value);
  read(map.require("on"), support.on);
  bool holds = false;
  for (std::size_t axis = 0; axis < study::axis_words.size(); ++axis)
    if (const auto given = find_axis(map, axis, context)) {
      support.components[axis] = read_amplitude(*given, functions);
      holds = true;
    }
  if (const auto fix = map.find("fix")) {
    read_fixed(*fix, context, support);
    holds = holds || !fix->tree().is(Tree::Kind::list) || !fix->tree().items.empty();
  }
  map.finish();
  if (!holds && map.is_map())
    value.fault("holds nothing, expected 'fix' or a displacement x, y or z");
  return support;
}

void read_components(MapReader& map, const Context& context, study::Load& load) {
  bool given = false;
  for (std::size_t axis = 0; axis < study::axis_words.size(); ++axis)
    if (const auto component = find_axis(map, axis, context)) {
      read(component, load.components[axis]);
      given = true;
    }
  if (!given && map.is_map())
    map.value().fault("has no component, expected at least one of x, y, z");
}

study::Load read_load(const Value& value, study::LoadKind kind, const Context& context,
                      const std::map<std::string, Function>& functions) {
  study::Load load;
  load.kind = kind;
  load.at = value.at();
  MapReader map(value);
  read(kind == study::LoadKind::gravity ? map.find("on") : map.require("on"), load.on);
  if (kind == study::LoadKind::pressure)
    read(map.require("value"), load.components[0]);
  else
    read_components(map, context, load);
  read_function_name(map.find("function"), functions, load.function);
  map.finish();
  return load;
}

} // namespace

void read_materials(const Found& value, const Context& context, std::vector<study::Material>& materials) {
  const auto entries = named_entries(value);
  materials.reserve(entries.size());
  for (const auto& entry : entries)
    materials.push_back(read_material(entry, context));
  refuse_overlap(materials, entries);
  if (value && value->tree().is(Tree::Kind::map) && entries.empty())
    value->fault("found no material, expected at least one");
}

void read_functions(const Found& value, std::map<std::string, Function>& functions) {
  for (const auto& [name, function] : named_entries(value))
    functions[name.text] = read_function(function);
}

void read_function_name(const Found& value, const std::map<std::string, Function>& functions,
                        study::Name& name) {
  if (!read(value, name) || functions.contains(name.text))
    return;
  std::vector<std::string> names;
  names.reserve(functions.size());
  for (const auto& [known, function] : functions)
    names.push_back(known);
  value->fault(fmt::format("no function is called {}{}", shown(name.text), suggestion(name.text, names)));
}

study::Amplitude read_amplitude(const Value& value, const std::map<std::string, Function>& functions) {
  study::Amplitude amplitude;
  if (!value.tree().is(Tree::Kind::map)) {
    read(Found(value), amplitude.value);
    return amplitude;
  }
  MapReader map(value);
  read(map.require("value"), amplitude.value);
  read_function_name(map.find("function"), functions, amplitude.function);
  map.finish();
  return amplitude;
}

bool read_point(const Found& value, const Context& context, std::array<double, 3>& point) {
  std::vector<double> numbers;
  if (!read(value, numbers))
    return false;
  const auto wanted =
      context.physics ? static_cast<std::size_t>(study::dimension_of(*context.physics)) : numbers.size();
  if (numbers.size() != wanted || numbers.size() > point.size()) {
    value->fault(fmt::format("found {} coordinates, expected {}", numbers.size(),
                             std::min<std::size_t>(wanted, point.size())));
    return false;
  }
  std::ranges::copy(numbers, point.begin());
  return true;
}

Found find_axis(MapReader& map, std::size_t axis, const Context& context) {
  auto found = map.find(study::axis_words[axis]);
  if (found && context.physics && axis >= static_cast<std::size_t>(study::dimension_of(*context.physics))) {
    found->fault(fmt::format("{} has no {}, expected x or y",
                             study::word_of(study::physics_words, *context.physics),
                             study::axis_words[axis]));
  }
  return found;
}

void read_supports(const Found& value, const Context& context,
                   const std::map<std::string, Function>& functions, std::vector<study::Support>& supports) {
  for (const auto& item : items(value))
    supports.push_back(read_support(item, context, functions));
}

void read_loads(const Found& value, const Context& context, const std::map<std::string, Function>& functions,
                std::vector<study::Load>& loads) {
  for (const auto& item : items(value)) {
    MapReader map(item);
    std::size_t kinds = 0;
    for (const auto& word : study::load_words)
      if (const auto load = map.find(word.text)) {
        loads.push_back(read_load(*load, word.value, context, functions));
        ++kinds;
      }
    map.finish();
    const bool unknown_key_told = kinds == 0 && !item.tree().entries.empty();
    if (map.is_map() && kinds != 1 && !unknown_key_told)
      item.fault(fmt::format("found {} kinds of load in one entry, expected one", kinds));
  }
}

} // namespace rubato::deck
