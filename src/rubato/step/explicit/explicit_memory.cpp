// SPDX-License-Identifier: LGPL-3.0-or-later
// What explicit motion shows of itself, keeps and takes back: of one that is dealt out to ranks, what all of
// them know together.
#include "rubato/domain/followed_points.hpp"
#include "rubato/domain/heat.hpp"
#include "rubato/domain/point_numbers.hpp"
#include "rubato/domain/rank_states.hpp"
#include "rubato/model/model.hpp"
#include "rubato/model/own_cells.hpp"
#include "rubato/step/explicit/explicit_motion.hpp"

#include <array>
#include <bit>
#include <utility>
#include <vector>

namespace rubato::step {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

/// Of numbers alone, over all ranks.
template <class Numbers> Numbers sum_over_ranks(const model::Model& model, const Numbers& own) {
  if (!model.parts)
    return own;
  auto parts = std::bit_cast<std::array<double, sizeof(Numbers) / sizeof(double)>>(own);
  model.ranks.sum(parts);
  return std::bit_cast<Numbers>(parts);
}

} // namespace

EnergyLedger ExplicitMotion::summed(const EnergyLedger& own) const {
  return sum_over_ranks(*model_, own);
}

domain::Balance ExplicitMotion::summed(const domain::Balance& own) const {
  return sum_over_ranks(*model_, own);
}

ExplicitMotion::Memory ExplicitMotion::memory() const {
  Memory memory{t_, h_, steps_, u_, v_,      unbalance_,   contact_force_, damping_force_,
                {}, {}, {},     {}, energy_, bulk_points_, path_,          survey_};
  for (const auto& load : loads_) {
    memory.load_factors.push_back(load.factor);
    memory.load_displacements.push_back(load.displacement);
  }
  for (const auto& support : supports_)
    memory.reactions.push_back(support.reaction);
  for (const auto& relation : relations_)
    memory.reactions.push_back(relation.reaction);
  for (const auto& zone : contact_)
    memory.zones.push_back(zone.memory());
  return memory;
}

void ExplicitMotion::restore(const Memory& memory) {
  t_ = memory.t;
  h_ = memory.step;
  steps_ = memory.steps;
  u_ = memory.u;
  v_ = memory.v;
  unbalance_ = memory.residual_force;
  contact_force_ = memory.contact_force;
  damping_force_ = memory.damping_force;
  energy_ = memory.energy;
  if (const auto* heat = model_->domain.heat())
    heat_force_ = heat->force(t_);
  if (has_followers())
    find_followers();
  bulk_points_ = memory.bulk_points;
  path_ = memory.path;
  survey_ = memory.survey;
  for (std::size_t i = 0; i < loads_.size(); ++i) {
    loads_[i].factor = memory.load_factors.at(i);
    loads_[i].displacement = memory.load_displacements.at(i);
  }
  for (std::size_t i = 0; i < supports_.size(); ++i)
    supports_[i].reaction = memory.reactions.at(i);
  for (std::size_t i = 0; i < relations_.size(); ++i)
    relations_[i].reaction = memory.reactions.at(supports_.size() + i);
  find_given();
  for (std::size_t z = 0; z < contact_.size(); ++z)
    contact_[z].restore(memory.zones.at(z), {&model_->mesh, &model_->dofs, &u_, &u_, t_, t_});
}

namespace {

/// Numbers in the points of a path that a cell has, by its place.
auto size_in_path(const model::Model& model) {
  return [&model](std::size_t place) {
    return domain::numbers_of_a_point<domain::LawPoint>() *
           domain::followed_points(model.bulk, place, model.mesh.type_of(model.bulk.cells[place]));
  };
}

/// Sums over what a path has of all cells.
std::array<double*, 3> sums_of(domain::LawPath& path) {
  return {&path.stored, &path.elsewhere, &path.law_work};
}

} // namespace

/// Of what the cells of each rank have added.
VectorXd ExplicitMotion::whole_sum(VectorXd sum) const {
  if (model_->parts) {
    model_->parts->add_up(sum);
    model_->parts->make_whole(sum);
  }
  return sum;
}

domain::QuadratureStates ExplicitMotion::whole(domain::QuadratureStates states) const {
  return domain::whole_states(std::move(states), model_->mesh, model_->bulk, *model_->parts);
}

ExplicitMotion::Memory ExplicitMotion::whole(Memory memory) const {
  if (!model_->parts)
    return memory;
  const auto& parts = *model_->parts;
  for (auto* values : {&memory.u, &memory.v, &memory.residual_force})
    parts.make_whole(*values);
  if (is_damped())
    memory.damping_force = whole_sum(std::move(memory.damping_force));
  for (std::size_t i = 0; i < memory.reactions.size(); ++i)
    if (!owns(supports_[i].prescribed->dof))
      memory.reactions[i] = 0;
  parts.ranks().sum(memory.reactions);
  parts.ranks().sum(memory.load_displacements);
  memory.energy = summed(memory.energy);
  memory.bulk_points = whole(std::move(memory.bulk_points));
  auto& path = memory.path;
  auto points = domain::numbers_of(path.points);
  parts.make_whole(std::span(points), size_in_path(*model_));
  domain::put(points, path.points);
  if (path.forces.size() > 0)
    path.forces = whole_sum(std::move(path.forces));
  for (auto* sum : sums_of(path))
    *sum = parts.ranks().sum(*sum);
  path.taken = summed(path.taken);
  return memory;
}

void ExplicitMotion::restore_whole(const Memory& memory) {
  restore(memory);
  if (!model_->parts)
    return;
  const auto& parts = *model_->parts;
  for (Index dof = 0; dof < v_.size(); ++dof)
    if (!parts.knows(static_cast<int>(dof)))
      v_[dof] = 0;
  auto points = domain::numbers_of(path_.points);
  parts.clear_others(std::span(points), size_in_path(*model_));
  domain::put(points, path_.points);
  if (path_.forces.size() > 0)
    path_.forces = counted_once(std::move(path_.forces));
  if (!counts()) {
    for (auto* sum : sums_of(path_))
      *sum = 0;
    path_.taken = {};
    energy_ = {};
  }
  for (auto& load : loads_)
    load.displacement = held_by(load);
  if (is_damped())
    find_damping();
}

State ExplicitMotion::state() const {
  State state;
  state.t = t_;
  VectorXd a = acceleration(), u = u_, v = v_ + h_ / 2 * a, unbalance = unbalance_;
  auto bulk_points = bulk_points_;
  if (const auto& parts = model_->parts) {
    for (auto* values : {&a, &u, &v, &unbalance})
      parts->make_whole(*values);
    bulk_points = whole(std::move(bulk_points));
  }
  state.residual_force = unbalance;
  if (is_damped())
    state.residual_force -= whole_sum(damping_force_);
  state.contact_force = contact_force_;
  state.reaction = reduction_->reaction(unbalance + mass_.times(a));
  add_contact(state.reaction, state);
  state.motion = {std::move(u), std::move(v), std::move(a)};
  state.bulk_points = std::move(bulk_points);
  return state;
}

/// Zones in the order of the model; forces of ties are contact forces, not reactions.
void ExplicitMotion::add_contact(const VectorXd& constraint_forces, State& state) const {
  const VectorXd multipliers = reduction_->multipliers(constraint_forces);
  auto tied = states_of_ties(*model_, ties_, multipliers);
  state.zones.resize(model_->zones.size());
  for (std::size_t i = 0; i < contact_.size(); ++i)
    state.zones[touching_[i]] = contact_[i].state();
  for (std::size_t i = 0; i < ties_.size(); ++i)
    state.zones[ties_[i].zone] = std::move(tied[i]);
  if (ties_.empty())
    return;
  const VectorXd forces = forces_of_ties(*model_, ties_, multipliers);
  state.contact_force += forces;
  state.residual_force += forces;
  state.reaction += forces;
}

int ExplicitMotion::points_in_contact() const {
  State state;
  state.contact_force = state.residual_force = state.reaction = VectorXd::Zero(u_.size());
  add_contact(state.reaction, state);
  return step::points_in_contact(state);
}

} // namespace rubato::step
