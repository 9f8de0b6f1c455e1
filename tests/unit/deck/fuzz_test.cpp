// SPDX-License-Identifier: LGPL-3.0-or-later
// Mutated decks: each is either read or refused with sentences, never anything else.
#include "rubato/study/echo.hpp"

#include <gtest/gtest.h>

#include "sample_deck.hpp"
#include "support/driven_deck.hpp"
#include <algorithm>
#include <array>
#include <random>
#include <sstream>

namespace rubato::deck::fuzz_test {
namespace {

constexpr std::array tokens{"~",
                            "{",
                            "}",
                            "[",
                            "]",
                            ": ",
                            ", ",
                            "- ",
                            "\n",
                            "\n  ",
                            "#",
                            "&a ",
                            "*a",
                            "<<: *a",
                            "!!str ",
                            "? ",
                            "'",
                            "\"",
                            "|\n",
                            ">-\n",
                            "---\n",
                            "...\n",
                            "%YAML 1",
                            "\t",
                            "-1e7",
                            "1e999",
                            "nan",
                            "-0",
                            "99999999999",
                            "0x1",
                            "1e-3s",
                            "",
                            "mesh",
                            "file",
                            "generate",
                            "box",
                            "rectangle",
                            "refine",
                            "solid",
                            "hht",
                            "static",
                            "alpha",
                            "step",
                            "end",
                            "instants",
                            "start",
                            "from",
                            "runs",
                            "run",
                            "evol1",
                            "contact",
                            "interface",
                            "master",
                            "slave",
                            "friction",
                            "gauss",
                            "probes",
                            "checks",
                            "tip.y",
                            "tip",
                            "functions",
                            "ramp",
                            "times",
                            "values",
                            "supports",
                            "fix",
                            "x",
                            "z",
                            "loads",
                            "pressure",
                            "gravity",
                            "all",
                            "along",
                            "normal",
                            "turn",
                            "velocity",
                            "until",
                            "rigid",
                            "embedded",
                            "at",
                            "x/0",
                            "log(t)",
                            "system(x)",
                            "acceleration",
                            "on",
                            "in",
                            "expansion",
                            "modes",
                            "\xC3\xA9",
                            "\xFF",
                            "\x01",
                            "\\",
                            "@",
                            "`",
                            "\xEF\xBB\xBF",
                            "\r\n"};

/// Draws that are the same on every machine: the standard's distributions are not.
class Draw {
public:
  explicit Draw(std::uint32_t seed) : engine_(seed) {}
  std::size_t below(std::size_t bound) { return bound == 0 ? 0 : engine_() % bound; }
  std::string token() { return tokens[below(tokens.size())]; }

private:
  std::mt19937 engine_;
};

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);)
    lines.push_back(line);
  return lines;
}

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const auto& line : lines)
    text += line + "\n";
  return text;
}

bool is_word(char letter) {
  return std::isalnum(static_cast<unsigned char>(letter)) != 0 || letter == '_';
}

/// Begin and length of a word drawn from the text; the text has one.
std::pair<std::size_t, std::size_t> draw_word(const std::string& text, Draw& draw) {
  auto begin =
      std::find_if(text.begin() + static_cast<std::ptrdiff_t>(draw.below(text.size())), text.end(), is_word);
  if (begin == text.end())
    begin = std::find_if(text.begin(), text.end(), is_word);
  const auto end = std::find_if_not(begin, text.end(), is_word);
  return {static_cast<std::size_t>(begin - text.begin()), static_cast<std::size_t>(end - begin)};
}

std::string with_lines_moved(const std::string& text, Draw& draw) {
  auto lines = lines_of(text);
  if (lines.empty())
    return text;
  const auto from = draw.below(lines.size());
  const auto to = static_cast<std::ptrdiff_t>(draw.below(lines.size()));
  switch (draw.below(3)) {
  case 0:
    lines.insert(lines.begin() + to, lines[from]);
    break;
  case 1:
    lines.erase(lines.begin() + to);
    break;
  default:
    std::swap(lines[from], lines[static_cast<std::size_t>(to)]);
  }
  return joined(lines);
}

std::string mutated(std::string text, Draw& draw) {
  if (text.empty())
    return draw.token();
  const auto at = draw.below(text.size());
  switch (draw.below(6)) {
  case 0:
    text[at] = static_cast<char>(static_cast<unsigned char>(text[at]) ^ (1U << draw.below(8)));
    return text;
  case 1:
    return text.erase(at, 1 + draw.below(12));
  case 2:
    return text.insert(at, draw.token());
  case 3:
    return with_lines_moved(text, draw);
  case 4: {
    const auto [begin, length] = draw_word(text, draw);
    return text.replace(begin, length, draw.token());
  }
  default: {
    const auto [from, from_length] = draw_word(text, draw);
    const auto word = text.substr(from, from_length);
    const auto [to, to_length] = draw_word(text, draw);
    return text.replace(to, to_length, word);
  }
  }
}

Setting drawn_setting(Draw& draw) {
  std::string path = draw.token();
  for (auto steps = draw.below(4); steps > 0; --steps)
    path.append(".").append(draw.below(4) == 0 ? std::to_string(draw.below(3)) : draw.token());
  return {path, draw.token()};
}

const std::string deck_with_runs = test::full_deck + R"(runs:
  evol1: &a {}
  evol2: {contact: {interface: {friction: 0.5}}, time: {scheme: newmark, alpha: ~}}
  evol3: {<<: *a, initial: ~, time: {start: {from: evol1}}}
)";

/// What is read can be echoed and read again, unless it needs another run beside it.
void expect_sound(const Deck& deck, const std::string& text) {
  EXPECT_FALSE(deck.runs.empty()) << text;
  for (const auto& study : deck.runs) {
    if (study.time.start == study::StartKind::from_run)
      continue;
    EXPECT_EQ(parse_deck(study::to_json(study), "echo.json").runs.at(0), study) << text;
  }
}

/// Reads a deck; true when it was valid. A refusal must say something and say where.
bool reads(const std::string& text, const std::vector<Setting>& settings) {
  try {
    expect_sound(parse_deck(text, "fuzz.yaml", settings), text);
    return true;
  } catch (const InputError& error) {
    EXPECT_FALSE(error.faults().empty()) << text;
    for (const auto& fault : error.faults()) {
      EXPECT_FALSE(to_string(fault.at).empty()) << text;
      EXPECT_FALSE(fault.text.empty()) << text;
    }
    return false;
  }
}

/// Reads mutations of a deck that `draw_deck` chooses, with settings in every fourth; how many are valid.
template <class DrawDeck> int valid_mutations(int decks, const DrawDeck& draw_deck) {
  int valid = 0;
  for (int i = 0; i < decks; ++i) {
    Draw draw(static_cast<std::uint32_t>(i));
    std::string text = draw_deck(draw);
    for (auto mutations = 1 + draw.below(1 + draw.below(10)); mutations > 0; --mutations)
      text = mutated(std::move(text), draw);
    std::vector<Setting> settings;
    if (draw.below(4) == 0)
      settings.push_back(drawn_setting(draw));
    valid += reads(text, settings) ? 1 : 0;
  }
  return valid;
}

// Both outcomes must be common, or the mutations test nothing.
TEST(DeckFuzz, MutatedDecksAreReadOrRefusedWithASentence) {
  constexpr int decks = 2000;
  const int valid = valid_mutations(
      decks, [](Draw& draw) { return draw.below(4) == 0 ? test::smallest_deck : deck_with_runs; });
  EXPECT_GT(valid, decks / 50);
  EXPECT_LT(valid, decks / 2);
}

TEST(DeckFuzz, MutatedDecksOfWhatHoldsAndDrivesAreReadOrRefusedWithASentence) {
  constexpr int decks = 2000;
  ASSERT_TRUE(reads(test::driven_deck, {}));
  const int valid = valid_mutations(decks, [](Draw&) { return test::driven_deck; });
  EXPECT_GT(valid, decks / 50);
  EXPECT_LT(valid, decks / 2);
}

} // namespace
} // namespace rubato::deck::fuzz_test
