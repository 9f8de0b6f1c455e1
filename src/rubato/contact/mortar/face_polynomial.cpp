// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/mortar/face_polynomial.hpp"

#include "rubato/cell/reference_cell.hpp"

#include <array>
#include <map>

namespace rubato::contact::mortar {
namespace {

/// Column a + 3b of a row: the factor of ξ^a η^b in the shape function of that node.
using Factors = std::array<std::array<double, 9>, 9>;

/// The factors of a parabola through its values at −1, 0, 1.
constexpr std::array<std::array<double, 3>, 3> parabola{{{0, 1, 0}, {-0.5, 0, 0.5}, {0.5, -1, 0.5}}};

Factors factors_of(CellType type) {
  Factors factors{};
  std::array<std::array<std::array<double, 9>, 3>, 3> values{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      values[i][j] = face_values(type, {static_cast<double>(i) - 1, static_cast<double>(j) - 1});
  for (std::size_t node = 0; node < static_cast<std::size_t>(cell::topology(type).node_count); ++node)
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t b = 0; b < 3; ++b)
        for (std::size_t j = 0; j < 3; ++j) {
          double along = 0;
          for (std::size_t i = 0; i < 3; ++i)
            along += parabola[a][i] * values[i][j][node];
          factors[node][a + 3 * b] += along * parabola[b][j];
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
    for (int row = 0; row < 3; ++row) {
      const double below = 0.25 * (nodes(row, 0) + nodes(row, 1)),
                   above = 0.25 * (nodes(row, 2) + nodes(row, 3));
      const double along = 0.25 * (nodes(row, 1) - nodes(row, 0)),
                   back = 0.25 * (nodes(row, 2) - nodes(row, 3));
      factors_(row, 0) = above + below;
      factors_(row, 1) = back + along;
      factors_(row, 3) = above - below;
      factors_(row, 4) = back - along;
    }
  } else if (type == CellType::tria3) {
    for (int row = 0; row < 3; ++row) {
      factors_(row, 0) = nodes(row, 0);
      factors_(row, 1) = nodes(row, 1) - nodes(row, 0);
      factors_(row, 3) = nodes(row, 2) - nodes(row, 0);
    }
  } else {
    const auto& of_type = factors_for(type);
    for (int term = 0; term < 9; ++term)
      for (int node = 0; node < nodes.cols(); ++node) {
        const double factor = of_type[static_cast<std::size_t>(node)][static_cast<std::size_t>(term)];
        if (factor == 0)
          continue;
        for (int row = 0; row < 3; ++row)
          factors_(row, term) += nodes(row, node) * factor;
      }
  }
}

} // namespace rubato::contact::mortar
