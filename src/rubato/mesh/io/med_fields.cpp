// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/mesh/io/med_fields.hpp"

#include "rubato/core/naming.hpp"
#include "rubato/mesh/io/med_file.hpp"
#include "rubato/mesh/io/med_library.hpp"

#include <fmt/format.h>
#include <med.h>

#include <algorithm>
#include <limits>

namespace rubato::mesh {
namespace {

struct Description {
  MedField field;
  med_field_type type = MED_FLOAT64;
};

/// Whether its first instant has some.
bool has_values_at_nodes(const med::File& file, const MedField& field) {
  const auto& first = field.instants.front();
  return med::library().field_profile_count(file.id(), field.name.c_str(), first.number, first.iteration,
                                            MED_NODE, MED_NONE, med::text_buffer(1, med::name_size).data(),
                                            med::text_buffer(1, med::name_size).data()) > 0;
}

Description description_of(const med::File& file, int index) {
  const auto components =
      file.plausible(med::library().field_component_count(file.id(), index), "components of a field");
  auto name = med::text_buffer(1, med::name_size);
  auto mesh_name = name;
  auto names = med::text_buffer(components, med::short_name_size);
  auto units = names;
  auto time_unit = med::text_buffer(1, med::short_name_size);
  med_bool local = MED_FALSE;
  med_int steps = 0;
  Description found;
  file.check(med::library().field_info(file.id(), index, name.data(), mesh_name.data(), &local, &found.type,
                                       names.data(), units.data(), time_unit.data(), &steps),
             "description of a field");
  found.field.name = med::text_at(name, 0, med::name_size);
  found.field.mesh_name = med::text_at(mesh_name, 0, med::name_size);
  for (std::size_t i = 0; i < components; ++i)
    found.field.component_names.push_back(med::text_at(names, i, med::short_name_size));
  found.field.unit = med::text_at(units, 0, med::short_name_size);
  found.field.time_unit = med::text_at(time_unit, 0, med::short_name_size);
  for (int step = 1; step <= steps; ++step) {
    med_int number = 0;
    med_int iteration = 0;
    med_float time = 0.0;
    file.check(med::library().field_computing_step_info(file.id(), found.field.name.c_str(), step, &number,
                                                        &iteration, &time),
               "instants of a field");
    found.field.instants.push_back({number, time, iteration});
  }
  found.field.at_nodes = found.field.instants.empty() || has_values_at_nodes(file, found.field);
  return found;
}

std::vector<MedField> fields_of(const med::File& file) {
  const auto count = med::library().field_count(file.id());
  file.check(count, "list of fields");
  std::vector<MedField> fields;
  for (int index = 1; index <= count; ++index)
    if (auto found = description_of(file, index); found.type == MED_FLOAT64)
      fields.push_back(std::move(found.field));
  return fields;
}

const MedField& field_named(const med::File& file, const std::vector<MedField>& fields,
                            const std::string& name) {
  const auto found = std::ranges::find(fields, name, &MedField::name);
  if (found != fields.end())
    return *found;
  std::vector<std::string> names(fields.size());
  std::ranges::transform(fields, names.begin(), &MedField::name);
  const auto nearest = nearest_word(name, names);
  file.refuse(fmt::format("holds no field '{}'{}", name,
                          nearest.empty() ? "" : fmt::format(", did you mean '{}'?", nearest)));
}

/// How many nodes the mesh of the field has at its first step, which is the one that is read.
std::size_t nodes_of(const med::File& file, const std::string& mesh_name) {
  med_int step = 0;
  med_int iteration = 0;
  med_float time = 0;
  file.check(
      med::library().mesh_computation_step_info(file.id(), mesh_name.c_str(), 1, &step, &iteration, &time),
      "mesh of a field");
  med_bool changed = MED_FALSE;
  med_bool moved = MED_FALSE;
  return file.plausible(med::library().mesh_entity_count(file.id(), mesh_name.c_str(), step, iteration,
                                                         MED_NODE, MED_NO_GEOTYPE, MED_COORDINATE,
                                                         MED_NO_CMODE, &changed, &moved),
                        "nodes");
}

/// The nodes of a profile, from 0; all of them where there is none.
std::vector<std::size_t> nodes_of_profile(const med::File& file, const std::string& profile,
                                          std::size_t count) {
  std::vector<std::size_t> nodes;
  if (profile.empty()) {
    for (std::size_t i = 0; i < count; ++i)
      nodes.push_back(i);
    return nodes;
  }
  const auto size =
      file.plausible(med::library().profile_size_by_name(file.id(), profile.c_str()), "nodes of a profile");
  std::vector<med_int> numbers(size);
  file.check(med::library().profile_read(file.id(), profile.c_str(), numbers.data()), "nodes of a profile");
  for (const auto number : numbers) {
    if (number < 1 || static_cast<std::size_t>(number) > count)
      file.refuse(fmt::format("is damaged: a profile names node {} of {}", number, count));
    nodes.push_back(static_cast<std::size_t>(number) - 1);
  }
  return nodes;
}

/// Puts the values of one profile, counted from 1, where they belong.
void read_profile(const med::File& file, const MedField& field, const MedInstant& instant, int profile,
                  std::vector<double>& values) {
  auto name = med::text_buffer(1, med::name_size);
  auto localisation = name;
  med_int size = 0;
  med_int points = 0;
  const auto found = med::library().field_value_count_with_profile(
      file.id(), field.name.c_str(), instant.number, instant.iteration, MED_NODE, MED_NONE, profile,
      MED_COMPACT_STMODE, name.data(), &size, localisation.data(), &points);
  const auto components = field.component_names.size();
  const auto nodes =
      nodes_of_profile(file, med::text_at(name, 0, med::name_size), values.size() / components);
  if (file.plausible(found, "values") != nodes.size())
    file.refuse(fmt::format("is damaged: '{}' has {} values at {} nodes", field.name, found, nodes.size()));
  std::vector<double> some(nodes.size() * components);
  file.check(med::library().field_value_with_profile_read(
                 file.id(), field.name.c_str(), instant.number, instant.iteration, MED_NODE, MED_NONE,
                 MED_COMPACT_STMODE, name.c_str(), MED_FULL_INTERLACE, MED_ALL_CONSTITUENT,
                 reinterpret_cast<unsigned char*>(some.data())),
             "values of a field");
  for (std::size_t i = 0; i < some.size(); ++i)
    values[nodes[i / components] * components + i % components] = some[i];
}

std::vector<double> values_of(const med::File& file, const std::string& name, int number) {
  const auto fields = fields_of(file);
  const auto& field = field_named(file, fields, name);
  const auto instant = std::ranges::find(field.instants, number, &MedInstant::number);
  auto text = med::text_buffer(1, med::name_size);
  auto localisation = text;
  const auto profiles =
      instant == field.instants.end()
          ? 0
          : med::library().field_profile_count(file.id(), name.c_str(), number, instant->iteration, MED_NODE,
                                               MED_NONE, text.data(), localisation.data());
  if (profiles <= 0)
    file.refuse(fmt::format("holds no values of '{}' at the nodes for instant {}", name, number));
  std::vector<double> values(nodes_of(file, field.mesh_name) * field.component_names.size(),
                             std::numeric_limits<double>::quiet_NaN());
  for (int profile = 1; profile <= profiles; ++profile)
    read_profile(file, field, *instant, profile, values);
  return values;
}

} // namespace

std::vector<MedField> med_fields(const std::filesystem::path& path) {
  const auto read = [&] { return fields_of(med::File(path, med::File::Access::read)); };
  med::rehearse(path, read);
  return read();
}

std::vector<double> read_med_field(const std::filesystem::path& path, const std::string& field, int number) {
  const auto read = [&] { return values_of(med::File(path, med::File::Access::read), field, number); };
  med::rehearse(path, read);
  return read();
}

} // namespace rubato::mesh
