// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/run/wave_watch.hpp"

#include "rubato/cell/topology.hpp"
#include "rubato/contact/small_vectors.hpp"
#include "rubato/material/make_point_law.hpp"
#include "rubato/model/model.hpp"
#include "rubato/study/study.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rubato::run {
namespace {

/// The least mean kinetic energy, in parts of the largest energy: bodies with less move as in statics.
constexpr double least_kinetic = 1e-2;
/// The largest step in parts of a period, and the largest cell in parts of a wavelength.
constexpr double longest_part_of_period = 0.25;
constexpr double longest_part_of_wave = 1. / 6;

/// The geometric mean of the edges of a cell over its order [length].
double spacing_in(const mesh::Mesh& mesh, mesh::CellIndex cell) {
  const auto& topology = cell::topology(mesh.type_of(cell));
  const auto nodes = mesh.nodes_of(cell);
  double sum = 0;
  for (const auto& edge : topology.edges) {
    const auto& a = mesh.points[static_cast<std::size_t>(nodes[static_cast<std::size_t>(edge[0])])];
    const auto& b = mesh.points[static_cast<std::size_t>(nodes[static_cast<std::size_t>(edge[1])])];
    sum += std::log(contact::length_of(contact::difference_of(a, b)));
  }
  return std::exp(sum / static_cast<double>(topology.edges.size())) / topology.order;
}

/// The speed of shear waves at small strain; 0 of orthotropic laws, of values by place and without density.
double shear_speed(const study::Material& material) {
  if (material.law == study::LawKind::orthotropic || !material.in_place.empty() ||
      !(material.density.value_or(0) > 0))
    return 0;
  const auto [young, poisson] = material::small_strain_moduli(material);
  return std::sqrt(young / (2 * (1 + poisson)) / *material.density);
}

} // namespace

WaveWatch::WaveWatch(const model::Model& model) : model_(model) {
  for (std::size_t i = 0; i < model.bulk.cells.size(); ++i) {
    const auto& material = model.study.materials[static_cast<std::size_t>(model.bulk.law_of_cell[i])];
    if (const double speed = shear_speed(material); speed > 0)
      passage_ = std::max(passage_, spacing_in(model.mesh, model.bulk.cells[i]) / speed);
  }
}

void WaveWatch::note(const step::State& before, const step::State& now) {
  const auto& v = now.motion.v;
  const auto& momentum = now.bulk.momentum;
  if (momentum.size() != v.size() || before.bulk.momentum.size() != v.size() || v.size() == 0)
    return;
  if (velocities_ == 0)
    begin_ = before.t;
  const double h = now.t - before.t;
  longest_step_ = std::max(longest_step_, h);
  accelerations_ += (v - before.motion.v).dot(momentum - before.bulk.momentum) / h;
  velocities_ += h * v.dot(momentum);
  t_ = now.t;
}

std::vector<results::Plausibility> WaveWatch::checks(double largest_energy) const {
  if (!(velocities_ > 0))
    return {};
  const bool moves = 0.5 * velocities_ > least_kinetic * largest_energy * (t_ - begin_);
  const double frequency = moves ? std::sqrt(accelerations_ / velocities_) / (2 * std::numbers::pi) : 0;
  std::vector<results::Plausibility> checks{
      {"step_in_period", frequency * longest_step_, longest_part_of_period, t_, "",
       "steps are this part of the period of the motion, which they do not resolve; expected a shorter "
       "'time.step'"}};
  if (passage_ > 0)
    checks.push_back({"cell_in_wave", frequency * passage_, longest_part_of_wave, t_, "",
                      "cells are this part of the length of shear waves of the motion, which they do not "
                      "resolve; expected a finer mesh"});
  return checks;
}

} // namespace rubato::run
