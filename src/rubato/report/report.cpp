// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/report/report.hpp"

#include "rubato/core/error.hpp"
#include "rubato/core/writing.hpp"
#include "rubato/report/page.hpp"
#include "rubato/report/quantise.hpp"
#include "rubato/report/run_record.hpp"
#include "rubato/report/view_data.hpp"
#include "rubato/results/stored_fields.hpp"
#include "rubato/version.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <optional>

namespace rubato::report {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// The version of uPlot, which does not tell it itself.
constexpr std::string_view uplot_version = "1.6.32";

/// The page without any field: scripts, styles, tables.
constexpr std::size_t room_beside_fields = 3'000'000;

/// One run as the page has it.
struct RunPage {
  Json json;
  std::vector<Blob> blobs = {};
  std::vector<std::string> notes = {};
};

std::string how_to_get_fields(const Json& study) {
  const auto end = study.contains("time") ? study.at("time").value("end", 1.0) : 1.0;
  return fmt::format("The run stored no fields, so that there is no view of it. They are stored with "
                     "'fields: {{at: [{}]}}' or 'fields: {{every: 1}}' in the deck.",
                     end);
}

std::string percent_of_range(std::uint16_t levels) {
  constexpr double percent = 100.0;
  return fmt::format("{:.1g} %", percent / (2.0 * levels));
}

/// What thinning out has done.
std::vector<std::string> notes_on(const ViewData& view) {
  std::vector<std::string> notes;
  for (const auto& field : view.description.at("fields"))
    if (const auto levels = field.at("levels").get<std::uint16_t>(); levels != finest_levels) {
      notes.push_back(fmt::format("To keep the report below {} MB, fields other than the displacement are "
                                  "rounded to {} of their range at each instant",
                                  largest_report / 1'000'000, percent_of_range(levels)));
      break;
    }
  if (view.shown_instants < view.stored_instants)
    notes.push_back(fmt::format("To keep the report below {} MB, it holds {} of the {} instants stored",
                                largest_report / 1'000'000, view.shown_instants, view.stored_instants));
  return notes;
}

void add_view(const fs::path& folder, std::size_t room, RunPage& page) {
  const auto fields = results::stored_fields(folder);
  if (!fields) {
    page.json["no_view"] = how_to_get_fields(page.json.at("study"));
    page.notes.push_back(page.json.at("no_view"));
    return;
  }
  auto view = view_data(*fields, page.json.at("prefix").get<std::string>(), room);
  page.notes = notes_on(view);
  page.blobs = std::move(view.blobs);
  if (view.description.at("drawn_nodes") == 0)
    page.json["no_view"] = "The mesh has no cells that could be drawn.";
  else
    page.json["view"] = std::move(view.description);
}

RunPage run_page(const fs::path& folder, std::size_t number, std::size_t room) {
  RunPage page{.json = run_record(folder)};
  page.json["prefix"] = fmt::format("r{}", number);
  page.json["view"] = nullptr;
  try {
    add_view(folder, room, page);
  } catch (const InputError& error) {
    page.json["no_view"] = fmt::format("The fields of the run cannot be read: {}", error.what());
    page.notes.push_back(page.json.at("no_view"));
  }
  for (const auto& note : page.notes)
    if (!page.json.at("view").is_null())
      page.json["warnings"].push_back(note + ".");
  return page;
}

std::string title_of(const Json& run) {
  const auto title = run.at("study").value("title", "");
  const auto name = run.at("summary").at("run").get<std::string>();
  return title.empty() ? name : fmt::format("{}: {}", title, name);
}

} // namespace

Written write_report(std::span<const fs::path> runs, const fs::path& file, std::size_t largest) {
  Json data{{"rubato", std::string(version)}, {"uplot", std::string(uplot_version)}, {"runs", Json::array()}};
  Written written;
  std::vector<Blob> blobs;
  const auto room = (largest - std::min(largest, room_beside_fields)) / std::max<std::size_t>(1, runs.size());
  for (std::size_t i = 0; i < runs.size(); ++i) {
    auto page = run_page(runs[i], i, room);
    data["runs"].push_back(std::move(page.json));
    std::ranges::move(page.blobs, std::back_inserter(blobs));
    for (const auto& note : page.notes)
      written.notes.push_back(fmt::format("{}: {}", runs[i].string(), note));
  }
  write_whole(file, [&](const fs::path& beside) {
    std::ofstream stream(beside, std::ios::binary);
    if (!stream)
      throw InputError(fmt::format(
          "{}: cannot be written: is there such a folder, and may you write into it?", file.string()));
    write_page(stream, title_of(data.at("runs").at(0)), data, blobs);
    finish_writing(stream, beside);
  });
  written.bytes = fs::file_size(file);
  return written;
}

} // namespace rubato::report
