// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/touched_surface.hpp"

#include <algorithm>
#include <iterator>
#include <stdexcept>

namespace rubato::step {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// What one point's unit forces move, row after row of them: one column a place.
template <int Rows>
void answer_to(const TouchedSurface& surface, const PointRows& point, MatrixXd& by_place,
               Eigen::Matrix<double, Rows, Eigen::Dynamic>& by_row) {
  by_place.setZero(surface.size(), Rows);
  for (std::size_t q = 0; q < point.places.size(); ++q)
    for (int row = 0; row < Rows; ++row)
      if (const double part = point.right(row, static_cast<Index>(q)); part != 0)
        surface.add_column(point.places[q], part, by_place.col(row));
  by_row = by_place.transpose();
}

template <int Rows>
void fill(const TouchedSurface& surface, std::span<const PointRows* const> points, double factor,
          bool symmetric, MatrixXd& matrix) {
  using Block = Eigen::Matrix<double, Rows, Rows>;
  MatrixXd by_place;
  Eigen::Matrix<double, Rows, Eigen::Dynamic> moved;
  for (std::size_t j = 0; j < points.size(); ++j) {
    answer_to<Rows>(surface, *points[j], by_place, moved);
    for (std::size_t i = 0; i < (symmetric ? j + 1 : points.size()); ++i) {
      const auto& point = *points[i];
      Block block = Block::Zero();
      for (std::size_t q = 0; q < point.places.size(); ++q)
        block += point.left.template block<Rows, 1>(0, static_cast<Index>(q)) *
                 moved.col(point.places[q]).transpose();
      block *= factor;
      matrix.template block<Rows, Rows>(point.first, points[j]->first) = block;
      if (symmetric)
        matrix.template block<Rows, Rows>(points[j]->first, point.first) = block.transpose();
    }
  }
}

} // namespace

void TouchedSurface::forget() {
  positions_.clear();
  body_of_.clear();
  bodies_.clear();
}

void TouchedSurface::touch(std::span<const int> positions) {
  std::vector<int> wanted(positions.begin(), positions.end());
  std::ranges::sort(wanted);
  wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
  if (std::ranges::includes(positions_, wanted))
    return;
  std::vector<int> all;
  std::ranges::set_union(positions_, wanted, std::back_inserter(all));
  positions_ = std::move(all);
  places_.resize(compliance_->surface().size(), -1);
  body_of_.clear();
  bodies_.clear();
  const auto& starts = compliance_->factor().body_starts();
  for (std::size_t b = 0; b + 1 < starts.size(); ++b) {
    const auto begin = std::ranges::lower_bound(positions_, starts[b]);
    const auto end = std::ranges::lower_bound(positions_, starts[b + 1]);
    if (begin == end)
      continue;
    body_of_.insert(body_of_.end(), static_cast<std::size_t>(end - begin), static_cast<int>(bodies_.size()));
    bodies_.push_back({begin - positions_.begin(), compliance_->between({begin, end})});
  }
  for (std::size_t place = 0; place < positions_.size(); ++place)
    places_[static_cast<std::size_t>(positions_[place])] = static_cast<int>(place);
}

void TouchedSurface::multiply(const VectorXd& force, VectorXd& moved) const {
  moved.resize(size());
  for (const auto& body : bodies_)
    moved.segment(body.first, body.s.rows()).noalias() = body.s * force.segment(body.first, body.s.rows());
}

void TouchedSurface::add_column(int place, double factor, Eigen::Ref<VectorXd> moved) const {
  const auto& body = bodies_[static_cast<std::size_t>(body_of_[static_cast<std::size_t>(place)])];
  moved.segment(body.first, body.s.rows()) += factor * body.s.col(place - body.first);
}

MatrixXd between_points(const TouchedSurface& surface, std::span<const PointRows* const> points,
                        double factor, bool symmetric) {
  if (points.empty())
    return {};
  const Index rows = points.front()->rows();
  MatrixXd matrix(points.back()->first + rows, points.back()->first + rows);
  if (rows == 1)
    fill<1>(surface, points, factor, symmetric, matrix);
  else if (rows == 2)
    fill<2>(surface, points, factor, symmetric, matrix);
  else if (rows == 3)
    fill<3>(surface, points, factor, symmetric, matrix);
  else
    throw std::invalid_argument("contact points have one to three forces each");
  return matrix;
}

} // namespace rubato::step
