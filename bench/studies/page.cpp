// SPDX-License-Identifier: LGPL-3.0-or-later
#include "page.hpp"

#include <Eigen/Dense>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string_view>
#include <vector>

namespace rubato::bench {
namespace {

std::string content_of(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream)
    throw std::runtime_error(fmt::format("cannot read {}", file.string()));
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// What follows a key and its colon in a file of lines.
std::string entry_of(const std::filesystem::path& file, std::string_view key) {
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);)
    if (line.starts_with(key)) {
      const auto value = line.find_first_not_of(" \t", line.find(':') + 1);
      return value == std::string::npos ? "" : line.substr(value);
    }
  return "unknown";
}

/// Three digits, in seconds, milliseconds or microseconds.
std::string shown_time(double seconds) {
  if (seconds >= 1)
    return fmt::format("{:.3g} s", seconds);
  if (seconds >= 1e-3)
    return fmt::format("{:.3g} ms", 1e3 * seconds);
  return fmt::format("{:.3g} µs", 1e6 * seconds);
}

std::string row_of(const Measurement& m) {
  const auto full = m.full_steps == 0
                        ? std::string("– | –")
                        : fmt::format("{} | {:.0f}", shown_time(m.full_step), m.full_step / m.step);
  return fmt::format(
      "| {} | {} | {} | {} | {:.0f} | {:.1f} | {} | {} | {} | {} | {} | {:.2f} | {:.2f} | {:.0f} MB | {} |\n",
      m.title, m.dofs, m.contact_dofs, m.steps, m.active, m.iterations, shown_time(m.setup),
      shown_time(m.step), shown_time(m.middle_step), shown_time(m.solve), shown_time(m.halves),
      m.step / m.halves, m.middle_step / m.halves, m.memory / 1e6, full);
}

/// p of y ~ xᵖ by least squares of the logarithms.
double exponent(std::span<const Measurement> measurements, double Measurement::*y) {
  Eigen::MatrixXd terms(static_cast<Eigen::Index>(measurements.size()), 2);
  Eigen::VectorXd values(terms.rows());
  for (Eigen::Index i = 0; i < terms.rows(); ++i) {
    const auto& m = measurements[static_cast<std::size_t>(i)];
    terms.row(i) << 1, std::log(static_cast<double>(m.dofs));
    values[i] = std::log(m.*y);
  }
  return terms.colPivHouseholderQr().solve(values)[1];
}

std::string exponents_of(std::span<const Measurement> measurements) {
  std::vector<Measurement> fitted;
  std::ranges::copy_if(measurements, std::back_inserter(fitted), &Measurement::fitted);
  if (fitted.size() < 2)
    return "";
  return fmt::format(
      "\nFitted over {} to {} unknowns (C refined, steps in proportion to the cells): set-up ~ "
      "unknowns^{:.2f}, step ~ unknowns^{:.2f}, solve ~ unknowns^{:.2f}, memory ~ "
      "unknowns^{:.2f}.\n",
      fitted.front().dofs, fitted.back().dofs, exponent(fitted, &Measurement::setup),
      exponent(fitted, &Measurement::step), exponent(fitted, &Measurement::solve),
      exponent(fitted, &Measurement::memory));
}

double in_seconds(const nlohmann::json& kernel) {
  const std::string unit = kernel.at("time_unit");
  const double scale = unit == "ns" ? 1e-9 : unit == "us" ? 1e-6 : unit == "ms" ? 1e-3 : 1;
  return scale * kernel.at("cpu_time").get<double>();
}

std::string counter(const nlohmann::json& kernel, const std::string& name) {
  return kernel.contains(name) ? fmt::format("{:.3g}", kernel.at(name).get<double>()) : "";
}

} // namespace

std::string machine_line() {
  const auto kibibytes = std::stod(entry_of("/proc/meminfo", "MemTotal"));
  return fmt::format("{}, {:.0f} GB, one core; {:%Y-%m-%d}", entry_of("/proc/cpuinfo", "model name"),
                     kibibytes * 1024 / 1e9, std::chrono::system_clock::now());
}

std::string table_of(std::span<const Measurement> measurements) {
  std::string text =
      "| study | dofs | contact dofs | steps | active | iterations | set-up | step | middle step | "
      "plain solve | its solves | step / its solves | middle step / its solves | peak memory | full step | "
      "full / condensed |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n";
  for (const auto& measurement : measurements)
    text += row_of(measurement);
  return text + exponents_of(measurements);
}

std::string table_of_kernels(const std::filesystem::path& json) {
  std::string text = "| kernel | of | time | Mel/s | GB/s |\n|---|---|---|---|---|\n";
  const auto found = nlohmann::json::parse(content_of(json));
  for (const auto& kernel : found.at("benchmarks"))
    text += fmt::format("| {} | {} | {} | {} | {} |\n", kernel.at("name").get<std::string>(),
                        kernel.value("label", ""), shown_time(in_seconds(kernel)), counter(kernel, "Mel/s"),
                        counter(kernel, "GB/s"));
  return text;
}

void write_part(const std::filesystem::path& page, const std::string& name, const std::string& text) {
  auto content = content_of(page);
  const auto first = fmt::format("<!-- {} -->\n", name);
  const auto last = fmt::format("<!-- end of {} -->\n", name);
  const auto begin = content.find(first);
  const auto end = content.find(last);
  if (begin == std::string::npos || end == std::string::npos || end < begin)
    throw std::runtime_error(fmt::format("{} has no part '{}'", page.string(), name));
  content.replace(begin + first.size(), end - begin - first.size(), text);
  std::ofstream(page) << content;
}

} // namespace rubato::bench
