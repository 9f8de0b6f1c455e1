// SPDX-License-Identifier: LGPL-3.0-or-later
// Elements that *MODEL CHANGE takes away: they keep next to none of their stiffness and mass.
#include "rubato/core/naming.hpp"
#include "rubato/core/transformed.hpp"
#include "rubato/inp/steps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

namespace rubato::inp {
namespace {

/// Part of their stiffness and density that removed elements keep.
constexpr double left_over = 1e-9;

/// A group of the mesh that is made of two others.
std::string made_group(Reading& reading, study::GroupKind kind, const std::string& a, const std::string& b) {
  auto& groups = reading.study.mesh.groups;
  const std::vector<std::string> of{a, b};
  const auto same = std::ranges::find_if(
      groups, [&](const study::MadeGroup& group) { return group.kind == kind && group.of == of; });
  if (same != groups.end())
    return same->name;
  study::MadeGroup group;
  const auto* word = kind == study::GroupKind::difference ? "without" : "in";
  group.name = chosen_name(reading, relation_kind, fmt::format("{}_{}_{}", a, word, b));
  group.kind = kind;
  group.of = of;
  groups.push_back(group);
  return group.name;
}

struct Split {
  std::vector<ElementGroup> kept;
  std::vector<ElementGroup> removed;
};

/// The groups of a material without those that are removed, and the removed parts.
Split split(Reading& reading, const std::vector<std::string>& cells) {
  Split found;
  for (const auto& name : cells)
    found.kept.push_back({name, elements_of_group(reading, name)});
  for (const auto& gone : reading.removed_elements) {
    const auto before = std::exchange(found.kept, {});
    for (const auto& part : before) {
      std::vector<std::int32_t> both, rest;
      std::ranges::set_intersection(part.items, gone.items, std::back_inserter(both));
      std::ranges::set_difference(part.items, gone.items, std::back_inserter(rest));
      if (both.empty()) {
        found.kept.push_back(part);
      } else if (rest.empty()) {
        found.removed.push_back(part);
      } else {
        using study::GroupKind;
        found.removed.push_back(
            {made_group(reading, GroupKind::intersection, part.name, gone.name), std::move(both)});
        found.kept.push_back(
            {made_group(reading, GroupKind::difference, part.name, gone.name), std::move(rest)});
      }
    }
  }
  return found;
}

void weaken(study::Material& material) {
  const auto scale = [](auto&... numbers) { ((numbers *= left_over), ...); };
  auto& o = material.orthotropy;
  auto& h = material.hyperelasticity;
  scale(material.young, o.young_x, o.young_y, o.shear_xy, h.c10, h.c01, h.c20, h.c30);
  for (auto* number : {&o.young_z, &o.shear_yz, &o.shear_xz, &h.bulk, &material.density})
    if (*number)
      **number *= left_over;
  for (auto& term : h.terms)
    term.shear *= left_over;
}

std::vector<std::string> names_of(const std::vector<ElementGroup>& groups) {
  return transformed<std::string>(groups, &ElementGroup::name);
}

} // namespace

void weaken_removed(Reading& reading, study::Study& study, const Step& step) {
  if (reading.removed_elements.empty())
    return;
  for (std::size_t i = 0, count = study.materials.size(); i < count; ++i) {
    const auto parts = split(reading, study.materials[i].cells);
    if (parts.removed.empty())
      continue;
    auto& material = study.materials[i];
    if (material.law == study::LawKind::plastic || material.law == study::LawKind::prony)
      return reading.faults.add(step.at,
                                fmt::format("found elements of {} that are taken away, whose material "
                                            "remembers its past, expected an elastic one",
                                            shown(material.name)));
    note(reading, step.at,
         fmt::format("elements that are taken away keep {} of their stiffness and mass", left_over));
    auto weak = material;
    weak.cells = names_of(parts.removed);
    weaken(weak);
    if (parts.kept.empty()) {
      material = std::move(weak);
      continue;
    }
    material.cells = names_of(parts.kept);
    weak.name += "_removed";
    study.materials.push_back(std::move(weak));
  }
}

} // namespace rubato::inp
