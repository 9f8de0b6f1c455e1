// SPDX-License-Identifier: LGPL-3.0-or-later
// Ties as relations.
#include "rubato/contact/tie.hpp"
#include "rubato/contact/zone.hpp"
#include "rubato/model/model.hpp"
#include "rubato/model/relations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rubato::model {
namespace {

/// Weights below this part of the largest are rounding of integrals: as terms they would couple far nodes.
constexpr double weight_rounding = 1e-13;
/// Narrower gaps, in edges of the zone, are those of facets and of coordinates in files.
constexpr double noted_gap = 1e-3;

/// What a tied point says of one component. The slave's own node comes first: it is solved for.
std::vector<constraint::Term> terms_of_tie(const Parts& parts, const contact::Stencil& stencil,
                                           mesh::NodeIndex slave, int component) {
  std::vector<constraint::Term> terms;
  double largest = 0;
  for (std::size_t i = 0; i < stencil.nodes.size(); ++i) {
    for (int of = 0; of < stencil.components; ++of) {
      const double weight = stencil.weight(static_cast<Eigen::Index>(i), component, of);
      if (of != component && weight == 0)
        continue;
      terms.push_back({parts.dofs.dof(stencil.nodes[i], of), weight});
      largest = std::max(largest, std::abs(weight));
    }
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

std::vector<std::string> notes_on_tied_gaps(const Model& model) {
  std::vector<std::string> notes;
  if (!study::is_explicit(model.study.time.scheme))
    return notes;
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(model.dofs.dof_count));
  for (const auto& zone : model.zones) {
    if (!zone.finite_rotations)
      continue;
    const auto ties =
        contact::make_ties(zone, {&model.mesh, &model.dofs, &rest, &rest, zone.begin, zone.begin});
    double widest = 0;
    for (const auto& gaps : ties.gaps)
      for (const auto& gap : gaps)
        widest = std::max(widest, gap.parts.norm());
    if (widest > noted_gap * zone.edge())
      notes.push_back(fmt::format(
          "contact.{}.tie: surfaces are tied over a gap of up to {:.3g}, which turns by linearised "
          "rotations in central_difference: a turn of the joint by φ leaves an error of φ²/2 of the gap. "
          "Surfaces that touch, or an implicit scheme, have none",
          zone.settings.name, widest));
  }
  return notes;
}

} // namespace rubato::model
