// SPDX-License-Identifier: LGPL-3.0-or-later
#include <fmt/format.h>

#include "verification/oracle_heat.hpp"
#include "verification/oracle_solids.hpp"
#include "verification/oracle_statics.hpp"
#include "verification/verify.hpp"

namespace rubato::verification {

void write_relations(const std::filesystem::path& folder) {
  Page page(folder / "relations.md", "Relations, oblique supports, orthotropic materials against Code_Aster");
  page.paragraph(
      "Static studies without contact, computed by Code_Aster 15.1.21 (small displacements, full "
      "integration) and by rubato: the largest deviation of a displacement component at the nodes that "
      "the file has, in parts of the largest component. The decks are those of "
      "`tests/verification/oracle_statics.cpp`; in each, "
      "relations are kept by elimination where Code_Aster has multipliers.");
  page.table({"file", "what", "nodes", "largest displacement", "deviation"});
  for (const auto& study : oracle_statics()) {
    const auto found = compare(study);
    page.row({study.file, study.what, fmt::format("{}", found.nodes), fmt::format("{:.10g}", found.peak),
              fmt::format("{:.1e}", found.largest)});
  }
}

void write_heat(const std::filesystem::path& folder) {
  Page page(folder / "heat.md", "Thermal expansion against Code_Aster");
  page.paragraph(
      "Two beams on one another, both clamped at one end, of which the upper one is heated in steps of time: "
      "uniformly by 100 degrees, or linearly over its height. Contact presses and, with friction, rubs. "
      "Computed by Code_Aster 15.1.21 (CONTINUE, RESI_GLOB_RELA 1e-9, AFFE_VARC, ALPHA 1.2e-5) and by rubato "
      "over the same instants: the largest deviation of a displacement component of the tip in parts of the "
      "largest one, of the reaction at the clamped end of the lower beam likewise, and the iterations of all "
      "steps. The decks are those of `tests/verification/oracle_heat.cpp`. Code_Aster has no history of the "
      "plane stress beam with gradient and friction.");
  page.table({"file", "what", "steps", "displacement", "reaction", "iterations", "Code_Aster"});
  for (const auto& study : oracle_heat()) {
    const auto found = compare(study);
    page.row({study.file, study.what, fmt::format("{}", found.rows),
              fmt::format("{:.1e}", found.displacement), fmt::format("{:.1e}", found.reaction),
              fmt::format("{}", found.iterations), fmt::format("{}", found.others)});
  }
}

void write_solids(const std::filesystem::path& folder) {
  Page page(folder / "solids.md",
            "Plasticity, finite strain, rubber and follower pressure against Code_Aster");
  page.paragraph(
      "SDNL140's two beams with other materials and strains (HHT, contact and friction, full integration), "
      "blocks of rubber pressed by 30 %, and a beam that a pressure bends by three quarters of its length, "
      "computed by Code_Aster 15.1.21 (RESI_GLOB_RELA 1e-9 and 1e-10) and by rubato over the same instants, "
      "those at which Code_Aster had to cut among them: the largest deviation of a displacement component of "
      "the tip, of blocks of the reaction of the plate, in parts of the largest one; what the energy ledger "
      "misses in parts of its largest term; iterations of the bulk, linear solves and factorisations of all "
      "steps. The decks are those of `tests/verification/oracle_solids.cpp`. SIMO_MIEHE is another law: τ = "
      "K/2 (J² − 1) + μ dev b; its files stand beside `strain: logarithmic`.");
  page.table({"file", "what", "steps", "deviation", "balance", "bulk", "solves", "factors", "Code_Aster"});
  for (const auto& study : oracle_solids()) {
    const auto found = compare(study);
    page.row({study.file, study.what, fmt::format("{}", found.rows), fmt::format("{:.1e}", found.largest),
              fmt::format("{:.1e}", found.balance), fmt::format("{}", found.bulk),
              fmt::format("{}", found.iterations), fmt::format("{}", found.factorisations),
              fmt::format("{}", found.others)});
  }
}

} // namespace rubato::verification
