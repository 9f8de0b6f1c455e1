// SPDX-License-Identifier: LGPL-3.0-or-later
/// A study in sentences, from the echo that run.json has of it.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace rubato::report {

struct Topic {
  std::string name; ///< "Contact interface"
  std::vector<std::string> sentences;
};

/// In the order of a deck. Parts that the study does not have are left out.
std::vector<Topic> study_in_words(const nlohmann::ordered_json& study);

} // namespace rubato::report
