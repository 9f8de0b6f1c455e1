// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/linalg/split_factor.hpp"

#include "rubato/linalg/blas.hpp"
#include "rubato/linalg/blas_threads.hpp"
#include "rubato/linalg/cholmod_engine.hpp"
#include "rubato/linalg/fingerprint.hpp"
#include "rubato/linalg/memory.hpp"
#include "rubato/linalg/surface_in_factor.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <stdexcept>

namespace rubato::linalg {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Of thicker bodies, with more unknowns for each on the surface, L_ss is not worth comparing with the
/// factor.
constexpr Index thickest = 100;

enum class Side : char { lower = 'N', transposed = 'T' };

void solve_in_place(const TrailingTriangle& triangle, Side side, Eigen::Ref<VectorXd> values) {
  const auto size = static_cast<int>(triangle.size);
  const auto stride = static_cast<int>(triangle.stride);
  const auto transposed = static_cast<char>(side);
  const int one = 1;
  if (size > 0)
    dtrsv_("L", &transposed, "N", &size, triangle.values, &stride, values.data(), &one);
}

/// Of columns that are zero above row `first`; the solution is taken from there on.
void solve_in_place(const TrailingTriangle& triangle, Side side, MatrixXd& values, Index first) {
  const auto size = static_cast<int>(triangle.size - first);
  const auto columns = static_cast<int>(values.cols());
  const auto stride = static_cast<int>(triangle.stride);
  const auto values_stride = static_cast<int>(values.rows());
  const auto transposed = static_cast<char>(side);
  const double one = 1;
  if (values.size() > 0)
    dtrsm_("L", "L", &transposed, "N", &size, &columns, &one, triangle.values + first * (triangle.stride + 1),
           &stride, values.data() + first, &values_stride);
}

/// L becomes L⁻¹. By halves, whose products run faster than what LAPACK does to a quarter column by column.
void invert_lower(double* values, int size, int stride) {
  constexpr int smallest = 32;
  if (size <= smallest) {
    int info = 0;
    dtrtri_("L", "N", &size, values, &stride, &info);
    return;
  }
  const int half = size / 2, rest = size - half;
  double* below = values + half;
  double* second = below + std::ptrdiff_t{half} * stride;
  invert_lower(values, half, stride);
  invert_lower(second, rest, stride);
  const double one = 1, minus_one = -1;
  dtrmm_("L", "L", "N", "N", &rest, &half, &minus_one, second, &stride, below, &stride);
  dtrmm_("R", "L", "N", "N", &rest, &half, &one, values, &stride, below, &stride);
}

} // namespace

struct SplitFactor::Body {
  std::vector<int> unknowns; ///< in the order of elimination once analysed
  Index surface_size = 0;    ///< the last of them, before that
  std::unique_ptr<CholmodEngine> engine;
  TrailingTriangle triangle;             ///< where the surface is eliminated last
  std::optional<SurfaceInFactor> within; ///< where it is not
  std::optional<std::uint64_t> values;   ///< checksum of those that were factored; none without a factor
  std::size_t renewals = 0;

  Index size() const { return static_cast<Index>(unknowns.size()); }

  void analyse(LowerTriangle& lower, SurfaceLimits limits) {
    engine = std::make_unique<CholmodEngine>();
    if (surface_size > limits.last && size() <= thickest * surface_size) {
      engine->analyse_supernodes(lower);
      if (engine->bytes() < bytes_of_triangle() || engine->flops() < flops_of_triangle()) {
        within.emplace(*engine, size() - surface_size, limits.whole_within);
        return;
      }
      engine = std::make_unique<CholmodEngine>();
    }
    engine->analyse(lower, surface_size);
  }

  std::size_t bytes_of_triangle() const {
    return static_cast<std::size_t>(surface_size * (surface_size + 1) / 2) * sizeof(double);
  }

  double flops_of_triangle() const { return std::pow(static_cast<double>(surface_size), 3) / 3; }

  std::size_t bytes_of_compliance() const {
    return within ? within->bytes_of_compliance()
                  : static_cast<std::size_t>(surface_size * surface_size) * sizeof(double);
  }

  void eliminate_in_order_of_factor() {
    const auto order = engine->permutation();
    std::vector<int> ordered(unknowns.size());
    std::ranges::transform(order, ordered.begin(),
                           [&](auto i) { return unknowns[static_cast<std::size_t>(i)]; });
    unknowns = std::move(ordered);
  }

  /// The unknowns as they were analysed; `number` gets the place of each among them.
  std::vector<int> in_order_of_analysis(std::span<int> number) const {
    const auto order = engine->permutation();
    std::vector<int> analysed(unknowns.size());
    for (std::size_t i = 0; i < unknowns.size(); ++i) {
      analysed[static_cast<std::size_t>(order[i])] = unknowns[i];
      number[static_cast<std::size_t>(unknowns[i])] = static_cast<int>(order[i]);
    }
    return analysed;
  }

  void add_surface_to(std::vector<int>& surface) const {
    if (within)
      for (const Index place : within->places())
        surface.push_back(unknowns[static_cast<std::size_t>(place)]);
    else
      surface.insert(surface.end(), unknowns.end() - surface_size, unknowns.end());
  }

  /// False when there is no factor. `lower` is in the order of the analysis.
  bool factorise(LowerTriangle& lower) {
    const auto wanted = fingerprint_of(std::span<const double>(lower.values));
    if (values == wanted)
      return true;
    ++renewals;
    values.reset();
    triangle = {}; // no copy beside the new one
    if (!lower.finite || !engine->factorise(lower))
      return false;
    if (!within)
      triangle = engine->trailing(surface_size);
    values = wanted;
    return true;
  }
};

SplitFactor::SplitFactor(SplitFactor&&) noexcept = default;
SplitFactor& SplitFactor::operator=(SplitFactor&&) noexcept = default;
SplitFactor::~SplitFactor() = default;

/// The bodies and their unknowns: those of the surface last.
SplitFactor::SplitFactor(const SparseMatrix& matrix, std::span<const int> surface, const Threads& threads)
    : threads_(threads), size_(matrix.cols()), pattern_(pattern_of(matrix)) {
  int body_count = 0;
  const auto body_of = bodies_of(matrix, body_count);
  bodies_.resize(static_cast<std::size_t>(body_count));
  std::vector<char> on_surface(body_of.size(), 0);
  for (const int unknown : surface)
    on_surface[static_cast<std::size_t>(unknown)] = 1;
  const auto body_with = [&](int unknown) -> Body& {
    return bodies_[static_cast<std::size_t>(body_of[static_cast<std::size_t>(unknown)])];
  };
  for (int unknown = 0; unknown < matrix.cols(); ++unknown)
    if (on_surface[static_cast<std::size_t>(unknown)] == 0)
      body_with(unknown).unknowns.push_back(unknown);
  for (const int unknown : surface) {
    body_with(unknown).unknowns.push_back(unknown);
    ++body_with(unknown).surface_size;
  }
}

/// Of every body, before the analysis.
std::vector<LowerTriangle> SplitFactor::triangles_of(const SparseMatrix& matrix) const {
  std::vector<int> number(static_cast<std::size_t>(size_));
  std::vector<LowerTriangle> triangles;
  for (const auto& body : bodies_) {
    for (std::size_t i = 0; i < body.unknowns.size(); ++i)
      number[static_cast<std::size_t>(body.unknowns[i])] = static_cast<int>(i);
    triangles.emplace_back(matrix, body.unknowns, number);
  }
  return triangles;
}

void SplitFactor::analyse(std::vector<LowerTriangle>& triangles, std::size_t memory,
                          const std::function<void(std::size_t)>& tell, SurfaceLimits limits) {
  constexpr std::size_t fewest = 100'000; // entries, analysed in some ten milliseconds
  std::size_t entries = 0;
  for (const auto& triangle : triangles)
    entries += triangle.rows.size();
  const Threads threads = entries >= fewest ? threads_ : Threads();
  threads.each(static_cast<int>(bodies_.size()), [&](int body) {
    const auto b = static_cast<std::size_t>(body);
    bodies_[b].analyse(triangles[b], limits);
  });
  auto needed = factor_bytes();
  for (const auto& body : bodies_)
    needed += body.bytes_of_compliance();
  if (needed > memory)
    throw TooLargeForMemory(needed, memory);
  tell(needed);
  body_starts_.push_back(0);
  for (auto& body : bodies_) {
    body.eliminate_in_order_of_factor();
    body.add_surface_to(surface_);
    body_starts_.push_back(static_cast<int>(surface_.size()));
  }
}

std::optional<SplitFactor> SplitFactor::of(const SparseMatrix& matrix, std::span<const int> surface,
                                           std::size_t memory, const std::function<void(std::size_t)>& tell,
                                           SurfaceLimits limits, const Threads& threads) {
  if (matrix.rows() != matrix.cols())
    throw std::invalid_argument("SplitFactor::of wants a square matrix.");
  SplitFactor factor(matrix, surface, threads);
  auto triangles = factor.triangles_of(matrix);
  if (!std::ranges::all_of(triangles, &LowerTriangle::finite))
    return std::nullopt;
  factor.analyse(triangles, memory, tell, limits);
  if (!factor.factorise([&](std::size_t b) { return std::move(triangles[b]); }))
    return std::nullopt;
  factor.has_values_ = true;
  return factor;
}

SplitFactor SplitFactor::analysed(const SparseMatrix& matrix, std::span<const int> surface,
                                  std::size_t memory, const std::function<void(std::size_t)>& tell,
                                  SurfaceLimits limits, const Threads& threads) {
  if (matrix.rows() != matrix.cols())
    throw std::invalid_argument("SplitFactor::analysed wants a square matrix.");
  SplitFactor factor(matrix, surface, threads);
  auto triangles = factor.triangles_of(matrix);
  factor.analyse(triangles, memory, tell, limits);
  return factor;
}

bool SplitFactor::refactor(const SparseMatrix& matrix) {
  if (matrix.rows() != size_ || matrix.cols() != size_ || pattern_of(matrix) != pattern_)
    throw std::invalid_argument("SplitFactor::refactor wants a matrix of the analysed one's pattern.");
  has_values_ = false;
  std::vector<int> number(static_cast<std::size_t>(size_)); // bodies have unknowns of their own
  has_values_ = factorise(
      [&](std::size_t b) { return LowerTriangle(matrix, bodies_[b].in_order_of_analysis(number), number); });
  return has_values_;
}

/// Whether bodies side by side, each by one thread, are sooner factored than one after the other by all
/// threads of BLAS, which keep about two thirds of them busy.
bool SplitFactor::pays_side_by_side() const {
  double all = 0, largest = 0;
  for (const auto& body : bodies_) {
    all += body.engine->flops();
    largest = std::max(largest, body.engine->flops());
  }
  const double threads = threads_.count();
  return std::max(largest, all / threads) <= all / (1 + 2. / 3 * (threads - 1));
}

/// False when a body's matrix is not positive definite.
bool SplitFactor::factorise(const std::function<LowerTriangle(std::size_t)>& triangle_of) {
  constexpr double fewest = 1e7; // multiplications and additions, some milliseconds
  const bool is_small = factor_flops() < fewest;
  if (threads_.count() > 1 && !is_small && !pays_side_by_side())
    return factorise_by_blas(triangle_of);
  std::atomic<bool> failed = false;
  const Threads threads = is_small ? Threads() : threads_;
  threads.each(static_cast<int>(bodies_.size()), [&](int body) {
    if (failed)
      return;
    const auto b = static_cast<std::size_t>(body);
    auto triangle = triangle_of(b);
    if (!bodies_[b].factorise(triangle))
      failed = true;
  });
  return !failed;
}

bool SplitFactor::factorise_by_blas(const std::function<LowerTriangle(std::size_t)>& triangle_of) {
  const BlasThreads threads(threads_.count());
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    auto triangle = triangle_of(b);
    if (!bodies_[b].factorise(triangle))
      return false;
  }
  return true;
}

std::size_t SplitFactor::renewals(std::size_t body) const {
  return bodies_[body].renewals;
}

void SplitFactor::must_have_values() const {
  if (!has_values_)
    throw std::logic_error(
        "SplitFactor has no values: no matrix was factored, or the last one could not be.");
}

VectorXd SplitFactor::solve(const VectorXd& right_side) const {
  return backward(forward(right_side));
}

/// Calls work(body, place of its first unknown in a vector that has body after body), side by side where
/// threads wake up sooner than one of them is done.
template <class Work> void SplitFactor::each_body(const Work& work) const {
  constexpr std::size_t smallest = 200'000; // entries of a factor, read in a tenth of a millisecond
  Index first = 0;
  if (threads_.count() == 1 || bodies_.size() == 1 || factor_nonzeros() < smallest) {
    for (const auto& body : bodies_) {
      work(body, first);
      first += body.size();
    }
    return;
  }
  std::vector<Index> firsts;
  for (const auto& body : bodies_) {
    firsts.push_back(first);
    first += body.size();
  }
  threads_.each(static_cast<int>(bodies_.size()), [&](int body) {
    const auto b = static_cast<std::size_t>(body);
    work(bodies_[b], firsts[b]);
  });
}

Index SplitFactor::first_position(const Body& body) const {
  return body_starts_[static_cast<std::size_t>(&body - bodies_.data())];
}

VectorXd SplitFactor::forward(const VectorXd& right_side) const {
  must_have_values();
  if (right_side.size() != size_)
    throw std::invalid_argument("SplitFactor wants a right side of the matrix's size.");
  VectorXd half_way(size_);
  each_body([&](const Body& body, Index first) {
    auto part = half_way.segment(first, body.size());
    std::ranges::transform(body.unknowns, part.begin(), [&](int unknown) { return right_side[unknown]; });
    part = body.engine->solve(CHOLMOD_L, part);
  });
  return half_way;
}

VectorXd SplitFactor::backward(const VectorXd& half_way) const {
  must_have_values();
  VectorXd solution(size_);
  each_body([&](const Body& body, Index first) {
    const auto part = body.engine->solve(CHOLMOD_Lt, half_way.segment(first, body.size()));
    for (Index i = 0; i < part.size(); ++i)
      solution[body.unknowns[static_cast<std::size_t>(i)]] = part[i];
  });
  return solution;
}

VectorXd SplitFactor::surface_of(const VectorXd& half_way) const {
  must_have_values();
  VectorXd values(static_cast<Index>(surface_.size()));
  each_body([&](const Body& body, Index first) {
    auto part = values.segment(first_position(body), body.surface_size);
    if (body.within) {
      part = body.within->values(half_way.segment(first, body.size()));
      return;
    }
    part = half_way.segment(first + body.size() - body.surface_size, body.surface_size);
    solve_in_place(body.triangle, Side::transposed, part);
  });
  return values;
}

void SplitFactor::load_surface(const VectorXd& force, VectorXd& half_way) const {
  must_have_values();
  each_body([&](const Body& body, Index first) {
    VectorXd part = force.segment(first_position(body), body.surface_size);
    if (part.isZero(0))
      return;
    if (body.within) {
      body.within->load(part, half_way.segment(first, body.size()));
      return;
    }
    solve_in_place(body.triangle, Side::lower, part);
    half_way.segment(first + body.size() - body.surface_size, body.surface_size) += part;
  });
}

const SurfaceInFactor* SplitFactor::surface_within(std::size_t body) const {
  const auto& within = bodies_[body].within;
  return within ? &*within : nullptr;
}

MatrixXd SplitFactor::compliance(std::size_t body) const {
  must_have_values();
  if (bodies_[body].within)
    return bodies_[body].within->whole();
  const auto& triangle = bodies_[body].triangle;
  MatrixXd inverse(triangle.size, triangle.size);
  for (Index j = 0; j < triangle.size; ++j)
    std::copy_n(triangle.values + j * triangle.stride + j, triangle.size - j, &inverse(j, j));
  const auto size = static_cast<int>(triangle.size);
  int info = 0;
  if (size > 0) {
    invert_lower(inverse.data(), size, size);
    dlauum_("L", &size, inverse.data(), &size, &info);
  }
  inverse.triangularView<Eigen::StrictlyUpper>() = inverse.transpose();
  return inverse;
}

MatrixXd SplitFactor::compliance(std::size_t body, Index first, Index count) const {
  must_have_values();
  const auto& triangle = bodies_[body].triangle;
  MatrixXd columns = MatrixXd::Zero(triangle.size, count);
  columns.middleRows(first, count).diagonal().setOnes();
  solve_in_place(triangle, Side::lower, columns, first);
  solve_in_place(triangle, Side::transposed, columns, 0);
  return columns;
}

VectorXd SplitFactor::moved_by(std::size_t body, const VectorXd& force) const {
  must_have_values();
  if (bodies_[body].within)
    return bodies_[body].within->moved_by(force);
  VectorXd moved = force;
  solve_in_place(bodies_[body].triangle, Side::lower, moved);
  solve_in_place(bodies_[body].triangle, Side::transposed, moved);
  return moved;
}

std::size_t SplitFactor::factor_bytes() const {
  std::size_t bytes = 0;
  for (const auto& body : bodies_)
    bytes += body.engine->bytes();
  return bytes;
}

std::size_t SplitFactor::factor_nonzeros() const {
  double entries = 0;
  for (const auto& body : bodies_)
    entries += body.engine->entries();
  return static_cast<std::size_t>(entries);
}

double SplitFactor::factor_flops() const {
  double flops = 0;
  for (const auto& body : bodies_)
    flops += body.engine->flops();
  return flops;
}

} // namespace rubato::linalg
