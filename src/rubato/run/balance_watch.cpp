// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/run/balance_watch.hpp"

#include "rubato/contact/small_vectors.hpp"
#include "rubato/contact/zone.hpp"
#include "rubato/model/model.hpp"
#include "rubato/model/rigid_motions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace rubato::run {
namespace {

using contact::add_scaled;
using contact::cross;
using contact::length_of;
using Eigen::Vector3d;
using Eigen::VectorXd;
using results::Plausibility;

/// Sums of forces leave so much by rounding and by what a step leaves unbalanced.
constexpr double unbalanced_force_limit = 1e-4;
/// The moment of a body that turns by 0.05 under small strain.
constexpr double unbalanced_moment_limit = 0.05;
/// The largest distance between the lines of action on both sides of a zone, in longest edges of the slave.
constexpr double offset_limit = 0.1;
/// The least scale, in parts of Σ|f_int|: the rounding of bodies that only stress themselves stays below the
/// limits.
constexpr double least_of_internal = 1e-3;

void keep(Resultant& kept, double sum, double scale, double t) {
  kept.scale = std::max(kept.scale, scale);
  if (sum > kept.sum)
    kept = {sum, kept.scale, t};
}

/// The nodes on which springs and connectors act.
std::vector<mesh::NodeIndex> sprung_nodes(const model::Model& model) {
  std::vector<mesh::NodeIndex> nodes;
  for (const auto& spring : model.springs)
    nodes.push_back(model.node_of(spring.dof));
  for (const auto& connector : model.connectors)
    for (const auto& term : connector.row)
      nodes.push_back(model.node_of(term.dof));
  return nodes;
}

std::string zones_text(const model::Model& model) {
  return model.zones.size() == 1 ? fmt::format("contact.{}", model.zones.front().settings.name)
                                 : "all contact zones together";
}

} // namespace

BalanceWatch::BalanceWatch(const model::Model& model)
    : model_(model), bodies_(model.mesh, model.bulk), of_body_(static_cast<std::size_t>(bodies_.count())),
      watched_(of_body_.size(), model.gauges.empty() ? 1 : 0) {
  for (const auto node : sprung_nodes(model))
    if (const int body = bodies_.of(node); body >= 0)
      watched_[static_cast<std::size_t>(body)] = 0;
  balances_contact_ = !model.zones.empty() && std::ranges::none_of(model.zones, [](const auto& zone) {
    return zone.obstacle.has_value();
  });
  of_before_ = model.study.time.scheme == study::SchemeKind::energy_momentum ? 0.5 : 0;
  for (const auto& zone : model.zones)
    longest_face_ = std::max(longest_face_, zone.slave.longest_edge);
  takes_moments_ = model.study.physics != study::Physics::axisymmetric;
}

Vector3d BalanceWatch::value_at(const VectorXd& values, std::size_t node) const {
  const int first = model_.dofs.dof(static_cast<mesh::NodeIndex>(node), 0);
  Vector3d value(0, 0, 0);
  const bool rings = !takes_moments_; // radial forces of a ring have no resultant
  for (int c = rings ? 1 : 0; c < model_.dofs.components; ++c)
    value[c] = values[first + c];
  return value;
}

/// Forces of conserving schemes belong to the middle of the step.
std::vector<Vector3d> BalanceWatch::places_at(const step::State& before, const step::State& now) const {
  std::vector<Vector3d> places = model_.mesh.points;
  for (const auto node : model_.dofs.nodes)
    for (int c = 0; c < model_.dofs.components; ++c) {
      const int dof = model_.dofs.dof(node, c);
      places[static_cast<std::size_t>(node)][c] +=
          of_before_ * before.motion.u[dof] + (1 - of_before_) * now.motion.u[dof];
    }
  return places;
}

void BalanceWatch::note(const step::State& before, const step::State& now) {
  const auto places = places_at(before, now);
  if (now.bulk.internal.size() == now.motion.u.size())
    note_bodies(places, now);
  if (balances_contact_)
    note_contact(places, now);
}

void BalanceWatch::note_bodies(const std::vector<Vector3d>& places, const step::State& now) {
  struct Sums {
    Vector3d centre{0, 0, 0}, force{0, 0, 0}, moment{0, 0, 0};
    double nodes = 0, internal = 0, acting = 0, arm = 0, internal_arm = 0;
  };
  std::vector<Sums> sums(of_body_.size());
  const auto of_node = [&](mesh::NodeIndex node) -> Sums* {
    const int body = bodies_.of(node);
    return body >= 0 && watched_[static_cast<std::size_t>(body)] != 0 ? &sums[static_cast<std::size_t>(body)]
                                                                      : nullptr;
  };
  for (const auto node : model_.dofs.nodes)
    if (auto* const sum = of_node(node)) {
      add_scaled(1, places[static_cast<std::size_t>(node)], sum->centre);
      sum->nodes += 1;
    }
  for (auto& sum : sums)
    if (sum.nodes > 0)
      sum.centre /= sum.nodes;
  const std::array<const VectorXd*, 4> acting{&now.contact_force, &now.external_force, &now.reaction,
                                              &now.bulk.inertia};
  for (const auto node : model_.dofs.nodes) {
    auto* const sum = of_node(node);
    if (sum == nullptr)
      continue;
    const auto at = static_cast<std::size_t>(node);
    const Vector3d arm = places[at] - sum->centre;
    const auto force = value_at(now.bulk.internal, at);
    add_scaled(1, force, sum->force);
    add_scaled(1, cross(arm, force), sum->moment);
    sum->internal += length_of(force);
    sum->internal_arm += length_of(force) * length_of(arm);
    for (const auto* const values : acting)
      if (values->size() == now.motion.u.size()) {
        const double size = length_of(value_at(*values, at));
        sum->acting += size;
        sum->arm += size * length_of(arm);
      }
  }
  for (std::size_t body = 0; body < sums.size(); ++body) {
    const auto& sum = sums[body];
    keep(of_body_[body].force, length_of(sum.force), std::max(sum.acting, least_of_internal * sum.internal),
         now.t);
    keep(of_body_[body].moment, length_of(sum.moment),
         std::max(sum.arm, least_of_internal * sum.internal_arm), now.t);
  }
}

void BalanceWatch::note_contact(const std::vector<Vector3d>& places, const step::State& now) {
  Vector3d force(0, 0, 0), moment(0, 0, 0), centre(0, 0, 0);
  double size = 0;
  for (const bool about_centre : {false, true}) {
    for (const auto node : model_.dofs.nodes) {
      const auto at = static_cast<std::size_t>(node);
      const auto of_node = value_at(now.contact_force, at);
      if (about_centre) {
        add_scaled(1, of_node, force);
        add_scaled(1, cross(places[at] - centre, of_node), moment);
      } else {
        add_scaled(length_of(of_node), places[at], centre);
        size += length_of(of_node);
      }
    }
    if (!(size > 0))
      return;
    if (!about_centre)
      centre /= size;
  }
  keep(contact_force_, length_of(force), size, now.t);
  keep(contact_moment_, length_of(moment), 0.5 * size * longest_face_, now.t);
}

std::vector<Plausibility> BalanceWatch::checks() const {
  Plausibility force{"body_forces",
                     0,
                     unbalanced_force_limit,
                     0,
                     "",
                     "internal forces of a body do not sum to zero; expected a smaller 'newton.residual'"};
  Plausibility moment{"body_moments",
                      0,
                      unbalanced_moment_limit,
                      0,
                      "",
                      "internal forces of the body have a moment, as small strain does not follow its turn; "
                      "expected 'strain: green_lagrange' or 'logarithmic'"};
  bool any = false;
  for (std::size_t body = 0; body < of_body_.size(); ++body) {
    if (watched_[body] == 0)
      continue;
    any = true;
    const auto name = model::body_text(model_, bodies_, static_cast<int>(body));
    const auto take = [&](Plausibility& check, const Resultant& found) {
      if (found.ratio() > check.value)
        check = {check.name, found.ratio(), check.limit, found.t, name, check.advice};
    };
    take(force, of_body_[body].force);
    take(moment, of_body_[body].moment);
  }
  std::vector<Plausibility> checks;
  if (any)
    checks.push_back(force);
  if (any && takes_moments_)
    checks.push_back(moment);
  if (balances_contact_) {
    checks.push_back({"contact_forces", contact_force_.ratio(), unbalanced_force_limit, contact_force_.t,
                      zones_text(model_), "forces on slave and master differ; expected finer faces"});
    if (takes_moments_)
      checks.push_back({"contact_moment", contact_moment_.ratio(), offset_limit, contact_moment_.t,
                        zones_text(model_),
                        "the lines of action on slave and master are this part of a face apart; expected "
                        "finer faces, the other side as slave, or a shorter step"});
  }
  return checks;
}

} // namespace rubato::run
