// SPDX-License-Identifier: LGPL-3.0-or-later
#include "verification/solids_sweep.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

namespace rubato::verification {
namespace {

struct Family {
  std::string_view name;
  SolidVariant (*draw)(Dice&);
};

/// Ten numbers in a row are five pairs of beams, two blocks and three others.
constexpr std::array<Family, 20> families{{{"plastic beams", plastic_beams},
                                           {"blocks", squeezed_block},
                                           {"stretched beams", stretched_beams},
                                           {"plastic beams", plastic_beams},
                                           {"seals", seal_in_groove},
                                           {"plastic beams", plastic_beams},
                                           {"blocks", squeezed_block},
                                           {"stretched beams", stretched_beams},
                                           {"rings", squeezed_ring},
                                           {"press fits", press_fit},
                                           {"plastic beams", plastic_beams},
                                           {"snap fits", snap_fit},
                                           {"blocks", squeezed_block},
                                           {"stretched beams", stretched_beams},
                                           {"plastic beams", plastic_beams},
                                           {"rings", squeezed_ring},
                                           {"seals", seal_in_groove},
                                           {"plastic beams", plastic_beams},
                                           {"snap fits", snap_fit},
                                           {"press fits", press_fit}}};

SolidVariant variant(std::uint32_t seed, int number) {
  Dice dice(seed, number);
  const auto& family = families[static_cast<std::size_t>(number) % families.size()];
  auto drawn = family.draw(dice);
  drawn.number = number;
  drawn.family = family.name;
  drawn.deck =
      fmt::format("title: {}, variant {}\n{}checkpoint: {{last: false}}\n", family.name, number, drawn.deck);
  return drawn;
}

/// How much of the way from square to disc.
constexpr double roundness = 0.6;

} // namespace

std::vector<SolidVariant> solid_variants(std::uint32_t seed, int first, int count) {
  std::vector<SolidVariant> all;
  for (int number = first; number < first + count; ++number)
    all.push_back(variant(seed, number));
  return all;
}

std::array<double, 2> placed(const Shape& shape, double x, double y) {
  if (shape.mapping == Mapping::polar)
    return {y * std::cos(x), -y * std::sin(x)};
  if (shape.mapping == Mapping::none)
    return {x, y};
  const double a = (x - shape.x) / shape.half, b = y / shape.half;
  const double disc_x = a * std::sqrt(1 - b * b / 2), disc_y = b * std::sqrt(1 - a * a / 2);
  return {shape.x + shape.half * (a + roundness * (disc_x - a)), shape.half * (b + roundness * (disc_y - b))};
}

} // namespace rubato::verification
