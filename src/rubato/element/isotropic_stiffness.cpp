// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/element/isotropic_stiffness.hpp"

#include "rubato/element/hexa8_stiffness.hpp"
#include "rubato/element/nonlinear/block_sums.hpp"

namespace rubato::element {
namespace {

/// A_ab(i,j) = Σ w ∂_a N_i ∂_b N_j of two nodes i at a + rows b.
template <int rows> using GramPair = std::array<Pair, static_cast<std::size_t>(rows* rows)>;

template <int d, int rows> class IsotropicStiffness {
public:
  IsotropicStiffness(const CellGradients& gradients, const material::Lame& lame)
      : gradients_(gradients), lame_(lame) {}

  void put(const MatrixView& k) {
    for (int j = 0; j < gradients_.nodes(); ++j) {
      set_weighted(j);
      for (int i = 0; i <= j; i += 2)
        put_blocks<d>(block(gram(i)), i, j, k);
    }
  }

private:
  void set_weighted(int j) {
    for (int q = 0; q < gradients_.points(); ++q)
      for (int row = 0; row < rows; ++row)
        weighted_[static_cast<std::size_t>(q)][static_cast<std::size_t>(row)] =
            twice(gradients_.weight(q) * gradients_.at(q, row, j));
  }

  GramPair<rows> gram(int i) const {
    GramPair<rows> sum{};
    const int stride = gradients_.stride();
    for (int q = 0; q < gradients_.points(); ++q) {
      const double* const at = gradients_.row(q, 0) + i;
      const auto& weighted = weighted_[static_cast<std::size_t>(q)];
      unrolled<rows>([&](auto a) {
        const Pair g = pair_at(at + a * stride);
        unrolled<rows>([&](auto b) { sum[a + rows * b] += g * weighted[b]; });
      });
    }
    return sum;
  }

  BlockPair<d> block(const GramPair<rows>& gram) const {
    const auto [lambda, mu] = lame_;
    Pair trace = gram[0];
    for (std::size_t a = 1; a < d; ++a)
      trace += gram[a * (rows + 1)];
    BlockPair<d> result;
    for (std::size_t b = 0; b < d; ++b)
      for (std::size_t a = 0; a < d; ++a)
        result[a + d * b] = lambda * gram[a + rows * b] + mu * gram[b + rows * a];
    for (std::size_t a = 0; a < d; ++a)
      result[a * (d + 1)] += mu * trace;
    if constexpr (rows > d) { // what ε_zz = u_r/R adds
      for (std::size_t a = 0; a < d; ++a) {
        result[d * a] += lambda * gram[d + rows * a];
        result[a] += lambda * gram[a + rows * d];
      }
      result[0] += (lambda + 2 * mu) * gram[d + rows * d];
    }
    return result;
  }

  const CellGradients& gradients_;
  material::Lame lame_;
  AtPoints<std::array<Pair, static_cast<std::size_t>(rows)>> weighted_;
};

void put_hexa8(std::span<const Eigen::Vector3d> points, const material::Lame& lame,
               Eigen::Ref<Eigen::MatrixXd> k) {
  Eigen::MatrixXd own;
  const Hexa8Stiffness cell{points, lame, own};
  set_hexa8_stiffness({cell, cell});
  k = own;
}

} // namespace

void isotropic_stiffness(CellType type, std::span<const Eigen::Vector3d> points, const material::Lame& lame,
                         const Section& section, Eigen::Ref<Eigen::MatrixXd> k) {
  if (type == CellType::hexa8 && section.physics == study::Physics::solid)
    return put_hexa8(points, lame, k);
  const CellGradients gradients(type, points, section, PointRule::stiffness);
  const MatrixView view{k.data(), static_cast<int>(k.outerStride())};
  if (section.physics == study::Physics::solid)
    IsotropicStiffness<3, 3>(gradients, lame).put(view);
  else if (section.physics == study::Physics::axisymmetric)
    IsotropicStiffness<2, 3>(gradients, lame).put(view);
  else
    IsotropicStiffness<2, 2>(gradients, lame).put(view);
}

} // namespace rubato::element
