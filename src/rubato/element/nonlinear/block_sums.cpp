// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/element/nonlinear/block_sums.hpp"

namespace rubato::element {
namespace {

/// Rows and columns of D by component and gradient row.
struct SmallStrain {
  using Held = material::Tangent6;
  static constexpr std::size_t size = 6;
  static constexpr int place(int a, int row, int d) {
    const int of_tensor = tensor_place(a, row, d);
    return of_tensor < 0 ? -1 : voigt_place(of_tensor % 3, of_tensor / 3);
  }
};

struct LargeMotion {
  using Held = Moduli;
  static constexpr std::size_t size = 9;
  static constexpr int place(int a, int row, int d) { return tensor_place(a, row, d); }
};

template <int d, int rows, class Kind> class BlockSums {
public:
  BlockSums(const CellGradients& gradients, std::span<const typename Kind::Held> moduli)
      : gradients_(gradients), moduli_(moduli) {}

  void put(int first, int last, const MatrixView& k) {
    for (int j = first; j < last; ++j) {
      set_products(j);
      for (int i = first; i <= j; i += 2)
        put_blocks<d>(sum(i), i, j, k);
    }
  }

private:
  /// A ∂N_j by component k, both lanes the same: a sum multiplies each of them with two nodes.
  using Product = std::array<Pair, Kind::size* static_cast<std::size_t>(d)>;

  /// Whether a gradient of the plane meets that row of A.
  static constexpr bool is_used(int place) {
    for (int row = 0; row < rows; ++row)
      for (int a = 0; a < d; ++a)
        if (Kind::place(a, row, d) == place)
          return true;
    return false;
  }

  void set_products(int j) {
    for (std::size_t q = 0; q < moduli_.size(); ++q) {
      const double* const a = moduli_[q].data();
      const double* const g = gradients_.row(static_cast<int>(q), 0) + j;
      const int stride = gradients_.stride();
      auto& product = products_[q];
      unrolled<d>([&](auto k) {
        const double* const first = a + Kind::place(k, 0, d) * Kind::size;
        const auto put_product = [&](std::size_t place) {
          double sum = g[0] * first[place];
          unrolled<rows - 1>([&](auto m) {
            constexpr int column = Kind::place(k, m + 1, d);
            if constexpr (column >= 0)
              sum += g[(m + 1) * stride] * a[column * Kind::size + place];
          });
          product[k * Kind::size + place] = twice(sum);
        };
        if constexpr (d == 3)
          for (std::size_t place = 0; place < Kind::size; ++place)
            put_product(place);
        else
          unrolled<Kind::size>([&](auto place) {
            if constexpr (is_used(place))
              put_product(place);
          });
      });
    }
  }

  [[gnu::always_inline]] BlockPair<d> sum(int i) const {
    BlockPair<d> total{};
    const int stride = gradients_.stride();
    for (std::size_t q = 0; q < moduli_.size(); ++q) {
      const double* const at = gradients_.row(static_cast<int>(q), 0) + i;
      const auto& product = products_[q];
      unrolled<rows>([&](auto row) {
        const Pair g = pair_at(at + row * stride);
        unrolled<d * d>([&](auto m) {
          constexpr int place = Kind::place(m % d, row, d);
          if constexpr (place >= 0)
            total[m] += g * product[m / d * Kind::size + place];
        });
      });
    }
    return total;
  }

  const CellGradients& gradients_;
  std::span<const typename Kind::Held> moduli_;
  AtPoints<Product> products_;
};

template <class Kind>
void put_sums(const CellGradients& gradients, std::span<const typename Kind::Held> moduli, int first,
              int last, const MatrixView& k) {
  if (gradients.components() == 3)
    BlockSums<3, 3, Kind>(gradients, moduli).put(first, last, k);
  else if (gradients.rows() == 3)
    BlockSums<2, 3, Kind>(gradients, moduli).put(first, last, k);
  else
    BlockSums<2, 2, Kind>(gradients, moduli).put(first, last, k);
}

} // namespace

void put_block_sums(const CellGradients& gradients, std::span<const material::Tangent6> moduli, int first,
                    int last, const MatrixView& k) {
  put_sums<SmallStrain>(gradients, moduli, first, last, k);
}

void put_block_sums(const CellGradients& gradients, std::span<const Moduli> moduli, int first, int last,
                    const MatrixView& k) {
  put_sums<LargeMotion>(gradients, moduli, first, last, k);
}

} // namespace rubato::element
