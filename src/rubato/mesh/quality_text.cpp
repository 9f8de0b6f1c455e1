// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/mesh/quality.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <string_view>

namespace rubato::mesh {
namespace {

using Out = std::back_insert_iterator<std::string>;

std::string_view kind_of_dimension(int dimension) {
  constexpr std::array<std::string_view, 4> names{"points", "segments", "faces", "solids"};
  return names[static_cast<std::size_t>(dimension)];
}

void write_overview(Out out, const MeshReport& report) {
  fmt::format_to(out, "{}D mesh, {} nodes, {} connected {}\n", report.dimension, report.nodes,
                 report.connected_bodies, report.connected_bodies == 1 ? "body" : "bodies");
  constexpr std::string_view axes = "xyz";
  for (int a = 0; a < report.dimension; ++a)
    fmt::format_to(out, "  {} from {:.6g} to {:.6g}\n", axes[static_cast<std::size_t>(a)], report.lower[a],
                   report.upper[a]);
  fmt::format_to(out, "  {} {:.6g}\n", report.dimension == 3 ? "volume" : "area", report.bulk_measure);
  fmt::format_to(out, "  edges from {:.6g} to {:.6g}\n", report.shortest_edge, report.longest_edge);
  if (report.names_nodes)
    fmt::format_to(out, "  nodes have names in the file: decks call them by these\n");
}

void write_types(Out out, const MeshReport& report) {
  fmt::format_to(out, "\n{:<10}{:>10}   scaled Jacobian: {:>10}{:>10}   worst cell\n", "cells", "count",
                 "smallest", "mean");
  for (const auto& type : report.types) {
    fmt::format_to(out, "{:<10}{:>10}", cell::topology(type.type).name, type.count);
    if (type.has_jacobian)
      fmt::format_to(out, "{:>30.4f}{:>10.4f}   {}", type.smallest_jacobian, type.mean_jacobian,
                     type.worst_cell);
    fmt::format_to(out, "\n");
  }
}

void write_groups(Out out, const MeshReport& report) {
  std::size_t width = 20;
  for (const auto& group : report.groups)
    width = std::max(width, group.name.size() + 2);
  fmt::format_to(out, "\n{:<{}}{:>10}   of\n", "groups", width, "count");
  for (const auto& group : report.groups) {
    const bool nodes = group.kind == GroupSummary::Kind::nodes;
    const auto what = group.count == 0 && !nodes ? "cells"
                      : nodes                    ? "nodes"
                                                 : kind_of_dimension(group.dimension);
    fmt::format_to(out, "{:<{}}{:>10}   {}{}\n", group.name, width, group.count, what,
                   group.mixed ? " and cells of other dimensions" : "");
  }
  if (report.groups.empty())
    fmt::format_to(out, "none\n");
}

void write_findings(Out out, std::string_view what, const Findings& findings, std::string_view begin = "  ") {
  if (findings.count == 0)
    return;
  const bool more = findings.count > static_cast<std::int64_t>(findings.first.size());
  fmt::format_to(out, "{}{} {}: {}{}\n", begin, findings.count, what, fmt::join(findings.first, " "),
                 more ? " …" : "");
}

std::string hint_of_flat_axis(const MeshReport& report) {
  constexpr std::string_view axes = "xyz";
  if (report.dimension != 3 || report.flat_axis < 0 || report.flat_axis > 1)
    return {};
  return fmt::format(" (all nodes share one {}; the plane of a plane model is x, y)",
                     axes[static_cast<std::size_t>(report.flat_axis)]);
}

void write_faults(Out out, const MeshReport& report) {
  if (report.looks_right()) {
    fmt::format_to(out, "\nnothing looks wrong\n");
  } else {
    fmt::format_to(out, "\nwhat looks wrong:\n");
    if (!report.has_bulk_cells)
      fmt::format_to(out, "  no {} to compute on{}\n",
                     report.dimension == 3 ? "solid cells" : "surface cells", hint_of_flat_axis(report));
    write_findings(out, "nodes with a coordinate that is not finite", report.lost_nodes);
    write_findings(out, "nodes of no cell", report.free_nodes);
    write_findings(out, "inverted or flat cells", report.inverted_cells);
    write_findings(out, fmt::format("nearly flat cells (scaled Jacobian below {:g})", least_jacobian),
                   report.flat_cells);
    write_findings(out, "nodes at the place of another node of their body", report.duplicate_nodes);
    write_findings(out, "cells connected to no body", report.loose_cells);
    write_findings(out, "faces that bound no bulk cell", report.unowned_faces);
    if (!report.empty_groups.empty())
      fmt::format_to(out, "  empty groups: {}\n", fmt::join(report.empty_groups, ", "));
  }
  write_findings(out, "reversed cells, mended in a run", report.reversed_cells, "note: ");
  if (report.coincident_between_bodies > 0)
    fmt::format_to(out, "note: {} coincident nodes of different bodies: fine for contact\n",
                   report.coincident_between_bodies);
}

} // namespace

std::string to_text(const MeshReport& report) {
  std::string text;
  const Out out = std::back_inserter(text);
  write_overview(out, report);
  write_types(out, report);
  write_groups(out, report);
  write_faults(out, report);
  return text;
}

} // namespace rubato::mesh
