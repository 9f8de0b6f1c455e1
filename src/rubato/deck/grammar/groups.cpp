// SPDX-License-Identifier: LGPL-3.0-or-later
// Groups that are made of what the mesh has.
#include "rubato/study/groups.hpp"

#include "rubato/core/transformed.hpp"
#include "rubato/deck/grammar/parts.hpp"
#include "rubato/study/bounds.hpp"
#include "rubato/study/words.hpp"

#include <string>

namespace rubato::deck::grammar {
namespace {

using study::GroupKind;

Forms round(const std::string& title, std::vector<Key> keys) {
  keys.push_back({"radius", "[length]", number(study::bounds::radius), true});
  return map(title, std::move(keys));
}

/// What stands below the word of the kind.
Forms shape(GroupKind kind) {
  switch (kind) {
  case GroupKind::box:
    return map("a box", {{"from", "corner with the least coordinates [length]", coordinates(), true},
                         {"to", "opposite corner [length]", coordinates(), true}});
  case GroupKind::sphere:
    return round("a sphere, in 2D a circle", {{"point", "its centre [length]", coordinates(), true}});
  case GroupKind::cylinder:
    return round("a cylinder without ends", {{"point", "any point of its axis [length]", coordinates(), true},
                                             {"axis", "direction of its axis", coordinates(), true}});
  case GroupKind::plane:
    return map("a plane, in 2D a straight line", {{"point", "any point of it [length]", coordinates(), true},
                                                  {"normal", "direction across it", coordinates(), true}});
  case GroupKind::normal:
  case GroupKind::along:
    return coordinates();
  default:
    return study::entry_of(kind).sources == study::GroupSources::list ? list(name(), 2) : name();
  }
}

} // namespace

Forms groups() {
  auto keys = transformed<Key>(study::group_kinds, [](const auto& entry) {
    return Key{std::string(entry.name), std::string(entry.meaning), shape(entry.kind)};
  });
  keys.push_back({"of", "group that is looked at; everything when not given", name()});
  keys.push_back(
      {"within",
       "largest distance from the plane, or from the surface of the sphere or the cylinder [length]",
       number(study::bounds::within)});
  keys.push_back({"angle", "largest angle between the normals [degrees]; 30 when not given",
                  number(study::bounds::normal_angle)});
  keys.push_back({"take", "what a shape chooses; nodes when not given", word_of(study::group_take_words)});
  return named(map("how a group is made", std::move(keys)));
}

} // namespace rubato::deck::grammar
