// SPDX-License-Identifier: LGPL-3.0-or-later
// Preloads of bolts.
#include "rubato/study/rules/rules.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace rubato::study {
namespace {

void check_preload(Rules& rules, const Preload& preload, const std::string& path) {
  check_cut(rules, preload.cut, path + ".cut");
  if (!preload.cut.on.empty()) // decks cannot say so
    rules.broken({path + ".cut.on"},
                 "found a group, a preload cuts by the plane itself, expected 'point', 'normal' "
                 "and 'cells'");
  const auto key = path + (preload.by_force ? ".force" : ".displacement");
  rules.number(key, preload.value.value);
  rules.function(path + ".function", preload.value.function);
  const auto& normal = preload.cut.normal;
  if (rules.study.physics == Physics::axisymmetric && normal[0] != 0)
    rules.broken(
        {path + ".cut.normal", "physics"},
        "found a normal with a part along the radius, axisymmetric bolts are tightened along their axis y");
  if (!preload.lock)
    return;
  rules.number(path + ".lock", *preload.lock);
  const auto& time = rules.study.time;
  if (is_explicit(time.scheme))
    rules.broken(
        {path + ".lock", "time.scheme"},
        fmt::format("the scheme {} does not lock the sides of a cut, which stops them at once, expected "
                    "no lock or an implicit scheme such as hht",
                    word_of(scheme_words, time.scheme)));
  if (rules.has_time() && *preload.lock <= time.begin && time.start != StartKind::from_run)
    rules.broken(
        {path + ".lock", "time.begin"},
        fmt::format("found {}, expected an instant after the begin of the run, {}, which does not go on "
                    "from another one",
                    *preload.lock, time.begin));
}

} // namespace

void check_preloads(Rules& rules) {
  std::vector<std::string> names;
  for (const auto& preload : rules.study.preload) {
    const auto path = "preload." + preload.name;
    rules.chosen_name(path, preload.name, names);
    names.push_back(preload.name);
    check_preload(rules, preload, path);
  }
  if (rules.study.preload.empty())
    return;
  for (const auto& zone : rules.study.contact)
    if (zone.all)
      rules.broken(
          {fmt::format("contact.{}.all", zone.name), "preload"},
          "the sides of a preload's cut are no surfaces that touch, expected 'between' or 'master' and "
          "'slave'");
}

} // namespace rubato::study
