// SPDX-License-Identifier: LGPL-3.0-or-later
// Decks.
#include "rubato/ccx/write.hpp"
#include "rubato/core/error.hpp"
#include "rubato/core/naming.hpp"
#include "rubato/core/writing.hpp"
#include "rubato/deck/read.hpp"

#include <fmt/format.h>

#include "bind.hpp"
#include "values.hpp"
#include <algorithm>
#include <fstream>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

namespace rubato::python {
namespace {

/// As YAML: texts as `--set` has them, nothing for what is removed, all else as JSON.
std::string yaml_of(const py::object& value) {
  if (value.is_none())
    return "~";
  if (py::isinstance<py::str>(value))
    return value.cast<std::string>();
  const auto numbers = py::hasattr(value, "tolist") ? value.attr("tolist")() : value;
  return py::module_::import("json").attr("dumps")(numbers).cast<std::string>();
}

std::vector<deck::Setting> settings_of(const py::dict& settings) {
  std::vector<deck::Setting> result;
  for (const auto& [path, value] : settings)
    result.push_back(
        {Codec<std::string>::from(path, "settings"), yaml_of(py::reinterpret_borrow<py::object>(value))});
  return result;
}

void warn_of(const deck::Deck& deck) {
  for (const auto& note : deck.notes)
    if (PyErr_WarnEx(PyExc_UserWarning, note.c_str(), 1) != 0)
      throw py::error_already_set();
}

/// The run of that name, or the only one.
py::object chosen(const deck::Deck& deck, const std::optional<std::string>& run, const std::string& file) {
  warn_of(deck);
  if (!run && deck.runs.size() > 1) {
    std::string names;
    for (const auto& study : deck.runs)
      names += (names.empty() ? "" : ", ") + study.name;
    throw InputError(fmt::format("found the runs {}, expected the name of one of them as 'run'", names),
                     {file});
  }
  const auto found = run ? std::ranges::find(deck.runs, *run, &study::Study::name) : deck.runs.begin();
  return Codec<study::Study>::to(*found);
}

py::list all_of(const deck::Deck& deck) {
  warn_of(deck);
  py::list studies;
  for (const auto& study : deck.runs)
    studies.append(Codec<study::Study>::to(study));
  return studies;
}

std::vector<std::string> only(const std::optional<std::string>& run) {
  return run ? std::vector{*run} : std::vector<std::string>();
}

/// Writes the runs, or the natural modes of the first one; returns what differs.
std::vector<std::string> write_inp(const std::vector<study::Study>& runs, const std::filesystem::path& path,
                                   const std::optional<int>& modes) {
  if (runs.empty())
    throw InputError("found no study, expected one at least", {path.string()});
  ccx::InputFile file;
  const std::size_t count = modes ? 1 : runs.size();
  for (std::size_t i = 0; i < count; ++i)
    file.add(runs[i], modes ? std::optional(ccx::Frequencies{.number = *modes, .lowest = 0, .highest = {}})
                            : std::nullopt);
  write_whole(path, [&](const std::filesystem::path& beside) {
    std::ofstream stream(beside, std::ios::binary);
    stream << file.text();
    finish_writing(stream, path);
  });
  return file.notes();
}

} // namespace

void bind_deck(py::module_& module) {
  module.def(
      "load",
      [](const std::filesystem::path& path, const std::optional<std::string>& run, const py::dict& settings) {
        return chosen(deck::read_deck(path, settings_of(settings), only(run)), run, path.string());
      },
      py::arg("path"), py::arg("run") = py::none(), py::arg("settings") = py::dict(),
      R"(The study of one run of a deck.

run: its name; may be left out where the deck has one run. settings: changes of the deck, as the program's --set
makes them: {"time.step": 1e-4}. Texts are YAML, None removes a key. Raises InputError with every fault of the
deck, each at file:line:column.)");
  module.def(
      "load_all",
      [](const std::filesystem::path& path, const std::vector<std::string>& runs, const py::dict& settings) {
        return all_of(deck::read_deck(path, settings_of(settings), runs));
      },
      py::arg("path"), py::arg("runs") = py::list(), py::arg("settings") = py::dict(),
      R"(The studies of the named runs of a deck, of all when none is named, and of those they start from.

They come in the order of the deck. settings and errors as of load().)");
  module.def(
      "parse",
      [](const std::string& text, const std::optional<std::string>& run, const py::dict& settings,
         const std::string& file_name) {
        return chosen(deck::parse_deck(text, file_name, settings_of(settings), only(run)), run, file_name);
      },
      py::arg("text"), py::arg("run") = py::none(), py::arg("settings") = py::dict(),
      py::arg("file_name") = "deck",
      R"(The same as load() of a deck that is given as text.

file_name stands in the places of faults; its folder is where mesh files are.)");
  module.def(
      "parse_all",
      [](const std::string& text, const std::vector<std::string>& runs, const py::dict& settings,
         const std::string& file_name) {
        return all_of(deck::parse_deck(text, file_name, settings_of(settings), runs));
      },
      py::arg("text"), py::arg("runs") = py::list(), py::arg("settings") = py::dict(),
      py::arg("file_name") = "deck", "The same as load_all() of a deck that is given as text.");
  module.def(
      "write_inp",
      [](const py::object& studies, const std::filesystem::path& path, const std::optional<int>& modes) {
        std::vector<study::Study> runs;
        if (py::isinstance<py::list>(studies) || py::isinstance<py::tuple>(studies))
          for (const auto& study : studies)
            runs.push_back(Codec<study::Study>::from(study, "studies"));
        else
          runs.push_back(Codec<study::Study>::from(studies, "studies"));
        return write_inp(runs, path, modes);
      },
      py::arg("studies"), py::arg("path"), py::arg("modes") = py::none(),
      R"(Writes a study, or a list of studies that follow one another, as an input file of CalculiX.

modes: so many natural modes of the first study instead. Returns sentences on what differs in CalculiX, which are the
first lines of the file too. Raises InputError for each key that CalculiX has no counterpart of.)");
}

} // namespace rubato::python
