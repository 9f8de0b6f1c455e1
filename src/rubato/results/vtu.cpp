// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/results/vtu.hpp"

#include "rubato/core/error.hpp"
#include "rubato/core/writing.hpp"
#include "rubato/mesh/io/vtu.hpp"
#include "rubato/results/vtk_arrays.hpp"

#include <fmt/format.h>

#include <fstream>
#include <stdexcept>
#include <utility>

namespace rubato::results {
namespace {

/// Of an instant. Nine steps of 0.001 add up to 0.009000000000000001: what rounding adds, over many steps
/// more than the last digit, is not shown.
constexpr int shown_digits = 12;

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
  const VtkArrays arrays(fields, options.cell_fields);
  const auto points = options.displacement.empty() ? mesh.points : moved(mesh, options.displacement);
  mesh::write_vtu(path, mesh, arrays.all(),
                  {.which = options.all_cells ? mesh::VtuCells::all : mesh::VtuCells::of_highest_dimension,
                   .points = points,
                   .digits = options.digits});
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
