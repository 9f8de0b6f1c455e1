// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/linalg/surface_in_factor.hpp"

#include "rubato/linalg/blas.hpp"
#include "rubato/linalg/cholmod_engine.hpp"

#include <algorithm>
#include <iterator>

namespace rubato::linalg {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A supernode as BLAS sees it: the triangle of its own columns, and the rows below.
struct Panel {
  explicit Panel(const Supernode& node)
      : first(node.first), columns(static_cast<int>(node.columns)),
        stride(static_cast<int>(node.rows.size())), below(stride - columns),
        rows_below(node.rows.subspan(static_cast<std::size_t>(columns))), triangle(node.values),
        rectangle(node.values + columns) {}

  /// Of several columns, by the triangle.
  void solve(int count, double* values, int values_stride) const {
    const double one = 1;
    dtrsm_("L", "L", "N", "N", &columns, &count, &one, triangle, &stride, values, &values_stride);
  }
  /// y = rectangle x, of several columns.
  void multiply(int count, const double* x, int x_stride, double* y) const {
    const double one = 1;
    const double none = 0;
    dgemm_("N", "N", &below, &count, &columns, &one, rectangle, &stride, x, &x_stride, &none, y, &below);
  }
  void solve(char transposed, double* values) const {
    const int one = 1;
    dtrsv_("L", &transposed, "N", &columns, triangle, &stride, values, &one);
  }
  /// y = rectangle x, or its transpose.
  void multiply(char transposed, double factor, const double* x, double sum_factor, double* y) const {
    const int one = 1;
    if (below > 0)
      dgemv_(&transposed, &below, &columns, &factor, rectangle, &stride, x, &one, &sum_factor, y, &one);
  }

  Index first;
  int columns;
  int stride;
  int below;
  std::span<const CholmodEngine::Index> rows_below;
  const double* triangle;
  const double* rectangle;
};

/// sum(columns, columns) += rowsᵀ rows, of the lower triangle.
void add_square(const MatrixXd& rows, std::span<const int> columns, MatrixXd& square, MatrixXd& sum) {
  const auto size = static_cast<int>(rows.cols());
  const auto inner = static_cast<int>(rows.rows());
  const double one = 1;
  const double none = 0;
  square.resize(size, size);
  dsyrk_("L", "T", &size, &inner, &one, rows.data(), &inner, &none, square.data(), &size);
  for (int j = 0; j < size; ++j) {
    double* const column = sum.col(columns[static_cast<std::size_t>(j)]).data();
    for (int i = j; i < size; ++i)
      column[columns[static_cast<std::size_t>(i)]] += square(i, j);
  }
}

/// sum += rowsᵀ rows in rows and columns from `first` on, of the lower triangle.
void add_square(const MatrixXd& rows, Index first, MatrixXd& sum) {
  const auto size = static_cast<int>(rows.cols());
  const auto inner = static_cast<int>(rows.rows());
  const auto stride = static_cast<int>(sum.rows());
  const double one = 1;
  if (rows.size() > 0)
    dsyrk_("L", "T", &size, &inner, &one, rows.data(), &inner, &one, &sum(first, first), &stride);
}

/// Where each of some numbers stands among more of them, both ascending.
void find_among(std::span<const int> some, std::span<const int> more, std::vector<Index>& places) {
  places.clear();
  std::size_t at = 0;
  for (const int number : some) {
    while (more[at] != number)
      ++at;
    places.push_back(static_cast<Index>(at));
  }
}

/// firstᵀ second, of the last rows of both.
MatrixXd product_of_ends(const MatrixXd& first, const MatrixXd& second, Index rows) {
  if (rows == 0)
    return MatrixXd::Zero(first.cols(), second.cols());
  MatrixXd product(first.cols(), second.cols());
  const auto height = static_cast<int>(first.cols());
  const auto width = static_cast<int>(second.cols());
  const auto inner = static_cast<int>(rows);
  const auto first_stride = static_cast<int>(first.rows());
  const auto second_stride = static_cast<int>(second.rows());
  const double one = 1;
  const double none = 0;
  dgemm_("T", "N", &height, &width, &inner, &one, first.data() + first.rows() - rows, &first_stride,
         second.data() + second.rows() - rows, &second_stride, &none, product.data(), &height);
  return product;
}

} // namespace

SurfaceInFactor::SurfaceInFactor(const CholmodEngine& engine, Index first_surface, Index largest_whole)
    : engine_(engine), node_of_(static_cast<std::size_t>(engine.order())), parent_(engine.supernode_count()),
      path_(engine.supernode_count()) {
  const auto order = engine.permutation();
  const auto nodes = static_cast<Index>(engine.supernode_count());
  for (Index s = 0; s < nodes; ++s) {
    const auto node = engine.supernode(static_cast<std::size_t>(s));
    std::fill_n(node_of_.begin() + node.first, node.columns, s);
  }
  for (Index s = nodes - 1; s >= 0; --s) {
    const auto node = engine.supernode(static_cast<std::size_t>(s));
    const auto columns = static_cast<std::size_t>(node.columns);
    const bool is_root = node.rows.size() == columns;
    const auto parent = is_root ? -1 : node_of_[static_cast<std::size_t>(node.rows[columns])];
    parent_[static_cast<std::size_t>(s)] = parent;
    path_[static_cast<std::size_t>(s)] =
        node.columns + (is_root ? 0 : path_[static_cast<std::size_t>(parent)]);
  }
  std::vector<char> on_path(parent_.size(), 0);
  for (std::size_t place = 0; place < order.size(); ++place) {
    if (order[place] < first_surface)
      continue;
    const Index node = node_of_[place];
    const auto position = static_cast<Index>(places_.size());
    if (node_of_block_.empty() || node_of_block_.back() != node ||
        position - block_starts_.back() == largest_block) {
      block_starts_.push_back(position);
      node_of_block_.push_back(node);
    }
    places_.push_back(static_cast<Index>(place));
    on_path[static_cast<std::size_t>(node)] = 1;
  }
  block_starts_.push_back(size());
  for (Index s = 0; s < nodes; ++s)
    if (on_path[static_cast<std::size_t>(s)] != 0) {
      above_.push_back(s);
      if (const Index parent = parent_[static_cast<std::size_t>(s)]; parent >= 0)
        on_path[static_cast<std::size_t>(parent)] = 1;
    }
  is_formed_whole_ = size() <= largest_whole && is_sooner_read_than_solved();
}

bool SurfaceInFactor::is_sooner_read_than_solved() const {
  double read = 0;
  for (const Index s : above_) {
    const auto node = engine_.supernode(static_cast<std::size_t>(s));
    const auto columns = static_cast<double>(node.columns);
    read += 2 * columns * (static_cast<double>(node.rows.size()) - (columns - 1) / 2);
  }
  return static_cast<double>(size()) * static_cast<double>(size() + 1) / 2 < read;
}

void SurfaceInFactor::load(const VectorXd& force, Eigen::Ref<VectorXd> half_way) const {
  VectorXd loaded = VectorXd::Zero(half_way.size());
  loaded(places_) = force;
  VectorXd carried(half_way.size());
  for (const Index s : above_) {
    const Panel panel(engine_.supernode(static_cast<std::size_t>(s)));
    auto own = loaded.segment(panel.first, panel.columns);
    if (own.isZero(0))
      continue;
    panel.solve('N', own.data());
    panel.multiply('N', 1, own.data(), 0, carried.data());
    for (std::size_t i = 0; i < panel.rows_below.size(); ++i)
      loaded[panel.rows_below[i]] -= carried[static_cast<Index>(i)];
  }
  half_way += loaded;
}

VectorXd SurfaceInFactor::values(const Eigen::Ref<const VectorXd>& half_way) const {
  VectorXd solution = half_way;
  VectorXd below(half_way.size());
  for (std::size_t k = above_.size(); k > 0; --k) {
    const Panel panel(engine_.supernode(static_cast<std::size_t>(above_[k - 1])));
    for (std::size_t i = 0; i < panel.rows_below.size(); ++i)
      below[static_cast<Index>(i)] = solution[panel.rows_below[i]];
    double* own = solution.data() + panel.first;
    panel.multiply('T', -1, below.data(), 1, own);
    panel.solve('T', own);
  }
  return solution(places_);
}

VectorXd SurfaceInFactor::moved_by(const VectorXd& force) const {
  VectorXd half_way = VectorXd::Zero(engine_.order());
  load(force, half_way);
  return values(half_way);
}

MatrixXd SurfaceInFactor::half_way_of(std::size_t block) const {
  const Index begin = block_starts_[block];
  const Index count = block_starts_[block + 1] - begin;
  const Index bottom = node_of_block_[block];
  const Index length = path_[static_cast<std::size_t>(bottom)];
  MatrixXd on_path = MatrixXd::Zero(length, count);
  const Index first = engine_.supernode(static_cast<std::size_t>(bottom)).first;
  for (Index k = 0; k < count; ++k)
    on_path(places_[static_cast<std::size_t>(begin + k)] - first, k) = 1;
  const auto row_on_path = [&](Index place) {
    const Index node = node_of_[static_cast<std::size_t>(place)];
    return length - path_[static_cast<std::size_t>(node)] + place -
           engine_.supernode(static_cast<std::size_t>(node)).first;
  };
  const auto width = static_cast<int>(count);
  const auto stride = static_cast<int>(length);
  MatrixXd carried;
  for (Index s = bottom; s >= 0; s = parent_[static_cast<std::size_t>(s)]) {
    const Panel panel(engine_.supernode(static_cast<std::size_t>(s)));
    double* own = on_path.data() + length - path_[static_cast<std::size_t>(s)];
    panel.solve(width, own, stride);
    if (panel.below == 0)
      continue;
    carried.resize(panel.below, count);
    panel.multiply(width, own, stride, carried.data());
    for (std::size_t i = 0; i < panel.rows_below.size(); ++i)
      on_path.row(row_on_path(panel.rows_below[i])) -= carried.row(static_cast<Index>(i));
  }
  return on_path;
}

/// How many rows.
Index SurfaceInFactor::path_end_shared_by(std::size_t first, std::size_t second) const {
  Index a = node_of_block_[first];
  Index b = node_of_block_[second];
  while (a != b) {
    auto& lower = a < b ? a : b;
    lower = parent_[static_cast<std::size_t>(lower)];
    if (lower < 0)
      return 0;
  }
  return path_[static_cast<std::size_t>(a)];
}

MatrixXd SurfaceInFactor::compliance(std::size_t first, const MatrixXd& half_way_of_first, std::size_t second,
                                     const MatrixXd& half_way_of_second) const {
  return product_of_ends(half_way_of_first, half_way_of_second, path_end_shared_by(first, second));
}

MatrixXd SurfaceInFactor::between(const SparseMatrix& forces, Index first) const {
  MatrixXd sum = MatrixXd::Zero(forces.cols(), forces.cols());
  MatrixXd square;
  auto parts = parts_of(forces, first);
  for (const Index s : above_) {
    auto& part = parts[static_cast<std::size_t>(s)];
    if (part.columns.empty())
      continue;
    const Panel panel(engine_.supernode(static_cast<std::size_t>(s)));
    panel.solve(static_cast<int>(part.rows.cols()), part.rows.data(), panel.columns);
    carry_up(static_cast<std::size_t>(s), parts);
    add_square(part.rows, part.columns, square, sum);
    part.rows.resize(0, 0);
  }
  sum.triangularView<Eigen::StrictlyUpper>() = sum.transpose();
  return sum;
}

/// With the forces in their rows.
std::vector<SurfaceInFactor::Part> SurfaceInFactor::parts_of(const SparseMatrix& forces, Index first) const {
  std::vector<Part> parts(parent_.size());
  const auto for_each_entry = [&](const auto& take) {
    for (int column = 0; column < forces.cols(); ++column)
      for (SparseMatrix::InnerIterator entry(forces, column); entry; ++entry)
        if (const Index position = entry.row() - first; position >= 0 && position < size()) {
          const Index place = places_[static_cast<std::size_t>(position)];
          const Index node = node_of_[static_cast<std::size_t>(place)];
          take(parts[static_cast<std::size_t>(node)], column, node, place, entry.value());
        }
  };
  for_each_entry([](Part& part, int column, Index, Index, double) {
    if (part.columns.empty() || part.columns.back() != column)
      part.columns.push_back(column);
  });
  std::vector<int> both;
  for (const Index s : above_) {
    auto& part = parts[static_cast<std::size_t>(s)];
    part.rows.setZero(engine_.supernode(static_cast<std::size_t>(s)).columns,
                      static_cast<Index>(part.columns.size()));
    if (const Index parent = parent_[static_cast<std::size_t>(s)]; parent >= 0) {
      auto& above = parts[static_cast<std::size_t>(parent)].columns;
      both.clear();
      std::ranges::set_union(part.columns, above, std::back_inserter(both));
      above.swap(both);
    }
  }
  for_each_entry([&](Part& part, int column, Index node, Index place, double value) {
    const auto at = std::ranges::lower_bound(part.columns, column) - part.columns.begin();
    part.rows(place - engine_.supernode(static_cast<std::size_t>(node)).first, at) += value;
  });
  return parts;
}

/// Takes what a supernode's rows carry off the rows of those above it.
void SurfaceInFactor::carry_up(std::size_t node, std::vector<Part>& parts) const {
  const Panel panel(engine_.supernode(node));
  if (panel.below == 0)
    return;
  const auto& part = parts[node];
  MatrixXd carried(panel.below, part.rows.cols());
  panel.multiply(static_cast<int>(part.rows.cols()), part.rows.data(), panel.columns, carried.data());
  std::vector<Index> columns_above;
  each_above(node, [&](Index above, std::size_t begin, std::size_t end) {
    auto& rows_above = parts[static_cast<std::size_t>(above)].rows;
    const Index first = engine_.supernode(static_cast<std::size_t>(above)).first;
    find_among(part.columns, parts[static_cast<std::size_t>(above)].columns, columns_above);
    for (Index column = 0; column < carried.cols(); ++column) {
      double* const to = rows_above.col(columns_above[static_cast<std::size_t>(column)]).data();
      for (std::size_t i = begin; i < end; ++i)
        to[panel.rows_below[i] - first] -= carried(static_cast<Index>(i), column);
    }
  });
}

/// Calls take(supernode above, first, last) with the rows below a supernode that belong to one above it.
template <class Take> void SurfaceInFactor::each_above(std::size_t node, const Take& take) const {
  const auto below = Panel(engine_.supernode(node)).rows_below;
  for (std::size_t begin = 0, end = 0; begin < below.size(); begin = end) {
    const Index above = node_of_[static_cast<std::size_t>(below[begin])];
    while (end < below.size() && node_of_[static_cast<std::size_t>(below[end])] == above)
      ++end;
    take(above, begin, end);
  }
}

MatrixXd SurfaceInFactor::whole() const {
  MatrixXd sum = MatrixXd::Zero(size(), size());
  auto strips = empty_strips();
  for (const Index s : above_) {
    auto& strip = strips[static_cast<std::size_t>(s)];
    put_units(static_cast<std::size_t>(s), strip);
    const Panel panel(engine_.supernode(static_cast<std::size_t>(s)));
    panel.solve(static_cast<int>(strip.count), strip.rows.data(), panel.columns);
    carry_up(static_cast<std::size_t>(s), strips);
    add_square(strip.rows, strip.first, sum);
    strip.rows.resize(0, 0);
  }
  sum.triangularView<Eigen::StrictlyUpper>() = sum.transpose();
  return sum;
}

/// What is below a supernode in the tree was eliminated before it: its positions come before its own.
std::vector<SurfaceInFactor::Strip> SurfaceInFactor::empty_strips() const {
  std::vector<Strip> strips(parent_.size());
  const auto positions_before = [&](Index place) {
    return static_cast<Index>(std::ranges::lower_bound(places_, place) - places_.begin());
  };
  for (auto& strip : strips)
    strip.first = size();
  for (const Index s : above_) {
    const auto node = engine_.supernode(static_cast<std::size_t>(s));
    auto& strip = strips[static_cast<std::size_t>(s)];
    strip.first = std::min(strip.first, positions_before(node.first));
    strip.count = positions_before(node.first + node.columns) - strip.first;
    if (const Index parent = parent_[static_cast<std::size_t>(s)]; parent >= 0) {
      auto& first = strips[static_cast<std::size_t>(parent)].first;
      first = std::min(first, strip.first);
    }
  }
  return strips;
}

/// The unit forces at the positions of a supernode.
void SurfaceInFactor::put_units(std::size_t node, Strip& strip) const {
  const auto supernode = engine_.supernode(node);
  if (strip.rows.size() == 0)
    strip.rows.setZero(supernode.columns, strip.count);
  for (Index k = strip.count - 1; k >= 0; --k) {
    const Index row = places_[static_cast<std::size_t>(strip.first + k)] - supernode.first;
    if (row < 0)
      return;
    strip.rows(row, k) += 1;
  }
}

/// Takes what a supernode's rows carry off the rows of those above it.
void SurfaceInFactor::carry_up(std::size_t node, std::vector<Strip>& strips) const {
  const Panel panel(engine_.supernode(node));
  if (panel.below == 0)
    return;
  const auto& strip = strips[node];
  MatrixXd carried(panel.below, strip.count);
  panel.multiply(static_cast<int>(strip.count), strip.rows.data(), panel.columns, carried.data());
  each_above(node, [&](Index above, std::size_t begin, std::size_t end) {
    auto& to = strips[static_cast<std::size_t>(above)];
    const auto supernode = engine_.supernode(static_cast<std::size_t>(above));
    if (to.rows.size() == 0)
      to.rows.setZero(supernode.columns, to.count);
    for (Index column = 0; column < carried.cols(); ++column) {
      double* const rows = to.rows.col(strip.first - to.first + column).data();
      for (std::size_t i = begin; i < end; ++i)
        rows[panel.rows_below[i] - supernode.first] -= carried(static_cast<Index>(i), column);
    }
  });
}

std::size_t SurfaceInFactor::bytes_of_compliance() const {
  if (is_formed_whole())
    return static_cast<std::size_t>(size() * size()) * sizeof(double);
  std::size_t numbers = 0;
  for (std::size_t block = 0; block < node_of_block_.size() && block_starts_[block] < most_formed; ++block) {
    const auto count = static_cast<std::size_t>(block_starts_[block + 1] - block_starts_[block]);
    const auto path = static_cast<std::size_t>(path_[static_cast<std::size_t>(node_of_block_[block])]);
    numbers += count * (path + static_cast<std::size_t>(block_starts_[block + 1]));
  }
  return numbers * sizeof(double);
}

} // namespace rubato::linalg
