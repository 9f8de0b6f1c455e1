// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/time/step_control.hpp"

#include "rubato/study/study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <string>

namespace rubato::time {
namespace {

/// Instants that differ by less than this part of a step are the same but for rounding.
constexpr double sliver = 1e-6;

/// A rest shorter than this part of a step is taken by the last one: in a step of its own, as where a step of
/// 1/3 was written as 0.333, bodies have next to nothing but their inertia, and what meets then meets too
/// hard.
constexpr double short_rest = 1e-2;

/// Steps whose lengths differ by less than this part are the same but for rounding.
constexpr double same_length = 1e-9;

} // namespace

double as_meant(double t, double begin) {
  constexpr int digits = 12;
  constexpr double rounding = 4 * std::numeric_limits<double>::epsilon();
  const double shown = std::stod(fmt::format("{:.{}g}", t, digits));
  return std::abs(shown - t) <= rounding * std::max(std::abs(t), std::abs(begin)) ? shown : t;
}

std::vector<double> with_stops(std::vector<double> instants, std::span<const double> stops) {
  for (const double stop : stops) {
    const auto after = std::ranges::lower_bound(instants, stop);
    if (after == instants.begin() || after == instants.end())
      continue;
    const double before = *(after - 1);
    const double near = sliver * (*after - before);
    if (stop - before > near && *after - stop > near)
      instants.insert(after, stop);
  }
  return instants;
}

namespace {

/// Ends of even steps that a stop nearly meets move to it: what would be left between is no step.
void move_to_stops(std::vector<double>& ends, double step, std::span<const double> stops) {
  if (ends.size() < 3)
    return;
  const auto between = std::span(ends).subspan(1, ends.size() - 2);
  for (const double stop : stops) {
    const auto near = std::ranges::lower_bound(between, stop - short_rest * step);
    if (near != between.end() && std::abs(*near - stop) <= short_rest * step &&
        std::abs(*near - stop) > sliver * step)
      *near = stop;
  }
}

std::vector<double> listed_or_even(const study::TimeStepping& settings) {
  std::vector<double> instants{settings.begin};
  if (!settings.instants.empty()) {
    std::ranges::copy_if(settings.instants, std::back_inserter(instants),
                         [&](double t) { return t > settings.begin; });
    return instants;
  }
  // Multiples of the step, not sums: a thousand additions of 1e-3 are not 1.
  const double span = settings.end - settings.begin;
  const auto steps = static_cast<std::int64_t>(std::ceil(span / settings.step - short_rest));
  for (std::int64_t i = 1; i < steps; ++i)
    instants.push_back(as_meant(settings.begin + static_cast<double>(i) * settings.step, settings.begin));
  instants.push_back(settings.end);
  move_to_stops(instants, settings.step, settings.stops);
  return instants;
}

} // namespace

std::vector<double> instants_of(const study::TimeStepping& settings) {
  return with_stops(listed_or_even(settings), settings.stops);
}

std::vector<double> instants_of_varying(const study::TimeStepping& settings) {
  if (!settings.instants.empty())
    return instants_of(settings);
  return with_stops({settings.begin, settings.end}, settings.stops);
}

double length_after(double length, int iterations, double longest) {
  constexpr double usual = 6; // iterations that neither ask for shorter steps nor allow longer ones
  constexpr double least_change = 1.2;
  const double change = std::clamp(std::sqrt(usual / std::max(1, iterations)), 0.5, 2.0);
  const bool keeps = change < least_change && change > 1 / least_change;
  return std::min(longest, keeps ? length : change * length);
}

namespace {

bool are_same(double length, double usual) {
  return std::abs(length - usual) <= same_length * usual;
}

/// Which of ascending lengths it is but for rounding, a part of each of them; their end when it is none.
auto same_among(const std::vector<double>& lengths, double length, double parts = 1) {
  auto known = std::ranges::lower_bound(lengths, length * parts * (1 - 2 * same_length));
  while (known != lengths.end() && *known <= length * parts * (1 + 2 * same_length) &&
         !are_same(length, *known / parts))
    ++known;
  return known != lengths.end() && are_same(length, *known / parts) ? known : lengths.end();
}

/// The step of the settings, or the lengths between listed instants, each once, ascending.
std::vector<double> distinct_lengths(const study::TimeStepping& settings, std::span<const double> instants) {
  if (settings.instants.empty())
    return {settings.step};
  std::vector<double> lengths;
  for (std::size_t i = 1; i < instants.size(); ++i) {
    const double length = instants[i] - instants[i - 1];
    if (same_among(lengths, length) == lengths.end())
      lengths.insert(std::ranges::upper_bound(lengths, length), length);
  }
  return lengths;
}

double first_length(const study::TimeStepping& settings, std::span<const double> instants) {
  const double first = settings.step > 0 ? settings.step : instants[1] - instants[0];
  return std::min(first, *settings.max_step);
}

} // namespace

StepControl::StepControl(const study::TimeStepping& settings, double start)
    : instants_(settings.max_step ? instants_of_varying(settings) : instants_of(settings)), now_(start),
      usual_lengths_(distinct_lengths(settings, instants_)), parts_(settings.cut_parts),
      levels_(settings.cut_levels), longest_(settings.max_step.value_or(0)),
      wanted_(settings.max_step ? first_length(settings, instants_) : 0) {
  next_ = static_cast<std::size_t>(std::ranges::upper_bound(instants_, start) - instants_.begin());
}

/// Two equal steps stand for one and a short rest.
double StepControl::target() const {
  if (!varies())
    return ends_.empty() ? instants_[next_] : ends_.back().instant;
  const double end = instants_[next_];
  const double left = end - now_;
  if (left <= wanted_ * (1 + short_rest))
    return end;
  return now_ + (left < 2 * wanted_ ? left / 2 : wanted_);
}

double StepControl::length() const {
  if (varies())
    return are_same(target() - now_, wanted_) ? wanted_ : target() - now_;
  const double difference = target() - now_;
  const double parts = std::pow(parts_, level());
  const auto usual = same_among(usual_lengths_, difference, parts);
  return usual == usual_lengths_.end() ? difference : *usual / parts;
}

/// The end of a shorter list may differ from an instant of this one by rounding. A cut interval whose end is
/// listed no more is left for the next listed instant.
void StepControl::go_on(const Place& place) {
  now_ = place.now;
  next_ = static_cast<std::size_t>(std::ranges::upper_bound(instants_, now_) - instants_.begin());
  const bool two_left = next_ + 1 < instants_.size();
  if (place.finished && two_left && instants_[next_] - now_ <= sliver * (instants_[next_ + 1] - now_))
    ++next_;
  const bool listed =
      next_ < instants_.size() && !place.ends.empty() && place.ends.front().instant == instants_[next_];
  ends_ = listed ? place.ends : std::vector<End>();
  if (varies() && place.wanted > 0)
    wanted_ = place.wanted;
}

void StepControl::accept(int iterations) {
  if (varies()) {
    const double end = target();
    const double length = this->length();
    now_ = end;
    if (end == instants_[next_])
      ++next_;
    cuts_ = 0;
    // A step that an instant cut short says nothing of longer ones.
    if (are_same(length, wanted_) || length_after(length, iterations, longest_) < wanted_)
      wanted_ = length_after(length, iterations, longest_);
    return;
  }
  now_ = target();
  if (!ends_.empty())
    ends_.pop_back();
  if (ends_.empty())
    ++next_;
}

bool StepControl::cut() {
  const double end = target();
  if (varies()) {
    if (cuts_ == levels_)
      return false;
    ++cuts_;
    wanted_ = (end - now_) / parts_;
    return true;
  }
  const int deeper = level() + 1;
  if (deeper > levels_)
    return false;
  if (ends_.empty())
    ends_.push_back({end, 0});
  ends_.back().level = deeper;
  const double length = end - now_;
  for (int part = parts_ - 1; part >= 1; --part)
    ends_.push_back({now_ + length * part / parts_, deeper});
  return true;
}

} // namespace rubato::time
