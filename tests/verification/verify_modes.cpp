// SPDX-License-Identifier: LGPL-3.0-or-later
#include <fmt/format.h>

#include "verification/beam_modes.hpp"
#include "verification/verify.hpp"

namespace rubato::verification {
namespace {

void write_frequencies(Page& page) {
  page.paragraph(
      "The upper beam of SDNL140 alone (20 × 2 × 1 cells, 1 m × 0.1 m × 0.1 m, E = 200 GPa, ρ = 7800 "
      "kg/m³), clamped at one end, with consistent masses. Largest deviation of the ten lowest "
      "frequencies from Code_Aster 15.1.21, and the largest residual ‖K φ − λ M φ‖ beside λ ‖M φ‖.");
  page.table({"cells", "ν", "f1 (Hz)", "f2 (Hz)", "f10 (Hz)", "largest deviation", "largest residual"});
  for (const auto& beam : beams_with_modes()) {
    const auto modes = computed_modes(beam);
    const auto reference = reference_frequencies(beam);
    page.row({beam.cells, fmt::format("{:g}", beam.poisson), fmt::format("{:.9g}", modes.frequencies[0]),
              fmt::format("{:.9g}", modes.frequencies[1]), fmt::format("{:.9g}", modes.frequencies[9]),
              reference ? fmt::format("{:.1e}", largest_deviation(modes, *reference)) : "–",
              fmt::format("{:.1e}", modes.residuals.maxCoeff())});
  }
}

} // namespace

void write_modes(const std::filesystem::path& folder) {
  Page page(folder / "modes.md", "Natural modes against Code_Aster");
  write_frequencies(page);
}

} // namespace rubato::verification
