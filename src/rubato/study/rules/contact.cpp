// SPDX-License-Identifier: LGPL-3.0-or-later
// Contact zones: each by itself, and with the scheme that moves the bodies.
#include "rubato/study/rules/rules.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

namespace rubato::study {
namespace {

constexpr int most_loops = 10'000;

/// Each broken rule of one zone.
class ZoneRules {
public:
  ZoneRules(Rules& rules, const ContactZone& zone)
      : rules_(rules), zone_(zone), method_(entry_of(zone.method)),
        friction_method_(entry_of(zone.friction_method)), path_("contact." + zone.name) {}

  void check() {
    check_place();
    check_friction();
    check_integration();
    check_coefficients();
    check_levels();
    check_scheme();
  }

private:
  std::string at(std::string_view key) const { return fmt::format("{}.{}", path_, key); }

  void check_place() {
    check_surfaces(rules_, zone_);
    rules_.names(at("exclude_nodes"), zone_.exclude_nodes);
    if (!zone_.obstacle)
      return;
    check_obstacle(rules_, zone_);
    if (zone_.normal != ContactNormal::master)
      rules_.broken({at("normal"), at("obstacle")},
                    fmt::format("found {}, an obstacle gives the normal itself, expected master",
                                word_of(contact_normal_words, zone_.normal)));
  }

  void check_friction() {
    rules_.number(at("friction"), zone_.friction, at_least(0));
    rules_.number(at("restitution"), zone_.restitution, from_to(0, 1));
    if (method_.exact_prediction && zone_.friction > 0)
      rules_.broken({at("friction"), at("method")},
                    fmt::format("found {}, {} is without friction, expected 0 or the method nodal_lagrange",
                                zone_.friction, method_.name));
    if (std::ranges::find(method_.friction, zone_.friction_method) == method_.friction.end())
      rules_.broken({at("friction_method"), at("method")},
                    fmt::format("found {} with the contact method {}, expected {}", friction_method_.name,
                                method_.name, either(method_.friction)));
  }

  static std::string either(std::span<const FrictionMethod> methods) {
    std::string text;
    for (std::size_t i = 0; i < methods.size(); ++i)
      if (i == 0 || methods[i] != methods[i - 1])
        text += fmt::format("{}{}", text.empty() ? "" : " or ", entry_of(methods[i]).name);
    return text;
  }

  void check_integration() {
    const auto& rule = entry_of(zone_.integration.by);
    const auto path = at("integration") + (rule.most_order > 0 ? fmt::format(".{}", rule.name) : "");
    rules_.whole_number(path, zone_.integration.order,
                        from_to(std::min(1, rule.most_order), rule.most_order));
    if (!method_.between_nodes && zone_.integration.by != ContactIntegration::nodes)
      rules_.broken({at("integration"), at("method")},
                    fmt::format("{} has one relation a node, expected nodes; {} take points between the "
                                "nodes",
                                method_.name, those_between_nodes()));
    if (!rule.chooses_normal && zone_.normal != ContactNormal::master)
      rules_.broken({at("normal"), at("integration")},
                    fmt::format("found {} with the integration {}, whose normals are those of the slave's "
                                "nodes, expected no 'normal'",
                                word_of(contact_normal_words, zone_.normal), rule.name));
  }

  static std::string those_between_nodes() {
    std::vector<std::string_view> names;
    for (const auto& method : contact_methods)
      if (method.between_nodes)
        names.push_back(method.name);
    const auto last = names.back();
    names.pop_back();
    return fmt::format("{} and {}", fmt::join(names, ", "), last);
  }

  void check_coefficients() {
    rules_.numbers_of(method_, at("coefficients"), zone_);
    for (const auto& number : method_.numbers)
      if (const auto key = fmt::format("coefficients.{}", number.key); number.required && !number.get(zone_))
        rules_.broken({path_, at(key), at("method")},
                      fmt::format("'{}' is missing, which {} needs", key, method_.name));
    if (zone_.tangential_coefficient)
      rules_.number(at("coefficients.tangential"), *zone_.tangential_coefficient, above(0));
  }

  void check_levels() {
    check_level(zone_.geometry, "iterate.geometry", true);
    check_level(zone_.threshold, "iterate.friction", true);
    check_level(zone_.status, "iterate.status", false);
    if (method_.geometry == Iteration::fixed_point && zone_.geometry.by == Iteration::newton)
      rules_.broken({at("iterate.geometry"), at("method")},
                    fmt::format("{} holds its relations during a loop, expected fixed_point", method_.name));
    if (!method_.status_loop && zone_.status.by == Iteration::fixed_point)
      rules_.broken({at("iterate.status"), at("method")},
                    fmt::format("{} finds the points that touch by itself, expected newton", method_.name));
  }

  void check_level(const Level& level, std::string_view key, bool has_tolerance) {
    if (level.by == Iteration::newton)
      return;
    if (has_tolerance)
      rules_.number(at(key) + ".tolerance", level.tolerance, between(0, 1));
    rules_.whole_number(at(key) + ".max_loops", level.max_loops, from_to(1, most_loops));
  }

  void check_scheme() {
    const auto& time = rules_.study.time;
    if (is_explicit(time.scheme))
      check_explicit(time);
    else
      check_velocities(time);
  }

  /// Explicit steps solve nothing, multipliers least of all.
  void check_explicit(const TimeStepping& time) {
    if (!method_.explicit_steps || !friction_method_.explicit_steps)
      rules_.broken({path_, at("method"), at("friction_method"), "time.scheme"},
                    fmt::format("found the method {} with friction by {}, but the scheme {} has forces only, "
                                "expected penalty for both",
                                method_.name, friction_method_.name, word_of(scheme_words, time.scheme)));
    if (const auto& rule = entry_of(zone_.integration.by); !rule.explicit_steps)
      rules_.broken({path_, at("integration"), "time.scheme"},
                    fmt::format("found the integration {}, but the scheme {} computes forces point by point, "
                                "expected integration: nodes",
                                rule.name, word_of(scheme_words, time.scheme)));
  }

  /// Velocities that jump ask for impulses, which springs have none of; and only they know of restitution.
  void check_velocities(const TimeStepping& time) {
    const bool jumps = time.scheme == SchemeKind::moreau_jean;
    if (zone_.restitution > 0 && !jumps)
      rules_.broken({path_, at("restitution"), "time.scheme"},
                    fmt::format("found a restitution, which the scheme moreau_jean takes; {} computes the "
                                "rebound from the bodies' own motion",
                                word_of(scheme_words, time.scheme)));
    if (zone_.restitution > 0 && time.contact_mass == ContactMass::redistributed)
      rules_.broken({path_, at("restitution"), "time.contact_mass", "time.scheme"},
                    "found a restitution, but redistributed contact mass leaves nothing that could bounce, "
                    "expected contact_mass: consistent or no restitution");
    const bool springs = !method_.impulses || (zone_.friction > 0 && !friction_method_.exact);
    if (jumps && springs)
      rules_.broken({path_, at("method"), at("friction_method"), at("friction"), "time.scheme"},
                    fmt::format("found the method {} with friction by {}, but the scheme {} stops bodies by "
                                "impulses, expected augmented_lagrangian for both",
                                method_.name, friction_method_.name, word_of(scheme_words, time.scheme)));
  }

  Rules& rules_;
  const ContactZone& zone_;
  const ContactMethodEntry& method_;
  const FrictionMethodEntry& friction_method_;
  std::string path_;
};

/// Conjugate gradients find the forces of all zones together, or of none.
void check_methods_together(Rules& rules) {
  const auto& zones = rules.study.contact;
  if (std::ranges::none_of(zones, predicts_exactly) || std::ranges::all_of(zones, predicts_exactly))
    return;
  const auto other = std::ranges::find_if_not(zones, predicts_exactly);
  const auto path = "contact." + other->name;
  rules.broken({path, path + ".method"},
               fmt::format("found the method {} beside nodal_pcg, which solves for all zones together, "
                           "expected nodal_pcg in every zone or in none",
                           entry_of(other->method).name));
}

} // namespace

void check_contact(Rules& rules) {
  std::vector<std::string> names;
  for (const auto& zone : rules.study.contact) {
    rules.chosen_name("contact." + zone.name, zone.name, names);
    ZoneRules(rules, zone).check();
    names.push_back(zone.name);
  }
  check_methods_together(rules);
}

} // namespace rubato::study
