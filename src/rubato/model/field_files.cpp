// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/core/naming.hpp"
#include "rubato/mesh/io/field_file.hpp"
#include "rubato/model/build.hpp"
#include "rubato/study/words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <utility>

namespace rubato::model {
namespace {

/// Reads each field once, and makes what all of them need of the mesh when the first one comes.
class FieldFiles {
public:
  FieldFiles(const mesh::Mesh& mesh, std::vector<Fault>& faults) : mesh_(mesh), faults_(faults) {}

  void read(study::FieldValue& value, const std::string& path) {
    auto* field = std::get_if<study::FileField>(&value.is);
    if (field == nullptr)
      return;
    const auto known = std::ranges::find(read_, *field);
    if (known != read_.end()) {
      field->values = known->values;
      return;
    }
    try {
      field->values = values_of(*field);
      read_.push_back(*field);
    } catch (const InputError& error) {
      faults_.push_back(fault_at(path, path + ": " + error.faults().front().text));
    }
  }

  /// A field of a material or of friction, which do not change with time.
  void read_constant(study::FieldValue& value, const std::string& path) {
    read(value, path);
    if (const auto* field = value.of_file();
        field != nullptr && field->values && field->values->varies_in_time())
      faults_.push_back(
          fault_at(path, fmt::format("{}: the field '{}' of '{}' has several instants, expected "
                                     "'at' with one of them: the value depends on the place only",
                                     path, field->name, field->file)));
    if (const auto* field = value.of_program();
        field != nullptr && field->values && field->values->varies_in_time())
      faults_.push_back(
          fault_at(path, fmt::format("{}: the field {} varies in time, expected one that depends on the "
                                     "place only",
                                     path, shown(field->name))));
  }

private:
  std::shared_ptr<const SampledField> values_of(const study::FileField& field) {
    const auto samples = mesh::read_nodal_field(field.file, {field.name, field.component, field.at});
    if (!cells_)
      cells_ = std::make_shared<const mesh::PlaceFinder>(mesh_);
    return mesh::sampled_field(cells_, samples);
  }

  const mesh::Mesh& mesh_;
  std::vector<Fault>& faults_;
  std::shared_ptr<const mesh::PlaceFinder> cells_;
  std::vector<study::FileField> read_;
};

std::string along(const std::string& path, std::size_t axis) {
  return fmt::format("{}.{}", path, study::axis_words.at(axis));
}

/// The path of a value that may stand alone or beside a function of time.
void read(FieldFiles& files, study::Field& field, const std::string& path) {
  files.read(field.value, field.function.empty() ? path : path + ".value");
}

void read(FieldFiles& files, study::Support& support, const std::string& path) {
  for (std::size_t axis = 0; axis < support.components.size(); ++axis) {
    if (auto& component = support.components[axis])
      read(files, *component, along(path, axis));
    if (auto& turn = support.turns[axis])
      read(files, *turn, along(path + ".turn", axis));
  }
  if (support.along)
    read(files, support.along->value, path + ".value");
}

void read(FieldFiles& files, study::Load& load, const std::string& path) {
  for (std::size_t axis = 0; axis < load.components.size(); ++axis)
    files.read(load.components[axis],
               load.kind == study::LoadKind::pressure ? path + ".value" : along(path, axis));
}

void read(FieldFiles& files, study::Relation& relation) {
  const auto path =
      fmt::format("relations.{}.{}", relation.name, study::word_of(study::relation_words, relation.kind));
  read(files, relation.value, path + ".value");
  for (std::size_t axis = 0; axis < relation.difference.size(); ++axis)
    read(files, relation.difference[axis], along(path + ".difference", axis));
}

void read(FieldFiles& files, study::ContactZone& zone) {
  const auto path = "contact." + zone.name;
  read(files, zone.gap, path + ".gap");
  read(files, zone.interference, path + ".interference");
  if (zone.friction_in_place)
    files.read_constant(*zone.friction_in_place, path + ".friction");
}

} // namespace

void read_field_files(study::Study& study, const mesh::Mesh& mesh, std::vector<Fault>& faults) {
  FieldFiles files(mesh, faults);
  for (auto& material : study.materials)
    for (auto& [key, value] : material.in_place)
      files.read_constant(value, fmt::format("materials.{}.{}", material.name, key));
  for (std::size_t i = 0; i < study.supports.size(); ++i)
    read(files, study.supports[i], fmt::format("supports.{}", i));
  for (auto& relation : study.relations)
    read(files, relation);
  for (std::size_t i = 0; i < study.loads.size(); ++i)
    read(files, study.loads[i],
         fmt::format("loads.{}.{}", i, study::word_of(study::load_words, study.loads[i].kind)));
  for (std::size_t i = 0; i < study.temperatures.size(); ++i)
    files.read(study.temperatures[i].value.value, fmt::format("temperature.{}.value", i));
  for (auto& zone : study.contact)
    read(files, zone);
}

} // namespace rubato::model
