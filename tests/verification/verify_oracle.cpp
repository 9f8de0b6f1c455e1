// SPDX-License-Identifier: LGPL-3.0-or-later
#include <fmt/format.h>

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

} // namespace rubato::verification
