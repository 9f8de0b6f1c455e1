// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/results/ccx_files.hpp"

#include "rubato/core/error.hpp"
#include "rubato/core/writing.hpp"
#include "rubato/model/model.hpp"
#include "rubato/results/frd_blocks.hpp"
#include "rubato/results/run_folder.hpp"

#include <fmt/format.h>

#include <fstream>
#include <sstream>
#include <utility>
#include <vector>

namespace rubato::results {
namespace {

struct CcxPosition {
  std::uintmax_t tables = 0;
  FrdPosition frd;
};

CcxPosition ccx_position(const std::string& text) {
  CcxPosition position;
  std::istringstream stream(text);
  stream >> position.tables >> position.frd.bytes >> position.frd.instants >> position.frd.blocks;
  if (!stream)
    throw InputError(
        fmt::format("the checkpoint has '{}' for the lengths of {} and {}, expected four numbers", text,
                    tables_file, frd_file));
  return position;
}

std::vector<std::filesystem::path> files_of(const std::filesystem::path& folder,
                                            std::span<const std::string> runs, std::string_view file) {
  std::vector<std::filesystem::path> files;
  for (const auto& run : runs)
    if (std::filesystem::exists(folder / run / file))
      files.push_back(folder / run / file);
  return files;
}

void join_text(std::span<const std::filesystem::path> files, const std::filesystem::path& joined) {
  write_whole(joined, [&](const std::filesystem::path& beside) {
    std::ofstream all(beside, std::ios::binary);
    for (const auto& file : files)
      if (std::filesystem::file_size(file) > 0)
        all << std::ifstream(file, std::ios::binary).rdbuf();
    finish_writing(all, beside);
  });
}

} // namespace

CcxFiles::CcxFiles(const model::Model& model, const std::filesystem::path& folder)
    : model_(&model), contact_(model) {
  const auto& output = model.study.fields;
  if (output.frd)
    frd_.emplace(folder / frd_file, model.mesh, frd_settings(model));
  if (!output.tables.empty())
    tables_.emplace(model, folder / tables_file);
}

CcxFiles::CcxFiles(const model::Model& model, const std::filesystem::path& folder,
                   const std::string& position)
    : model_(&model), contact_(model) {
  const auto& output = model.study.fields;
  const auto known = ccx_position(position);
  if (output.frd)
    frd_.emplace(folder / frd_file, model.mesh, frd_settings(model), known.frd);
  if (!output.tables.empty())
    tables_.emplace(model, folder / tables_file, known.tables);
}

void CcxFiles::write_tables(const step::State& now, int number, bool last) {
  if (tables_)
    tables_->write(now, number, last);
}

void CcxFiles::write_fields(const step::State& now, int number, std::span<const OwnedField> fields) {
  if (frd_)
    frd_->add(now.t, number, frd_blocks(*model_, now, fields, contact_));
}

void CcxFiles::cut(const std::string& position) {
  const auto known = ccx_position(position);
  if (frd_)
    frd_->cut(known.frd);
  if (tables_)
    tables_->cut(known.tables);
}

std::string CcxFiles::position() const {
  const auto frd = frd_ ? frd_->position() : FrdPosition{};
  return fmt::format("{} {} {} {}", tables_ ? tables_->bytes() : 0, frd.bytes, frd.instants, frd.blocks);
}

void join_ccx_files(const std::filesystem::path& folder, std::span<const std::string> runs,
                    const std::string& name) {
  const auto join = [&](std::string_view file, const std::string& ending, const auto& write) {
    const auto files = files_of(folder, runs, file);
    const auto joined = folder / (name + ending);
    std::error_code ignored;
    if (files.empty())
      std::filesystem::remove(joined, ignored);
    else
      write(files, joined);
  };
  join(frd_file, ".frd", join_frd);
  join(tables_file, ".dat", join_text);
}

} // namespace rubato::results
