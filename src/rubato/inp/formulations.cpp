// SPDX-License-Identifier: LGPL-3.0-or-later
// Cells are integrated as the types of their elements say.
#include "rubato/cell/topology.hpp"
#include "rubato/inp/steps.hpp"
#include "rubato/study/formulation.hpp"
#include "rubato/study/schemes.hpp"
#include "rubato/study/words.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace rubato::inp {
namespace {

using mesh::inp::Element;
using mesh::inp::Integration;
using study::Formulation;

std::optional<Formulation> formulation_for(Integration how) {
  switch (how) {
  case Integration::incompatible:
    return Formulation::enhanced;
  case Integration::reduced:
    return Formulation::reduced;
  case Integration::full:
    break;
  }
  return std::nullopt;
}

/// Why cells of the material are not integrated so; empty where nothing forbids it.
std::string obstacle_to(Formulation formulation, CellType type, const study::Material& material,
                        const study::Study& study) {
  const bool is_explicit = study::is_explicit(study.time.scheme);
  if (!material.in_place.empty() || material.orthotropy.cylindrical)
    return "numbers or axes that depend on the place";
  if (formulation == Formulation::reduced) {
    if (!study::has_one_point(type))
      return "";
    if (material.law == study::LawKind::plastic && !is_explicit)
      return "plasticity in implicit steps";
    return study::is_heated(study, material) ? "thermal expansion" : "";
  }
  if (study::is_hyperelastic(material.law))
    return "hyperelasticity";
  if (study::strain_of(material) == study::StrainKind::logarithmic)
    return "logarithmic strain";
  const bool simple = study::has_constant_stiffness(material) && !study::is_heated(study, material);
  return is_explicit && !simple ? "explicit steps of such a material" : "";
}

/// Bodies that flow or hardly change their volume have other cells than the file in a study without a word.
/// C3D10M and C3D10T are no fully integrated cells.
bool needs_full(const study::Material& material, const mesh::inp::ElementType& type) {
  constexpr std::string_view modified = "MT";
  return modified.find(type.name.back()) == std::string_view::npos &&
         study::wanted_formulation(material) != Formulation::full;
}

class Fitter {
public:
  Fitter(Reading& reading, study::Study& study, Places& places)
      : reading_(reading), study_(study), places_(places) {}

  void fit() {
    for (auto& material : std::exchange(study_.materials, {}))
      split(std::move(material));
  }

private:
  void split(study::Material material) {
    std::map<std::optional<Formulation>, std::vector<std::string>> parts;
    for (const auto& group : material.cells)
      add_parts(material, group, parts);
    if (material.everywhere || material.formulation || parts.empty())
      return study_.materials.push_back(std::move(material));
    const auto at = places_.find("materials." + material.name);
    for (auto& [formulation, groups] : parts) {
      auto part = material;
      part.cells = std::move(groups);
      part.formulation = formulation;
      if (formulation && parts.size() > 1)
        part.name = free_name(
            fmt::format("{}_{}", material.name, study::word_of(study::formulation_words, *formulation)));
      if (at != places_.end())
        places_["materials." + part.name] = at->second;
      study_.materials.push_back(std::move(part));
    }
  }

  std::string free_name(std::string name) const {
    while (std::ranges::find(study_.materials, name, &study::Material::name) != study_.materials.end())
      name += "_2";
    return name;
  }

  void add_parts(const study::Material& material, const std::string& group,
                 std::map<std::optional<Formulation>, std::vector<std::string>>& parts) {
    std::map<Integration, std::optional<Formulation>> of_kind;
    const auto items = elements_of_group(reading_, group);
    for (const auto index : items) {
      const auto& element = reading_.content.elements[static_cast<std::size_t>(index)];
      const auto wanted = wanted_for(material, element);
      auto& chosen = of_kind[element.type->how];
      chosen = wanted ? wanted : chosen;
    }
    const mesh::inp::Found found{group, {}, true};
    for (const auto& [how, formulation] : of_kind)
      parts[formulation].push_back(mesh::inp::section_group(found, how, of_kind.size() == 1));
    if (of_kind.empty())
      parts[std::nullopt].push_back(group);
  }

  /// The formulation of an element where rubato has it; else a note says how it is integrated.
  std::optional<Formulation> wanted_for(const study::Material& material, const Element& element) {
    const auto& type = *element.type;
    const auto wanted = formulation_for(type.how);
    if (!wanted)
      return needs_full(material, type) ? std::optional(Formulation::full) : std::nullopt;
    auto with = material;
    with.formulation = wanted;
    const bool has = study::formulation_of(with, study_.physics, *type.cell) == *wanted;
    const auto obstacle = has ? obstacle_to(*wanted, *type.cell, material, study_) : std::string();
    if (has && obstacle.empty()) {
      if (*wanted == Formulation::reduced && study::has_one_point(*type.cell) &&
          told_.insert(type.name).second)
        note(
            reading_, element.at,
            fmt::format("{} has forces of rubato's own against hourglasses: coarse meshes differ from Abaqus "
                        "and CalculiX, fine ones agree",
                        type.name));
      return wanted;
    }
    if (told_.insert(type.name).second)
      note(reading_, element.at,
           fmt::format("{} has {}, rubato computes it as {} with full integration{}: coarse meshes may be "
                       "stiffer, fine ones agree",
                       type.name, type.differs, cell::topology(*type.cell).name,
                       obstacle.empty() ? "" : " because of " + obstacle));
    return std::nullopt;
  }

  Reading& reading_;
  study::Study& study_;
  Places& places_;
  std::set<std::string_view> told_;
};

} // namespace

void fit_formulations(Reading& reading, study::Study& study, Places& places) {
  Fitter(reading, study, places).fit();
}

} // namespace rubato::inp
