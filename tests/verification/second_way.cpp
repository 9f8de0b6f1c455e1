// SPDX-License-Identifier: LGPL-3.0-or-later
#include "verification/second_way.hpp"

#include <fmt/format.h>

#include "verification/second_way_families.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace rubato::verification {
namespace {

constexpr double large_difference = 0.02;
/// An error of first order in the length of edges and steps is halved at level 2.
constexpr double shrinks_to = 0.7;

struct WayFamily {
  const char* name;
  WayStudy (*draw)(Dice&);
};

constexpr std::array<WayFamily, 12> way_families{{{"edges", edged_block},
                                                  {"noses", nosed_block},
                                                  {"hooks", hook},
                                                  {"rings", ring},
                                                  {"rollers", roller},
                                                  {"wedges", wedge},
                                                  {"linings", lining},
                                                  {"seals", seal},
                                                  {"bolted plates", bolted_plates},
                                                  {"stacks", stack},
                                                  {"punches", punch},
                                                  {"impacts", impact}}};

Way with_each_zone(const WayStudy& study, std::string name, const std::string& key,
                   const std::string& value) {
  Way way{std::move(name), {}, false};
  for (const auto& pair : study.pairs)
    way.changes.push_back({fmt::format("contact.{}.{}", pair.name, key), value});
  return way;
}

Way swapped_way(const WayStudy& study) {
  Way way{"swapped", {}, true};
  for (const auto& pair : study.pairs) {
    way.changes.push_back({fmt::format("contact.{}.slave", pair.name), pair.master});
    way.changes.push_back({fmt::format("contact.{}.master", pair.name), pair.slave});
  }
  return way;
}

Way scheme_way(const std::string& scheme) {
  return {scheme, {{"time.scheme", scheme}, {"time.alpha", scheme == "hht" ? "-0.1" : "~"}}, false};
}

Way explicit_way(const WayStudy& study) {
  auto way = with_each_zone(study, "explicit", "method", "penalty");
  for (const auto& pair : study.pairs)
    way.changes.push_back({fmt::format("contact.{}.coefficients.normal", pair.name),
                           fmt::format("{:.6g}", study.stiff_spring)});
  way.changes.push_back({"time.scheme", "central_difference"});
  way.changes.push_back({"time.alpha", "~"});
  way.changes.push_back({"time.step", "~"});
  return way;
}

} // namespace

std::vector<WayStudy> way_studies(std::uint32_t seed, int first, int count) {
  std::vector<WayStudy> all;
  for (int number = first; number < first + count; ++number) {
    Dice dice(seed, number);
    const auto& family = way_families[static_cast<std::size_t>(number) % way_families.size()];
    all.push_back(family.draw(dice));
    all.back().number = number;
    all.back().family = family.name;
  }
  return all;
}

std::vector<Way> ways_of(const WayStudy& study) {
  std::vector<Way> ways{{"deck", {}, false},
                        with_each_zone(study, "nodes", "integration", "nodes"),
                        swapped_way(study),
                        {"half step", {{"time.step", fmt::format("{:.12g}", study.step / 2)}}, false}};
  if (!study.solid || study.number % 5 == 0) // the whole system of solids takes long
    ways.push_back({"full", {{"solver", "full"}}, false});
  for (const auto* scheme : {"moreau_jean", "hht"})
    if (study.scheme != scheme)
      ways.push_back(scheme_way(scheme));
  if (study.fast_explicit)
    ways.push_back(explicit_way(study));
  return ways;
}

WayDifference largest_difference(const WayResult& a, const WayResult& b) {
  WayDifference largest;
  for (std::size_t k = 0; k < a.kinds.size(); ++k) {
    const double scale = std::max(a.kinds[k].scale, b.kinds[k].scale);
    for (const auto& of_a : a.kinds[k].quantities) {
      const auto found = std::ranges::find(b.kinds[k].quantities, of_a.name, &Quantity::name);
      if (found == b.kinds[k].quantities.end())
        continue;
      const auto& of_b = *found;
      for (std::size_t i = 0; i < of_a.mean.size(); ++i)
        if (const double size = std::abs(of_a.mean[i] - of_b.mean[i]); size > largest.size * scale)
          largest = {size / scale, fmt::format("{} ({})", of_a.name, i + 1)};
    }
  }
  return largest;
}

bool Comparison::large() const {
  return coarse.size > large_difference;
}

bool Comparison::explained() const {
  const auto shrinks = [](double size, double before) {
    return size >= 0 && size <= std::max(large_difference, shrinks_to * before);
  };
  return shrinks(fine, coarse.size) || shrinks(finest, shrinks_to * coarse.size);
}

namespace {

Comparison compared(const std::string& way, const WayResult& base, const WayResult& other) {
  Comparison comparison;
  comparison.way = way;
  comparison.failure = other.failure;
  comparison.friction_given = std::max(base.friction_given, other.friction_given);
  if (!base.finished())
    comparison.failure = base.failure;
  if (comparison.failure.empty())
    comparison.coarse = largest_difference(base, other);
  for (const auto* result : {&base, &other})
    for (const auto& warning : result->warnings)
      if (std::ranges::find(comparison.warnings, warning) == comparison.warnings.end())
        comparison.warnings.push_back(warning);
  comparison.warned = !comparison.warnings.empty();
  return comparison;
}

/// Runs of a study, each made once.
class WayRuns {
public:
  explicit WayRuns(const WayStudy& study) : study_(study) {}

  const WayResult& at(const Way& way, int level) {
    const auto [place, is_new] = done_.try_emplace({way.name, level});
    if (is_new)
      place->second = run_way(study_, way, level);
    return place->second;
  }

  /// The difference of a way at a level from another way, and where that is large those of both at finer
  /// levels.
  Comparison compare(const std::string& name, const Way& base, const Way& way, int level) {
    auto comparison = compared(name, at(base, 1), at(way, level));
    if (!comparison.failure.empty() || !comparison.large())
      return comparison;
    comparison.fine = difference(base, 2, way, level + 1, comparison.failure);
    if (comparison.failure.empty() && !comparison.explained())
      comparison.finest = difference(base, 4, way, level + 3, comparison.failure);
    return comparison;
  }

  int count() const { return static_cast<int>(done_.size()); }
  double seconds() const {
    double sum = 0;
    for (const auto& [name, result] : done_)
      sum += result.seconds;
    return sum;
  }

private:
  /// −1 where one of the runs does not come to its end.
  double difference(const Way& base, int base_level, const Way& way, int level, std::string& failure) {
    const auto& a = at(base, base_level);
    const auto& b = at(way, level);
    failure = a.finished() ? b.failure : a.failure;
    return failure.empty() ? largest_difference(a, b).size : -1;
  }

  const WayStudy& study_;
  std::map<std::pair<std::string, int>, WayResult> done_;
};

} // namespace

StudyComparison compare_ways(const WayStudy& study) {
  const auto ways = ways_of(study);
  const auto& base = ways.front();
  WayRuns runs(study);
  StudyComparison result;
  if (!runs.at(base, 1).finished()) {
    result.ways.push_back(compared(base.name, runs.at(base, 1), runs.at(base, 1)));
  } else {
    if (study.finest > 2)
      result.ways.push_back(runs.compare("refined", base, base, 2));
    for (std::size_t i = 1; i < ways.size(); ++i)
      result.ways.push_back(runs.compare(ways[i].name, base, ways[i], 1));
  }
  result.seconds = runs.seconds();
  result.runs = runs.count();
  return result;
}

} // namespace rubato::verification
