// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/mortar/face_polynomial.hpp"

#include "rubato/cell/reference_cell.hpp"

#include <array>
#include <map>

namespace rubato::contact::mortar {
namespace {

/// Column a + 3b of a row: the factor of ξ^a η^b in the shape function of that node.
using Factors = Eigen::Matrix<double, 9, 9>;

/// The factors of a parabola through its values at −1, 0, 1.
const Eigen::Matrix3d& parabola() {
  static const Eigen::Matrix3d factors{{0, 1, 0}, {-0.5, 0, 0.5}, {0.5, -1, 0.5}};
  return factors;
}

Factors factors_of(CellType type) {
  Factors factors = Factors::Zero();
  std::array<std::array<std::array<double, 9>, 3>, 3> values{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      values[i][j] = face_values(type, {static_cast<double>(i) - 1, static_cast<double>(j) - 1});
  for (int node = 0; node < cell::topology(type).node_count; ++node) {
    Eigen::Matrix3d grid;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        grid(i, j) =
            values[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)][static_cast<std::size_t>(node)];
    const Eigen::Matrix3d products = parabola() * grid * parabola().transpose();
    factors.row(node) = Eigen::Map<const Eigen::RowVector<double, 9>>(products.data());
  }
  return factors;
}

const Factors& factors_for(CellType type) {
  static const auto table = [] {
    std::map<CellType, Factors> all;
    for (const auto face : {CellType::tria3, CellType::tria6, CellType::tria7, CellType::quad4,
                            CellType::quad8, CellType::quad9})
      all[face] = factors_of(face);
    return all;
  }();
  return table.at(type);
}

FaceTerms terms_of(CellType type) {
  switch (type) {
  case CellType::tria3:
  case CellType::quad4:
    return FaceTerms::bilinear;
  case CellType::tria6:
    return FaceTerms::quadratic;
  case CellType::tria7:
  case CellType::quad8:
    return FaceTerms::serendipity;
  default:
    return FaceTerms::biquadratic;
  }
}

} // namespace

FacePolynomial::FacePolynomial(CellType type, const FaceCoordinates& nodes) : terms_(terms_of(type)) {
  if (type == CellType::quad4) {
    const Eigen::Vector3d below = 0.25 * (nodes.col(0) + nodes.col(1)),
                          above = 0.25 * (nodes.col(2) + nodes.col(3));
    const Eigen::Vector3d along = 0.25 * (nodes.col(1) - nodes.col(0)),
                          back = 0.25 * (nodes.col(2) - nodes.col(3));
    factors_.col(0) = above + below;
    factors_.col(1) = back + along;
    factors_.col(3) = above - below;
    factors_.col(4) = back - along;
  } else if (type == CellType::tria3) {
    factors_.col(0) = nodes.col(0);
    factors_.col(1) = nodes.col(1) - nodes.col(0);
    factors_.col(3) = nodes.col(2) - nodes.col(0);
  } else {
    factors_.noalias() = nodes * factors_for(type).topRows(nodes.cols());
  }
}

} // namespace rubato::contact::mortar
