// SPDX-License-Identifier: LGPL-3.0-or-later
// Ties as relations.
#include "rubato/contact/tie.hpp"
#include "rubato/contact/zone.hpp"
#include "rubato/model/relations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rubato::model {
namespace {

/// Weights below this part of the largest are rounding of integrals: as terms they would couple far nodes.
constexpr double weight_rounding = 1e-13;

/// What a tied point says of one component. The slave's own node comes first: it is solved for.
std::vector<constraint::Term> terms_of_tie(const Parts& parts, const contact::Stencil& stencil,
                                           mesh::NodeIndex slave, int component) {
  std::vector<constraint::Term> terms;
  double largest = 0;
  for (std::size_t i = 0; i < stencil.nodes.size(); ++i) {
    const double weight = stencil.weight(static_cast<Eigen::Index>(i), component);
    terms.push_back({parts.dofs.dof(stencil.nodes[i], component), weight});
    largest = std::max(largest, std::abs(weight));
  }
  std::erase_if(terms,
                [&](const auto& term) { return std::abs(term.coefficient) <= weight_rounding * largest; });
  const auto own = std::ranges::find(terms, parts.dofs.dof(slave, component), &constraint::Term::dof);
  if (own != terms.end())
    std::iter_swap(terms.begin(), own);
  return terms;
}

} // namespace

void add_tie(const Parts& parts, const contact::Zone& zone, Equations& equations) {
  const auto source = static_cast<int>(equations.paths.size());
  equations.paths.push_back(fmt::format("contact.{}.tie", zone.settings.name));
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(parts.dofs.dof_count));
  const auto points =
      contact::tied_points(zone, {&parts.mesh, &parts.dofs, &rest, &rest, zone.begin, zone.begin});
  contact::for_each_relation(points, [&](std::size_t point, int component) {
    const auto slave = zone.slave.nodes[static_cast<std::size_t>(
        zone.mortar ? static_cast<int>(point) : zone.points[point].node_position)];
    equations.list.push_back(
        {terms_of_tie(parts, points[point].kinematics->stencil, slave, component), {}, source, true});
  });
}

} // namespace rubato::model
