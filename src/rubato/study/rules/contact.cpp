// SPDX-License-Identifier: LGPL-3.0-or-later
// Contact zones: each by itself, and with the scheme that moves the bodies.
#include "rubato/core/error.hpp"
#include "rubato/study/fields.hpp"
#include "rubato/study/rules/rules.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

namespace rubato::study {
namespace {

/// Each broken rule of one zone.
class ZoneRules {
public:
  ZoneRules(Rules& rules, const ContactZone& zone)
      : rules_(rules), zone_(zone), method_(entry_of(zone.method)),
        friction_method_(entry_of(zone.friction_method)), path_("contact." + zone.name) {}

  void check() {
    check_place();
    check_friction();
    check_offsets();
    check_bonds();
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
    if (zone_.projection_tolerance)
      rules_.number(at("projection_tolerance"), *zone_.projection_tolerance, bounds::projection_tolerance);
    if (!zone_.obstacle)
      return;
    if (zone_.projection_tolerance)
      rules_.broken({at("projection_tolerance"), at("obstacle")},
                    "found a projection_tolerance before an obstacle, which has no end, expected none");
    check_obstacle(rules_, zone_);
    if (zone_.normal != ContactNormal::master)
      rules_.broken({at("normal"), at("obstacle")},
                    fmt::format("found {}, an obstacle gives the normal itself, expected master",
                                word_of(contact_normal_words, zone_.normal)));
    if (zone_.smoothing)
      rules_.broken({at("smoothing"), at("obstacle")},
                    "found smoothing: true before an obstacle, which is smooth, expected no 'smoothing'");
  }

  void check_friction() {
    rules_.number(at("friction"), zone_.friction, bounds::friction);
    if (zone_.friction_in_place)
      check_friction_in_place(*zone_.friction_in_place);
    rules_.number(at("restitution"), zone_.restitution, bounds::restitution);
    if (method_.exact_prediction && zone_.friction > 0)
      rules_.broken({at("friction"), at("method")},
                    fmt::format("found {}, {} is without friction, expected 0 or the method nodal_lagrange",
                                zone_.friction, method_.name));
    if (std::ranges::find(method_.friction, zone_.friction_method) == method_.friction.end())
      rules_.broken({at("friction_method"), at("method")},
                    fmt::format("found {} with the contact method {}, expected {}", friction_method_.name,
                                method_.name, either(method_.friction)));
  }

  void check_friction_in_place(const FieldValue& value) {
    rules_.field_value(at("friction"), value);
    if (zone_.friction != 1 || value.number() != nullptr)
      rules_.broken({at("friction")},
                    "found a number beside a friction that depends on the place, expected 1 "
                    "and an expression or a table");
    Field field;
    field.value = value;
    if (value.formula() != nullptr && varies_in_time(field))
      rules_.broken({at("friction")}, fmt::format("found t in {}, friction depends on the place only",
                                                  shown(value.formula()->text)));
  }

  void check_offsets() {
    rules_.field(at("gap"), zone_.gap);
    rules_.field(at("interference"), zone_.interference);
    if (const auto* number = zone_.interference.value.number(); number != nullptr && *number < 0)
      rules_.broken(
          {at("interference"), at("interference.value")},
          fmt::format("found {}, an interference is a positive overlap, expected gap: {}, which sets "
                      "surfaces apart",
                      *number, -*number));
    if (becomes_negative(zone_.interference))
      rules_.broken({at("interference.function"), "functions"},
                    fmt::format("found the function {}, which becomes negative, expected one that is >= 0; "
                                "'gap' sets surfaces apart",
                                shown(zone_.interference.function)));
  }

  /// Whether its function does, as far as its form tells; of the others the run asks.
  bool becomes_negative(const Field& field) const {
    const auto found = rules_.study.functions.find(field.function);
    if (found == rules_.study.functions.end())
      return false;
    const auto is_negative = [](double value) { return value < 0; };
    if (const auto* table = found->second.table())
      return !table->at.empty() && table->at.size() == table->values.size() &&
             std::ranges::any_of(table->values, is_negative);
    const auto* ramp = std::get_if<Ramp>(&found->second.is);
    return ramp != nullptr && (is_negative(ramp->from) || is_negative(ramp->to));
  }

  /// 1 where it has no function, or a bad one.
  double factor_at(const Field& field, double t) const {
    const auto found = rules_.study.functions.find(field.function);
    try {
      return found == rules_.study.functions.end() ? 1.0 : value_at(found->second, t);
    } catch (const InputError&) {
      return 1.0;
    }
  }

  void check_bonds() {
    if (zone_.tie)
      check_tie();
    if (zone_.nodal_pairs && (!method_.nodal || zone_.obstacle))
      rules_.broken({at("nodal_pairs"), at("method"), at("obstacle")},
                    "found nodal_pairs: true, which takes a master with nodes and a nodal method, expected "
                    "nodal_lagrange, nodal_penalty or nodal_pcg before a master");
    if (zone_.bilateral && method_.exact_prediction)
      rules_.broken({at("bilateral"), at("method")},
                    fmt::format("found bilateral: true, but {} knows of pushing forces only, expected "
                                "nodal_lagrange",
                                method_.name));
    if (zone_.bilateral && zone_.restitution > 0)
      rules_.broken(
          {at("bilateral"), at("restitution")},
          "found a restitution beside bilateral: true, where nothing bounces, expected one of them");
    if (zone_.freeze && zone_.geometry.by == Iteration::fixed_point &&
        method_.geometry != Iteration::fixed_point)
      rules_.broken({at("iterate.geometry"), at("freeze")},
                    "found fixed_point beside freeze: true, which leaves no geometry to iterate, expected "
                    "newton");
  }

  void check_tie() {
    const auto expect = [&](bool broken, const char* key, std::string_view found, std::string_view expected) {
      if (broken)
        rules_.broken({at(key), at("tie"), path_},
                      fmt::format("found {} in a tie, expected {}", found, expected));
    };
    expect(zone_.friction > 0, "friction", "friction", "none: surfaces that are tied do not slide");
    expect(zone_.method != ContactMethod::augmented_lagrangian, "method", method_.name,
           "augmented_lagrangian: a tie holds exactly");
    expect(zone_.obstacle.has_value(), "obstacle", "an obstacle", "supports, which hold or move a surface");
    expect(!entry_of(zone_.integration.by).ties, "integration", entry_of(zone_.integration.by).name,
           "mortar or nodes");
    expect(!is_zero(zone_.interference), "interference", "an interference",
           "none: what lies between the "
           "surfaces stays as it is");
    expect(!is_zero(zone_.gap), "gap", "a gap", "none: what lies between the surfaces stays as it is");
    expect(zone_.bilateral, "bilateral", "bilateral: true", "one of them");
    expect(zone_.freeze, "freeze", "freeze: true", "one of them: a tie holds its geometry");
  }

  /// What explicit steps do not have.
  void check_explicit_bonds(std::string_view scheme) {
    const auto refuse = [&](bool found, const char* key) {
      if (found)
        rules_.broken({at(key), "time.scheme"},
                      fmt::format("found {}: true, which the scheme {} does not have, expected an implicit "
                                  "scheme",
                                  key, scheme));
    };
    refuse(zone_.bilateral, "bilateral");
    refuse(zone_.freeze, "freeze");
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
    if (!rule.chooses_normal && zone_.smoothing)
      rules_.broken(
          {at("smoothing"), at("integration")},
          fmt::format("found smoothing: true with the integration {}, whose normals are averages at "
                      "the slave's nodes already, expected no 'smoothing'",
                      rule.name));
    if (!rule.chooses_normal && zone_.projection_tolerance)
      rules_.broken(
          {at("projection_tolerance"), at("integration")},
          fmt::format("found a projection_tolerance with the integration {}, which takes what faces "
                      "share, expected none",
                      rule.name));
    if (!rule.chooses_normal && zone_.clamped_normal != ClampedNormal::projection)
      rules_.broken({at("clamped_normal"), at("integration")},
                    fmt::format("found {} with the integration {}, which clamps no projection, expected no "
                                "'clamped_normal'",
                                word_of(clamped_normal_words, zone_.clamped_normal), rule.name));
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
      rules_.number(at("coefficients.tangential"), *zone_.tangential_coefficient, bounds::tangential);
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
      rules_.number(at(key) + ".tolerance", level.tolerance, bounds::loop_tolerance);
    rules_.whole_number(at(key) + ".max_loops", level.max_loops, bounds::max_loops);
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
    if (!zone_.tie && (!method_.explicit_steps || !friction_method_.explicit_steps))
      rules_.broken({path_, at("method"), at("friction_method"), "time.scheme"},
                    fmt::format("found the method {} with friction by {}, but the scheme {} has forces only, "
                                "expected penalty for both",
                                method_.name, friction_method_.name, word_of(scheme_words, time.scheme)));
    if (const auto& rule = entry_of(zone_.integration.by); !zone_.tie && !rule.explicit_steps)
      rules_.broken({path_, at("integration"), "time.scheme"},
                    fmt::format("found the integration {}, but the scheme {} computes forces point by point, "
                                "expected integration: nodes",
                                rule.name, word_of(scheme_words, time.scheme)));
    const bool overlaps = !is_zero(zone_.interference);
    if (overlaps || varies_in_time(zone_.gap))
      rules_.broken(
          {overlaps ? at("interference") : at("gap"), "time.scheme"},
          fmt::format("found {}, which the scheme {} does not follow, expected an implicit scheme{}",
                      overlaps ? "an interference" : "a gap that changes", word_of(scheme_words, time.scheme),
                      overlaps ? "" : " or a number or an expression without t"));
    check_explicit_bonds(word_of(scheme_words, time.scheme));
  }

  /// Velocities that jump ask for impulses, which springs have none of; and only they know of restitution.
  void check_velocities(const TimeStepping& time) {
    const bool jumps = has_jumps(time.scheme);
    if (zone_.restitution > 0 && !jumps)
      rules_.broken(
          {path_, at("restitution"), "time.scheme"},
          fmt::format(
              "found a restitution, which the schemes moreau_jean and energy_momentum take; {} computes "
              "the rebound from the bodies' own motion",
              word_of(scheme_words, time.scheme)));
    if (zone_.restitution > 0 && time.contact_mass == ContactMass::redistributed)
      rules_.broken({path_, at("restitution"), "time.contact_mass", "time.scheme"},
                    "found a restitution, but redistributed contact mass leaves nothing that could bounce, "
                    "expected contact_mass: consistent or no restitution");
    const auto* number = zone_.interference.value.number(); // of an expression the model asks
    const double at_start = number == nullptr ? 0.0 : *number * factor_at(zone_.interference, time.begin);
    if (jumps && at_start != 0)
      rules_.broken(
          {at("interference"), "time.scheme"},
          fmt::format("found {} at the first instant, but the scheme {} leaves overlaps of the start "
                      "as they are, expected a function that begins with 0",
                      at_start, word_of(scheme_words, time.scheme)));
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
