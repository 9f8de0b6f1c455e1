// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/mesh/nodal_samples.hpp"

#include "rubato/core/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <mutex>
#include <optional>
#include <span>
#include <utility>

namespace rubato::mesh {
namespace {

using Eigen::Vector3d;

constexpr double none = std::numeric_limits<double>::quiet_NaN();
/// Shape functions below it are 0 but for rounding.
constexpr double no_share = 1e-9;
/// Values at one place that differ by less, in parts of those around it, are one.
constexpr double same_value = 1e-5;

std::size_t index_of(NodeIndex node) {
  return static_cast<std::size_t>(node);
}

/// Which nodes of a file have their place where a node of the mesh is.
class Partners {
public:
  Partners(const std::vector<Vector3d>& places, double tolerance)
      : places_(places), tolerance_(tolerance), tree_(boxes_around(places, tolerance)) {}

  std::vector<std::size_t> of(std::size_t node, const Vector3d& place) const {
    if (node < places_.size() && is_at(node, place))
      return {node};
    std::vector<std::size_t> found;
    for (const auto index : tree_.boxes_at(place))
      if (is_at(index_of(index), place))
        found.push_back(index_of(index));
    return found;
  }

private:
  bool is_at(std::size_t node, const Vector3d& place) const {
    return (places_[node] - place).norm() <= tolerance_;
  }

  const std::vector<Vector3d>& places_;
  double tolerance_;
  BoxTree tree_;
};

/// Two instants and the share of the second.
struct Between {
  std::size_t before = 0;
  std::size_t after = 0;
  double share = 0;
};

Between between(std::span<const double> instants, double t) {
  const auto later = std::ranges::upper_bound(instants, t);
  const auto after = static_cast<std::size_t>(later - instants.begin());
  if (later == instants.begin())
    return {0, 0, 0};
  if (later == instants.end())
    return {after - 1, after - 1, 0};
  return {after - 1, after, (t - instants[after - 1]) / (instants[after] - instants[after - 1])};
}

/// A value that may be one of several at a place, and the largest of those around it.
struct Candidate {
  double value = 0;
  double scale = 0;
};

class FieldAtNodes : public SampledField {
public:
  FieldAtNodes(std::shared_ptr<const PlaceFinder> cells, const NodalSamples& samples)
      : cells_(std::move(cells)), called_(samples.called), instants_(samples.instants) {
    take_values(samples);
    for (std::size_t i = 0; i < samples.places.size(); ++i)
      if (std::ranges::none_of(samples.values, [&](const auto& values) { return !std::isfinite(values[i]); }))
        places_.push_back(samples.places[i]);
  }

  bool varies_in_time() const override { return instants_.size() > 1; }

  double at(std::span<const double, 3> place, double t) const override {
    const auto when = between(instants_, t);
    std::optional<NodeIndex> lacking;
    std::vector<Candidate> found;
    for (const auto& share : shares_at({place[0], place[1], place[2]}))
      add(share, when, found, lacking);
    if (found.empty())
      refuse(place, lacking);
    check_alike(place, found);
    return found.front().value;
  }

private:
  /// The nodes at the place, else the cells. Places come again at each instant: they are kept then.
  std::vector<CellShare> shares_at(const std::array<double, 3>& place) const {
    if (!varies_in_time())
      return find_shares(place);
    const std::lock_guard lock(mutex_);
    const auto known = known_.find(place);
    return known != known_.end() ? known->second : known_.emplace(place, find_shares(place)).first->second;
  }

  std::vector<CellShare> find_shares(const std::array<double, 3>& place) const {
    const Vector3d x(place[0], place[1], place[2]);
    std::vector<CellShare> shares;
    for (const auto node : cells_->nodes_at(x))
      shares.push_back({{node}, {1.0}});
    return shares.empty() ? cells_->cells_at(x) : shares;
  }

  void take_values(const NodalSamples& samples) {
    const auto& points = cells_->points();
    const Partners partners(samples.places, cells_->tolerance());
    values_.assign(samples.values.size(), std::vector<double>(points.size(), none));
    for (std::size_t node = 0; node < points.size(); ++node) {
      const auto found = partners.of(node, points[node]);
      for (std::size_t i = 0; i < values_.size(); ++i)
        values_[i][node] = common_value(samples.values[i], found, node);
    }
  }

  /// Of nodes of the file at one place; none where there is no node.
  double common_value(const std::vector<double>& values, std::span<const std::size_t> nodes,
                      std::size_t node) const {
    double common = none;
    for (const auto i : nodes) {
      if (!std::isfinite(values[i]))
        continue;
      if (!std::isnan(common) && values[i] != common)
        throw InputError(fmt::format("{} has several values at {}, {} and {}, expected one", called_,
                                     cells_->label_of(static_cast<NodeIndex>(node)), common, values[i]));
      common = values[i];
    }
    return common;
  }

  double value_at(NodeIndex node, const Between& when) const {
    const double before = values_[when.before][index_of(node)];
    return when.share == 0 ? before : before + when.share * (values_[when.after][index_of(node)] - before);
  }

  /// A node without value that the cell needs becomes `lacking`.
  void add(const CellShare& share, const Between& when, std::vector<Candidate>& found,
           std::optional<NodeIndex>& lacking) const {
    Candidate candidate;
    for (std::size_t i = 0; i < share.nodes.size(); ++i) {
      if (std::abs(share.weights[i]) <= no_share)
        continue;
      const double value = value_at(share.nodes[i], when);
      if (std::isnan(value)) {
        lacking = share.nodes[i];
        return;
      }
      candidate.value += share.weights[i] * value;
      candidate.scale = std::max(candidate.scale, std::abs(value));
    }
    found.push_back(candidate);
  }

  void check_alike(std::span<const double, 3> place, const std::vector<Candidate>& found) const {
    const auto& first = found.front();
    for (const auto& other : found)
      if (std::abs(other.value - first.value) > same_value * std::max(first.scale, other.scale))
        throw InputError(fmt::format("{} has several values at {} where bodies touch, {:.6g} and {:.6g}, "
                                     "expected one",
                                     called_, shown_place(place), first.value, other.value));
  }

  [[noreturn]] void refuse(std::span<const double, 3> place, const std::optional<NodeIndex>& lacking) const {
    if (!lacking)
      throw InputError(
          fmt::format("{} is asked for at {}, where no cell of the mesh is", called_, shown_place(place)));
    const auto nearest = distance_to_nearest(cells_->points()[index_of(*lacking)]);
    const auto has = nearest ? fmt::format("the nearest node that has one is {:.4g} away", *nearest)
                             : std::string("no node has one");
    throw InputError(fmt::format("{} has no value at node {}, {}", called_, cells_->label_of(*lacking), has));
  }

  /// To a node of the file that has a value; nothing when none has.
  std::optional<double> distance_to_nearest(const Vector3d& place) const {
    std::optional<double> least;
    for (const auto& known : places_)
      if (const double distance = (known - place).norm(); !least || distance < *least)
        least = distance;
    return least;
  }

  std::shared_ptr<const PlaceFinder> cells_;
  std::string called_;
  std::vector<Vector3d> places_; ///< of the nodes of the file that have a value at every instant
  std::vector<double> instants_;
  std::vector<std::vector<double>> values_; ///< of each instant, one a node of the mesh
  mutable std::mutex mutex_;
  mutable std::map<std::array<double, 3>, std::vector<CellShare>> known_; ///< guarded by the mutex
};

} // namespace

std::shared_ptr<const SampledField> sampled_field(std::shared_ptr<const PlaceFinder> cells,
                                                  const NodalSamples& samples) {
  return std::make_shared<const FieldAtNodes>(std::move(cells), samples);
}

} // namespace rubato::mesh
