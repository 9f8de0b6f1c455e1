// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/report/page.hpp"

#include "rubato/mesh/io/vtu.hpp"
#include "rubato/report/assets.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>
#include <functional>
#include <string_view>
#include <utility>

namespace rubato::report {
namespace {

constexpr std::array<std::string_view, 2> styles{"vendor/uPlot.min.css", "page.css"};
/// In the order in which they run: each uses those before it.
constexpr std::array<std::string_view, 10> scripts{"vendor/three.min.js",
                                                   "vendor/uPlot.iife.min.js",
                                                   "data.js",
                                                   "words.js",
                                                   "fields.js",
                                                   "picture.js",
                                                   "curves.js",
                                                   "viewer.js",
                                                   "sections.js",
                                                   "main.js"};
constexpr std::array<std::pair<std::string_view, std::string_view>, 2> licences{
    {{"three.js", "vendor/three.LICENSE"}, {"uPlot", "vendor/uPlot.LICENSE"}}};

/// JSON that does not end the script it stands in, whatever its strings are.
std::string harmless(const nlohmann::ordered_json& data) {
  auto text = data.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
  std::string safe;
  safe.reserve(text.size());
  for (const char letter : text) {
    if (letter == '<')
      safe += "\\u003c";
    else
      safe += letter;
  }
  return safe;
}

void write_data(std::ostream& to, const nlohmann::ordered_json& data, std::span<const Blob> blobs) {
  to << R"(<script type="application/json" id="report-data">)" << harmless(data) << "</script>\n";
  for (const auto& blob : blobs)
    to << fmt::format(R"(<script type="text/plain" id="{}">)", blob.name) << blob.text << "</script>\n";
}

void write_scripts(std::ostream& to) {
  for (const auto& [library, file] : licences)
    to << "<!-- " << library << "\n" << asset(file) << "-->\n";
  for (const auto script : scripts)
    to << "<script>\n" << asset(script) << "</script>\n";
}

void write_styles(std::ostream& to) {
  for (const auto style : styles)
    to << asset(style) << '\n';
}

} // namespace

void write_page(std::ostream& to, const std::string& title, const nlohmann::ordered_json& data,
                std::span<const Blob> blobs) {
  const std::array<std::pair<std::string_view, std::function<void()>>, 4> parts{
      {{"@TITLE@", [&] { to << mesh::xml_escaped(title); }},
       {"@STYLES@", [&] { write_styles(to); }},
       {"@DATA@", [&] { write_data(to, data, blobs); }},
       {"@SCRIPTS@", [&] { write_scripts(to); }}}};
  auto rest = asset("page.html");
  for (const auto& [mark, write] : parts) {
    const auto at = rest.find(mark);
    to << rest.substr(0, at);
    write();
    rest.remove_prefix(at + mark.size());
  }
  to << rest;
}

} // namespace rubato::report
