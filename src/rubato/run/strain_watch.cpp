// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/run/strain_watch.hpp"

#include "rubato/cell/parts.hpp"
#include "rubato/cell/reference_cell.hpp"
#include "rubato/contact/small_vectors.hpp"
#include "rubato/domain/behaviour.hpp"
#include "rubato/material/voigt.hpp"
#include "rubato/model/model.hpp"
#include "rubato/model/rotations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string_view>

namespace rubato::run {
namespace {

using contact::add_scaled;
using contact::cross;
using contact::dot;
using contact::length_of;
using contact::scaled;
using Eigen::Vector3d;
using Eigen::VectorXd;
using model::Model;

bool has_small_strain(const domain::Bulk& bulk, std::size_t cell) {
  const auto* const behaviour = bulk.behaviour(cell);
  return behaviour == nullptr || behaviour->strain == element::StrainKind::small;
}

Vector3d middle_of(const cell::ReferenceCell& reference) {
  Vector3d middle(0, 0, 0);
  for (const auto& node : reference.nodes)
    add_scaled(1. / reference.node_count, node, middle);
  return middle;
}

using Slopes = std::array<Vector3d, 8>;

/// ∂N_i/∂X of the corners of a cell, in the middle of them.
Slopes slopes_in(const mesh::Mesh& mesh, const cell::ReferenceCell& reference,
                 std::span<const mesh::NodeIndex> corners) {
  const auto dimension = static_cast<std::size_t>(reference.dimension);
  std::array<double, 24> by_reference{};
  reference.gradients(middle_of(reference), by_reference);
  std::array<Vector3d, 3> tangents{Vector3d(0, 0, 0), Vector3d(0, 0, 0), Vector3d(0, 0, 0)};
  if (dimension == 2)
    tangents[2] = Vector3d(0, 0, 1);
  for (std::size_t i = 0; i < corners.size(); ++i)
    for (std::size_t a = 0; a < dimension; ++a)
      add_scaled(by_reference[i * dimension + a], mesh.points[static_cast<std::size_t>(corners[i])],
                 tangents[a]);
  const double volume = dot(tangents[0], cross(tangents[1], tangents[2]));
  Slopes slopes;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    slopes[i] = Vector3d(0, 0, 0);
    for (std::size_t a = 0; a < dimension; ++a)
      add_scaled(by_reference[i * dimension + a] / volume,
                 cross(tangents[(a + 1) % 3], tangents[(a + 2) % 3]), slopes[i]);
  }
  return slopes;
}

double radius_of(const mesh::Mesh& mesh, std::span<const mesh::NodeIndex> corners) {
  double sum = 0;
  for (const auto node : corners)
    sum += mesh.points[static_cast<std::size_t>(node)][0];
  return sum / static_cast<double>(corners.size());
}

template <int D> double square_of_turn(const std::array<double, D * D>& h) {
  if constexpr (D == 2)
    return 0.25 * (h[2] - h[1]) * (h[2] - h[1]);
  else
    return 0.25 *
           ((h[7] - h[5]) * (h[7] - h[5]) + (h[2] - h[6]) * (h[2] - h[6]) + (h[3] - h[1]) * (h[3] - h[1]));
}

/// Of the length of the symmetric part, to which `hoop` belongs.
template <int D> double square_of_strain(const std::array<double, D * D>& h, double hoop) {
  double sum = hoop * hoop;
  for (std::size_t a = 0; a < D; ++a) {
    sum += h[a * D + a] * h[a * D + a];
    for (std::size_t b = 0; b < a; ++b)
      sum += 0.5 * (h[a * D + b] + h[b * D + a]) * (h[a * D + b] + h[b * D + a]);
  }
  return sum;
}

/// Of the largest magnitude.
template <int D> double principal_strain(const std::array<double, D * D>& h, double hoop) {
  material::FullStrain strain = material::FullStrain::Zero();
  strain[2] = hoop;
  for (std::size_t a = 0; a < D; ++a)
    strain[static_cast<Eigen::Index>(a)] += h[a * D + a];
  constexpr std::array<std::array<std::size_t, 2>, 3> shears{{{0, 1}, {1, 2}, {0, 2}}};
  for (std::size_t k = 0; k < (D == 3 ? 3U : 1U); ++k) {
    const auto [a, b] = shears[k];
    strain[static_cast<Eigen::Index>(3 + k)] = 0.5 * (h[a * D + b] + h[b * D + a]);
  }
  const auto principal = material::principal_values(strain);
  return std::max(std::abs(principal[0]), std::abs(principal[2]));
}

double largest_move(const VectorXd& from, const VectorXd& to) {
  double largest = 0;
  for (Eigen::Index i = 0; i < to.size(); ++i)
    largest = std::max(largest, std::abs(to[i] - from[i]));
  return largest;
}

bool is_elastic(const study::Material& material) {
  return material.law == study::LawKind::elastic || material.law == study::LawKind::orthotropic;
}

std::string_view remedy_of_turn(const study::Material& material) {
  return is_elastic(material) ? "expected 'strain: green_lagrange'" : "expected 'strain: logarithmic'";
}

std::string_view remedy_of_stretch(const study::Material& material) {
  return material.law == study::LawKind::orthotropic ? "expected a law of large strains"
                                                     : "expected 'strain: logarithmic'";
}

} // namespace

StrainWatch::StrainWatch(const Model& model, const Watch& watch) : model_(model), watch_(watch) {
  for (std::size_t cell = 0; cell < model.bulk.cells.size(); ++cell)
    if (has_small_strain(model.bulk, cell))
      add(cell);
}

void StrainWatch::add(std::size_t cell) {
  const auto [block, index] = model_.mesh.place_of(model_.bulk.cells[cell]);
  const auto& reference = cell::reference_cell(cell::linear_type(block->type));
  const auto corners = block->cell(index).first(static_cast<std::size_t>(reference.node_count));
  const auto slopes = slopes_in(model_.mesh, reference, corners);
  const bool has_hoop = model_.bulk.section.physics == study::Physics::axisymmetric;
  double steepness = 0; // Σ|∂N_i/∂X|, and 1/r: nothing grows faster with what the dofs move
  for (std::size_t i = 0; i < corners.size(); ++i) {
    steepness += length_of(slopes[i]);
    dofs_.push_back(model_.dofs.dof(corners[i], 0));
    for (int c = 0; c < reference.dimension; ++c)
      slopes_.push_back(static_cast<float>(slopes[i][c]));
  }
  const double hoop = has_hoop ? 1 / radius_of(model_.mesh, corners) : 0;
  steepest_ = std::max(steepest_, steepness + hoop);
  cells_.push_back({cell, reference.node_count, hoop});
}

void StrainWatch::note(double t, const VectorXd& u) {
  if (cells_.empty() || (told_turn() && told_stretch()))
    return;
  if (looked_at_.size() > 0 && largest_move(looked_at_, u) < margin_)
    return;
  auto [turn, stretch] = model_.dofs.components == 2 ? worst_at<2>(u) : worst_at<3>(u);
  turn.t = stretch.t = t;
  if (!told_turn() && turn.size > model::largest_small_angle)
    tell_turn(t, turn);
  if (!told_stretch() && stretch.size > largest_small_strain)
    tell_stretch(t, stretch);
  if (turn.size > largest_.turn.size)
    largest_.turn = turn;
  if (stretch.size > largest_.stretch.size)
    largest_.stretch = stretch;
  looked_at_ = u;
  const double to_turn = told_turn() ? INFINITY : model::largest_small_angle - turn.size;
  const double to_stretch = told_stretch() ? INFINITY : largest_small_strain - stretch.size;
  margin_ = std::min(to_turn, to_stretch) / (std::sqrt(model_.dofs.components) * steepest_);
}

bool StrainWatch::told_turn() const {
  return largest_.turn.size > model::largest_small_angle;
}

bool StrainWatch::told_stretch() const {
  return largest_.stretch.size > largest_small_strain;
}

template <int D> StrainWatch::Found StrainWatch::worst_at(const VectorXd& u) const {
  constexpr double limit = largest_small_strain * largest_small_strain;
  Worst turn, stretch; // sizes squared
  std::size_t corner = 0;
  for (const auto& [cell, corners, by_radius] : cells_) {
    std::array<double, D * D> h{}; // ∂u/∂X
    double outward = 0;
    for (int i = 0; i < corners; ++i, ++corner)
      for (std::size_t c = 0; c < D; ++c) {
        const double moved = u[dofs_[corner] + static_cast<int>(c)];
        outward += c == 0 ? moved : 0;
        for (std::size_t b = 0; b < D; ++b)
          h[c * D + b] += moved * slopes_[corner * D + b];
      }
    const double hoop = by_radius * outward / corners;
    if (const double square = square_of_turn<D>(h); square > turn.size)
      turn = {.size = square, .cell = cell};
    double square = square_of_strain<D>(h, hoop);
    if (square > limit) // of what is less the length will do
      square = std::pow(principal_strain<D>(h, hoop), 2);
    if (square > stretch.size)
      stretch = {.size = square, .cell = cell};
  }
  turn.size = std::sqrt(turn.size);
  stretch.size = std::sqrt(stretch.size);
  return {turn, stretch};
}

void StrainWatch::tell_turn(double t, const Worst& turn) {
  watch_.warn(fmt::format("{}: at t = {:g} {} of material '{}' has turned by {:.3g} radians, more than {}: "
                          "small strain stretches what turns, here by {:.2g}; {}",
                          model_.study.name, t, domain::cell_label(model_.mesh, model_.bulk.cells[turn.cell]),
                          material_of(turn.cell).name, turn.size, model::largest_small_angle,
                          1 - std::cos(turn.size), remedy_of_turn(material_of(turn.cell))));
}

void StrainWatch::tell_stretch(double t, const Worst& stretch) {
  watch_.warn(
      fmt::format("{}: at t = {:g} {} of material '{}' has a strain of {:.3g}, more than {}: small strain "
                  "leaves out its square, here {:.2g}; {}",
                  model_.study.name, t, domain::cell_label(model_.mesh, model_.bulk.cells[stretch.cell]),
                  material_of(stretch.cell).name, stretch.size, largest_small_strain,
                  stretch.size * stretch.size / 2, remedy_of_stretch(material_of(stretch.cell))));
}

const study::Material& StrainWatch::material_of(std::size_t cell) const {
  return model_.study.materials[static_cast<std::size_t>(model_.bulk.law_of_cell[cell])];
}

std::vector<results::Plausibility> StrainWatch::checks() const {
  if (cells_.empty())
    return {};
  const auto place = [&](const Worst& worst) {
    return domain::cell_label(model_.mesh, model_.bulk.cells[worst.cell]);
  };
  return {{"rotation", largest_.turn.size, model::largest_small_angle, largest_.turn.t, place(largest_.turn),
           "", told_turn()},
          {"strain", largest_.stretch.size, largest_small_strain, largest_.stretch.t, place(largest_.stretch),
           "", told_stretch()}};
}

} // namespace rubato::run
