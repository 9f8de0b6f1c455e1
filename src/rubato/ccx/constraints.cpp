// SPDX-License-Identifier: LGPL-3.0-or-later
// Supports as *BOUNDARY, relations as *EQUATION.
#include "rubato/ccx/draft.hpp"
#include "rubato/mesh/names.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace rubato::ccx {
namespace {

using constraint::DependentDof;
using constraint::ImposedValue;
using constraint::PrescribedDof;

/// The lines of each course.
class Boundary {
public:
  void add(const Course& course, const std::string& on, int component) {
    lines_[course.amplitude] +=
        fmt::format("{}, {}, {}, {}\n", on, component, component, shown_number(course.factor));
  }
  /// Blocks without the keyword's other parameters, which differ from step to step.
  std::string text() const {
    std::string text;
    for (const auto& [amplitude, lines] : lines_)
      text += fmt::format("*BOUNDARY{}\n{}", amplitude.empty() ? "" : ", AMPLITUDE=" + amplitude, lines);
    return text;
  }

private:
  std::map<std::string, std::string> lines_;
};

Course course_of_imposed(Run& run, const ImposedValue& imposed, std::string_view name) {
  if (!imposed.field && !imposed.rotation)
    return course_of(run, imposed.value, imposed.function, name);
  return sampled_course(
      run, [&](double t) { return constraint::value_at(imposed, t); }, name);
}

std::string name_of_function(const study::Field& field) {
  return field.function.empty() ? "support" : field.function;
}

/// Nodes of a support that holds displacements along the axes by a number; nothing of others.
std::vector<mesh::NodeIndex> plainly_held(const Run& run, const study::Support& support) {
  const bool is_plain = std::ranges::all_of(support.components, [](const auto& component) {
    return !component ||
           (component->value.number() != nullptr && component->given == study::Given::displacement);
  });
  if (!is_plain || support.rotate)
    return {};
  auto nodes = mesh::find_nodes(run.model.mesh, support.on).nodes;
  std::erase_if(nodes, [&](mesh::NodeIndex node) { return !run.model.dofs.has(node); });
  return nodes;
}

/// The part of a dependent dof that neither unknowns nor supports give.
double right_side(const model::Model& model, const DependentDof& dependent, double t) {
  double rest = model.reduction.given_part(dependent, t);
  const auto supports = model.reduction.prescribed();
  for (const auto& term : dependent.prescribed) {
    const auto found = std::ranges::lower_bound(supports, term.dof, {}, &PrescribedDof::dof);
    rest -= term.coefficient * model.reduction.displacement(*found, t);
  }
  return rest;
}

/// Sums that cancel leave rounding.
constexpr double rounding_of_sums = 1e-12;

bool has_right_side(const Run& run, const DependentDof& dependent) {
  if (dependent.given.empty())
    return false;
  const auto instants = instants_of(run.study().time);
  return std::ranges::any_of(instants, [&](double t) {
    const double whole = std::abs(run.model.reduction.given_part(dependent, t));
    return std::abs(right_side(run.model, dependent, t)) > rounding_of_sums * whole;
  });
}

/// A right side is the displacement along x of a node that has nothing else. Equal right sides share a node.
Place place_of_right_side(Run& run, const Course& course) {
  const auto purpose = fmt::format("right side {} {}", shown_number(course.factor), course.amplitude);
  return {made_node(run.draft, purpose), 1};
}

Course course_of_right_side(Run& run, const DependentDof& dependent) {
  return sampled_course(
      run, [&](double t) { return right_side(run.model, dependent, t); }, "relation");
}

} // namespace

void write_equation(std::string& body, std::span<const PlaceTerm> terms) {
  std::vector<std::string> entries;
  for (const auto& term : terms)
    entries.push_back(
        fmt::format("{}, {}, {}", term.at.node, term.at.component, shown_number(term.coefficient)));
  body += fmt::format("*EQUATION\n{}\n{}", terms.size(), rows_of(entries, 4));
}

void write_relations(Run& run) {
  const auto& model = run.model;
  for (const auto& dependent : model.reduction.dependents()) {
    std::vector<PlaceTerm> terms{{place_of(run, dependent.dof), 1}};
    for (const auto* others : {&dependent.of, &dependent.prescribed})
      for (const auto& term : *others)
        terms.push_back({place_of(run, term.dof), -term.coefficient});
    if (has_right_side(run, dependent))
      terms.push_back({place_of_right_side(run, course_of_right_side(run, dependent)), -1});
    if (terms.size() == 1) // held by relations alone: a second term without effect is needed
      terms.push_back({{made_node(run.draft, "zero"), 1}, -1});
    write_equation(run.body, terms);
  }
}

std::string support_lines(Run& run) {
  const auto& model = run.model;
  Boundary boundary;
  std::vector<char> done(static_cast<std::size_t>(model.dofs.dof_count), 0);
  for (const auto& support : run.study().supports) {
    const auto nodes = plainly_held(run, support);
    if (nodes.empty())
      continue;
    const auto label = label_of_nodes(run, nodes, support.on);
    for (int i = 0; i < model.dofs.components; ++i) {
      const auto& field = support.components[static_cast<std::size_t>(i)];
      if (!field)
        continue;
      const auto function = field->function.empty()
                                ? std::optional<Function>()
                                : std::optional(run.study().functions.at(field->function));
      boundary.add(course_of(run, *field->value.number(), function, name_of_function(*field)), label, i + 1);
      for (const auto node : nodes)
        done[static_cast<std::size_t>(model.dofs.dof(node, i))] = 1;
    }
  }
  for (const auto& prescribed : model.reduction.prescribed())
    if (done[static_cast<std::size_t>(prescribed.dof)] == 0) {
      const auto at = place_of(run, prescribed.dof);
      boundary.add(course_of_imposed(run, prescribed.imposed, "support"), fmt::format("{}", at.node),
                   at.component);
    }
  for (const auto& dependent : model.reduction.dependents())
    if (has_right_side(run, dependent)) {
      const auto course = course_of_right_side(run, dependent);
      const auto at = place_of_right_side(run, course);
      boundary.add(course, fmt::format("{}", at.node), at.component);
    }
  for (const auto& [at, course] : run.moved)
    boundary.add(course, fmt::format("{}", at.node), at.component);
  for (const auto& [purpose, node] : run.draft.made_nodes)
    if (purpose == "zero" || purpose.starts_with("fixed"))
      for (int i = 1; i <= 3; ++i)
        boundary.add({}, fmt::format("{}", node), i);
    else if (purpose.starts_with("along"))
      for (int i = 2; i <= 3; ++i)
        boundary.add({}, fmt::format("{}", node), i);
  return boundary.text();
}

} // namespace rubato::ccx
