// SPDX-License-Identifier: LGPL-3.0-or-later
/// Inside the project only: the keywords of Abaqus and CalculiX, a row each.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace rubato::mesh::inp {

/// What becomes of a keyword.
enum class Use {
  structure,  ///< parts, instances, steps: what the others stand in
  mesh,       ///< nodes, cells, groups
  study,      ///< what rubato computes with
  harmless,   ///< changes no result; told once
  unavailable ///< rubato has nothing of the kind: a study with it is refused
};

struct Keyword {
  std::string_view name; ///< in capitals, with blanks: "SOLID SECTION"
  Use use;
  std::string_view takes = {};   ///< parameters that are looked at, separated by commas
  std::string_view ignores = {}; ///< parameters that change nothing here
  std::string_view note = {};    ///< what it becomes, or why it is not available
};

/// In the order of their names.
std::span<const Keyword> all_keywords();

/// Capitals without blanks, - and _: how names of keywords, parameters and words are compared.
std::string compact(std::string_view text);
/// Capitals without blanks: how labels of sets, materials and so on are compared.
std::string folded(std::string_view label);

/// By its name in any case and with any blanks; nullptr when there is none.
const Keyword* keyword_named(std::string_view name);

/// "; did you mean '*NODE'?", or nothing.
std::string nearest_keyword(std::string_view name);

} // namespace rubato::mesh::inp
