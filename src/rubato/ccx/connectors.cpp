// SPDX-License-Identifier: LGPL-3.0-or-later
// Springs, dashpots and masses. Those that act on several displacements act on a node of their own, which an
// equation moves.
#include "rubato/ccx/draft.hpp"
#include "rubato/mesh/names.hpp"
#include "rubato/model/springs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rubato::ccx {
namespace {

/// Elements that are no cells, those with the same numbers in one set.
class Discrete {
public:
  explicit Discrete(Run& run) : run_(run) {}

  void spring(const Place& at, double stiffness) {
    families_[{"SPRING1", fmt::format("*SPRING, ELSET=@\n{}\n{}\n", at.component, shown_number(stiffness))}]
        .push_back(fmt::format("{}", at.node));
  }
  void line(std::string_view type, std::string_view keyword, std::int64_t from, std::int64_t to,
            const std::string& law) {
    families_[{std::string(type), fmt::format("*{}, ELSET=@\n\n{}", keyword, law)}].push_back(
        fmt::format("{}, {}", from, to));
  }
  void mass(std::int64_t node, double mass) {
    families_[{"MASS", fmt::format("*MASS, ELSET=@\n{}\n", shown_number(mass))}].push_back(
        fmt::format("{}", node));
  }

  void finish(std::string_view name) {
    int count = 0;
    for (const auto& [key, elements] : families_) {
      const auto set = fmt::format("{}_{}", name, ++count);
      run_.body += fmt::format("*ELEMENT, TYPE={}, ELSET={}\n", key.first, set);
      for (const auto& nodes : elements)
        run_.body += fmt::format("{}, {}\n", run_.next_element++, nodes);
      auto section = key.second;
      section.replace(section.find('@'), 1, set);
      run_.body += section;
    }
  }

private:
  Run& run_;
  std::map<std::pair<std::string, std::string>, std::vector<std::string>> families_; ///< by type and section
};

/// Lines of force and elongation; CalculiX keeps the last force beyond them.
std::string table_law(const LinearTable& table) {
  constexpr double far = 1000;
  auto at = table.at;
  auto forces = table.values;
  if (table.outside == LinearTable::Outside::linear && at.size() > 1) {
    const double size = far * (at.back() - at.front());
    for (const double end : {at.front() - size, at.back() + size}) {
      const bool below = end < at.front();
      at.insert(below ? at.begin() : at.end(), end);
      forces.insert(below ? forces.begin() : forces.end(), interpolated(table, end));
    }
  }
  std::string text;
  for (std::size_t i = 0; i < at.size(); ++i)
    text += fmt::format("{}, {}\n", shown_number(forces[i]), shown_number(at[i]));
  return text;
}

/// The displacement Σ row · u as that of a node of its own along x.
Place place_along(Run& run, std::span<const constraint::Term> row, const std::string& purpose) {
  const auto name = "along " + purpose;
  const Place at{made_node(run.draft, name), 1};
  std::map<Place, double> sums;
  for (const auto& term : row)
    sums[place_of(run, term.dof)] -= term.coefficient;
  std::vector<PlaceTerm> terms{{at, 1}};
  for (const auto& [place, coefficient] : sums)
    if (coefficient != 0)
      terms.push_back({place, coefficient});
  write_equation(run.body, terms);
  return at;
}

/// The number of the one node that has that name; nothing of references and groups.
std::optional<std::int64_t> node_named(const Run& run, const std::string& name) {
  const auto nodes = mesh::find_nodes(run.model.mesh, name).nodes;
  if (nodes.size() != 1)
    return std::nullopt;
  return run.draft.node_numbers[static_cast<std::size_t>(nodes.front())];
}

void add_turning(Run& run, Discrete& springs, const model::Connector& connector, std::size_t i) {
  const auto& line = *connector.line;
  const auto& way = *connector.way;
  if (!run.nonlinear)
    return run.refuse("connectors",
                      "found a spring that rotates beside bodies with small strains; springs of "
                      "CalculiX turn with NLGEOM alone, expected 'strain: green_lagrange'");
  if (line.dashpot.acts() || line.spring.table)
    return run.refuse("connectors",
                      "found a dashpot or a table that rotates; CalculiX has stiffnesses alone, "
                      "expected one");
  const auto from = node_named(run, way.on);
  auto to = way.to.empty() ? std::nullopt : node_named(run, way.to);
  if (way.to.empty() && from) {
    const auto node = mesh::find_nodes(run.model.mesh, way.on).nodes.front();
    to = made_node(run.draft, fmt::format("fixed anchor {}", i),
                   run.model.mesh.points[static_cast<std::size_t>(node)] + way.undeformed);
  }
  if (!from || !to)
    return run.refuse("connectors",
                      "found a spring that rotates at a reference or a group; CalculiX has SPRINGA "
                      "between two nodes, expected nodes");
  springs.line("SPRINGA", "SPRING", *from, *to, shown_number(line.spring.slope) + "\n");
}

/// The two nodes of a spring that acts along the line between them, in space.
std::optional<std::array<mesh::NodeIndex, 2>> ends_of(const Run& run, std::span<const constraint::Term> row) {
  std::map<mesh::NodeIndex, Eigen::Vector3d> parts;
  for (const auto& term : row) {
    const auto node = run.model.node_of(term.dof);
    auto& part = parts.try_emplace(node, Eigen::Vector3d::Zero()).first->second;
    part[place_of(run, term.dof).component - 1] += term.coefficient;
  }
  if (run.is_plane() || parts.size() != 2)
    return std::nullopt;
  const auto& [from, pulls_from] = *parts.begin();
  const auto& [to, pulls_to] = *parts.rbegin();
  const auto& points = run.model.mesh.points;
  const Eigen::Vector3d way = points[static_cast<std::size_t>(to)] - points[static_cast<std::size_t>(from)];
  constexpr double rounding = 1e-12;
  const bool is_along = way.norm() > 0 && (pulls_to - way.normalized()).norm() < rounding &&
                        (pulls_to + pulls_from).norm() < rounding;
  return is_along ? std::optional(std::array{from, to}) : std::nullopt;
}

/// Springs on nodes themselves where CalculiX has such ones, so that its reactions have their forces.
bool add_plain(Run& run, Discrete& springs, const model::Connector& connector) {
  if (connector.force || run.nonlinear)
    return false;
  const auto ends = ends_of(run, connector.row);
  if (!ends)
    return false;
  const auto number = [&](mesh::NodeIndex node) {
    return run.draft.node_numbers[static_cast<std::size_t>(node)];
  };
  springs.line("SPRINGA", "SPRING", number((*ends)[0]), number((*ends)[1]),
               shown_number(connector.stiffness) + "\n");
  return true;
}

void add_connector(Run& run, Discrete& springs, std::size_t i) {
  const auto& connector = run.model.connectors[i];
  if (connector.line)
    return add_turning(run, springs, connector, i);
  const bool has_spring = connector.stiffness > 0 || connector.force;
  const bool has_dashpot = (connector.damping > 0 || connector.damper) && !run.is_static() && !run.modes;
  if (has_dashpot)
    run.refuse("connectors",
               "found damping; dashpots of CalculiX act in harmonic steps alone, expected none");
  if (!has_spring)
    return;
  if (add_plain(run, springs, connector))
    return;
  const auto at = place_along(run, connector.row, fmt::format("connector {}", i));
  add_note(run.draft,
           "connectors: springs act on nodes of their own, which equations move: RF of CalculiX lacks their "
           "forces on nodes that supports hold");
  if (!connector.force)
    return springs.spring(at, connector.stiffness);
  if (!run.nonlinear)
    return run.refuse("connectors",
                      "found a table beside bodies with small strains; CalculiX takes tables of springs "
                      "with NLGEOM alone, expected 'strain: green_lagrange'");
  if (connector.force->outside == LinearTable::Outside::zero)
    return run.refuse("connectors",
                      "found a table that is 0 outside; springs of CalculiX keep the last force, expected "
                      "'constant' or 'linear'");
  const double reach = std::max(std::abs(connector.force->at.front()), std::abs(connector.force->at.back()));
  constexpr double far = 1000;
  const auto fixed =
      made_node(run.draft, fmt::format("fixed end {}", i), {-far * std::max(reach, 1.0), 0, 0});
  springs.line("SPRINGA", "SPRING, NONLINEAR", fixed, at.node, table_law(*connector.force));
}

} // namespace

void write_springs(Run& run) {
  if (run.model.springs.empty() && run.model.connectors.empty())
    return;
  if (run.study().physics == study::Physics::axisymmetric)
    return run.refuse(
        run.model.springs.empty() ? "connectors" : "springs",
        "found springs of rings, which CalculiX cuts into a wedge without them; expected other physics");
  Discrete springs(run);
  for (const auto& spring : run.model.springs) {
    const constraint::Term own{spring.dof, 1};
    const auto at = run.is_plane() ? place_along(run, {&own, 1}, fmt::format("spring {}", spring.dof))
                                   : place_of(run, spring.dof);
    springs.spring(at, spring.stiffness);
  }
  for (std::size_t i = 0; i < run.model.connectors.size(); ++i)
    add_connector(run, springs, i);
  springs.finish("spring");
}

void write_masses(Run& run) {
  const bool of_references =
      std::ranges::any_of(run.model.connectors, [](const auto& connector) { return connector.mass > 0; });
  if (run.is_static() || (run.model.point_masses.empty() && !of_references))
    return;
  if (run.study().physics == study::Physics::axisymmetric)
    return run.refuse("masses",
                      "found masses of rings, which CalculiX cuts into a wedge without them; expected other "
                      "physics");
  Discrete masses(run);
  for (const auto& point : run.model.point_masses) {
    if (!run.is_plane()) {
      masses.mass(run.draft.node_numbers[static_cast<std::size_t>(point.node)], point.mass);
      continue;
    }
    for (int i = 0; i < run.model.dofs.components; ++i) {
      const constraint::Term own{run.model.dofs.dof(point.node, i), 1};
      masses.mass(place_along(run, {&own, 1}, fmt::format("mass {}", own.dof)).node, point.mass);
    }
  }
  for (std::size_t i = 0; i < run.model.connectors.size(); ++i)
    if (const auto& connector = run.model.connectors[i]; connector.mass > 0)
      masses.mass(place_along(run, connector.row, fmt::format("mass of reference {}", i)).node,
                  connector.mass);
  masses.finish("mass");
}

} // namespace rubato::ccx
