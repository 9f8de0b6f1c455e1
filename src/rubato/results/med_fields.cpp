// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/results/med_fields.hpp"

#include "rubato/core/error.hpp"
#include "rubato/core/writing.hpp"
#include "rubato/mesh/io/med_file.hpp"
#include "rubato/mesh/io/med_library.hpp"
#include "rubato/mesh/io/med_numbering.hpp"
#include "rubato/results/med_gauss.hpp"

#include <fmt/format.h>
#include <med.h>

#include <algorithm>
#include <stdexcept>

namespace rubato::results {
namespace {

namespace med = mesh::med;
using Components = std::vector<std::string>;

template <class Field> Components component_names(const Field& field) {
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
  const auto count =
      med::library().mesh_entity_count(file.id(), mesh_name.c_str(), MED_NO_DT, MED_NO_IT, MED_NODE, MED_NONE,
                                       MED_COORDINATE, MED_NO_CMODE, &changed, &moved);
  if (count <= 0)
    file.refuse(fmt::format("holds no mesh '{}' for the fields", mesh_name));
  return count;
}

template <class Field> bool is_declared(const med::File& file, const Field& field) {
  med_bool there = MED_FALSE;
  file.check(med::library().file_object_exist(file.id(), MED_FIELD, field.name.c_str(), &there), "a field");
  if (there == MED_TRUE &&
      med::library().field_component_count_by_name(file.id(), field.name.c_str()) != field.components)
    throw std::invalid_argument(fmt::format("field '{}' has {} components, other than in '{}'", field.name,
                                            field.components, file.path().string()));
  return there == MED_TRUE;
}

std::string unit_of(const NodalField& field) {
  return field.unit.empty() ? " " : field.unit;
}

std::string unit_of(const CellField&) {
  return " ";
}

template <class Field>
void declare(const med::File& file, const std::string& mesh_name, const Field& field,
             const std::string& time_unit) {
  const auto names = med::joined_texts(component_names(field), med::short_name_size);
  const Components units(static_cast<std::size_t>(field.components), unit_of(field));
  const auto time = med::joined_texts({time_unit.empty() ? " " : time_unit}, med::short_name_size);
  file.check(med::library().field_create(
                 file.id(), field.name.c_str(), MED_FLOAT64, field.components, names.c_str(),
                 med::joined_texts(units, med::short_name_size).c_str(), time.c_str(), mesh_name.c_str()),
             "a field");
}

void append(const med::File& file, const Instant& instant, const NodalField& field, std::int64_t nodes) {
  const auto* const bytes = reinterpret_cast<const unsigned char*>(field.values.data());
  file.check(med::library().field_value_write(file.id(), field.name.c_str(), instant.number, MED_NO_IT,
                                              instant.time, MED_NODE, MED_NONE, MED_FULL_INTERLACE,
                                              MED_ALL_CONSTITUENT, static_cast<med_int>(nodes), bytes),
             "the values of a field");
}

void write_localisation(const med::File& file, const MedGauss& gauss, CellType type) {
  med_bool there = MED_FALSE;
  file.check(med::library().file_object_exist(file.id(), MED_LOCALIZATION, gauss.name.c_str(), &there),
             "a localisation");
  if (there == MED_TRUE)
    return;
  file.check(med::library().localization_write(
                 file.id(), gauss.name.c_str(), static_cast<med_geometry_type>(med::geometry_of(type)),
                 gauss.dimension, gauss.nodes.data(), MED_FULL_INTERLACE,
                 static_cast<med_int>(gauss.weights.size()), gauss.points.data(), gauss.weights.data(),
                 MED_NO_INTERPOLATION, MED_NO_MESH_SUPPORT),
             "a localisation");
}

/// Values at the nodes of cells in MED's order of the nodes.
std::vector<double> in_med_order(const CellField::Part& part, int components) {
  const auto order = med::node_order(part.type);
  if (order.empty())
    return part.values;
  std::vector<double> values(part.values.size());
  const auto size = static_cast<std::size_t>(components);
  const auto cell = size * order.size();
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i / cell * cell + order[i % cell / size] * size + i % size] = part.values[i];
  return values;
}

void append_part(const med::File& file, const Instant& instant, const CellField& field,
                 const CellField::Part& part) {
  const bool at_nodes = field.place == study::FieldPlace::element_nodes;
  std::string localisation; // MED_NO_LOCALIZATION
  std::vector<double> values = at_nodes ? in_med_order(part, field.components) : part.values;
  if (!at_nodes) {
    const auto gauss = med_gauss(part.type);
    write_localisation(file, gauss, part.type);
    localisation = gauss.name;
  }
  const auto cells = values.size() / static_cast<std::size_t>(field.components * part.places);
  file.check(med::library().field_value_with_profile_write(
                 file.id(), field.name.c_str(), instant.number, MED_NO_IT, instant.time,
                 at_nodes ? MED_NODE_ELEMENT : MED_CELL,
                 static_cast<med_geometry_type>(med::geometry_of(part.type)), MED_COMPACT_STMODE,
                 MED_NO_PROFILE, localisation.c_str(), MED_FULL_INTERLACE, MED_ALL_CONSTITUENT,
                 static_cast<med_int>(cells), reinterpret_cast<const unsigned char*>(values.data())),
             "the values of a field");
}

/// What an instant needs at most: its values, and what MED and HDF5 tell about each field.
std::uintmax_t room_for(std::span<const NodalField> fields, std::span<const CellField> cell_fields) {
  constexpr std::uintmax_t of_field = 6144;
  std::uintmax_t bytes = 0;
  for (const auto& field : fields)
    bytes += of_field + field.values.size_bytes();
  for (const auto& field : cell_fields)
    for (const auto& part : field.parts)
      bytes += 2 * of_field + part.values.size() * sizeof(double);
  return bytes;
}

} // namespace

void append_med_fields(const std::filesystem::path& path, const std::string& mesh_name, Instant instant,
                       std::span<const NodalField> fields, const std::string& time_unit,
                       std::span<const CellField> cell_fields) {
  require_room(path, room_for(fields, cell_fields));
  med::File file(path, med::File::Access::extend);
  check_length(time_unit, med::short_name_size, "time unit");
  const auto nodes = node_count(file, mesh_name);
  for (const auto& field : fields) {
    check_field(field, nodes);
    if (!is_declared(file, field))
      declare(file, mesh_name, field, time_unit);
    append(file, instant, field, nodes);
  }
  for (const auto& field : cell_fields) {
    if (!is_declared(file, field))
      declare(file, mesh_name, field, time_unit);
    for (const auto& part : field.parts)
      append_part(file, instant, field, part);
  }
  file.close();
}

} // namespace rubato::results
