// SPDX-License-Identifier: LGPL-3.0-or-later
// Loads, temperatures and the motion at the begin.
#include "rubato/ccx/draft.hpp"
#include "rubato/load/field_forces.hpp"
#include "rubato/mesh/names.hpp"
#include "rubato/study/fields.hpp"
#include "rubato/study/words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rubato::ccx {
namespace {

using mesh::NodeIndex;
using study::Load;
using study::LoadKind;

constexpr std::string_view unset = "load";

std::string_view name_of(const Load& load) {
  return load.function.empty() ? unset : std::string_view(load.function);
}

std::optional<Function> function_of(const Run& run, const std::string& name) {
  return name.empty() ? std::optional<Function>() : std::optional(run.study().functions.at(name));
}

bool has_numbers(const Load& load) {
  const std::size_t count = load.kind == LoadKind::pressure ? 1 : 3;
  return std::all_of(load.components.begin(), load.components.begin() + static_cast<std::ptrdiff_t>(count),
                     [](const auto& value) { return value.number() != nullptr; });
}

/// Forces on components of nodes. CalculiX has one force with one amplitude on each of them in a step: a
/// second one acts on a node that moves as that one does.
class PointForces {
public:
  explicit PointForces(Run& run) : run_(run) {}

  void add(const Place& at, const Course& course) {
    if (course.factor != 0)
      forces_[at][course.amplitude] += course.factor;
  }

  /// Forces on groups that nothing else acts on are lines of the group.
  std::string text() {
    std::map<std::string, std::map<std::pair<int, double>, std::vector<std::int64_t>>> by_amplitude;
    for (const auto& [at, courses] : forces_) {
      int count = 0;
      for (const auto& [amplitude, force] : courses) {
        const auto place = count++ == 0 ? at : copy_of(at, count);
        by_amplitude[amplitude][{place.component, force}].push_back(place.node);
      }
    }
    std::string text;
    for (const auto& [amplitude, lines] : by_amplitude) {
      text += fmt::format("*CLOAD{}\n", amplitude.empty() ? "" : ", AMPLITUDE=" + amplitude);
      for (const auto& [what, nodes] : lines)
        text += lines_of(nodes, what.first, what.second);
    }
    return text;
  }

private:
  Place copy_of(const Place& at, int count) {
    const auto purpose = fmt::format("along force {} {} {}", at.node, at.component, count);
    const Place copy{made_node(run_.draft, purpose), 1};
    std::string equation;
    write_equation(equation, std::array<PlaceTerm, 2>{{{copy, 1}, {at, -1}}});
    run_.draft.copies[copy] = equation;
    return copy;
  }

  std::string lines_of(std::span<const std::int64_t> nodes, int component, double force) const {
    const auto set = run_.draft.node_sets_by_content.find({nodes.begin(), nodes.end()});
    if (set != run_.draft.node_sets_by_content.end() && nodes.size() > 1)
      return fmt::format("{}, {}, {}\n", set->second, component, shown_number(force));
    std::string text;
    for (const auto node : nodes)
      text += fmt::format("{}, {}, {}\n", node, component, shown_number(force));
    return text;
  }

  Run& run_;
  std::map<Place, std::map<std::string, double>> forces_;
};

class LoadWriter {
public:
  explicit LoadWriter(Run& run) : run_(run), forces_(run) {}

  void write() {
    const auto& study = run_.study();
    std::size_t force = 0;
    for (std::size_t i = 0; i < study.loads.size(); ++i) {
      const auto& load = study.loads[i];
      const auto path = fmt::format("loads.{}.{}", i, study::word_of(study::load_words, load.kind));
      if (load.follower)
        add_follower(load, path);
      else
        add_dead(load, run_.model.forces[force++], path);
    }
  }

  void put(std::map<std::string, std::string>& parts) {
    parts["*CLOAD"] = forces_.text();
    std::string text;
    for (const auto& [keyword, lines] : distributed_)
      text += keyword + "\n" + lines;
    parts["*DLOAD"] = text;
  }

private:
  void add_dead(const Load& load, const model::Force& force, const std::string& path) {
    if (load.kind == LoadKind::gravity && is_weight(load))
      return add_weight(load);
    if (load.kind == LoadKind::pressure && !run_.nonlinear && has_numbers(load) && is_new_surface(load.on))
      return add_pressure(load);
    if (load.kind != LoadKind::nodal_force && run_.nonlinear && load.kind == LoadKind::pressure)
      add_note(run_.draft,
               fmt::format("{}: the pressure does not turn with its faces: it is written as forces on "
                           "nodes",
                           path));
    add_pattern(force.pattern, force.function, name_of(load));
    for (const auto& field : force.fields)
      add_field(field, path, name_of(load));
  }

  void add_pattern(const Eigen::VectorXd& pattern, const std::optional<Function>& function,
                   std::string_view name) {
    const auto course = course_of(run_, 1, function, name);
    for (Eigen::Index dof = 0; dof < pattern.size(); ++dof)
      if (pattern[dof] != 0)
        forces_.add(place_of(run_, static_cast<int>(dof)), {pattern[dof] * course.factor, course.amplitude});
  }

  /// A value that changes with time as an expression.
  void add_field(const load::FieldForce& field, const std::string& path, std::string_view name) {
    if (field.value.varies_in_place())
      return run_.refuse(
          path, "found a value that changes with place and time at once; CalculiX has a pattern times a "
                "function of time, expected an expression of the place and a function");
    Eigen::VectorXd pattern = Eigen::VectorXd::Zero(run_.model.dofs.dof_count);
    for (const auto& at : field.places)
      load::add_at(at, 1, pattern);
    constexpr std::array anywhere{0.0, 0.0, 0.0};
    const auto course = sampled_course(
        run_, [&](double t) { return field.value.at(anywhere, t); }, name);
    for (Eigen::Index dof = 0; dof < pattern.size(); ++dof)
      if (pattern[dof] != 0)
        forces_.add(place_of(run_, static_cast<int>(dof)), {pattern[dof] * course.factor, course.amplitude});
  }

  /// Returns whether a load is one GRAV of whole sets of elements; CalculiX takes one of each set.
  bool is_weight(const Load& load) {
    if (!has_numbers(load) || !run_.study().masses.empty() || weighted_)
      return false;
    return load.on.empty() || run_.draft.element_sets.contains(load.on);
  }

  void add_weight(const Load& load) {
    weighted_ = true;
    Eigen::Vector3d g = Eigen::Vector3d::Zero();
    for (int i = 0; i < run_.model.dofs.components; ++i)
      g[i] = *load.components[static_cast<std::size_t>(i)].number();
    const double size = g.norm();
    if (size == 0)
      return;
    const auto course = course_of(run_, size, function_of(run_, load.function), name_of(load));
    std::vector<std::string> sets;
    if (load.on.empty())
      for (std::size_t i = 0; i < run_.draft.element_sets_of_law.size(); ++i) {
        if (run_.study().materials[i].density.value_or(0) > 0)
          std::ranges::copy(run_.draft.element_sets_of_law[i], std::back_inserter(sets));
      }
    else
      sets.push_back(run_.draft.element_sets.at(load.on));
    auto& lines = distributed_[keyword("*DLOAD", course)];
    for (const auto& set : sets)
      lines += fmt::format("{}, GRAV, {}, {}, {}, {}\n", set, shown_number(course.factor),
                           shown_number(g[0] / size), shown_number(g[1] / size), shown_number(g[2] / size));
  }

  static std::string keyword(std::string_view name, const Course& course) {
    return fmt::format("{}{}", name, course.amplitude.empty() ? "" : ", AMPLITUDE=" + course.amplitude);
  }

  /// Returns whether no other pressure acts on a face of the group: a second one would replace it.
  bool is_new_surface(const std::string& group) {
    const auto& mesh = run_.model.mesh;
    const auto* items = mesh.cell_group(group);
    if (items == nullptr || !run_.draft.surface_labels.contains(group))
      return false;
    const bool is_new =
        std::ranges::none_of(items->items, [&](mesh::CellIndex cell) { return pressed_.contains(cell); });
    if (is_new)
      pressed_.insert(items->items.begin(), items->items.end());
    return is_new;
  }

  void add_pressure(const Load& load) {
    const auto course =
        course_of(run_, *load.components[0].number(), function_of(run_, load.function), name_of(load));
    distributed_[keyword("*DSLOAD", course)] +=
        fmt::format("{}, P, {}\n", run_.draft.surface_labels.at(load.on), shown_number(course.factor));
  }

  void add_follower(const Load& load, const std::string& path) {
    if (!has_numbers(load))
      return run_.refuse(path + ".value",
                         "found a pressure that follows its faces and is no number; CalculiX has one "
                         "number for a surface, expected one");
    if (!is_new_surface(load.on))
      return run_.refuse(path + ".on",
                         fmt::format("found a second pressure on faces of '{}'; in CalculiX it would "
                                     "replace the first, expected one",
                                     load.on));
    add_pressure(load);
  }

  Run& run_;
  PointForces forces_;
  std::map<std::string, std::string> distributed_; ///< by keyword line
  std::set<mesh::CellIndex> pressed_;
  bool weighted_ = false;
};

std::vector<NodeIndex> heated_nodes(const Run& run, const std::string& on) {
  return on == study::everywhere ? run.model.dofs.nodes : mesh::find_nodes(run.model.mesh, on).nodes;
}

/// Temperatures at which nothing is expanded, one for all materials.
double reference_temperature(Run& run) {
  std::optional<double> reference;
  for (const auto& material : run.study().materials) {
    if (!material.expansion)
      continue;
    if (reference.value_or(material.expansion->reference) != material.expansion->reference)
      run.refuse(
          "materials." + material.name + ".reference_temperature",
          fmt::format("found {} beside {}; strains of CalculiX count from the initial temperatures of nodes, "
                      "expected one for all materials",
                      material.expansion->reference, *reference));
    reference = material.expansion->reference;
  }
  return reference.value_or(0);
}

void add_initial(Run& run, std::string_view type, const Eigen::VectorXd& values) {
  std::map<std::pair<int, double>, std::vector<NodeIndex>> groups;
  for (Eigen::Index dof = 0; dof < values.size(); ++dof)
    if (values[dof] != 0) {
      const auto at = place_of(run, static_cast<int>(dof));
      groups[{at.component, values[dof]}].push_back(run.model.node_of(static_cast<int>(dof)));
    }
  if (groups.empty())
    return;
  run.draft.initial += fmt::format("*INITIAL CONDITIONS, TYPE={}\n", type);
  for (const auto& [what, nodes] : groups)
    run.draft.initial += fmt::format("{}, {}, {}\n", label_of_nodes(run, nodes, "initial"), what.first,
                                     shown_number(what.second));
}

} // namespace

void write_loads(Run& run, std::map<std::string, std::string>& parts) {
  LoadWriter writer(run);
  writer.write();
  writer.put(parts);
}

std::string temperature_lines(Run& run) {
  if (!run.model.heat)
    return {};
  std::string text;
  for (std::size_t i = 0; i < run.study().temperatures.size(); ++i) {
    const auto& temperature = run.study().temperatures[i];
    const auto path = fmt::format("temperature.{}.value", i);
    const auto field = study::field_function(temperature.value, run.study().functions, path);
    const auto nodes = heated_nodes(run, temperature.on);
    const auto add = [&](const Course& course, const std::string& label) {
      text += fmt::format("*TEMPERATURE{}\n{}, {}\n",
                          course.amplitude.empty() ? "" : ", AMPLITUDE=" + course.amplitude, label,
                          shown_number(course.factor));
    };
    constexpr std::array anywhere{0.0, 0.0, 0.0};
    if (!field.varies_in_place()) {
      add(temperature.value.value.number() != nullptr
              ? course_of(run, *temperature.value.value.number(), field.function, "temperature")
              : sampled_course(
                    run, [&](double t) { return field.at(anywhere, t); }, "temperature"),
          label_of_nodes(run, nodes, temperature.on));
      continue;
    }
    add_note(
        run.draft,
        "temperatures that change with the place: linear cells have their mean in CalculiX, coarse meshes "
        "differ");
    for (const auto node : nodes) {
      const auto& x = run.model.mesh.points[static_cast<std::size_t>(node)];
      const std::array place{x[0], x[1], x[2]};
      add(sampled_course(
              run, [&](double t) { return field.at(place, t); }, "temperature"),
          fmt::format("{}", run.draft.node_numbers[static_cast<std::size_t>(node)]));
    }
  }
  return text;
}

void write_initial(Run& run) {
  if (run.model.heat)
    run.draft.initial += fmt::format("*INITIAL CONDITIONS, TYPE=TEMPERATURE\n{}, {}\n", run.draft.all_nodes,
                                     shown_number(reference_temperature(run)));
  if (run.modes)
    return;
  add_initial(run, "DISPLACEMENT", run.model.initial.displacement);
  if (!run.is_static())
    add_initial(run, "VELOCITY", run.model.initial.velocity);
}

} // namespace rubato::ccx
