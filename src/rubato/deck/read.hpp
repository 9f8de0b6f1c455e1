// SPDX-License-Identifier: LGPL-3.0-or-later
/// The deck module: a YAML deck becomes studies, plain data that the rest of the program works from.
#pragma once

#include "rubato/deck/places.hpp"
#include "rubato/deck/setting.hpp"
#include "rubato/study/study.hpp"

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rubato::deck {

/// Splits "path=value". Throws InputError when there is no path or no "=".
Setting parse_setting(std::string_view argument);

/// A deck read whole.
struct Deck {
  std::string title;
  std::vector<study::Study>
      runs; ///< in the order of the file, at least one; a run starts only from an earlier one
  std::vector<Places> places;     ///< where the values of each run are written
  std::vector<std::string> notes; ///< sentences that whoever gave the settings should read
};

/// Reads a deck from a file: the runs that `only` names, all when it is empty, and those they start from;
/// others are not looked at. Each run is the deck with the run's own entries and then the settings laid over
/// it: maps are merged key by key, words and lists are replaced whole, `~` removes a key. A setting whose
/// path starts with `runs.NAME.` changes one run, any other changes all that are asked for; a note names each
/// run that it would have changed besides. Of mesh.file and mesh.generate the one given last stands.
/// mesh.file is relative to the folder of the deck, in a setting to the current folder. Throws one InputError
/// with every fault of these runs, each at file:line:column, settings at "--set path", names of runs at
/// "--only".
Deck read_deck(const std::filesystem::path& file, std::span<const Setting> settings = {},
               std::span<const std::string> only = {});

/// The same from text; `file_name` stands in the places of faults, its folder is where mesh files are.
Deck parse_deck(std::string_view text, const std::string& file_name, std::span<const Setting> settings = {},
                std::span<const std::string> only = {});

/// Reads back what study::to_json wrote, to an equal study; the other runs that it names are not looked for.
/// Throws as parse_deck does.
study::Study parse_echo(std::string_view text, const std::string& file_name);

/// Whether the study is still a sound one with these settings laid over it, as far as the deck alone tells.
bool accepts(const study::Study& study, std::span<const Setting> settings);

} // namespace rubato::deck
