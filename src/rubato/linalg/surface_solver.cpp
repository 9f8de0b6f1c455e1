// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/linalg/surface_solver.hpp"

namespace rubato::linalg {

std::vector<int> bodies_of(const SparseMatrix& matrix, int& count) {
  std::vector<int> body(static_cast<std::size_t>(matrix.cols()), -1);
  std::vector<int> waiting;
  count = 0;
  for (int seed = 0; seed < matrix.cols(); ++seed) {
    if (body[static_cast<std::size_t>(seed)] >= 0)
      continue;
    body[static_cast<std::size_t>(seed)] = count;
    waiting.push_back(seed);
    while (!waiting.empty()) {
      const int unknown = waiting.back();
      waiting.pop_back();
      for (SparseMatrix::InnerIterator entry(matrix, unknown); entry; ++entry)
        if (auto& other = body[static_cast<std::size_t>(entry.row())]; other < 0) {
          other = count;
          waiting.push_back(static_cast<int>(entry.row()));
        }
    }
    ++count;
  }
  return body;
}

SurfaceOfBodies surface_of_bodies(std::span<const int> surface, const std::vector<int>& body_of, int bodies) {
  std::vector<std::vector<int>> of_body(static_cast<std::size_t>(bodies));
  for (const int unknown : surface)
    of_body[static_cast<std::size_t>(body_of[static_cast<std::size_t>(unknown)])].push_back(unknown);
  SurfaceOfBodies found;
  for (const auto& unknowns : of_body) {
    found.unknowns.insert(found.unknowns.end(), unknowns.begin(), unknowns.end());
    found.starts.push_back(static_cast<int>(found.unknowns.size()));
  }
  return found;
}

} // namespace rubato::linalg
