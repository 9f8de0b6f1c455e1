// SPDX-License-Identifier: LGPL-3.0-or-later
/// Counts what this program allocates by `new`: the laws are asked at every point in every iteration.
#include <gtest/gtest.h>

#include "support/point_path.hpp"
#include <atomic>
#include <cstdlib>
#include <new>

namespace {
std::atomic<long> allocations{0};
}

void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size == 0 ? 1 : size))
    return memory;
  throw std::bad_alloc();
}

void operator delete(void* memory) noexcept {
  std::free(memory);
}

void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}

namespace rubato::material::point_law_memory_test {
namespace {

TEST(PointLaw, AllocatesNothing) {
  const BackStresses three{{BackStress{20e3, 100}, BackStress{5e3, 0}, BackStress{50e3, 400}}, 3};
  const std::array<PointLaw, 8> laws{make_elastic_point(200e3, 0.3),
                                     Plastic{200e3, 0.3, VoceHardening{200, 100, 50, 500}, three},
                                     Plastic{200e3, 0.3, TableHardening{{{0, 200}, {0.01, 260}}}, {}},
                                     Prony{2.6, 0.3, {{2, 0.1}, {3, 1}}},
                                     MooneyRivlin{0.4, 0.1, 20},
                                     Yeoh{0.5, -0.05, 0.02, 20},
                                     Ogden{{{0.6, 1.3}, {0.1, -2}}, 20},
                                     PlaneStress{Ogden{{{0.6, 1.3}, {0.1, -2}}, 20}}};
  Strain6 strain;
  strain << 0.01, -0.004, 0, 0.002, 0, 0;
  for (const auto& law : laws) {
    const std::vector<double> old(static_cast<std::size_t>(state_size(law)), 0.0);
    std::vector<double> now(old);
    Response out;
    const long before = allocations;
    const bool works = respond(law, strain, old, now, {0.1}, Want::tangent, out);
    const auto lost = dissipation(law, old, now, out.stress);
    EXPECT_EQ(allocations - before, 0) << law.index();
    EXPECT_TRUE(works && std::isfinite(lost.plastic + lost.viscous)) << law.index();
  }
}

} // namespace
} // namespace rubato::material::point_law_memory_test
