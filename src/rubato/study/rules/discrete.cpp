// SPDX-License-Identifier: LGPL-3.0-or-later
// Springs, dashpots and masses that are no cells.
#include "rubato/study/rules/rules.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace rubato::study {
namespace {

/// At most so many connectors with tables: each keeps an answer of all unknowns.
constexpr std::size_t most_laws = 256;

void check_connector_law(Rules& rules, const std::optional<LinearTable>& law, const std::string& path,
                         const std::string& key, double beside, const std::string& other) {
  if (!law)
    return;
  rules.ascending(path + "." + key, law->at);
  rules.numbers(path + ".forces", law->values);
  if (law->at.size() != law->values.size())
    rules.broken(
        {path + ".forces", path + "." + key},
        fmt::format("found {} forces for {} {}, expected one each", law->values.size(), law->at.size(), key));
  if (key == "rates" && !law->values.empty() && steepest(*law) == 0)
    rules.broken({path + ".forces"}, "found a force that no rate changes, expected one that does");
  if (law->at.size() < 2)
    rules.broken({path + "." + key}, "found fewer than two, expected at least two");
  if (beside != 0)
    rules.broken({path, other}, "found a table beside a number, expected one of the two");
}

/// Both of its ends are places.
void check_rotating_connector(Rules& rules, const Connector& connector, const std::string& path) {
  if (connector.along)
    rules.broken({path + ".along", path + ".rotates"},
                 "found a fixed direction beside rotates: true, whose direction is that of the line between "
                 "the ends; expected one of the two");
  if (connector.to.empty() != connector.anchor.has_value())
    rules.broken({path, path + ".rotates"},
                 connector.anchor ? "found 'to' and 'anchor', expected one of the two"
                                  : "has rotates: true and one end; expected 'to', or 'anchor', the place of "
                                    "the end at the ground");
  if (connector.anchor)
    for (std::size_t axis = 0; axis < connector.anchor->size(); ++axis)
      rules.number(fmt::format("{}.anchor.{}", path, axis), connector.anchor->at(axis));
}

void check_connector(Rules& rules, const Connector& connector, const std::string& path) {
  rules.name(path + ".on", connector.on);
  rules.number(path + ".stiffness", connector.stiffness, bounds::connector);
  rules.number(path + ".damping", connector.damping, bounds::connector);
  check_connector_law(rules, connector.force, path + ".force", "elongations", connector.stiffness,
                      path + ".stiffness");
  check_connector_law(rules, connector.damper, path + ".damper", "rates", connector.damping,
                      path + ".damping");
  if (connector.stiffness == 0 && connector.damping == 0 && !connector.force && !connector.damper)
    rules.broken({path, path + ".stiffness", path + ".damping"},
                 "has no force, expected a 'stiffness' or 'damping' above 0");
  if (connector.on == connector.to)
    rules.broken({path + ".to", path + ".on"},
                 fmt::format("found {} at both ends, expected two places", shown(connector.on)));
  if (connector.rotates)
    return check_rotating_connector(rules, connector, path);
  if (connector.anchor)
    rules.broken({path + ".anchor"}, "has no effect: only connectors with rotates: true have an anchor");
  if (!connector.along) {
    if (connector.to.empty())
      rules.broken({path, path + ".on"},
                   "'along' is missing: without 'to' a connector goes to the ground, in a "
                   "direction that the deck gives");
    return;
  }
  for (std::size_t axis = 0; axis < connector.along->size(); ++axis)
    rules.number(fmt::format("{}.along.{}", path, axis), connector.along->at(axis));
  if (std::ranges::all_of(*connector.along, [](double number) { return number == 0; }))
    rules.broken({path + ".along"}, "found a direction without length");
}

} // namespace

void check_modal_damping(Rules& rules) {
  if (!rules.study.modal_damping)
    return;
  const auto& [modes, ratios] = *rules.study.modal_damping;
  rules.whole_number("modal_damping.modes", modes, bounds::damped_modes);
  for (std::size_t i = 0; i < ratios.size(); ++i)
    rules.number(ratios.size() == 1 ? "modal_damping.ratio" : fmt::format("modal_damping.ratio.{}", i),
                 ratios[i], bounds::damping_ratio);
  if (ratios.size() != 1 && ratios.size() != static_cast<std::size_t>(std::max(0, modes)))
    rules.broken(
        {"modal_damping.ratio", "modal_damping.modes"},
        fmt::format("found {} ratios for {} modes, expected one for all or one each", ratios.size(), modes));
  const auto scheme = rules.study.time.scheme;
  if (is_explicit(scheme) || scheme == SchemeKind::static_steps)
    rules.broken(
        {"modal_damping", "time.scheme"},
        fmt::format("the scheme {} takes no modal damping, expected an implicit scheme with inertia such as "
                    "hht{}",
                    word_of(scheme_words, scheme),
                    is_explicit(scheme) ? ", or 'rayleigh' in the materials" : ""));
}

void check_connectors(Rules& rules) {
  for (std::size_t i = 0; i < rules.study.connectors.size(); ++i)
    check_connector(rules, rules.study.connectors[i], fmt::format("connectors.{}", i));
  const auto laws = std::ranges::count_if(rules.study.connectors, [](const Connector& connector) {
    return !connector.rotates && (connector.force.has_value() || connector.damper.has_value());
  });
  if (static_cast<std::size_t>(laws) > most_laws)
    rules.broken({"connectors"},
                 fmt::format("found {} connectors with tables, expected at most {}", laws, most_laws));
}

void check_point_masses(Rules& rules) {
  for (std::size_t i = 0; i < rules.study.masses.size(); ++i) {
    const auto path = fmt::format("masses.{}", i);
    rules.name(path + ".on", rules.study.masses[i].on);
    const auto& masses = rules.study.masses[i];
    rules.number(path + ".mass", masses.mass, bounds::point_mass);
    for (std::size_t axis = 0; axis < masses.inertia.size(); ++axis)
      rules.number(fmt::format("{}.inertia.{}", path, axis), masses.inertia.at(axis), bounds::inertia);
    const bool turns = masses.inertia != std::array<double, 3>{};
    if (masses.mass == 0 && !turns)
      rules.broken({path + ".mass"}, "found 0, expected a mass above 0");
    if (turns)
      check_rotation(rules, masses.on, {path + ".inertia", path + ".on", "relations"});
  }
}

} // namespace rubato::study
