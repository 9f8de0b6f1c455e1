// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/results/vtu.hpp"

#include "rubato/core/error.hpp"
#include "rubato/core/writing.hpp"
#include "rubato/mesh/io/vtu.hpp"

#include <fmt/format.h>

#include <fstream>
#include <stdexcept>
#include <utility>

namespace rubato::results {
namespace {

constexpr std::size_t vector_size = 3;

/// Of an instant. Nine steps of 0.001 add up to 0.009000000000000001: what rounding adds, over many steps
/// more than the last digit, is not shown.
constexpr int shown_digits = 12;

std::vector<double> with_third_component(std::span<const double> values) {
  std::vector<double> padded(values.size() / 2 * vector_size, 0.0);
  for (std::size_t i = 0; i < values.size() / 2 * 2; ++i)
    padded[i / 2 * vector_size + i % 2] = values[i];
  return padded;
}

std::vector<Eigen::Vector3d> moved(const mesh::Mesh& mesh, std::span<const double> displacement) {
  const auto dimension = static_cast<std::size_t>(mesh.dimension);
  if (displacement.size() != mesh.points.size() * dimension)
    throw std::invalid_argument(fmt::format("{} displacements for {} nodes in {}D", displacement.size(),
                                            mesh.points.size(), dimension));
  auto points = mesh.points;
  for (std::size_t i = 0; i < displacement.size(); ++i)
    points[i / dimension][static_cast<Eigen::Index>(i % dimension)] += displacement[i];
  return points;
}

} // namespace

void write_vtu(const std::filesystem::path& path, const mesh::Mesh& mesh, std::span<const NodalField> fields,
               const VtuOptions& options) {
  std::vector<std::vector<double>> padded;
  padded.reserve(fields.size());
  std::vector<mesh::VtuArray> arrays;
  for (const auto& field : fields) {
    mesh::VtuArray array{field.name, field.components, field.values, field.component_names};
    if (field.components == 2) {
      array.values = padded.emplace_back(with_third_component(field.values));
      array.components = vector_size;
      if (!array.component_names.empty())
        array.component_names.emplace_back("z");
    }
    arrays.push_back(std::move(array));
  }
  const auto points = options.displacement.empty() ? mesh.points : moved(mesh, options.displacement);
  mesh::write_vtu(path, mesh, arrays,
                  options.all_cells ? mesh::VtuCells::all : mesh::VtuCells::of_highest_dimension, points);
}

PvdSeries::PvdSeries(std::filesystem::path path, std::vector<Entry> entries)
    : path_(std::move(path)), entries_(std::move(entries)) {}

void PvdSeries::add(double time, const std::filesystem::path& file) {
  const auto folder = std::filesystem::absolute(path_).parent_path();
  auto longer = entries_;
  longer.push_back({time, std::filesystem::absolute(file).lexically_proximate(folder)});
  std::swap(entries_, longer);
  try {
    write();
  } catch (...) {
    std::swap(entries_, longer);
    throw;
  }
}

void PvdSeries::rewrite() const {
  if (!entries_.empty())
    return write();
  std::error_code ignored;
  std::filesystem::remove(path_, ignored);
}

void PvdSeries::write() const {
  write_whole(path_, [this](const std::filesystem::path& beside) {
    std::ofstream stream(beside);
    if (!stream)
      throw InputError(fmt::format(
          "file '{}' cannot be written: is there such a folder, and may you write into it?", path_.string()));
    stream << "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\">\n<Collection>\n";
    for (const auto& entry : entries_)
      stream << fmt::format(R"(<DataSet timestep="{:.{}g}" part="0" file="{}"/>)", entry.time, shown_digits,
                            mesh::xml_escaped(entry.file.generic_string()))
             << '\n';
    stream << "</Collection>\n</VTKFile>\n";
    finish_writing(stream, path_);
  });
}

} // namespace rubato::results
