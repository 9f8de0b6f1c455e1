// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/results/checks.hpp"

#include "rubato/model/model.hpp"
#include "rubato/model/node_label.hpp"
#include "rubato/results/compare.hpp"
#include "rubato/results/history.hpp"
#include "rubato/results/run_folder.hpp"
#include "rubato/study/words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rubato::results {
namespace {

/// What came out: a value, and what its deviation is relative to.
struct Found {
  double value = 0;
  double scale = 1;
};

/// The column of a table that a check is of.
std::string column_of(const study::Check& check) {
  if (check.resultant)
    return check.resultant->quantity;
  if (!check.energy.empty())
    return check.energy;
  return check.component.empty() ? check.probe : fmt::format("{}.{}", check.probe, check.component);
}

/// The table that it is of, in the folder of a run.
std::filesystem::path table_of(const study::Check& check, const std::filesystem::path& folder) {
  if (check.resultant)
    return folder / resultants_file(check.resultant->zone);
  return folder / (check.energy.empty() ? probes_file : energy_file);
}

/// What a column has at the instant, or of the whole history; nothing when it does not reach the instant.
std::optional<double> value_in(const study::Check& check, const Table& table) {
  const int column = table.column(column_of(check));
  if (check.when == study::CheckedTime::instant)
    return value_at(table, column, check.at);
  if (column < 0 || table.rows.empty())
    return std::nullopt;
  const auto value = [&](const std::vector<double>& row) { return row[static_cast<std::size_t>(column)]; };
  const auto magnitude = [&](const std::vector<double>& row) { return std::abs(value(row)); };
  switch (check.when) {
  case study::CheckedTime::least:
    return value(*std::ranges::min_element(table.rows, {}, value));
  case study::CheckedTime::largest_magnitude:
    return magnitude(*std::ranges::max_element(table.rows, {}, magnitude));
  default:
    return value(*std::ranges::max_element(table.rows, {}, value));
  }
}

/// Of this run; its probes are given.
std::optional<double> own_value(const study::Check& check, const Table& probes,
                                const std::filesystem::path& folder) {
  return check.probe.empty() ? value_in(check, read_csv(table_of(check, folder))) : value_in(check, probes);
}

std::optional<Found> of_history(const study::Check& check, const Table& probes,
                                const std::filesystem::path& folder) {
  const auto value = own_value(check, probes, folder);
  return value ? std::optional<Found>({*value, std::abs(check.reference)}) : std::nullopt;
}

std::optional<Found> of_history_difference(const study::Check& check, const Table& probes,
                                           const std::filesystem::path& folder,
                                           const std::filesystem::path& other) {
  const auto own = own_value(check, probes, folder);
  const auto others = value_in(check, read_csv(table_of(check, other)));
  if (!others)
    throw InputError(fmt::format("run {} has no {} at {}", check.run, column_of(check), check.at));
  return own ? std::optional<Found>({*own - *others, std::abs(*others)}) : std::nullopt;
}

Found of_field_difference(const study::Check& check, const std::filesystem::path& folder,
                          const std::filesystem::path& other, std::string& where) {
  const auto fields = compare_fields(folder, other, check.field->name, check.at);
  const auto& on = check.field->on;
  const auto parts = extents(fields, on.empty() ? all_nodes(fields.mesh) : nodes_of(fields.mesh, on));
  const auto wanted = [&](const Extent& part) {
    return check.field->component.empty() || part.component == check.field->component;
  };
  Found found{0, 0};
  for (const auto& part : parts) {
    if (!wanted(part))
      continue;
    found.scale = std::max(found.scale, part.largest_b);
    if (where.empty() || std::abs(part.difference) > std::abs(found.value)) {
      found.value = part.difference;
      where = model::node_label(fields.mesh, part.node);
    }
  }
  return found;
}

std::string quantity_of(const study::Check& check) {
  if (check.resultant)
    return fmt::format("{}.{}", check.resultant->zone, check.resultant->quantity);
  if (!check.energy.empty())
    return fmt::format("energy {}", check.energy);
  if (!check.field)
    return column_of(check);
  const auto& field = *check.field;
  return fmt::format("{}{}{}{}{}", field.name, field.component.empty() ? "" : ".", field.component,
                     field.on.empty() ? "" : " on ", field.on);
}

/// Throws InputError when the other run does not have what is compared.
std::optional<Found> find(const study::Check& check, const Table& probes, const std::filesystem::path& folder,
                          CheckResult& result) {
  if (check.run.empty())
    return of_history(check, probes, folder);
  const auto other = folder / ".." / check.run;
  if (!std::filesystem::exists(other / summary_file))
    throw InputError(fmt::format("run {} has no folder beside this one", check.run));
  return check.field ? of_field_difference(check, folder, other, result.where)
                     : of_history_difference(check, probes, folder, other);
}

double deviation_of(double difference, double scale) {
  return difference == 0 ? 0 : std::abs(difference) / scale;
}

CheckResult evaluate(const study::Check& check, const Table& probes, const std::filesystem::path& folder) {
  CheckResult result;
  result.quantity = quantity_of(check);
  result.over = study::word_of(study::checked_time_words, check.when);
  result.at = check.at;
  result.reference = check.reference;
  result.tolerance = check.tolerance;
  result.relative = check.relative;
  result.source = to_string(check.source);
  result.run = check.run;
  result.note = check.note;
  try {
    if (const auto found = find(check, probes, folder, result)) {
      result.value = found->value;
      result.deviation = deviation_of(found->value - check.reference, check.relative ? found->scale : 1.0);
      result.holds = result.deviation <= check.tolerance;
    }
  } catch (const InputError& error) {
    result.failure = error.what();
  }
  return result;
}

std::string source_of(const CheckResult& r) {
  auto text = r.source;
  if (!r.run.empty())
    text += " " + r.run;
  if (!r.where.empty())
    text += ", largest at " + r.where;
  if (!r.note.empty())
    text += ": " + r.note;
  return r.failure.empty() ? text : fmt::format("{} ({})", text, r.failure);
}

/// Text in a cell of a Markdown table.
std::string cell_text(const std::string& text) {
  std::string shown;
  for (const char letter : text) {
    if (std::string_view("\\|*_`<>").find(letter) != std::string_view::npos)
      shown += '\\';
    shown += letter == '\n' ? ' ' : letter;
  }
  return shown;
}

} // namespace

std::vector<CheckResult> evaluate_checks(std::span<const study::Check> checks, const Table& probes,
                                         const std::filesystem::path& folder) {
  std::vector<CheckResult> results;
  for (const auto& check : checks)
    results.push_back(evaluate(check, probes, folder));
  return results;
}

std::string to_text(std::span<const CheckResult> results) {
  std::size_t width = 12;
  for (const auto& r : results)
    width = std::max(width, r.quantity.size());
  std::string text = fmt::format("{:<{}} {:>10} {:>20} {:>20} {:>10} {:>11}  {:<6} {}\n", "quantity", width,
                                 "t", "reference", "value", "deviation", "tolerance", "", "source");
  for (const auto& r : results)
    text += fmt::format("{:<{}} {:>10} {:>20.12g} {:>20} {:>10} {:>11}  {:<6} {}\n", r.quantity, width,
                        r.over.empty() ? fmt::format("{:.6g}", r.at) : r.over, r.reference,
                        r.value ? fmt::format("{:.12g}", *r.value) : "not reached",
                        r.value ? fmt::format("{:.2e}", r.deviation) : "",
                        fmt::format("{:.1e}{}", r.tolerance, r.relative ? "" : " abs"),
                        r.holds ? "ok" : "FAILS", source_of(r));
  return text;
}

std::string to_markdown(std::span<const CheckResult> results) {
  std::string text =
      "| quantity | t | value | reference | difference | deviation | tolerance | verdict | source |\n"
      "|---|---:|---:|---:|---:|---:|---:|---|---|\n";
  for (const auto& r : results)
    text += fmt::format("| {} | {} | {} | {:.9g} | {} | {} | {:.1e} {} | {} | {} |\n", cell_text(r.quantity),
                        r.over.empty() ? fmt::format("{:.6g}", r.at) : cell_text(r.over),
                        r.value ? fmt::format("{:.9g}", *r.value) : "not reached", r.reference,
                        r.value ? fmt::format("{:.2e}", *r.value - r.reference) : "",
                        r.value ? fmt::format("{:.2e}", r.deviation) : "", r.tolerance,
                        r.relative ? "relative" : "absolute", r.holds ? "ok" : "**FAILS**",
                        cell_text(source_of(r)));
  return text;
}

std::string_view to_string(study::CheckSource source) {
  switch (source) {
  case study::CheckSource::external:
    return "external";
  case study::CheckSource::analytic:
    return "analytic";
  case study::CheckSource::other_code:
    return "other_code";
  case study::CheckSource::other_run:
    return "other_run";
  }
  return "";
}

} // namespace rubato::results
