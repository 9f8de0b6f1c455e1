// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/deck/read.hpp"

#include "rubato/deck/check_forms.hpp"
#include "rubato/deck/chosen_runs.hpp"
#include "rubato/deck/grammar/parts.hpp"
#include "rubato/deck/other_runs.hpp"
#include "rubato/deck/overlay.hpp"
#include "rubato/deck/parts.hpp"
#include "rubato/study/echo.hpp"
#include "rubato/study/validate.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <utility>

namespace rubato::deck {
namespace {

/// Runs times values of the deck: what reading it may cost.
constexpr std::size_t most_work = 5'000'000;

using Run = WrittenRun;

/// Takes the entry `runs` out of the deck. A deck without one has one run.
std::vector<Run> take_runs(Tree& deck, Faults& faults) {
  const auto found = std::ranges::find(deck.entries, "runs", &Tree::Entry::key);
  if (found == deck.entries.end())
    return {{{"run", deck.at}, {}}};
  const Tree tree = std::move(found->value);
  deck.entries.erase(found);
  const Value value(tree, "runs", faults, grammar::runs());
  std::vector<Run> runs;
  for (const auto& [name, over] : named_entries(value)) {
    if (over.tree().is(Tree::Kind::map) || over.tree().is(Tree::Kind::nothing))
      runs.push_back({name, over.tree()});
    else
      over.fault(fmt::format("found {}, expected a map of changes", described(over.tree())));
  }
  if (tree.is(Tree::Kind::map) && tree.entries.empty())
    value.fault("found no run, expected at least one");
  if (runs.size() * count_nodes(deck) > most_work) {
    value.fault(fmt::format("found {} runs of a deck this large, which is too much to read", runs.size()));
    runs.clear();
  }
  return runs;
}

std::vector<std::string> names_of(const std::vector<Run>& runs) {
  std::vector<std::string> names;
  names.reserve(runs.size());
  for (const auto& run : runs)
    names.push_back(run.name.text);
  return names;
}

void read_physics(MapReader& map, Context& context, study::Study& study) {
  if (read(map.require("physics"), study.physics, study::physics_words))
    context.physics = study.physics;
  const auto thickness = map.find("thickness");
  read(thickness, study.thickness);
  const bool has_thickness =
      study.physics == study::Physics::plane_stress || study.physics == study::Physics::plane_strain;
  if (thickness && context.physics && !has_thickness)
    thickness->fault(fmt::format("{} has no thickness, plane_stress and plane_strain do",
                                 study::word_of(study::physics_words, study.physics)));
}

/// Rules about values that could not be read are left out.
void add_broken_rules(const study::Study& study, const Places& places, Faults& faults) {
  const auto is_spoiled = [&](const std::string& path) { return faults.is_spoiled(path); };
  const auto judgement = study::judge(study);
  faults.add_bounds(judgement.bounds);
  for (const auto& rule : judgement.broken)
    if (std::ranges::none_of(rule.paths, is_spoiled))
      faults.add(places.of(rule.paths.front()), rule.paths.front() + ": " + rule.text);
}

/// The deck of one run, everything laid over it. Parts come in the order in which one needs another.
study::Study read_study(const Tree& tree, const std::filesystem::path& folder, Faults& faults) {
  study::Study study;
  Context context{.folder = folder, .physics = {}, .scheme = {}};
  MapReader map(Value(tree, "", faults, grammar::deck()));
  read(map.find("title"), study.title);
  read(map.find("units"), study.units);
  read_physics(map, context, study);
  read_mesh(map.require("mesh"), context, study.mesh);
  read_time(map.require("time"), context, study.time);
  read_materials(map.require("materials"), context, study.materials);
  read_functions(map.find("functions"), context, study.functions);
  read_supports(map.find("supports"), context, study.supports);
  read_base_motion(map.find("base_motion"), context, study.base_motion);
  read_preload(map.find("preload"), context, study.preload);
  read_relations(map.find("relations"), context, study.relations);
  read_springs(map.find("springs"), study.springs);
  read_connectors(map.find("connectors"), context, study.connectors);
  read_masses(map.find("masses"), study.masses);
  read_loads(map.find("loads"), context, study.loads);
  read_temperatures(map.find("temperature"), context, study.temperatures);
  read_initial(map.find("initial"), study.initial);
  read_modal_damping(map.find("modal_damping"), study.modal_damping);
  read_contact(map.find("contact"), context, study.contact);
  read_newton(map.find("newton"), study.newton);
  read(map.find("solver"), study.solver, study::solver_words);
  read_probes(map.find("probes"), context, study.probes);
  read_fields(map.find("fields"), study.fields);
  study.time.stops = study.fields.at;
  read_checkpoint(map.find("checkpoint"), study.checkpoint);
  read_checks(map.find("checks"), study.checks);
  map.finish();
  return study;
}

/// The deck's title as the settings leave it; a run may have its own.
std::string title_of(Tree deck, std::span<const Change> changes) {
  Faults told_by_runs;
  for (const auto& change : changes)
    if (change.run.empty())
      apply(deck, change, told_by_runs);
  const auto* title = deck.find("title");
  return title != nullptr && title->is(Tree::Kind::word) ? title->text : "";
}

/// Where the runs are that a run names: in the deck, or computed already and known to be right.
enum class OtherRuns { in_the_deck, elsewhere };

/// A setting that would have made the run before it fit is not seen in the deck.
void hint_at_only(const study::Study& study, std::span<const ChosenRun> chosen, Faults& faults) {
  const auto& source = study.time.start_run;
  const auto is_left = [&](const ChosenRun& run) { return run.left && run.run->name.text == source; };
  if (std::ranges::any_of(chosen, is_left))
    faults.add({"--set"},
               fmt::format("run {} starts from run {}, which --only does not name and which so was left "
                           "as in the deck; expected '--only {},{}' to change both",
                           study.name, source, source, study.name));
}

std::string note_of(const ChosenRun& run, std::span<const std::string> only) {
  const auto& name = run.run->name.text;
  return fmt::format(
      "{}: left as in the deck, as --set changes the runs of --only; '--only {},{}' would change it, "
      "too",
      name, name, fmt::join(only, ","));
}

Deck parse(std::string_view text, const std::string& file_name, std::span<const Setting> settings,
           std::span<const std::string> only, OtherRuns others) {
  Faults faults;
  auto base = parse_tree(text, file_name, faults);
  if (base && !base->is(Tree::Kind::map))
    faults.add(base->at,
               fmt::format("found {}, expected a map with mesh, physics, materials, time", described(*base)));
  if (!base || !base->is(Tree::Kind::map))
    faults.throw_if_any();

  const auto runs = take_runs(*base, faults);
  const auto names = names_of(runs);
  const auto changes = parse_changes(settings, names, faults);
  const auto folder = std::filesystem::path(file_name).parent_path();
  Deck deck{title_of(*base, changes), {}, {}, {}};
  const auto chosen = choose_runs(*base, runs, changes, only, faults);
  for (const auto& run : chosen) {
    faults.enter_run(run.run->name.text);
    const auto tree = tree_of(*base, run, changes, faults);
    Places places(tree);
    auto study = read_study(tree, folder, faults);
    study.name = run.run->name.text;
    add_broken_rules(study, places, faults);
    if (others == OtherRuns::in_the_deck && !check_other_runs(study, deck.runs, names, places, faults))
      hint_at_only(study, chosen, faults);
    if (run.left)
      deck.notes.push_back(note_of(run, only));
    deck.runs.push_back(std::move(study));
    deck.places.push_back(std::move(places));
  }
  faults.add_untold(faults_of_forms(*base));
  faults.throw_if_any();
  return deck;
}

} // namespace

Deck parse_deck(std::string_view text, const std::string& file_name, std::span<const Setting> settings,
                std::span<const std::string> only) {
  return parse(text, file_name, settings, only, OtherRuns::in_the_deck);
}

study::Study parse_echo(std::string_view text, const std::string& file_name) {
  return parse(text, file_name, {}, {}, OtherRuns::elsewhere).runs.front();
}

bool accepts(const study::Study& study, std::span<const Setting> settings) {
  try {
    parse(study::to_json(study), "", settings, {}, OtherRuns::elsewhere);
    return true;
  } catch (const InputError&) {
    return false;
  }
}

Deck read_deck(const std::filesystem::path& file, std::span<const Setting> settings,
               std::span<const std::string> only) {
  if (std::filesystem::is_directory(file))
    throw InputError("found a folder, expected a deck file", {file.string()});
  std::ifstream stream(file, std::ios::binary);
  std::string text(std::istreambuf_iterator<char>(stream), {});
  if (!stream)
    throw InputError(std::filesystem::exists(file) ? "the deck file cannot be read"
                                                   : "the deck file does not exist",
                     {file.string()});
  return parse_deck(text, file.string(), settings, only);
}

} // namespace rubato::deck
