// SPDX-License-Identifier: LGPL-3.0-or-later
// Mutated .inp files: each ends in studies that keep every rule or in sentences with places, whatever the
// bytes. RUBATO_MUTATIONS says how many there are, 2,000 when it does not.
#include "rubato/inp/read.hpp"
#include "rubato/mesh/io/inp_content.hpp"
#include "rubato/study/validate.hpp"

#include <gtest/gtest.h>

#include "computed.hpp"
#include <array>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <random>
#include <string_view>

namespace rubato::fuzz_test {
namespace {

int mutation_count(int by_default) {
  const char* wanted = std::getenv("RUBATO_MUTATIONS");
  return wanted != nullptr ? std::atoi(wanted) : by_default;
}

/// Changes bytes, words and lines as files get damaged, by the generator's raw numbers alone.
class Mutation {
public:
  explicit Mutation(unsigned seed) : random_(seed) {}

  std::string of(std::string text) {
    const auto times = 1 + below(4);
    for (std::size_t i = 0; i < times && !text.empty(); ++i)
      change(text);
    return text;
  }

private:
  std::size_t below(std::size_t limit) { return random_() % limit; }

  void change(std::string& text) {
    const auto at = below(text.size());
    const auto length = std::min(text.size() - at, 1 + below(64));
    switch (below(9)) {
    case 0: // any byte
      text[at] = static_cast<char>(random_());
      break;
    case 1: // a part lost
      text.erase(at, length);
      break;
    case 2: // the end lost
      text.resize(at);
      break;
    case 3: // a part twice
      text.insert(at, text.substr(at, length));
      break;
    case 4: // a part elsewhere
      text.insert(below(text.size()), text.substr(at, length));
      break;
    case 5: // another number
      change_number(text, at);
      break;
    case 6: // another word
      change_word(text, at);
      break;
    case 7: // a line lost
      text.erase(at, std::min(text.find('\n', at), text.size() - 1) + 1 - at);
      break;
    default: // a sign of the format
      text[at] = std::string_view("*,=\n\"'. -")[below(9)];
    }
  }

  void change_number(std::string& text, std::size_t at) {
    static constexpr std::array<std::string_view, 11> numbers{
        "0",     "-1", "1",    "9", "2147483648", "9223372036854775807", "99999999999999999999",
        "1e400", "x",  "1.D5", ""};
    const auto first = text.find_first_of("0123456789", at);
    if (first == std::string::npos)
      return;
    const auto last = std::min(text.size(), text.find_first_not_of("0123456789", first));
    text.replace(first, last - first, numbers[below(numbers.size())]);
  }

  void change_word(std::string& text, std::size_t at) {
    static constexpr std::array<std::string_view, 14> words{
        "*NODE\n",   "*STEP\n",   "*END STEP\n", "*PART, NAME=P\n", "*ELEMENT, TYPE=C3D20\n",
        "GENERATE",  "TYPE=CPS4", "OP=NEW",      "NLGEOM",          "*BOUNDARY\n",
        "*STATIC\n", "*CLOAD\n",  "ELSET=",      "*EQUATION\n 3\n"};
    text.insert(below(2) == 0 ? at : std::min(text.find('\n', at), text.size() - 1) + 1,
                words[below(words.size())]);
  }

  std::mt19937 random_;
};

std::string text_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// Whether a sentence says something and where.
void expect_sentence(const Fault& fault, const std::string& name) {
  EXPECT_EQ(fault.at.file.rfind(name, 0) == 0 || fault.at.file.ends_with(".inc"), true) << fault.text;
  EXPECT_GT(fault.text.size(), 10U);
  EXPECT_EQ(fault.text.find('\n'), std::string::npos) << fault.text;
}

TEST(MutatedInp, EndsInSoundStudiesOrInSentences) {
  std::vector<std::string> texts;
  for (const auto& file : test::all_inp_files())
    if (std::filesystem::file_size(file) < 8000)
      texts.push_back(text_of(file));
  ASSERT_GE(texts.size(), 40U);
  const int count = mutation_count(2000);
  int refused = 0;
  for (int i = 0; i < count; ++i) {
    const auto seed = static_cast<unsigned>(i);
    const auto text = Mutation(seed).of(texts[seed % texts.size()]);
    SCOPED_TRACE(seed);
    try {
      const auto input =
          inp::parse_input(text, "a.inp", i % 10 == 0 ? inp::Purpose::modes : inp::Purpose::run);
      EXPECT_FALSE(input.runs.empty());
      for (const auto& study : input.runs)
        EXPECT_TRUE(study::broken_rules(study).empty());
      const auto mesh = mesh::inp::mesh_of(mesh::inp::parse_content(text, "a.inp"));
      EXPECT_GT(mesh.cell_count(), 0);
    } catch (const InputError& error) {
      ++refused;
      ASSERT_FALSE(error.faults().empty());
      for (const auto& fault : error.faults())
        expect_sentence(fault, "a.inp");
    }
  }
  // Damage is mostly seen, and not everything is taken for damage.
  EXPECT_GT(refused, count / 3);
  EXPECT_LT(refused, count);
}

} // namespace
} // namespace rubato::fuzz_test
