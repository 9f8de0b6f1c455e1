// SPDX-License-Identifier: LGPL-3.0-or-later
/// The inp module: an input file of Abaqus or CalculiX becomes studies, one for each step. A front end, as
/// deck is.
#pragma once

#include "rubato/core/error.hpp"
#include "rubato/study/study.hpp"

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace rubato::inp {

/// Steps that are read: all of the file, or those with natural modes.
enum class Purpose { run, modes };

/// Where the values of a study are written, by their paths: "contact.top_base", "supports.0".
using Places = std::map<std::string, Location, std::less<>>;

/// Number and range of the natural modes of a step.
struct ModesAsked {
  std::optional<int> number;     ///< of the lowest ones in the range; not given: all in it
  double lowest = 0;             ///< frequency [1/time]
  std::optional<double> highest; ///< likewise
  bool operator==(const ModesAsked&) const = default;
};

struct Input {
  std::string title;              ///< the heading's first line
  std::vector<study::Study> runs; ///< of each step, at least one; each starts from the end of the one before
  std::vector<Places> places;     ///< of each run
  std::map<std::string, ModesAsked> modes; ///< runs that are natural modes, by name
  std::vector<std::string> notes;          ///< sentences on what was left out or differs
};

/// Reads a file and those it includes. Its mesh is that of mesh::read_inp, which the studies name as their
/// file. Whatever has no counterpart in rubato and changes the answer is a fault. Throws one InputError with
/// every fault, each at file:line:column.
Input read_input(const std::filesystem::path& file, Purpose purpose = Purpose::run);
/// The same of text; `name` stands in the places of faults and is the file of the mesh.
Input parse_input(std::string text, const std::string& name, Purpose purpose = Purpose::run);

} // namespace rubato::inp
