// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/modes/closed_contact.hpp"

#include "rubato/contact/discretisation.hpp"
#include "rubato/model/model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace rubato::modes {
namespace {

using contact::Kinematics;
using contact::PointEvaluation;
using Eigen::Index;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// Gap up to which a point touches, in edges of its zone: mesh files round coordinates to seven digits.
constexpr double touching = 1e-6;

std::vector<PointEvaluation> undeformed_points(const model::Model& model, const contact::Zone& zone) {
  const VectorXd rest = VectorXd::Zero(model.dofs.dof_count);
  const double t = model.study.time.begin;
  return contact::evaluate(zone, contact::initial_state(zone).multipliers,
                           {&model.mesh, &model.dofs, &rest, &rest, t, t});
}

bool is_held(const contact::Zone& zone, const PointEvaluation& point) {
  return point.kinematics && (zone.settings.tie || point.kinematics->gap <= touching * zone.edge());
}

class RelationMaker {
public:
  RelationMaker(const model::Model& model, Contact contact) : model_(model), contact_(contact) {}

  void add(const contact::Zone& zone) {
    const auto points = undeformed_points(model_, zone);
    std::size_t held = 0;
    for (std::size_t p = 0; p < points.size(); ++p) {
      const auto& at = zone.points[p];
      if (at.excluded || !is_held(zone, points[p]))
        continue;
      ++held;
      if (zone.points_own_multipliers || zone.settings.tie)
        add_point(zone, *points[p].kinematics, columns_, 1);
      else
        for (std::size_t k = 0; k < at.multipliers.size(); ++k)
          add_point(zone, *points[p].kinematics, first_ + at.multipliers[k] * directions(zone),
                    contact::weight_of(at, points[p]) * at.multiplier_shape[k]);
    }
    if (!zone.points_own_multipliers && !zone.settings.tie)
      columns_ = first_ + static_cast<int>(zone.slave.nodes.size()) * directions(zone);
    first_ = columns_;
    notes_.push_back(fmt::format("contact.{}: {} of {} points {}", zone.settings.name, held, points.size(),
                                 zone.settings.tie ? "are tied" : "touch and are held together"));
    if (held > 0 && zone.settings.friction > 0 && !holds_all(zone))
      warnings_.push_back(fmt::format(
          "contact.{}: points slide without friction; with the friction of the study motions may grow by "
          "themselves (squeal), which these modes do not show, expected 'friction: 0', '--contact stuck' or "
          "a run in time",
          zone.settings.name));
  }

  ClosedContact take() {
    ClosedContact closed;
    closed.relations.resize(model_.dofs.dof_count, columns_);
    closed.relations.setFromTriplets(entries_.begin(), entries_.end());
    closed.notes = std::move(notes_);
    closed.warnings = std::move(warnings_);
    return closed;
  }

private:
  bool holds_all(const contact::Zone& zone) const { return zone.settings.tie || contact_ == Contact::stuck; }
  int directions(const contact::Zone& zone) const { return holds_all(zone) ? model_.dofs.components : 1; }

  void add_point(const contact::Zone& zone, const Kinematics& kinematics, int column, double factor) {
    const auto& stencil = kinematics.stencil;
    for (std::size_t i = 0; i < stencil.nodes.size(); ++i)
      for (int c = 0; c < stencil.components; ++c) {
        const int dof = model_.dofs.dof(stencil.nodes[i], c);
        const auto node = static_cast<Index>(i);
        if (!holds_all(zone))
          entries_.emplace_back(dof, column, factor * kinematics.gap_weight(node, c) * kinematics.normal[c]);
        for (int row = 0; row < stencil.components && holds_all(zone); ++row)
          if (const double weight = stencil.weight(node, row, c); row == c || weight != 0)
            entries_.emplace_back(dof, column + row, factor * weight);
      }
    columns_ = std::max(columns_, column + directions(zone));
  }

  const model::Model& model_;
  Contact contact_;
  int first_ = 0;   ///< column of the zone's first relation
  int columns_ = 0; ///< so far
  std::vector<Eigen::Triplet<double>> entries_;
  std::vector<std::string> notes_, warnings_;
};

} // namespace

ClosedContact closed_contact(const model::Model& model, Contact contact) {
  RelationMaker maker(model, contact);
  for (const auto& zone : model.zones)
    if (zone.settings.tie || contact != Contact::open)
      maker.add(zone);
  return maker.take();
}

} // namespace rubato::modes
