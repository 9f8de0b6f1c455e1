// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/results/med_fields.hpp"

#include "rubato/core/error.hpp"
#include "rubato/core/naming.hpp"
#include "rubato/core/writing.hpp"
#include "rubato/mesh/io/med_file.hpp"

#include <fmt/format.h>
#include <med.h>

#include <algorithm>
#include <stdexcept>

namespace rubato::results {
namespace {

namespace med = mesh::med;
using Components = std::vector<std::string>;

Components component_names(const NodalField& field) {
  if (!field.component_names.empty())
    return field.component_names;
  const Components axes{"x", "y", "z"};
  const auto count = static_cast<std::size_t>(field.components);
  Components names(count);
  for (std::size_t i = 0; i < count; ++i)
    names[i] = count == 2 || count == 3 ? axes[i] : std::to_string(i + 1);
  return names;
}

void check_length(const std::string& text, std::size_t most, std::string_view what) {
  if (text.size() > most)
    throw InputError(
        fmt::format("{} '{}' does not fit into a MED file: at most {} letters", what, text, most));
}

void check_field(const NodalField& field, std::int64_t nodes) {
  if (field.name.empty())
    throw InputError("a field needs a name to go into a MED file");
  check_length(field.name, med::name_size, "field name");
  check_length(field.unit, med::short_name_size, "unit");
  const auto names = component_names(field);
  for (const auto& name : names)
    check_length(name, med::short_name_size, "component name");
  if (field.components < 1 || names.size() != static_cast<std::size_t>(field.components) ||
      field.values.size() != static_cast<std::size_t>(nodes * field.components))
    throw std::invalid_argument(
        fmt::format("field '{}' has {} values and {} component names for {} nodes of {} "
                    "components",
                    field.name, field.values.size(), names.size(), nodes, field.components));
}

std::int64_t node_count(const med::File& file, const std::string& mesh_name) {
  med_bool changed = MED_FALSE;
  med_bool moved = MED_FALSE;
  const auto count = MEDmeshnEntity(file.id(), mesh_name.c_str(), MED_NO_DT, MED_NO_IT, MED_NODE, MED_NONE,
                                    MED_COORDINATE, MED_NO_CMODE, &changed, &moved);
  if (count <= 0)
    file.refuse(fmt::format("holds no mesh '{}' for the fields", mesh_name));
  return count;
}

bool is_declared(const med::File& file, const NodalField& field) {
  med_bool there = MED_FALSE;
  file.check(MEDfileObjectExist(file.id(), MED_FIELD, field.name.c_str(), &there), "a field");
  if (there == MED_TRUE && MEDfieldnComponentByName(file.id(), field.name.c_str()) != field.components)
    throw std::invalid_argument(fmt::format("field '{}' has {} components, other than in '{}'", field.name,
                                            field.components, file.path().string()));
  return there == MED_TRUE;
}

void declare(const med::File& file, const std::string& mesh_name, const NodalField& field,
             const std::string& time_unit) {
  const auto names = med::joined_texts(component_names(field), med::short_name_size);
  const Components units(static_cast<std::size_t>(field.components), field.unit.empty() ? " " : field.unit);
  const auto time = med::joined_texts({time_unit.empty() ? " " : time_unit}, med::short_name_size);
  file.check(MEDfieldCr(file.id(), field.name.c_str(), MED_FLOAT64, field.components, names.c_str(),
                        med::joined_texts(units, med::short_name_size).c_str(), time.c_str(),
                        mesh_name.c_str()),
             "a field");
}

void append(const med::File& file, const Instant& instant, const NodalField& field, std::int64_t nodes) {
  const auto* const bytes = reinterpret_cast<const unsigned char*>(field.values.data());
  file.check(MEDfieldValueWr(file.id(), field.name.c_str(), instant.number, MED_NO_IT, instant.time, MED_NODE,
                             MED_NONE, MED_FULL_INTERLACE, MED_ALL_CONSTITUENT, static_cast<med_int>(nodes),
                             bytes),
             "the values of a field");
}

/// What an instant needs at most: its values, and what MED and HDF5 tell about each field.
std::uintmax_t room_for(std::span<const NodalField> fields) {
  constexpr std::uintmax_t of_field = 6144;
  std::uintmax_t bytes = 0;
  for (const auto& field : fields)
    bytes += of_field + field.values.size_bytes();
  return bytes;
}

struct Description {
  MedField field;
  med_field_type type = MED_FLOAT64;
};

Description description_of(const med::File& file, int index) {
  const auto components = file.plausible(MEDfieldnComponent(file.id(), index), "components of a field");
  auto name = med::text_buffer(1, med::name_size);
  auto mesh_name = name;
  auto names = med::text_buffer(components, med::short_name_size);
  auto units = names;
  auto time_unit = med::text_buffer(1, med::short_name_size);
  med_bool local = MED_FALSE;
  med_int steps = 0;
  Description found;
  file.check(MEDfieldInfo(file.id(), index, name.data(), mesh_name.data(), &local, &found.type, names.data(),
                          units.data(), time_unit.data(), &steps),
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
    file.check(
        MEDfieldComputingStepInfo(file.id(), found.field.name.c_str(), step, &number, &iteration, &time),
        "instants of a field");
    found.field.instants.push_back({number, time});
  }
  return found;
}

std::vector<MedField> fields_of(const med::File& file) {
  const auto count = MEDnField(file.id());
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

std::vector<double> values_of(const med::File& file, const std::string& field, int number) {
  const auto fields = fields_of(file);
  const auto& found = field_named(file, fields, field);
  const auto nodes = MEDfieldnValue(file.id(), field.c_str(), number, MED_NO_IT, MED_NODE, MED_NONE);
  if (nodes <= 0)
    file.refuse(fmt::format("holds no values of '{}' at the nodes for instant {}", field, number));
  std::vector<double> values(file.plausible(nodes, "values") * found.component_names.size());
  file.check(MEDfieldValueRd(file.id(), field.c_str(), number, MED_NO_IT, MED_NODE, MED_NONE,
                             MED_FULL_INTERLACE, MED_ALL_CONSTITUENT,
                             reinterpret_cast<unsigned char*>(values.data())),
             "values of a field");
  return values;
}

} // namespace

void append_med_fields(const std::filesystem::path& path, const std::string& mesh_name, Instant instant,
                       std::span<const NodalField> fields, const std::string& time_unit) {
  require_room(path, room_for(fields));
  med::File file(path, med::File::Access::extend);
  check_length(time_unit, med::short_name_size, "time unit");
  const auto nodes = node_count(file, mesh_name);
  for (const auto& field : fields) {
    check_field(field, nodes);
    if (!is_declared(file, field))
      declare(file, mesh_name, field, time_unit);
    append(file, instant, field, nodes);
  }
  file.close();
}

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

} // namespace rubato::results
