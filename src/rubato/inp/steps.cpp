// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/inp/steps.hpp"

#include "rubato/core/naming.hpp"
#include "rubato/study/formulation.hpp"
#include "rubato/study/table_words.hpp"
#include "rubato/study/validate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace rubato::inp {
namespace {

using mesh::inp::compact;
using mesh::inp::Use;

struct StepKeyword {
  std::string_view name;
  void (*read)(Reading&, const Placed&, Step&);
};
/// Keywords that say what the step is, read before its loads.
constexpr std::array procedures{StepKeyword{"STATIC", read_static}, StepKeyword{"VISCO", read_visco},
                                StepKeyword{"DYNAMIC", read_dynamic},
                                StepKeyword{"FREQUENCY", read_frequency}};
constexpr std::array requests{
    StepKeyword{"NODE PRINT", read_print},      StepKeyword{"EL PRINT", read_print},
    StepKeyword{"SECTION PRINT", read_print},   StepKeyword{"CONTACT PRINT", read_print},
    StepKeyword{"NODE OUTPUT", read_output},    StepKeyword{"ELEMENT OUTPUT", read_output},
    StepKeyword{"CONTACT OUTPUT", read_output}, StepKeyword{"NODE FILE", read_field_request},
    StepKeyword{"EL FILE", read_field_request}, StepKeyword{"CONTACT FILE", read_field_request},
    StepKeyword{"OUTPUT", read_field_request}};

struct ChangeKeyword {
  std::string_view name;
  void (*read)(Reading&, std::size_t index);
};
/// Keywords of the model that a step may have.
constexpr std::array changes_only_in_steps{ChangeKeyword{"CHANGE FRICTION", read_change},
                                           ChangeKeyword{"CHANGE SURFACE BEHAVIOR", read_change},
                                           ChangeKeyword{"CHANGE CONTACT TYPE", read_change},
                                           ChangeKeyword{"CHANGE MATERIAL", read_change},
                                           ChangeKeyword{"CHANGE PLASTIC", read_change_plastic},
                                           ChangeKeyword{"MODEL CHANGE", read_model_change}};
constexpr std::array changes_too{ChangeKeyword{"EQUATION", read_equation}, ChangeKeyword{"MPC", read_mpc},
                                 ChangeKeyword{"FRICTION", read_friction},
                                 ChangeKeyword{"SURFACE BEHAVIOR", read_surface_behavior}};

struct LoadKeyword {
  std::string_view name;
  void (*read)(Reading&, const Placed&, const Step&, History&);
};
constexpr std::array loads{LoadKeyword{"BOUNDARY", read_boundary}, LoadKeyword{"CLOAD", read_cload},
                           LoadKeyword{"DLOAD", read_dload}, LoadKeyword{"DSLOAD", read_dsload},
                           LoadKeyword{"TEMPERATURE", read_temperature}};

template <class Table> auto find(const Table& table, std::string_view name) {
  const auto found = std::ranges::find(table, name, &Table::value_type::name);
  return found == table.end() ? nullptr : &*found;
}

/// Blocks of a step, without its begin and end.
struct StepBlocks {
  const Placed* begin = nullptr;
  std::vector<const Placed*> blocks;
};

std::vector<StepBlocks> split(Reading& reading) {
  std::vector<StepBlocks> steps;
  bool open = false;
  for (const auto& placed : reading.content.layout.blocks) {
    const auto& block = *placed.block;
    if (block.is("STEP")) {
      if (open)
        reading.faults.add(block.at,
                           fmt::format("found {} inside of that of line {}, expected *END STEP before it",
                                       block.at.text, steps.back().begin->block->at.line));
      steps.push_back({&placed, {}});
      open = true;
    } else if (block.is("END STEP")) {
      if (!open)
        reading.faults.add(block.at, "found *END STEP without its begin, expected *STEP before it");
      open = false;
    } else if (open) {
      steps.back().blocks.push_back(&placed);
    }
  }
  if (open)
    reading.faults.add(steps.back().begin->block->at,
                       "found *STEP without its end, expected *END STEP after it");
  return steps;
}

/// NLGEOM of a step; nothing where it is not there.
std::optional<bool> nonlinear_in(Reading& reading, const Block& block) {
  const auto* const nlgeom = block.find("NLGEOM");
  if (nlgeom == nullptr)
    return std::nullopt;
  const auto word = compact(nlgeom->value.text);
  if (!word.empty() && word != "YES" && word != "NO" && word != "ON" && word != "OFF")
    reading.faults.add(nlgeom->value, fmt::format("found NLGEOM={}, expected YES or NO", nlgeom->value.text));
  return word != "NO" && word != "OFF";
}

void read_head(Reading& reading, const Block& block, Step& step) {
  mesh::inp::check_parameters(block, reading.faults);
  if (step.nonlinear = nonlinear_in(reading, block); step.nonlinear)
    step.nonlinear_at = block.find("NLGEOM")->name;
  if (const auto* amplitude = block.find("AMPLITUDE"); amplitude != nullptr) {
    const auto word = compact(amplitude->value.text);
    step.ramp = word == "RAMP";
    if (word != "RAMP" && word != "STEP")
      reading.faults.add(amplitude->value,
                         fmt::format("found AMPLITUDE={}, expected RAMP or STEP", amplitude->value.text));
  }
  step.perturbation = block.find("PERTURBATION") != nullptr;
  if (step.perturbation && step.procedure != Procedure::modes)
    reading.faults.add(block.find("PERTURBATION")->name,
                       "found PERTURBATION, which *FREQUENCY takes alone, expected a "
                       "step without it");
}

/// Keywords that are no part of a step, or of the file outside of steps.
void refuse(Reading& reading, const Placed& placed, bool in_step) {
  const auto& block = *placed.block;
  const auto& row = *block.keyword;
  if (row.use == Use::harmless)
    return leave_out(reading, block);
  if (row.use == Use::unavailable)
    return reading.faults.add(block.at, fmt::format("found *{}, which rubato does not have{}{}", row.name,
                                                    row.note.empty() ? "" : ": ", row.note));
  reading.faults.add(block.at,
                     fmt::format("found *{} {} a step, expected it {} one", row.name,
                                 in_step ? "in" : "outside of", in_step ? "before the first" : "in"));
}

// ---- a study of a step

std::array<study::FieldValue, 3> times(const std::array<study::FieldValue, 3>& direction, double factor) {
  auto product = direction;
  for (auto& component : product) {
    if (const auto* number = component.number())
      component = *number * factor;
    else if (factor != 1)
      component = study::Formula{fmt::format("({})*({})", factor, component.formula()->text)};
  }
  return product;
}

void add_loads(study::Study& study, Places& places, const History& history, const Step& step) {
  for (const auto& active : history.loads) {
    const auto [value, function] =
        value_in(study, active.course, step.time.begin, step.time.end, step.number);
    if (value == 0)
      continue;
    study::Load load;
    load.kind = active.load;
    load.on = active.on;
    load.components = times(active.direction, value);
    load.function = function;
    places[fmt::format("loads.{}", study.loads.size())] = active.at.at();
    study.loads.push_back(std::move(load));
  }
}

/// Displacements and rotations of one target in one entry.
void add_supports(study::Study& study, Places& places, const History& history, const Step& step) {
  for (const auto& active : history.supports) {
    const auto dof = static_cast<std::size_t>(active.dof);
    const auto component = [&](study::Support& support) -> std::optional<study::Field>& {
      return dof < 3 ? support.components.at(dof) : support.turns.at(dof - 3);
    };
    const auto [value, function] =
        value_in(study, active.course, step.time.begin, step.time.end, step.number);
    study::Field field(value, function);
    field.given = active.given;
    if (active.along) {
      study::Support support;
      support.on = active.on;
      support.along = study::ObliqueSupport{false, *active.along, field};
      places[fmt::format("supports.{}", study.supports.size())] = active.at.at();
      study.supports.push_back(std::move(support));
      continue;
    }
    const auto entry = std::ranges::find_if(study.supports, [&](const study::Support& support) {
      return support.on == active.on && !support.along;
    });
    if (entry != study.supports.end()) {
      component(*entry) = field;
      continue;
    }
    study::Support support;
    support.on = active.on;
    component(support) = field;
    places[fmt::format("supports.{}", study.supports.size())] = active.at.at();
    study.supports.push_back(std::move(support));
  }
}

void add_temperatures(study::Study& study, Places& places, const History& history, const Step& step,
                      const Reading& reading) {
  const auto expands = [](const study::Material& material) { return material.expansion.has_value(); };
  if (history.temperatures.empty() || std::ranges::none_of(study.materials, expands))
    return;
  study.temperatures.push_back(
      {std::string(study::everywhere), study::Field(reading.initial_temperature.value_or(0))});
  for (const auto& active : history.temperatures) {
    const auto [value, function] =
        value_in(study, active.course, step.time.begin, step.time.end, step.number);
    places[fmt::format("temperature.{}", study.temperatures.size())] = active.at.at();
    study.temperatures.push_back({active.on, study::Field(value, function)});
  }
}

/// Increments grow and shrink between the first and the largest one where a step has iterations to judge by.
void set_increments(Reading& reading, study::Study& study, const Step& step) {
  if (step.procedure != Procedure::steps || step.direct || study.time.step >= step.time.end - step.time.begin)
    return;
  if (study::is_linear(study))
    return note(reading, step.procedure_at,
                fmt::format("increments are {} throughout (shorter where a step does not converge); Abaqus "
                            "and CalculiX choose their own without DIRECT",
                            study.time.step));
  study.time.max_step = step.largest > 0 ? step.largest : step.time.end - step.time.begin;
  note(reading, step.procedure_at,
       fmt::format("increments begin with {} and grow and shrink with their iterations, up to {}",
                   study.time.step, *study.time.max_step));
}

/// Weights need masses.
void check_weights(Reading& reading, const study::Study& study, const History& history) {
  for (const auto& active : history.loads) {
    if (active.load != study::LoadKind::gravity || (active.course.to == 0 && active.course.curve == nullptr))
      continue;
    for (std::size_t i = 0; i < reading.made_materials.size(); ++i)
      if (study.materials[i].density.value_or(0) == 0 &&
          share(reading.made_materials[i].elements, active.items))
        reading.faults.add(active.at,
                           fmt::format("found {} on elements of {}, which has no *DENSITY; expected "
                                       "it",
                                       active.label, shown(reading.made_materials[i].data->material.name)));
  }
}

void add_probes_and_fields(Reading& reading, study::Study& study, const Requests& asked, int step,
                           const Word& at) {
  study.probes = asked.probes;
  if (study.temperatures.empty())
    std::erase_if(study.probes,
                  [](const auto& probe) { return probe.field == study::ProbeField::temperature; });
  study.fields = asked.fields;
  study.fields.step = step;
  auto& stops = study.time.stops;
  stops.insert(stops.end(), study.fields.at.begin(), study.fields.at.end());
  std::ranges::sort(stops);
  stops.erase(std::ranges::unique(stops).begin(), stops.end());
  std::erase_if(study.fields.tables, [&](const study::PrintedTable& table) {
    return table.of == study::TableOf::zones && study.contact.empty();
  });
  const bool has_energy = std::ranges::any_of(study.fields.tables, [](const auto& table) {
    return std::ranges::find(table.quantities, "ENER") != table.quantities.end() ||
           std::ranges::find(table.quantities, "ELSE") != table.quantities.end();
  });
  if (!has_energy || study::stores_half_of_products(study))
    return;
  for (auto& table : study.fields.tables)
    std::erase_if(table.quantities,
                  [](const std::string& quantity) { return quantity == "ENER" || quantity == "ELSE"; });
  std::erase_if(study.fields.tables, [](const auto& table) { return table.quantities.empty(); });
  note(reading, at, "ENER and ELSE are left out: tables have them of elastic materials with small strains");
}

study::Study study_of(Reading& reading, const History& history, const Step& step, const std::string& previous,
                      Places& places) {
  auto study = reading.study;
  study.name = step.name;
  study.title = reading.title;
  study.time = step.time;
  if (!previous.empty()) {
    study.time.start = study::StartKind::from_run;
    study.time.start_run = previous;
    study.initial.clear();
  }
  places["time"] = step.procedure_at.at();
  places[""] = step.at.at();
  add_supports(study, places, history, step);
  add_loads(study, places, history, step);
  set_bodies(reading, study, history, step);
  add_pretensions(reading, study);
  add_temperatures(study, places, history, step, reading);
  check_weights(reading, study, history);
  set_increments(reading, study, step);
  open_removed(reading, study);
  fit_contact(reading, study, history, step);
  fit_formulations(reading, study, places);
  weaken_removed(reading, study, step);
  add_probes_and_fields(reading, study, history.requests, step.number, step.at);
  return study;
}

void finish_step(History& history, const Step& step) {
  history.before.clear();
  for (auto* actives : {&history.loads, &history.supports, &history.temperatures})
    for (auto& active : *actives) {
      auto& course = active.course;
      course.to = value_at_end(course, step.time.begin, step.time.end);
      course.from = course.to;
      course.rise = 0;
      if (course.curve != nullptr && !course.curve->total_time)
        course.curve = nullptr;
      history.before.push_back(active);
    }
  std::erase_if(history.loads,
                [](const Active& active) { return active.course.curve == nullptr && active.course.to == 0; });
  history.time = step.time.end;
}

void read_loads(Reading& reading, const StepBlocks& blocks, const Step& step, History& history) {
  history.replaced_by_new.clear();
  for (const auto* placed : blocks.blocks)
    if (const auto* row = find(loads, placed->block->keyword->name); row != nullptr)
      row->read(reading, *placed, step, history);
}

void read_changes(Reading& reading, const StepBlocks& blocks) {
  const auto& all = reading.content.layout.blocks;
  for (const auto* placed : blocks.blocks) {
    const auto& name = placed->block->keyword->name;
    const auto* row = find(changes_only_in_steps, name);
    row = row == nullptr ? find(changes_too, name) : row;
    if (row != nullptr)
      row->read(reading, static_cast<std::size_t>(placed - all.data()));
  }
  apply_changes(reading);
}

Step read_step(Reading& reading, const StepBlocks& blocks, int number, double begin) {
  Step step;
  step.number = number;
  step.at = blocks.begin->block->at;
  for (const auto* placed : blocks.blocks) {
    const auto& name = placed->block->keyword->name;
    if (const auto* row = find(procedures, name); row != nullptr) {
      mesh::inp::check_parameters(*placed->block, reading.faults);
      row->read(reading, *placed, step);
    }
  }
  read_head(reading, *blocks.begin->block, step);
  if (step.procedure == Procedure::none)
    reading.faults.add(step.at,
                       "found a step without *STATIC, *VISCO, *DYNAMIC or *FREQUENCY, expected one of them");
  step.time.begin = begin;
  step.time.end += begin;
  for (const auto* placed : blocks.blocks) {
    const auto& block = *placed->block;
    const auto& name = block.keyword->name;
    const auto* const request = find(requests, name);
    const bool known = request != nullptr || find(loads, name) != nullptr ||
                       find(procedures, name) != nullptr || find(changes_only_in_steps, name) != nullptr ||
                       find(changes_too, name) != nullptr;
    if (block.keyword->use == Use::study)
      mesh::inp::check_parameters(block, reading.faults);
    if (request != nullptr)
      request->read(reading, *placed, step);
    else if (!known && name != "AMPLITUDE" && block.keyword->use != Use::mesh)
      refuse(reading, *placed, true);
  }
  return step;
}

/// The motion that follows from a velocity begins anew with each run.
void check_velocities(Reading& reading, const Step& step, const History& history) {
  for (const auto& active : history.supports)
    if (step.number > 1 && step.procedure != Procedure::modes && active.given != study::Given::displacement)
      reading.faults.add(
          active.at, fmt::format("found a velocity or an acceleration of a support that goes on in step {}, "
                                 "expected a displacement with an amplitude in files of several steps",
                                 step.number));
}

std::string step_name(Reading& reading, const Block& block, int number, std::size_t count) {
  const auto* const name = block.find("NAME");
  if (name != nullptr && !name->value.empty())
    return chosen_name(reading, "run", name->value.text);
  return chosen_name(reading, "run", count == 1 ? "run" : fmt::format("step{}", number));
}

void judge(Reading& reading, const study::Study& study, const Places& places) {
  for (const auto& rule : study::broken_rules(study)) {
    std::string_view path = rule.paths.front();
    while (!path.empty() && !places.contains(path)) {
      const auto dot = path.rfind('.');
      path = dot == std::string_view::npos ? std::string_view() : path.substr(0, dot);
    }
    const auto at = places.find(path);
    reading.faults.add(at == places.end() ? Location{} : at->second, rule.paths.front() + ": " + rule.text);
  }
}

/// Stress of the steps before changes the stiffness that modes have.
void check_base_state(Reading& reading, const Step& step, const History& history) {
  if (step.perturbation || history.nonlinear)
    return reading.faults.add(
        step.procedure_at,
        fmt::format("found {} after a static or dynamic step {}: its modes are about the bodies under the "
                    "stress of that step, and rubato has those of undeformed bodies only; expected it in the "
                    "first step",
                    step.procedure_at.text, step.perturbation ? "with PERTURBATION" : "with NLGEOM"));
  note(reading, step.procedure_at, "natural modes are those of the undeformed bodies without stress");
}

/// NLGEOM stays on in the steps that follow.
void follow_nonlinear(Reading& reading, const Step& step, History& history) {
  if (step.nonlinear.value_or(false) && !history.nonlinear) {
    history.nonlinear = true;
    history.nonlinear_at = step.nonlinear_at;
  } else if (!step.nonlinear.value_or(true) && history.nonlinear) {
    note(reading, step.nonlinear_at, "NLGEOM stays on after a step with it, as in Abaqus");
  }
}

/// Supports before the first step. Other keywords of steps are refused there.
void read_before_steps(Reading& reading, History& history) {
  const Step before_steps;
  bool in_step = false;
  for (const auto& placed : reading.content.layout.blocks) {
    in_step = placed.block->is("STEP") || (in_step && !placed.block->is("END STEP"));
    const auto& name = placed.block->keyword->name;
    if (placed.block->is("BOUNDARY") && !in_step)
      read_boundary(reading, placed, before_steps, history);
    else if (!in_step && (find(loads, name) != nullptr || find(procedures, name) != nullptr ||
                          find(requests, name) != nullptr || find(changes_only_in_steps, name) != nullptr))
      refuse(reading, placed, false);
  }
}

/// The study of a step, where it is wanted and nothing is wrong.
void add_run(Reading& reading, const History& history, const Step& step, const std::string& previous,
             Input& input) {
  const bool is_modes = step.procedure == Procedure::modes;
  auto places = reading.places;
  auto study = study_of(reading, history, step, is_modes ? "" : previous, places);
  if (!reading.faults.empty())
    return;
  judge(reading, study, places);
  if (is_modes)
    input.modes[study.name] = step.modes;
  input.runs.push_back(std::move(study));
  input.places.push_back(std::move(places));
}

} // namespace

void read_steps(Reading& reading, Purpose purpose, Input& input) {
  const auto steps = split(reading);
  History history;
  history.nonlinear_later = std::ranges::any_of(steps, [&](const StepBlocks& step) {
    return nonlinear_in(reading, *step.begin->block).value_or(false);
  });
  history.explicit_steps = std::ranges::any_of(steps, [](const StepBlocks& step) {
    return std::ranges::any_of(step.blocks, [](const Placed* placed) {
      return placed->block->is("DYNAMIC") && placed->block->find("EXPLICIT") != nullptr;
    });
  });
  read_before_steps(reading, history);
  if (steps.empty())
    reading.faults.add(reading.places.at("mesh"), "found no *STEP in the file, expected at least one");
  std::string previous;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const auto number = static_cast<int>(i) + 1;
    auto step = read_step(reading, steps[i], number, history.time);
    step.name = step_name(reading, *steps[i].begin->block, number, steps.size());
    follow_nonlinear(reading, step, history);
    read_changes(reading, steps[i]);
    read_loads(reading, steps[i], step, history);
    check_velocities(reading, step, history);
    renew_requests(reading, step, history.requests);
    const bool is_modes = step.procedure == Procedure::modes;
    if (is_modes && !previous.empty())
      check_base_state(reading, step, history);
    if ((purpose == Purpose::run || is_modes) && reading.faults.empty())
      add_run(reading, history, step, previous, input);
    if (is_modes)
      continue;
    previous = step.name;
    if (reading.faults.empty())
      finish_step(history, step);
  }
  keep_friction(input.runs);
  for (auto& study : input.runs) // one mesh for all of them
    study.mesh.groups = reading.study.mesh.groups;
  if (purpose == Purpose::modes && input.runs.empty() && reading.faults.empty() && !steps.empty())
    reading.faults.add(steps.front().begin->block->at,
                       "found no *FREQUENCY in the file, expected a step with it");
}

} // namespace rubato::inp
