// SPDX-License-Identifier: LGPL-3.0-or-later

#include <fmt/format.h>

#include "patch/contact_blocks.hpp"
#include "support/model_of.hpp"
#include "verification/free_beam.hpp"
#include "verification/verify.hpp"
#include <array>
#include <numbers>

namespace rubato::verification {
namespace {

constexpr std::array cells{CellType::quad4,  CellType::quad8,  CellType::quad9,   CellType::tria3,
                           CellType::tria6,  CellType::tria7,  CellType::hexa8,   CellType::hexa20,
                           CellType::hexa27, CellType::tetra4, CellType::tetra10, CellType::penta6,
                           CellType::penta15};

std::string shown(const test::PatchOutcome& outcome, double value) {
  return outcome.converged ? fmt::format("{:.1e}", value) : outcome.failure;
}

void write_blocks(Page& page, CellType type, const std::string& kind, const test::ContactBlocks& blocks) {
  const auto outcome = test::press(blocks);
  page.row({std::string(cell::topology(type).name), kind, shown(outcome, outcome.pressure),
            shown(outcome, outcome.displacement)});
}

/// What theory has for one step of a scheme at Ω = ω h.
std::complex<double> closed_form(const FreeBeamRuns::Vibration& run) {
  const auto& scheme = run.scheme;
  return principal(amplification(scheme.inertia.before, scheme.forces.before, scheme.beta, scheme.gamma,
                                 run.omega * run.h));
}

} // namespace

void write_contact_patch(const std::filesystem::path& folder) {
  Page page(folder / "v3.md", "V3: the contact patch test");
  page.paragraph(
      "Two blocks are pressed on one another by a tenth (cases/v3_contact_patch): the pressure is "
      "1e5 everywhere and the interface moves by −0.05. Largest deviations, relative to 1e5 and to "
      "the push of 0.1.");
  page.table({"cells", "interface", "pressure", "displacement"});
  for (const auto type : cells) {
    write_blocks(page, type, "conforming", {type, 2, 2, 0, ""});
    write_blocks(page, type, "conforming, μ = 0.3", {type, 2, 2, 0.3, ""});
    write_blocks(page, type, "conforming, 3 Gauss points", {type, 2, 2, 0, ", integration: {gauss: 3}"});
    write_blocks(page, type, "conforming, turned", {type, 2, 2, 0, "", 0.5});
    write_blocks(page, type, "conforming, turned, μ = 0.3", {type, 2, 2, 0.3, "", 0.5});
  }
  for (const auto type : {CellType::quad4, CellType::quad9, CellType::hexa8, CellType::hexa27}) {
    write_blocks(page, type, "slave 3, master 2 cells", {type, 3, 2, 0, ""});
    write_blocks(page, type, "slave 2, master 3 cells", {type, 2, 3, 0, ""});
    write_blocks(page, type, "slave 3, master 2 cells, 3 Gauss points",
                 {type, 3, 2, 0, ", integration: {gauss: 3}"});
  }
  page.paragraph("Points against faces cannot pass on meshes that do not match, as is known of every "
                 "node-to-segment method; those rows say by how much. [Mortar](mortar.md) passes. "
                 "Turned blocks stand along none of the axes.");
}

void write_free_beam(const std::filesystem::path& folder) {
  const FreeBeamRuns beam;
  Page page(folder / "v11.md", "V11: free vibration of one beam");
  const double omega = first_mode(test::BuiltModel(beam.study("newmark"))).omega;
  page.paragraph(
      fmt::format("First frequency of the mesh of cases/v11_free_beam (QUAD9, 20 × 2 cells): {:.4f} Hz; "
                  "Timoshenko's beam {:.4f} Hz ({:+.1e}), Bernoulli's {:.4f} Hz ({:+.1e}).",
                  omega / (2 * std::numbers::pi), timoshenko / (2 * std::numbers::pi), omega / timoshenko - 1,
                  bernoulli / (2 * std::numbers::pi), omega / bernoulli - 1));
  page.paragraph(
      "The first mode in a run, against the closed form of the scheme: relative error of the period "
      "(what the scheme does to it) and the logarithmic decrement of a step.");
  page.table({"scheme", "ω h", "period error, closed form", "measured − closed form (of ω h)",
              "decrement, closed form", "measured − closed form"});
  for (const auto* name : {"newmark", "hht", "generalized_alpha"}) {
    const auto run = beam.vibration(name);
    const auto found = measured_amplification(run.amplitude);
    const auto expected = closed_form(run);
    const double step = run.omega * run.h;
    page.row({name, fmt::format("{:.6f}", step), fmt::format("{:.6e}", step / std::arg(expected) - 1),
              fmt::format("{:.1e}", (std::arg(found) - std::arg(expected)) / step),
              fmt::format("{:.6e}", -std::log(std::abs(expected))),
              fmt::format("{:.1e}", std::log(std::abs(expected)) - std::log(std::abs(found)))});
  }
}

} // namespace rubato::verification
