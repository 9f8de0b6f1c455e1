// SPDX-License-Identifier: LGPL-3.0-or-later
/// Benchmarks of nonlinear bodies: numbers with a source, and what the program gives.
#pragma once

#include <string>
#include <vector>

namespace rubato::verification {

/// One number of a benchmark.
struct BenchmarkNumber {
  std::string quantity; ///< for readers, with its unit: "corner displacement"
  double found = 0;
  double expected = 0;
  double tolerance = 0; ///< relative to `expected`
  std::string source;   ///< closed form, book, or the program that it was computed with
  bool within() const;  ///< whether |found − expected| ≤ tolerance |expected|
};

struct Benchmark {
  int row = 0; ///< its number in the table
  std::string what;
  std::vector<BenchmarkNumber> numbers;
  std::vector<double> residuals; ///< bulk residuals of the last step that needed most iterations, with
                                 ///< `tangent: full`; may be empty
};

/// Rows 1 to 5, 15, 16, 20 to 22.
std::vector<Benchmark> structure_benchmarks();
/// Rows 6 to 14, 17 to 19.
std::vector<Benchmark> point_benchmarks();
/// Rows 23 to 29.
std::vector<Benchmark> contact_benchmarks();

} // namespace rubato::verification
