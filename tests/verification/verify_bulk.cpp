// SPDX-License-Identifier: LGPL-3.0-or-later
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "verification/bulk_benchmarks.hpp"
#include "verification/bulk_locking.hpp"
#include "verification/bulk_run.hpp"
#include "verification/bulk_seal.hpp"
#include "verification/bulk_structures.hpp"
#include "verification/verify.hpp"
#include <algorithm>
#include <span>
#include <string>
#include <vector>

namespace rubato::verification {
namespace {

void write_numbers(Page& page, std::span<const Benchmark> benchmarks) {
  page.table({"row", "benchmark", "number", "rubato", "expected", "source", "deviation", "permitted", ""});
  for (const auto& [row, what, numbers, residuals] : benchmarks)
    for (const auto& number : numbers)
      page.row({std::to_string(row), what, number.quantity, fmt::format("{:.6g}", number.found),
                fmt::format("{:.6g}", number.expected), number.source,
                fmt::format("{:+.2f} %", 100 * (number.found / number.expected - 1)),
                fmt::format("{:.2g} %", 100 * number.tolerance), number.within() ? "holds" : "**fails**"});
}

/// Rows of all parts, by their numbers.
std::vector<Benchmark> all_benchmarks() {
  std::vector<Benchmark> all;
  for (auto part : {&structure_benchmarks, &point_benchmarks, &contact_benchmarks})
    std::ranges::move(part(), std::back_inserter(all));
  std::ranges::stable_sort(all, {}, &Benchmark::row);
  return all;
}

void write_residuals(Page& page, std::span<const Benchmark> benchmarks) {
  page.paragraph(
      "## Quadratic convergence\n\nThe largest unbalanced force at the start and at every motion of "
      "the last of the steps that needed most iterations, with `newton: {tangent: full}`. Order: "
      "log(r₃/r₂)/log(r₂/r₁) of the last three residuals above rounding, 1e-13 of the largest one; 2 "
      "is quadratic. The first residual is that of loads and supports that have moved, which the "
      "others cannot be compared with. Thin beams alternate between stretching and bending, and have "
      "larger orders.");
  page.table({"row", "benchmark", "residuals", "order"});
  for (const auto& [row, what, numbers, residuals] : benchmarks) {
    if (residuals.empty())
      continue;
    const auto order = order_of(residuals);
    page.row({std::to_string(row), what, fmt::format("{:.1e}", fmt::join(residuals, ", ")),
              order ? fmt::format("{:.1f}", *order) : "–"});
  }
}

std::string locking_text(const std::optional<LockingNumber>& number, double exact) {
  if (!number)
    return "–";
  return fmt::format("{:.5g} ({:.4g}){}", number->found, number->expected,
                     holds(*number, exact) ? "" : " **fails**");
}

void write_locking(Page& page) {
  page.paragraph(
      "## Locking\n\nSmall strain, elastic, from decks; in brackets what an independent prototype of "
      "the same formulations gave, which each number matches to 0.5 % or to the digits printed, or is "
      "nearer to the exact one. Cook: 48 wide, 44 and 16 high, held at one end, F across at the other, "
      "E = 1, F = 1 or E = 250, F = 100. Tube: radii 20 and 40, E = 10, inner pressure 1, u(a). "
      "Cantilever: 20 × 2 × 2, deflection × E/F; skewed: x grows by 0.5 (y − 1) sin(πx/20). Its beam "
      "is without the clamp: Euler 2000, Timoshenko 2016; for ν = 0.4999 extrapolated, ± 20. One layer "
      "with `mean_dilatation` is too soft.");
  page.table({"structure", "`full`", "`mean_dilatation`", "`enhanced`", "exact, converged"});
  for (const auto& row : locking_rows())
    page.row({row.what, locking_text(row.full, row.exact), locking_text(row.mean_dilatation, row.exact),
              locking_text(row.enhanced, row.exact), fmt::format("{:.6g}", row.exact)});
}

void write_seal(Page& page) {
  page.paragraph(
      "## A seal ring\n\nA rubber cord of diameter 2 at the mean radius 10 (Mooney-Rivlin, c10 = 0.6, "
      "c01 = 0.15, K = 150), axisymmetric, pressed by 30 % between the floor and the lid of a groove "
      "2.4 wide, which it fills to 93 % then; friction 0.1, mortar contact, everything else by "
      "default, steps of 2.5 %. The first mesh has 32 edges around the cord. Nothing but contact holds "
      "the ring: its matrix without contact is not positive definite, and such steps have springs in it "
      "where surfaces touch, or contact itself.");
  page.table({"cells", "lid at 10 %", "at 20 %", "at 30 %", "walls at 30 %", "steps", "cuts", "bulk",
              "solves", "balance"});
  for (const int n : {4, 8, 16}) {
    const auto found = press_seal(n);
    page.row({std::to_string(found.cells), fmt::format("{:.2f}", found.force[0]),
              fmt::format("{:.2f}", found.force[1]), fmt::format("{:.2f}", found.force[2]),
              fmt::format("{:.2f}", found.wall), std::to_string(found.steps), std::to_string(found.cuts),
              std::to_string(found.bulk), std::to_string(found.iterations),
              fmt::format("{:.0e}", found.balance)});
  }
}

} // namespace

void write_bulk(const std::filesystem::path& folder) {
  Page page(folder / "bulk.md", "Benchmarks of bodies that yield, stretch and do not lock");
  page.paragraph(
      "Numbers with a closed form, of books, or of an independent prototype of the same formulations, "
      "against decks as `rubato run` takes them; formulation and strain are the defaults where none is "
      "named. The decks are those of `tests/verification/bulk_structures.cpp` and its neighbours.");
  const auto benchmarks = all_benchmarks();
  page.paragraph("## Benchmarks\n");
  write_numbers(page, benchmarks);
  write_residuals(page, benchmarks);
  page.paragraph("## On finer meshes\n");
  write_numbers(page, finer_structures());
  page.paragraph("## Integrated in full\n\nThe same structures where their cells lock.");
  write_numbers(page, locked_structures());
  write_locking(page);
  write_seal(page);
}

} // namespace rubato::verification
