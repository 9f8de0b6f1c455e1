// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/element/isotropic_stiffness.hpp"

#include "rubato/element/hexa8_stiffness.hpp"
#include "rubato/element/nonlinear/block_sums.hpp"
#include "rubato/element/nonlinear/shapes.hpp"

namespace rubato::element {
namespace {

/// A_ab(i,j) = Σ w ∂_a N_i ∂_b N_j of two nodes i at a + Rows b.
template <int Rows> using GramPair = std::array<Eigen::Array2d, static_cast<std::size_t>(Rows* Rows)>;

template <class S> class IsotropicStiffness {
public:
  IsotropicStiffness(const CellGradients<S>& gradients, const material::Lame& lame)
      : gradients_(gradients), lame_(lame) {}

  template <class Matrix> void put(Matrix& k) {
    for (int j = 0; j < gradients_.nodes(); ++j) {
      set_weighted(j);
      for (int i = 0; i <= j; i += 2)
        put_blocks<S::d>(block(gram(i)), i, j, k);
    }
  }

private:
  using Weighted = std::array<double, static_cast<std::size_t>(S::rows)>;

  void set_weighted(int j) {
    for (int q = 0; q < gradients_.points(); ++q)
      for (int row = 0; row < S::rows; ++row)
        weighted_[static_cast<std::size_t>(q)][static_cast<std::size_t>(row)] =
            gradients_.weight(q) * gradients_.at(q, row, j);
  }

  GramPair<S::rows> gram(int i) const {
    GramPair<S::rows> sum;
    sum.fill(Eigen::Array2d::Zero());
    for (int q = 0; q < gradients_.points(); ++q)
      unrolled<S::rows>([&]<int a>(std::integral_constant<int, a>) {
        const Eigen::Array2d g = Eigen::Map<const Eigen::Array2d, Eigen::Aligned16>(gradients_.pair(q, a, i));
        unrolled<S::rows>([&]<int b>(std::integral_constant<int, b>) {
          sum[a + S::rows * b] += g * weighted_[static_cast<std::size_t>(q)][b];
        });
      });
    return sum;
  }

  BlockPair<S::d> block(const GramPair<S::rows>& gram) const {
    const auto [lambda, mu] = lame_;
    const auto at = [&](int a, int b) -> const Eigen::Array2d& {
      return gram[static_cast<std::size_t>(a + S::rows * b)];
    };
    Eigen::Array2d trace = at(0, 0);
    for (int a = 1; a < S::d; ++a)
      trace += at(a, a);
    BlockPair<S::d> result;
    for (int b = 0; b < S::d; ++b)
      for (int a = 0; a < S::d; ++a)
        result[static_cast<std::size_t>(a + S::d * b)] = lambda * at(a, b) + mu * at(b, a);
    for (int a = 0; a < S::d; ++a)
      result[static_cast<std::size_t>(a + S::d * a)] += mu * trace;
    if constexpr (S::rows > S::d)
      add_hoop(at, result);
    return result;
  }

  /// What ε_zz = u_r/R adds.
  template <class At> void add_hoop(const At& at, BlockPair<S::d>& result) const {
    for (int a = 0; a < S::d; ++a) {
      result[static_cast<std::size_t>(S::d * a)] += lame_.lambda * at(S::d, a);
      result[static_cast<std::size_t>(a)] += lame_.lambda * at(a, S::d);
    }
    result[0] += (lame_.lambda + 2 * lame_.mu) * at(S::d, S::d);
  }

  const CellGradients<S>& gradients_;
  material::Lame lame_;
  std::array<Weighted, static_cast<std::size_t>(S::most_points)> weighted_;
};

} // namespace

namespace {

void put_hexa8(std::span<const Eigen::Vector3d> points, const material::Lame& lame,
               Eigen::Ref<Eigen::MatrixXd> k) {
  Eigen::MatrixXd own;
  const Hexa8Stiffness cell{points, lame, own};
  set_hexa8_stiffness({cell, cell});
  k = own;
}

} // namespace

bool isotropic_stiffness(CellType type, std::span<const Eigen::Vector3d> points, const material::Lame& lame,
                         const Section& section, Eigen::Ref<Eigen::MatrixXd> k) {
  if (type == CellType::hexa8 && section.physics == study::Physics::solid) {
    put_hexa8(points, lame, k);
    return true;
  }
  const auto put_as = [&]<class S>(ShapeTag<S>) {
    const CellGradients<S> gradients(reference_gradients(type), points, section);
    IsotropicStiffness<S>(gradients, lame).put(k);
  };
  const CellKind kind{type, section};
  switch (section.physics) {
  case study::Physics::solid:
    return with_fixed_solid(kind, put_as);
  case study::Physics::axisymmetric:
    return with_fixed_plane<3>(kind, put_as);
  default:
    return with_fixed_plane<2>(kind, put_as);
  }
}

} // namespace rubato::element
