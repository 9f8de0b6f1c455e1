// SPDX-License-Identifier: LGPL-3.0-or-later
/// Cells dealt out to threads, so that sums over cells at their nodes are those of one thread to the last
/// bit.
#pragma once

#include "rubato/core/threads.hpp"
#include "rubato/mesh/mesh.hpp"

#include <cstdint>
#include <exception>
#include <limits>
#include <span>
#include <vector>

namespace rubato::domain {

/// A share is a part of the body: its cells lie together in space. Nodes inside it are added to by its cells
/// alone, in ascending order. What border cells, those with a node of several shares, add to such nodes is
/// kept, and added in ascending order when all shares are done.
///
/// Cells go by their places in the list they were dealt from.
class WorkShares {
public:
  /// Fewer cells are not worth a thread.
  static constexpr std::size_t smallest = 512;
  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

  /// Of no cells.
  WorkShares() = default;
  WorkShares(const mesh::Mesh& mesh, std::span<const mesh::CellIndex> cells, const Threads& threads);

  int count() const { return static_cast<int>(starts_.size()) - 1; }
  const Threads& threads() const { return threads_; }
  /// The cells of one share, ascending.
  std::span<const std::uint32_t> of(int share) const {
    const auto s = static_cast<std::size_t>(share);
    return std::span(places_).subspan(starts_[s], starts_[s + 1] - starts_[s]);
  }
  /// Whether several shares have cells at this node.
  bool is_shared(mesh::NodeIndex node) const {
    return !shared_.empty() && shared_[static_cast<std::size_t>(node)] != 0;
  }
  /// Border cells, ascending.
  std::span<const std::uint32_t> border() const { return border_; }
  /// The place of a cell among border cells; −1 of all others.
  std::int32_t place_in_border(std::size_t cell) const { return in_border_.empty() ? -1 : in_border_[cell]; }

  /// Calls work(share, cell) for every cell, shares at the same time, and throws what the first of the cells
  /// that throw has thrown.
  template <class Work> void each(const Work& work) const {
    each_with_next([&](int share, std::size_t cell, std::size_t) { work(share, cell); });
  }
  /// The same with the cell that comes next in the share, `none` after the last.
  template <class Work> void each_with_next(const Work& work) const {
    std::vector<Thrown> thrown(static_cast<std::size_t>(count()));
    threads_.each(count(), [&](int share) {
      const auto cells = of(share);
      std::size_t i = 0;
      try {
        for (; i < cells.size(); ++i)
          work(share, std::size_t{cells[i]}, i + 1 < cells.size() ? std::size_t{cells[i + 1]} : none);
      } catch (...) {
        thrown[static_cast<std::size_t>(share)] = {cells[i], std::current_exception()};
      }
    });
    rethrow_first(thrown);
  }

private:
  struct Thrown {
    std::uint32_t cell = 0;
    std::exception_ptr what;
  };
  static void rethrow_first(std::span<const Thrown> thrown);
  void find_border(const mesh::Mesh& mesh, std::span<const mesh::CellIndex> cells);

  Threads threads_;
  std::vector<std::uint32_t> places_;
  std::vector<std::size_t> starts_ = {0, 0};
  std::vector<char> shared_; ///< of nodes of the mesh; empty with one share
  std::vector<std::uint32_t> border_;
  std::vector<std::int32_t> in_border_; ///< of each cell; empty with one share
};

} // namespace rubato::domain
