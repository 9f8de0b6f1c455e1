// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/mesh/io/field_file.hpp"

#include "rubato/core/error.hpp"
#include "rubato/core/naming.hpp"
#include "rubato/core/transformed.hpp"
#include "rubato/mesh/io/med_fields.hpp"
#include "rubato/mesh/io/mesh_file.hpp"
#include "rubato/mesh/io/vtu_reader.hpp"
#include "rubato/mesh/rounding.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

namespace rubato::mesh::field_file {
namespace {

namespace fs = std::filesystem;

/// Instants that differ by less than this part of the largest one are one.
constexpr double same_instant = 1e-9;

[[noreturn]] void refuse(const fs::path& path, const std::string& text) {
  throw InputError(fmt::format("file '{}' {}", path.string(), text));
}

/// The places, among the instants of a file, ascending, of those that are wanted.
std::vector<std::size_t> chosen(const fs::path& path, const WantedField& wanted,
                                const std::vector<double>& instants) {
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i < instants.size(); ++i)
    all.push_back(i);
  if (!wanted.at) {
    if (const auto twice = std::ranges::adjacent_find(instants); twice != instants.end())
      refuse(path, fmt::format("holds '{}' twice at the instant {:g}, expected instants that ascend, or 'at'",
                               wanted.name, *twice));
    return all;
  }
  double largest = std::abs(*wanted.at);
  for (const double t : instants)
    largest = std::max(largest, std::abs(t));
  std::erase_if(all,
                [&](std::size_t i) { return std::abs(instants[i] - *wanted.at) > same_instant * largest; });
  if (all.size() > 1)
    refuse(path, fmt::format("holds '{}' {} times at the instant {:g}, expected once", wanted.name,
                             all.size(), *wanted.at));
  if (all.empty()) {
    const auto nearest =
        *std::ranges::min_element(instants, {}, [&](double t) { return std::abs(t - *wanted.at); });
    refuse(path,
           fmt::format("holds '{}' at {} instants, {:g} to {:g}, none of them {:g}; the nearest is {:g}",
                       wanted.name, instants.size(), instants.front(), instants.back(), *wanted.at, nearest));
  }
  return all;
}

std::size_t component_of(const fs::path& path, const WantedField& wanted,
                         const std::vector<std::string>& names) {
  if (wanted.component.empty()) {
    if (names.size() == 1)
      return 0;
    refuse(path, fmt::format("holds '{}' with the components {}, expected 'component' with one of them",
                             wanted.name, fmt::join(names, ", ")));
  }
  const auto found = std::ranges::find(names, wanted.component);
  if (found != names.end())
    return static_cast<std::size_t>(found - names.begin());
  refuse(path, names.size() == 1 ? fmt::format("holds '{}' as a scalar, expected no component", wanted.name)
                                 : fmt::format("holds no component {} of '{}'{}", shown(wanted.component),
                                               wanted.name, suggestion(wanted.component, names)));
}

/// Every n-th number from the component on.
std::vector<double> column(const std::vector<double>& values, std::size_t component, std::size_t count) {
  std::vector<double> one;
  for (auto i = component; i < values.size(); i += count)
    one.push_back(values[i]);
  return one;
}

template <class Fields, class Name>
const auto& field_named(const fs::path& path, const std::string& name, const Fields& fields,
                        const Name& name_of) {
  const auto found = std::ranges::find(fields, name, name_of);
  if (found != fields.end())
    return *found;
  const auto names = transformed<std::string>(fields, name_of);
  refuse(path, names.empty()
                   ? std::string("holds no field at the nodes")
                   : fmt::format("holds no field {} at the nodes{}", shown(name), suggestion(name, names)));
}

NodalSamples from_med(const fs::path& path, const WantedField& wanted) {
  auto fields = med_fields(path);
  std::erase_if(fields, [](const MedField& field) { return !field.at_nodes || field.instants.empty(); });
  auto field = field_named(path, wanted.name, fields, &MedField::name);
  std::ranges::stable_sort(field.instants, {}, &MedInstant::time);
  const auto component = component_of(path, wanted, field.component_names);
  NodalSamples samples;
  samples.places = read_mesh(path, field.mesh_name).points;
  std::vector<double> instants;
  for (const auto& instant : field.instants)
    instants.push_back(instant.time);
  for (const auto i : chosen(path, wanted, instants)) {
    samples.instants.push_back(instants[i]);
    samples.values.push_back(column(read_med_field(path, field.name, field.instants[i].number), component,
                                    field.component_names.size()));
  }
  return samples;
}

void add_vtu(const fs::path& path, const WantedField& wanted, double instant, NodalSamples& samples) {
  auto content = vtk::read_vtu(path);
  lay_flat(content.mesh);
  const auto& array = field_named(path, wanted.name, content.arrays, &vtk::VtuArray::name);
  const auto component = component_of(path, wanted, array.component_names);
  if (!samples.places.empty() && samples.places != content.mesh.points)
    refuse(path, "has other nodes than the files before it in its collection");
  samples.places = std::move(content.mesh.points);
  samples.instants.push_back(instant);
  samples.values.push_back(column(array.values, component, array.component_names.size()));
}

NodalSamples from_vtu(const fs::path& path, const WantedField& wanted) {
  if (wanted.at)
    refuse(path,
           fmt::format("has no instants, expected no 'at', or a .pvd collection that has {:g}", *wanted.at));
  NodalSamples samples;
  add_vtu(path, wanted, 0, samples);
  return samples;
}

NodalSamples from_pvd(const fs::path& path, const WantedField& wanted) {
  auto entries = vtk::read_pvd(path);
  if (entries.empty())
    refuse(path, "names no files");
  std::ranges::stable_sort(entries, {}, &vtk::PvdEntry::time);
  const auto instants = transformed<double>(entries, &vtk::PvdEntry::time);
  NodalSamples samples;
  for (const auto i : chosen(path, wanted, instants))
    add_vtu(entries[i].file, wanted, instants[i], samples);
  return samples;
}

struct Kind {
  std::vector<std::string_view> endings;
  NodalSamples (*read)(const fs::path& path, const WantedField& wanted);
};

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> rows{
      {{".med", ".rmed", ".mmed"}, from_med}, {{".vtu"}, from_vtu}, {{".pvd"}, from_pvd}};
  return rows;
}

} // namespace
} // namespace rubato::mesh::field_file

namespace rubato::mesh {

NodalSamples read_nodal_field(const std::filesystem::path& path, const WantedField& wanted) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored))
    field_file::refuse(path, "does not exist");
  for (const auto& kind : field_file::kinds())
    if (std::ranges::find(kind.endings, path.extension().string()) != kind.endings.end()) {
      auto samples = kind.read(path, wanted);
      samples.called = fmt::format("the field '{}' of '{}'", wanted.name, path.string());
      return samples;
    }
  field_file::refuse(path, "is no file of fields, expected .med, .rmed, .mmed, .vtu or .pvd");
}

} // namespace rubato::mesh
