// SPDX-License-Identifier: LGPL-3.0-or-later
// The pages of V1, V2, V8 and V10.
#include <fmt/format.h>

#include "verification/impact.hpp"
#include "verification/verify.hpp"
#include <stdexcept>

namespace rubato::verification {
namespace {

std::string relative(double found, double theory) {
  return fmt::format("{:+.2f} %", 100 * (found / theory - 1));
}

void write_impacts(Page& page, CaseRuns& runs, const std::string& zone, const ImpactTheory& theory,
                   double impulse) {
  page.paragraph(fmt::format(
      "Theory: contact on [{:.4f}, {:.4f}], force {:g} at its beginning and {:g} at its "
      "end, impulse {:.4g}. Bodies touch and leave where the force crosses half of "
      "theory's, between two of its values by a straight line: waves in a mesh have no sharp "
      "fronts. Forces of `moreau_jean` are means over a step and stand in its middle. Force error: "
      "root of the mean square over the contact but its first 5 %, in parts of the first force. Energy "
      "error: the largest change of "
      "kinetic + strain + contact energy less the work of the loads, in parts of {:g}. "
      "Ledger: largest imbalance over its largest term.",
      theory.begin, theory.end, theory.force(theory.begin), theory.force(theory.end), impulse,
      theory.energy));
  page.table({"run", "step", "touches", "leaves", "impulse", "largest force", "force error", "energy error",
              "ledger", "seconds"});
  for (const auto& name : runs.names()) {
    try {
      const auto& run = runs[name];
      const auto found = measure_impact(run, zone, theory);
      page.row({name, run.study.time.step > 0 ? fmt::format("{:g}", run.study.time.step) : "stable",
                fmt::format("{:.4f}", found.begin), fmt::format("{:.4f}", found.end),
                fmt::format("{:.4g} ({})", found.impulse, relative(found.impulse, impulse)),
                fmt::format("{:.4g}", found.largest_force),
                fmt::format("{:.2f} %", 100 * found.pressure_error),
                fmt::format("{:.2g} %", 100 * found.energy_error), fmt::format("{:.1e}", run.ledger()),
                seconds_of(run.result)});
    } catch (const std::runtime_error& error) {
      page.row({name, error.what(), "", "", "", "", "", "", "", ""});
    }
  }
}

void tell_schemes(Page& page, const std::string& also = "") {
  page.paragraph(fmt::format(
      "`newmark`, `hht` and `generalized_alpha` give nodes that touch a mass that must stop at once: "
      "their forces oscillate from step to step, and so may their energy. `redistributed` is "
      "Newmark's scheme with `contact_mass: redistributed`, `redistributed_hht` the same with "
      "hht's, α = −0.05; `central_difference` presses by penalty. `default` names no scheme: `moreau_jean` "
      "on surfaces without mass. The run `moreau_jean` has `contact_mass: consistent`: it stops the nodes "
      "that "
      "touch and gives nothing back, a part of the energy that is that of the nodes' mass and falls with "
      "it. `mortar` is `default` with segment-to-segment integrals{}.",
      also));
}

} // namespace

void write_bar_on_wall(const std::filesystem::path& folder) {
  Page page(folder / "v1.md", "V1: an elastic bar hits a rigid wall");
  CaseRuns runs("v1_bar_on_wall/bar.yaml");
  write_impacts(page, runs, "wall", bar_on_wall(), 200);
  tell_schemes(page);
}

void write_dropped_bar(const std::filesystem::path& folder) {
  Page page(folder / "v2.md", "V2: an elastic bar falls on a rigid wall");
  CaseRuns runs("v2_dropped_bar/bar.yaml");
  write_impacts(page, runs, "wall", dropped_bar(), 800.0 / 3);
  tell_schemes(page);
}

void write_rod_on_rod(const std::filesystem::path& folder) {
  Page page(folder / "v10.md", "V10: a rod hits an equal one at rest");
  CaseRuns runs("v10_rod_on_rod/rods.yaml");
  write_impacts(page, runs, "interface", rod_on_rod(), 100);
  page.paragraph("The impulse of 100 is the striker's whole momentum: the rods exchange their velocities.");
  tell_schemes(page, ", `mortar_nonmatching` the same with three faces on two");
}

void write_sphere_impact(const std::filesystem::path& folder) {
  Page page(folder / "v8.md", "V8: an elastic sphere hits a rigid wall");
  const auto theory = hertz_impact(10, 210e3, 0.3, 7.8e-9, 1000);
  page.paragraph(
      fmt::format("Hertz's quasi-static theory: largest force {:.1f} N, approach {:.3f} µm, duration "
                  "{:.2f} µs. The sphere rings after the impact: what it keeps of that, theory has "
                  "not. Ledger: largest imbalance over its largest term.",
                  theory.force, 1e3 * theory.approach, 1e6 * theory.duration));
  page.table({"run", "force [N]", "approach of the centre [µm]", "duration [µs]", "ledger", "seconds"});
  CaseRuns runs("v8_hertz_impact/sphere.yaml");
  for (const auto& name : runs.names()) {
    try {
      const auto& run = runs[name];
      const auto found = measure_sphere(run);
      page.row({name, fmt::format("{:.1f} ({})", found.force, relative(found.force, theory.force)),
                fmt::format("{:.3f} ({})", 1e3 * found.approach, relative(found.approach, theory.approach)),
                fmt::format("{:.2f} ({})", 1e6 * found.duration, relative(found.duration, theory.duration)),
                fmt::format("{:.1e}", run.ledger()), seconds_of(run.result)});
    } catch (const std::runtime_error& error) {
      page.row({name, error.what(), "", "", "", ""});
    }
  }
}

} // namespace rubato::verification
