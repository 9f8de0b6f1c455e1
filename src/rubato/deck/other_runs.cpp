// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/deck/other_runs.hpp"

#include "rubato/study/formulation.hpp"
#include "rubato/study/stored_fields.hpp"
#include "rubato/study/words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rubato::deck {
namespace {

/// Instants nearer than this part of them are the same.
constexpr double same_instant = 1e-9;

/// A place where one run names another: knows how to complain there.
class Mention {
public:
  Mention(const std::string& name, std::string path, const Places& places, Faults& faults)
      : name_(name), path_(std::move(path)), places_(places), faults_(faults) {}

  void fault(const std::string& text) const { faults_.add(places_.of(path_), path_ + ": " + text); }

  /// The run that is named; nullptr and a fault when it is no earlier one. `verb` says what is done with it.
  const study::Study* earlier_run(const study::Study& study, std::span<const study::Study> earlier,
                                  const std::vector<std::string>& all, std::string_view verb) const {
    const auto source = std::ranges::find(earlier, name_, &study::Study::name);
    if (source != earlier.end())
      return &*source;
    if (name_ == study.name)
      fault(fmt::format("run {} cannot {} itself", name_, verb));
    else if (std::ranges::find(all, name_) == all.end())
      fault(fmt::format("no run is called {}{}", shown(name_), suggestion(name_, all)));
    else
      fault(fmt::format("run {} comes later than run {}, expected an earlier one", name_, study.name));
    return nullptr;
  }

private:
  const std::string& name_;
  std::string path_;
  const Places& places_;
  Faults& faults_;
};

/// However they move.
bool same_surface(std::optional<study::Obstacle> one, std::optional<study::Obstacle> other) {
  for (auto* obstacle : {&one, &other})
    if (*obstacle) {
      (*obstacle)->move = {};
      (*obstacle)->rotate.reset();
    }
  return one == other;
}

/// Whether multipliers and statuses of one study's contact mean the same in the other.
bool same_contact(const study::Study& a, const study::Study& b) {
  return std::ranges::equal(
      a.contact, b.contact, [](const study::ContactZone& one, const study::ContactZone& other) {
        return one.name == other.name && one.master == other.master && one.slave == other.slave &&
               one.between == other.between && one.self == other.self && one.all == other.all &&
               same_surface(one.obstacle, other.obstacle) && one.integration == other.integration &&
               (one.friction > 0) == (other.friction > 0);
      });
}

bool same_mesh(const study::Study& a, const study::Study& b) {
  return a.mesh == b.mesh && a.physics == b.physics;
}

/// The materials whose past counts, without what may change from run to run.
std::vector<study::Material> remembering(const study::Study& study) {
  std::vector<study::Material> materials;
  for (const auto& material : study.materials)
    if (study::remembers(material)) {
      auto& kept = materials.emplace_back(material);
      kept.density.reset();
      kept.in_place.erase("density");
      kept.rayleigh_stiffness = kept.rayleigh_mass = 0;
      kept.damping.reset();
    }
  return materials;
}

/// Whether it fits.
bool check_start(const study::Study& study, std::span<const study::Study> earlier,
                 const std::vector<std::string>& all, const Places& places, Faults& faults) {
  const auto& from = study.time.start_run;
  if (study.time.start != study::StartKind::from_run || from.empty())
    return true;
  const Mention mention(from, "time.start.from", places, faults);
  const auto* source = mention.earlier_run(study, earlier, all, "start from");
  if (source == nullptr)
    return false;
  const bool fits =
      same_mesh(*source, study) && (study::is_explicit(study.time.scheme) || same_contact(*source, study));
  if (fits && remembering(*source) == remembering(study))
    return true;
  if (!same_mesh(*source, study))
    mention.fault(fmt::format("run {} has another mesh or physics than run {}", from, study.name));
  else if (fits)
    mention.fault(
        fmt::format("run {} has other materials than run {}, expected the same of those that remember "
                    "their past: plastic, prony, and with 'formulation: enhanced'",
                    from, study.name));
  else
    mention.fault(fmt::format("run {} has other contact zones than run {}, expected the same surfaces, the "
                              "same integration and friction in both or in none",
                              from, study.name));
  return false;
}

/// A run of the deck before the study that was not read.
bool is_left_out(const std::string& name, const study::Study& study, std::span<const study::Study> earlier,
                 const std::vector<std::string>& all) {
  return std::ranges::find(earlier, name, &study::Study::name) == earlier.end() &&
         std::ranges::find(all, name) < std::ranges::find(all, study.name);
}

bool is_same_instant(double a, double b) {
  return std::abs(a - b) <= same_instant * std::max(std::abs(a), std::abs(b));
}

/// What a comparison reads are MED files. Whether every n-th step meets an instant shows in the run only.
bool may_store_fields(const study::Study& study, double instant) {
  const auto& fields = study.fields;
  const auto is_meant = [&](double at) { return is_same_instant(at, instant); };
  return fields.med && (fields.every > 0 || std::ranges::any_of(fields.at, is_meant) ||
                        (fields.last && is_meant(study.time.end)));
}

/// Whether the study does not write a field that there is. Another one is a fault of its own, told already.
bool leaves_out(const study::Study& study, const std::string& name) {
  const auto fields = study::stored_fields(study::dimension_of(study.physics));
  const auto found = std::ranges::find(fields, name, &study::StoredField::name);
  return found != fields.end() && !study::is_written(study.fields, *found);
}

void check_probe(const study::Check& check, const study::Study& study, const study::Study& source,
                 const Mention& mention) {
  const auto own = std::ranges::find(study.probes, check.probe, &study::Probe::name);
  const auto other = std::ranges::find(source.probes, check.probe, &study::Probe::name);
  if (own == study.probes.end()) // a fault of its own, told already
    return;
  if (other == source.probes.end())
    mention.fault(fmt::format("run {} has no probe '{}'", source.name, check.probe));
  else if (own->section.has_value() != other->section.has_value() ||
           own->minus.empty() != other->minus.empty())
    mention.fault(fmt::format("probe '{}' is something else in run {} than in run {}", check.probe,
                              source.name, study.name));
  else if (const auto components = study::components_of(*other, source);
           !check.component.empty() && std::ranges::find(components, check.component) == components.end())
    mention.fault(fmt::format("run {} has no component {}", source.name, check.component));
  else if (own->field != other->field)
    mention.fault(fmt::format("probe '{}' is of {} in run {} and of {} in run {}", check.probe,
                              study::word_of(study::probe_field_words, other->field), source.name,
                              study::word_of(study::probe_field_words, own->field), study.name));
  else if (own->take != other->take)
    mention.fault(
        fmt::format("probe '{}' takes something else of its nodes in run {} than in run {}, expected "
                    "the same 'take'",
                    check.probe, source.name, study.name));
  else if (own->place != other->place)
    mention.fault(fmt::format("probe '{}' is at {} in run {} and at {} in run {}", check.probe,
                              study::word_of(study::probe_place_words, other->place), source.name,
                              study::word_of(study::probe_place_words, own->place), study.name));
}

void check_field(const study::Check& check, const study::Study& study, const study::Study& source,
                 const Mention& mention) {
  if (!same_mesh(source, study)) {
    mention.fault(fmt::format("run {} has another mesh or physics than run {}: fields are compared node by "
                              "node, probes of the same name can be",
                              source.name, study.name));
    return;
  }
  for (const auto* run : {&source, &study}) {
    if (run->contact.empty() && check.field->name.starts_with("contact_"))
      mention.fault(fmt::format("run {} has no contact, so no {}", run->name, check.field->name));
    if (leaves_out(*run, check.field->name))
      mention.fault(fmt::format("run {} does not write {}, expected it among the fields of 'only' or 'also'",
                                run->name, check.field->name));
    if (!may_store_fields(*run, check.at))
      mention.fault(fmt::format("run {} stores no fields at {} that can be read back, expected 'fields: "
                                "{{formats: [med], at: [{}]}}' in both runs",
                                run->name, check.at, check.at));
  }
}

void check_resultant(const study::Check& check, const study::Study& source, const Mention& mention) {
  const auto is_meant = [&](const study::ContactZone& zone) {
    return zone.all || zone.name == check.resultant->zone;
  };
  if (std::ranges::none_of(source.contact, is_meant))
    mention.fault(fmt::format("run {} has no contact zone '{}'", source.name, check.resultant->zone));
}

void check_comparison(const study::Check& check, const study::Study& study, const study::Study& source,
                      const Mention& mention) {
  const auto& time = source.time;
  if (check.at < time.begin || (check.at > time.end && !is_same_instant(check.at, time.end)))
    mention.fault(fmt::format("run {} goes from {} to {}, expected one that comes by {}", source.name,
                              time.begin, time.end, check.at));
  else if (check.field)
    check_field(check, study, source, mention);
  else if (!check.probe.empty())
    check_probe(check, study, source, mention);
  else if (check.resultant)
    check_resultant(check, source, mention);
}

} // namespace

bool check_other_runs(const study::Study& study, std::span<const study::Study> earlier,
                      const std::vector<std::string>& all, const Places& places, Faults& faults) {
  const bool fits = check_start(study, earlier, all, places, faults);
  for (std::size_t i = 0; i < study.checks.size(); ++i) {
    const auto& check = study.checks[i];
    if (check.run.empty() || is_left_out(check.run, study, earlier, all))
      continue;
    const Mention mention(check.run, fmt::format("checks.{}.run", i), places, faults);
    if (const auto* source = mention.earlier_run(study, earlier, all, "be compared with"))
      check_comparison(check, study, *source, mention);
  }
  return fits;
}

} // namespace rubato::deck
