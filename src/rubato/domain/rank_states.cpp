// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/domain/rank_states.hpp"

#include "rubato/domain/behaviour.hpp"
#include "rubato/domain/point_numbers.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace rubato::domain {
namespace {

using element::PointRecord;

/// Calls visit(record) with the place among the records of the whole bulk of each record of this rank. How
/// many the bulk has.
template <class Visit>
std::size_t each_own_record(const mesh::Mesh& mesh, const Bulk& bulk, const RankParts& parts,
                            const Visit& visit) {
  std::size_t record = 0;
  auto own = parts.places().begin();
  for (std::size_t place = 0; place < bulk.cells.size(); ++place) {
    const bool is_own = own != parts.places().end() && *own == place;
    if (is_own)
      ++own;
    if (bulk.is_constant(place))
      continue;
    const auto kind = kind_of(bulk, *bulk.behaviour(place), mesh.type_of(bulk.cells[place]));
    for (int point = element::point_count(kind); point > 0; --point, ++record)
      if (is_own)
        visit(record);
  }
  return record;
}

std::size_t record_count(const mesh::Mesh& mesh, const Bulk& bulk, const RankParts& parts) {
  return each_own_record(mesh, bulk, parts, [](std::size_t) {});
}

} // namespace

QuadratureStates whole_states(QuadratureStates own, const mesh::Mesh& mesh, const Bulk& bulk,
                              const RankParts& parts) {
  const auto& ranks = parts.ranks();
  parts.make_whole(std::span(own.values), [&](std::size_t place) { return state_size(mesh, bulk, place); });
  own.mode_force = ranks.largest(own.mode_force);
  if (ranks.all(own.records.empty()))
    return own;
  const auto of_point = numbers_of_a_point<PointRecord>();
  const auto count = record_count(mesh, bulk, parts);
  const auto known = numbers_of(own.records);
  std::vector<double> numbers(count * of_point, 0.0);
  auto next = known.begin();
  each_own_record(mesh, bulk, parts, [&](std::size_t record) {
    std::copy_n(next, of_point, numbers.begin() + static_cast<std::ptrdiff_t>(record * of_point));
    next += static_cast<std::ptrdiff_t>(of_point);
  });
  ranks.sum(numbers);
  own.records.resize(count);
  put(numbers, own.records);
  return own;
}

QuadratureStates own_states(QuadratureStates whole, const mesh::Mesh& mesh, const Bulk& bulk,
                            const RankParts& parts) {
  if (whole.records.empty())
    return whole;
  std::vector<PointRecord> records;
  each_own_record(mesh, bulk, parts,
                  [&](std::size_t record) { records.push_back(whole.records.at(record)); });
  whole.records = std::move(records);
  return whole;
}

} // namespace rubato::domain
