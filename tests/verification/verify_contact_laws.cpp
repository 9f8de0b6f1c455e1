// SPDX-License-Identifier: LGPL-3.0-or-later
// The pages of V4 to V7 and V9.
#include <fmt/format.h>

#include "verification/hertz.hpp"
#include "verification/signorini.hpp"
#include "verification/sliding.hpp"
#include "verification/verify.hpp"
#include <array>
#include <cmath>

namespace rubato::verification {
namespace {

std::string deviation(double found, double theory) {
  return fmt::format("{:+.2e}", found / theory - 1);
}

std::string ledger(const CaseRun& run) {
  return fmt::format("The energy ledger closes to {:.1e} of its largest term.", run.ledger());
}

} // namespace

void write_hertz(const std::filesystem::path& folder) {
  Page page(folder / "v4.md", "V4: Hertz, a cylinder on a block");
  const auto theory = v4_theory();
  CaseRuns runs("v4_hertz_cylinder/cylinder.yaml");
  const auto& run = runs["run"];
  const auto points = surface_at_end(run);
  const auto fit = fitted_ellipse(points);
  double last = 0;
  for (const auto& point : points)
    if (point.status != contact::Status::open)
      last = point.x;
  page.paragraph("Cells of 0.2 mm where the bodies touch, QUAD4.");
  page.table({"", "Hertz", "computed", "deviation"});
  const auto row = [&](const char* name, double expected, double found) {
    page.row(
        {name, fmt::format("{:.4f}", expected), fmt::format("{:.4f}", found), deviation(found, expected)});
  };
  row("half-width of the ellipse through p² [mm]", theory.half_width, fit.half_width);
  row("last point in contact [mm]", theory.half_width, last);
  row("peak of the ellipse [MPa]", theory.peak, fit.peak);
  row("largest pressure at a node [MPa]", theory.peak, largest_pressure(points));
  page.paragraph("Pressure along the surface:");
  page.table({"x [mm]", "Hertz [MPa]", "computed [MPa]"});
  for (const auto& point : points) {
    const double s = point.x / theory.half_width;
    page.row({fmt::format("{:.3f}", point.x),
              fmt::format("{:.1f}", s < 1 ? theory.peak * std::sqrt(1 - s * s) : 0),
              fmt::format("{:.1f}", point.pressure)});
  }
  page.paragraph(ledger(run));
}

void write_mindlin(const std::filesystem::path& folder) {
  Page page(folder / "v5.md", "V5: Cattaneo and Mindlin, a cylinder pushed sideways");
  CaseRuns runs("v5_cattaneo_mindlin/cylinder.yaml");
  const auto& run = runs["pushed"];
  const auto theory = mindlin_theory(run);
  const auto points = surface_at_end(run);
  const double stick = stick_half_width(points);
  page.paragraph(fmt::format(
      "Friction bears {:.4f} of what it can, so that c/a = {:.4f}, with a = {:.4f} mm from "
      "the normal force. Cells of {} mm where the bodies touch, QUAD4.",
      theory.mobilised, theory.stick / theory.normal.half_width, theory.normal.half_width, v5_cell));
  page.table({"", "theory", "computed", "difference"});
  page.row(
      {"half-width of stick c [mm]", fmt::format("{:.4f}", theory.stick), fmt::format("{:.4f}", stick),
       fmt::format("{:+.4f} mm, {:+.2f} cells", stick - theory.stick, (stick - theory.stick) / v5_cell)});
  page.row({"q/(μ p₀), root mean square of the difference", "", "",
            fmt::format("{:.4f}", traction_error(points, theory))});
  page.paragraph("Traction along the surface, in parts of μ p₀:");
  page.table({"x [mm]", "status", "theory", "computed"});
  for (const auto& point : points) {
    if (point.status == contact::Status::open)
      continue;
    page.row({fmt::format("{:.3f}", point.x), std::string(contact::to_string(point.status)),
              fmt::format("{:.4f}", mindlin_traction(point.x, theory.normal.half_width, theory.stick)),
              fmt::format("{:.4f}", std::abs(point.traction) / (theory.friction * theory.normal.peak))});
  }
  page.paragraph(
      "The bodies are no half-planes and not each other's mirror image: the zone is not quite centred, "
      "and pressing alone leaves small tractions. " +
      ledger(run));
}

void write_incline(const std::filesystem::path& folder) {
  Page page(folder / "v6.md", "V6: a block on an incline, at three sizes");
  CaseRuns runs("v6_block_on_incline/block.yaml");
  const double theory = incline_acceleration(0.3);
  page.paragraph(
      fmt::format("Theory: g (sin 30° − 0.3 cos 30°) = {:.6f} m/s². Measured over the second half of "
                  "the run. With μ = 0.7 the block must not move: its last velocity, in parts of that "
                  "of free sliding.",
                  theory));
  page.table({"size", "acceleration, μ = 0.3", "deviation", "velocity, μ = 0.7", "ledger, μ = 0.3",
              "ledger, μ = 0.7"});
  for (const std::string size : {"1mm", "1m", "1km"}) {
    const auto& slides = runs["slides_" + size];
    const auto& sticks = runs["sticks_" + size];
    const double found = measured_acceleration(slides);
    const double freely = incline_acceleration(0) * sticks.study.time.end;
    page.row({size, fmt::format("{:.9f}", found), deviation(found, theory),
              fmt::format("{:.1e}", std::abs(column(sticks.probes, "speed.x").back()) / freely),
              fmt::format("{:.1e}", slides.ledger()), fmt::format("{:.1e}", sticks.ledger())});
  }
}

void write_slider(const std::filesystem::path& folder) {
  Page page(folder / "v7.md", "V7: a friction slider on a spring");
  CaseRuns runs("v7_friction_slider/slider.yaml");
  const auto theory = slider_theory();
  const auto& run = runs["run"];
  const auto found = measured_slider(run);
  page.table({"", "theory", "computed", "deviation"});
  for (std::size_t i = 0; i < theory.turning_points.size() && i < found.turning_points.size(); ++i)
    page.row({i + 1 < theory.turning_points.size() ? "turning point [mm]" : "stays at [mm]",
              fmt::format("{:.4f}", 1e3 * theory.turning_points[i]),
              fmt::format("{:.6f}", 1e3 * found.turning_points[i]),
              deviation(found.turning_points[i], theory.turning_points[i])});
  page.row({"stops at [s]", fmt::format("{:.5f}", theory.stop), fmt::format("{:.5f}", found.stop),
            deviation(found.stop, theory.stop)});
  page.paragraph(ledger(run));
}

void write_signorini(const std::filesystem::path& folder) {
  constexpr std::array divisions{4, 8, 16, 32, 64};
  constexpr int fine = 128;
  Page page(folder / "v9.md", "V9: order of convergence with contact");
  page.paragraph(
      fmt::format("Error of the displacement in the energy norm, relative, against {0} × {0} QUAD9, "
                  "where half the contact is {1:.4f} wide. The order is that between a mesh and the "
                  "one before. Theory: O(h) with linear cells; the pressure begins like a square root "
                  "where contact ends, so that quadratic cells reach O(h^1.5) and no more; their orders "
                  "swing with the place of that end in its cell.",
                  fine, signorini_half_width(fine)));
  page.table({"cells", "4 × 4", "8 × 8", "16 × 16", "32 × 32", "64 × 64", "orders", "mean"});
  for (const auto cells : {CellType::quad4, CellType::quad8, CellType::quad9}) {
    const auto errors = signorini_errors(cells, divisions, fine);
    std::vector<std::string> row{std::string(cell::topology(cells).name)};
    std::string orders;
    for (std::size_t i = 0; i < errors.size(); ++i) {
      row.push_back(fmt::format("{:.3e}", errors[i]));
      if (i > 0)
        orders += fmt::format("{}{:.2f}", i > 1 ? ", " : "", std::log2(errors[i - 1] / errors[i]));
    }
    row.push_back(orders);
    row.push_back(fmt::format("{:.2f}", std::log2(errors.front() / errors.back()) /
                                            static_cast<double>(errors.size() - 1)));
    page.row(row);
  }
}

} // namespace rubato::verification
