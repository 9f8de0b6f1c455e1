// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/element/nonlinear/dilatation_space.hpp"

#include "rubato/element/nonlinear/bubble_cell.hpp"

#include <cmath>

namespace rubato::element {
namespace {

bool has_linear_dilatation(CellType type) {
  return type == CellType::tria7 || type == CellType::quad9 || type == CellType::hexa27 || has_bubble(type);
}

} // namespace

DilatationSpace::DilatationSpace(CellType type, std::span<const Eigen::Vector3d> points,
                                 const CellGradients& gradients)
    : gradients_(gradients) {
  for (int q = 0; q < gradients_.points(); ++q) {
    volume_ += gradients_.weight(q);
    functions_[0][place(q)] = 1;
  }
  if (has_linear_dilatation(type))
    set_linear(type, points);
}

AtPoints<double> DilatationSpace::projected(const AtPoints<double>& values) const {
  AtPoints<double> out;
  const double mean = sum(0, values) / volume_;
  for (int q = 0; q < gradients_.points(); ++q)
    out[place(q)] = mean;
  for (int m = 1; m < size_; ++m) {
    const double part = sum(m, values) / volume_;
    for (int q = 0; q < gradients_.points(); ++q)
      out[place(q)] += part * at(m, q);
  }
  return out;
}

Eigen::Matrix4d DilatationSpace::products(const AtPoints<double>& values) const {
  Eigen::Matrix4d out = Eigen::Matrix4d::Zero();
  for (int q = 0; q < gradients_.points(); ++q)
    for (int m = 0; m < size_; ++m)
      for (int n = 0; n < size_; ++n)
        out(m, n) += values[place(q)] * (at(m, q) * at(n, q));
  return out;
}

/// Orthogonalises the coordinates by the method of Gram and Schmidt.
void DilatationSpace::set_linear(CellType type, std::span<const Eigen::Vector3d> points) {
  const auto& values = reference_gradients(type).values;
  for (int a = 0; a < gradients_.components(); ++a) {
    auto& function = functions_[place(size_)];
    for (int q = 0; q < gradients_.points(); ++q) {
      function[place(q)] = 0;
      for (int i = 0; i < gradients_.nodes(); ++i)
        function[place(q)] += values(i, q) * points[place(i)][a];
    }
    for (int m = 0; m < size_; ++m) {
      const double part = sum(m, function) / volume_;
      for (int q = 0; q < gradients_.points(); ++q)
        function[place(q)] -= part * at(m, q);
    }
    const double by = std::sqrt(volume_ / sum(size_, function));
    for (int q = 0; q < gradients_.points(); ++q)
      function[place(q)] *= by;
    ++size_;
  }
}

double DilatationSpace::sum(int m, const AtPoints<double>& values) const {
  double sum = 0;
  for (int q = 0; q < gradients_.points(); ++q)
    sum += gradients_.weight(q) * at(m, q) * values[place(q)];
  return sum;
}

} // namespace rubato::element
