// SPDX-License-Identifier: LGPL-3.0-or-later
/// Checksums by which a factor knows the pattern and the values that it was made of.
#pragma once

#include "rubato/linalg/direct_solver.hpp"

#include <array>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>

namespace rubato::linalg {

/// One step of FNV-1a on a word of 64 bits, and the high half of the sum mixed into the low one. For a given
/// word this maps sums one to one.
inline std::uint64_t with_word(std::uint64_t sum, std::uint64_t word) {
  sum = (sum ^ word) * 0x100000001b3U;
  return sum ^ sum >> 32U;
}

/// Of all bits of the numbers in their order, so that 0 and −0 differ. Sequences of one length that differ in
/// one number never agree, others do with a chance of 2⁻⁶⁴. Four sums take turns: one would wait for its own
/// products.
template <class Number>
requires std::same_as<Number, double> || std::same_as<Number, int> std::uint64_t
fingerprint_of(std::span<const Number> numbers) {
  const auto word = [](Number number) {
    if constexpr (std::same_as<Number, double>)
      return std::bit_cast<std::uint64_t>(number);
    else
      return static_cast<std::uint64_t>(number);
  };
  std::array<std::uint64_t, 4> sums{1, 2, 3, 4};
  std::size_t i = 0;
  for (; i + sums.size() <= numbers.size(); i += sums.size())
    for (std::size_t k = 0; k < sums.size(); ++k)
      sums[k] = with_word(sums[k], word(numbers[i + k]));
  std::uint64_t all = numbers.size();
  for (; i < numbers.size(); ++i)
    all = with_word(all, word(numbers[i]));
  for (const auto sum : sums)
    all = with_word(all, sum);
  return all;
}

/// Of the rows and columns of all entries that are stored, zeros among them.
inline std::uint64_t pattern_of(const SparseMatrix& matrix) {
  if (!matrix.isCompressed()) {
    SparseMatrix compressed = matrix;
    compressed.makeCompressed();
    return pattern_of(compressed);
  }
  const auto entries = static_cast<std::size_t>(matrix.nonZeros());
  const auto columns = static_cast<std::size_t>(matrix.cols());
  return with_word(fingerprint_of(std::span(matrix.innerIndexPtr(), entries)),
                   fingerprint_of(std::span(matrix.outerIndexPtr(), columns + 1)));
}

} // namespace rubato::linalg
