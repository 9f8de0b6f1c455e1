// SPDX-License-Identifier: LGPL-3.0-or-later
/// A Cholesky factor that several ranks hold, of a library that is loaded only then (petsc_module.hpp).
/// petsc/factor_of_ranks.cpp is that library's side.
///
///   A = [A_ii A_is; A_si A_ss],  S⁻¹ = A_ss − A_si A_ii⁻¹ A_is
///
/// A_ii is factored; the complement S⁻¹ of the surface is given.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace rubato::linalg {

/// All ranks make the same calls. What only the first one gives or gets is empty on others.
class FactorOfRanks {
public:
  /// The entries that this rank has, of the lower triangle; those at one place are summed over all ranks.
  struct Entries {
    int size = 0; ///< unknowns of the whole
    std::vector<int> rows;
    std::vector<int> columns;
    std::vector<int> surface; ///< unknowns that are not eliminated
    std::vector<int> order;   ///< the first rank's: the place of each unknown, those of the surface last
  };
  struct Needs {
    std::size_t bytes = 0; ///< of this rank
    double flops = 0;      ///< of all
  };

  FactorOfRanks() = default;
  FactorOfRanks(const FactorOfRanks&) = delete;
  FactorOfRanks& operator=(const FactorOfRanks&) = delete;
  virtual ~FactorOfRanks() = default;

  // All throw std::bad_alloc where memory does not suffice, std::runtime_error where the library fails
  // otherwise.
  virtual Needs analyse(Entries entries) = 0;
  /// Of the values of the entries, in their order. `complement`: the first rank's, surface × surface, column
  /// after column; its upper triangle is filled. False when A_ii is not positive definite.
  virtual bool factorise(std::span<const double> values, std::span<double> complement) = 0;
  /// The first rank gives b and gets b_s − A_si A_ii⁻¹ b_i.
  virtual void condense(std::span<double> right_side, std::span<double> on_surface) = 0;
  /// Once after each `condense`: the first rank gives x_s and gets x.
  virtual void expand(std::span<double> on_surface, std::span<double> solution) = 0;
  /// x = A⁻¹ b of the first rank, in place, where nothing is on the surface.
  virtual void solve(std::span<double> right_side) = 0;
  /// That the factor holds on all ranks.
  virtual std::size_t bytes() const = 0;
};

/// What the library's side exports by the name below, in C linkage. The number counts changes of this header.
using MakeFactorOfRanks = void(std::unique_ptr<FactorOfRanks>& made);
inline constexpr const char* make_factor_of_ranks_name = "rubato_make_factor_of_ranks_2";

} // namespace rubato::linalg
