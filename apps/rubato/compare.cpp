// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/results/compare.hpp"

#include "rubato/deck/read.hpp"
#include "rubato/model/model.hpp"
#include "rubato/model/node_label.hpp"
#include "rubato/results/run_folder.hpp"
#include "rubato/results/stored_run.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "commands.hpp"
#include "require_run.hpp"
#include <algorithm>
#include <cmath>

namespace rubato::app {
namespace {

using mesh::NodeIndex;
using results::FieldComparison;

/// The node of a probe of run A, or nothing when it has no such probe.
std::optional<NodeIndex> probe_node(const CompareArguments& arguments, const mesh::Mesh& mesh) {
  const auto study = deck::parse_echo(results::read_stored_run(arguments.a).study,
                                      (arguments.a / results::summary_file).string());
  const auto probe = std::ranges::find(study.probes, arguments.node, &study::Probe::name);
  if (probe == study.probes.end())
    return std::nullopt;
  if (!probe->point)
    return results::nodes_of(mesh, probe->node).front();
  const auto& p = *probe->point;
  const auto distance = [&](const Eigen::Vector3d& x) {
    return (x - Eigen::Vector3d(p[0], p[1], p[2])).norm();
  };
  return static_cast<NodeIndex>(std::ranges::min_element(mesh.points, {}, distance) - mesh.points.begin());
}

NodeIndex node_of(const CompareArguments& arguments, const mesh::Mesh& mesh) {
  if (mesh::nodes_named(mesh, arguments.node).empty())
    if (const auto node = probe_node(arguments, mesh))
      return *node;
  const auto nodes = results::nodes_of(mesh, arguments.node);
  if (nodes.size() > 1)
    throw InputError(fmt::format("--node: group '{}' has {} nodes, expected one (--group takes many)",
                                 arguments.node, nodes.size()));
  return nodes.front();
}

/// Prints and keeps the largest of the differences that were shown.
class Report {
public:
  explicit Report(const FieldComparison& fields) : fields_(fields) {}

  double largest() const { return largest_; }

  void at_node(NodeIndex node) {
    fmt::print("{}\n", model::node_label(fields_.mesh, node));
    const auto name_width = width();
    fmt::print("  {:<{}} {:>22} {:>22} {:>12}\n", "", name_width, "A", "B", "A - B");
    const auto parts = results::extents(fields_, std::array{node});
    for (std::size_t c = 0; c < parts.size(); ++c) {
      const auto i = static_cast<std::size_t>(node) * parts.size() + c;
      fmt::print("  {:<{}} {:>22.15g} {:>22.15g} {:>12.4e}\n", label(parts[c]), name_width, fields_.a[i],
                 fields_.b[i], parts[c].difference);
      largest_ = std::max(largest_, std::abs(parts[c].difference));
    }
  }

  void over(const std::string& place, std::span<const NodeIndex> nodes) {
    fmt::print("{}, {} nodes\n", place, nodes.size());
    const auto name_width = width();
    fmt::print("  {:<{}} {:>14} {:>12} {:>12}  {}\n", "", name_width, "largest A - B", "over max |A|", "rms",
               "largest at");
    for (const auto& part : results::extents(fields_, nodes)) {
      const auto relative =
          part.largest_a > 0 ? fmt::format("{:.2e}", std::abs(part.difference) / part.largest_a) : "-";
      fmt::print("  {:<{}} {:>14.4e} {:>12} {:>12.4e}  {}\n", label(part), name_width, part.difference,
                 relative, part.rms, part.difference == 0 ? "-" : model::node_label(fields_.mesh, part.node));
      largest_ = std::max(largest_, std::abs(part.difference));
    }
  }

private:
  const std::string& label(const results::Extent& part) const {
    return part.component.empty() ? fields_.field : part.component;
  }
  std::size_t width() const {
    std::size_t widest = 0;
    for (const auto& name : fields_.components)
      widest = std::max(widest, name.empty() ? fields_.field.size() : name.size());
    return widest;
  }

  const FieldComparison& fields_;
  double largest_ = 0;
};

int judged(const CompareArguments& arguments, double largest) {
  if (!arguments.tolerance)
    return done;
  const bool holds = largest <= *arguments.tolerance;
  fmt::print("largest difference {:.4e}, tolerance {:g}: {}\n", largest, *arguments.tolerance,
             holds ? "ok" : "FAILS");
  return holds ? done : check_failed;
}

int compare_fields(const CompareArguments& arguments) {
  if (!arguments.at)
    throw InputError("'--at' is missing: expected the instant at which the field is compared, or '--probe' "
                     "to compare histories");
  const auto fields = results::compare_fields(arguments.a, arguments.b, arguments.field, *arguments.at);
  // Names are looked up before anything is printed.
  std::optional<NodeIndex> node;
  std::vector<NodeIndex> group;
  if (!arguments.node.empty())
    node = node_of(arguments, fields.mesh);
  if (!arguments.group.empty())
    group = results::nodes_of(fields.mesh, arguments.group);
  fmt::print("{} at t = {:g}, A = {}, B = {}\n", fields.field, fields.at, arguments.a.string(),
             arguments.b.string());
  Report report(fields);
  if (node)
    report.at_node(*node);
  if (!group.empty())
    report.over(arguments.group, group);
  if (arguments.norms || (!node && group.empty()))
    report.over("whole mesh", results::all_nodes(fields.mesh));
  if (!arguments.output.empty()) {
    results::write_vtu(arguments.output, fields);
    fmt::print("written to {}\n", arguments.output.string());
  }
  return judged(arguments, report.largest());
}

int compare_histories(const CompareArguments& arguments) {
  const auto a = results::read_stored_run(arguments.a);
  const auto b = results::read_stored_run(arguments.b);
  const auto columns = results::compare_histories(a.probes, b.probes, arguments.probe, arguments.at);
  fmt::print("A = {}, B = {}, {}\n", arguments.a.string(), arguments.b.string(),
             arguments.at ? fmt::format("t = {:g}", *arguments.at)
                          : fmt::format("{} common instant{}", columns.front().instants,
                                        columns.front().instants == 1 ? "" : "s"));
  fmt::print("  {:<12} {:>14} {:>12} {:>12} {:>22} {:>22}\n", "", "largest A - B", "over max |A|", "at t",
             "A", "B");
  double largest = 0;
  for (const auto& column : columns) {
    const double difference = std::abs(column.difference());
    largest = std::max(largest, difference);
    fmt::print("  {:<12} {:>14.4e} {:>12} {:>12g} {:>22.15g} {:>22.15g}\n", column.quantity,
               column.difference(),
               column.largest_a > 0 ? fmt::format("{:.2e}", difference / column.largest_a) : "-", column.at,
               column.a, column.b);
  }
  return judged(arguments, largest);
}

} // namespace

int compare(const CompareArguments& arguments) {
  require_run(arguments.a);
  require_run(arguments.b);
  return arguments.probe.empty() ? compare_fields(arguments) : compare_histories(arguments);
}

} // namespace rubato::app
