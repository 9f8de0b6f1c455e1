// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/model/large_contact.hpp"

#include "rubato/contact/zone.hpp"
#include "rubato/model/model.hpp"

#include <fmt/format.h>

namespace rubato::model {
namespace {

constexpr double gigabyte = 1e9;
constexpr double most_bytes = 2 * gigabyte;

/// Of the matrix and its factors [bytes].
double dense_bytes(const contact::Zone& zone, int components) {
  const double unknowns = static_cast<double>(zone.points.size()) * components;
  return 2 * unknowns * unknowns * static_cast<double>(sizeof(double));
}

/// Why it is formed and what to write instead; empty where it is not formed.
std::string why_formed(const contact::Zone& zone, const Model& model) {
  if (zone.shares_multipliers())
    return "since points of this 'integration' share multipliers; 'integration: mortar' does without";
  if (!model.free_body_nodes.empty())
    return "since only contact holds a body; a coarser slave surface, or a scheme with masses, needs less";
  return {};
}

} // namespace

std::vector<std::string> notes_on_large_contact(const Model& model) {
  std::vector<std::string> notes;
  if (model.study.time.scheme == study::SchemeKind::central_difference)
    return notes;
  for (const auto& zone : model.zones)
    if (const double bytes = dense_bytes(zone, model.dofs.components); bytes > most_bytes)
      if (const auto because = why_formed(zone, model); !because.empty())
        notes.push_back(fmt::format(
            "contact zone '{}': if all of its {} points touch at once, a step takes {:.2g} GB for "
            "what they do to one another, {}",
            zone.settings.name, zone.points.size(), bytes / gigabyte, because));
  return notes;
}

} // namespace rubato::model
