// SPDX-License-Identifier: LGPL-3.0-or-later
/// Which instants a run aims at, and how it gets there when steps fail: cut, and grow back.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace rubato::study {
struct TimeStepping;
} // namespace rubato::study

namespace rubato::time {

/// An instant that was computed, as a number of 12 digits when it is that but for rounding: 9 times 0.001 is
/// 0.009, not 0.009000000000000001. `begin`: what it was counted from.
double as_meant(double t, double begin);

/// Ascending instants with those of `stops` among them that lie between the first and the last and are not
/// there yet.
std::vector<double> with_stops(std::vector<double> instants, std::span<const double> stops);

/// The instants a run must reach, ascending, the first one being the start; its stops among them.
std::vector<double> instants_of(const study::TimeStepping& settings);

/// The instants that steps of varying length must end at: those that are listed, the end and the stops.
std::vector<double> instants_of_varying(const study::TimeStepping& settings);

/// The length of the next step after one that took some iterations of the bulk: grows where they were few.
/// Lengths that would differ little stay: what is factored for one serves the next.
double length_after(double length, int iterations, double longest);

/// Walks through the list of instants. A failed step is cut into `cut_parts`; the parts may be cut again,
/// `cut_levels` deep. Parts that succeed bring the walk back to the list, so growing back needs no memory
/// beyond the stack of ends. Where the settings have a longest step, lengths follow the iterations of the
/// bulk instead, and only instants that steps must end at are hit. A value: copying it copies the place in
/// the list.
class StepControl {
public:
  StepControl(const study::TimeStepping& settings, double start);

  bool finished() const { return ends_.empty() && next_ >= instants_.size(); }
  double now() const { return now_; }
  /// The end of the step to try. Call only while not finished.
  double target() const;
  /// Length of the step to try; the very same number for steps that differ by the rounding of instants only,
  /// so that what is factored for one serves the others.
  double length() const;
  /// Whether target() is one of the listed instants.
  bool target_is_listed() const { return varies() ? target() == instants_[next_] : ends_.size() <= 1; }
  /// How often the interval between two listed instants has been cut to get this step.
  int level() const { return varies() ? cuts_ : ends_.empty() ? 0 : ends_.back().level; }

  /// The end of a part of a cut step, and how deep it is cut.
  struct End {
    double instant;
    int level;
    bool operator==(const End&) const = default;
  };
  /// Where the walk stands: what a run that is resumed goes on from.
  struct Place {
    double now = 0;
    std::vector<End> ends; ///< of the parts of the interval to the next listed instant, the nearest last
    bool finished = false;
    double wanted = 0; ///< of steps of varying length: that of the next one; else 0
    bool operator==(const Place&) const = default;
  };
  Place place() const { return {now_, ends_, finished(), wanted_}; }
  /// Goes on from a place that a walk through this list, or a shorter one, has reached.
  void go_on(const Place& place);

  /// `iterations`: of the bulk in the step.
  void accept(int iterations = 0);
  bool can_cut() const { return level() < levels_; }
  /// Cuts the step; false when the levels are used up.
  bool cut();

private:
  bool varies() const { return longest_ > 0; }

  std::vector<double> instants_;
  std::size_t next_ = 1;
  std::vector<End> ends_; ///< ends of the parts of the interval to instants_[next_], the nearest last
  double now_ = 0;
  std::vector<double> usual_lengths_; ///< of intervals that are not cut, each once, ascending
  int parts_ = 2;
  int levels_ = 12;
  double longest_ = 0; ///< of steps of varying length; else 0
  double wanted_ = 0;  ///< likewise, of the next one
  int cuts_ = 0;       ///< likewise, one after the other
};

} // namespace rubato::time
