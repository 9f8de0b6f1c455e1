// SPDX-License-Identifier: LGPL-3.0-or-later
/// What random studies are drawn with. The numbers of a seed are the same on every machine: the standard
/// fixes its engines, not its distributions.
#pragma once

#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <random>
#include <string>

namespace rubato::verification {

class Dice {
public:
  Dice(std::uint32_t seed, int number) : engine_(seed + static_cast<std::uint32_t>(number)) {}

  double uniform(double low, double high) { return low + (high - low) * part(); }
  /// Every order of magnitude alike.
  double magnitude(double low, double high) { return low * std::pow(high / low, part()); }
  int whole(int low, int high) { return low + static_cast<int>(part() * (high - low + 1)); }
  bool chance(double probability) { return part() < probability; }
  std::string one_of(std::initializer_list<const char*> words) {
    return std::data(words)[static_cast<std::size_t>(part() * static_cast<double>(words.size()))];
  }

private:
  double part() { return static_cast<double>(engine_()) / 4294967296.; }
  std::mt19937 engine_;
};

} // namespace rubato::verification
