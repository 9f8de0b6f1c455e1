// SPDX-License-Identifier: LGPL-3.0-or-later
// Mutated mesh files: each ends in a mesh or in one sentence, whatever the bytes. RUBATO_MUTATIONS says how
// many there are of each kind, 2,000 for a thorough look.
#include "rubato/core/error.hpp"
#include "rubato/mesh/io/mail.hpp"
#include "rubato/mesh/io/med.hpp"
#include "rubato/mesh/io/msh.hpp"
#include "rubato/mesh/quality.hpp"

#include <gtest/gtest.h>

#include "msh_making.hpp"
#include "one_cell.hpp"
#include "support/scratch_folder.hpp"
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <random>
#include <string_view>
#include <sys/resource.h>
#include <unistd.h>

namespace rubato::mesh::fuzz_test {
namespace {

using test::MshKind;

int mutation_count(int by_default) {
  const char* wanted = std::getenv("RUBATO_MUTATIONS");
  return wanted != nullptr ? std::atoi(wanted) : by_default;
}

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// Changes bytes in one of the ways in which files get damaged, by the generator's raw numbers alone: the
/// same everywhere.
class Mutation {
public:
  explicit Mutation(unsigned seed) : random_(seed) {}

  std::string of(std::string bytes) {
    const auto times = 1 + below(4);
    for (std::size_t i = 0; i < times && !bytes.empty(); ++i)
      change(bytes);
    return bytes;
  }

private:
  std::size_t below(std::size_t limit) { return random_() % limit; }

  void change(std::string& bytes) {
    const auto at = below(bytes.size());
    const auto length = std::min(bytes.size() - at, 1 + below(64));
    switch (below(8)) {
    case 0: // any byte
      bytes[at] = static_cast<char>(random_());
      break;
    case 1: // one bit
      bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8)));
      break;
    case 2: // a number as text
      change_number(bytes, at);
      break;
    case 3: // a number as bytes
      change_word(bytes, at);
      break;
    case 4: // the end lost
      bytes.resize(at);
      break;
    case 5: // a part lost
      bytes.erase(at, length);
      break;
    case 6: // a part twice
      bytes.insert(at, bytes.substr(at, length));
      break;
    default: // a part elsewhere
      bytes.replace(below(bytes.size()), length, bytes.substr(at, length));
    }
  }

  /// The next run of digits becomes another number.
  void change_number(std::string& bytes, std::size_t at) {
    static constexpr std::array<std::string_view, 10> numbers{
        "0",     "-1", "1", "9", "2147483647", "2147483648", "9223372036854775807", "99999999999999999999",
        "1e400", "x"};
    constexpr std::string_view digits = "0123456789";
    const auto first = bytes.find_first_of(digits, at);
    if (first == std::string::npos)
      return;
    const auto last = std::min(bytes.size(), bytes.find_first_not_of(digits, first));
    bytes.replace(first, last - first, numbers[below(numbers.size())]);
  }

  /// Four or eight bytes become a number that counts and offsets should not be.
  void change_word(std::string& bytes, std::size_t at) {
    static constexpr std::array<std::uint64_t, 8> words{0,
                                                        1,
                                                        0xFFFFFFFFU,
                                                        0x7FFFFFFFU,
                                                        0x80000000U,
                                                        0xFFFFFFFFFFFFFFFFU,
                                                        0x7FFFFFFFFFFFFFFFU,
                                                        0x10000000000U};
    const auto word = words[below(words.size())];
    const std::size_t width = below(2) == 0 ? 4 : 8;
    for (std::size_t i = 0; i < width && at + i < bytes.size(); ++i)
      bytes[at + i] = static_cast<char>(word >> (8 * i));
  }

  std::mt19937 random_;
};

/// No more than half a gigabyte beyond what is taken already. The address sanitizer reserves more than any
/// limit and has its own (allocation_limit.cpp).
class LimitedMemory {
public:
  LimitedMemory() {
    getrlimit(RLIMIT_AS, &before_);
#ifndef __SANITIZE_ADDRESS__
    std::size_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    constexpr rlim_t room = 512U << 20U;
    const rlimit limited{pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE)) + room, before_.rlim_max};
    if (pages > 0)
      setrlimit(RLIMIT_AS, &limited);
#endif
  }
  ~LimitedMemory() {
    setrlimit(RLIMIT_AS, &before_);
  }
  LimitedMemory(const LimitedMemory&) = delete;
  LimitedMemory& operator=(const LimitedMemory&) = delete;

private:
  rlimit before_{};
};

struct Endings {
  int meshes = 0;
  int sentences = 0;
};

/// Reads mutations of a file; each must end in one of the two ways.
template <class Read> Endings endings(const std::string& sound, int mutations, Read read) {
  const test::ScratchFolder folder;
  const LimitedMemory limit;
  Endings found;
  for (int i = 0; i < mutations; ++i) {
    std::ofstream(folder / "mutated", std::ios::binary) << Mutation(static_cast<unsigned>(i)).of(sound);
    try {
      examine(read(folder / "mutated"));
      ++found.meshes;
    } catch (const InputError& error) {
      EXPECT_EQ(error.faults().size(), 1U) << i;
      EXPECT_EQ(error.faults().front().text.find('\n'), std::string::npos) << i;
      ++found.sentences;
    } catch (const std::exception& error) {
      ADD_FAILURE() << "mutation " << i << " ends in: " << error.what();
    }
  }
  return found;
}

class MutatedMshFile : public testing::TestWithParam<MshKind> {};

TEST_P(MutatedMshFile, EndsInAMeshOrASentence) {
  const auto sound = msh_bytes(test::two_cubes(), GetParam());
  const int mutations = mutation_count(500);
  const auto found = endings(sound, mutations, [](const auto& path) { return read_msh(path); });
  EXPECT_EQ(found.meshes + found.sentences, mutations);
  EXPECT_GT(found.sentences, mutations / 4);
  EXPECT_GT(found.meshes, 0);
}

INSTANTIATE_TEST_SUITE_P(Gmsh, MutatedMshFile, testing::ValuesIn(test::all_msh_kinds),
                         [](const auto& kind) { return kind.param.name(); });

TEST(MutatedMedFile, EndsInAMeshOrASentence) {
  const test::ScratchFolder folder;
  auto mesh = test::one_cell(CellType::hexa27, 3);
  mesh.node_names.resize(mesh.points.size());
  for (std::size_t i = 0; i < mesh.node_names.size(); ++i)
    mesh.node_names[i] = "A" + std::to_string(i);
  write_med(folder / "sound.med", mesh);
  const int mutations = mutation_count(100);
  const auto found =
      endings(bytes_of(folder / "sound.med"), mutations, [](const auto& path) { return read_med(path); });
  EXPECT_EQ(found.meshes + found.sentences, mutations);
  EXPECT_GT(found.sentences, mutations / 4);
  EXPECT_GT(found.meshes, 0);
}

TEST(MutatedMailFile, EndsInAMeshOrASentence) {
  const test::ScratchFolder folder;
  write_mail(folder / "sound.mail", test::one_cell(CellType::hexa27, 3));
  const int mutations = mutation_count(500);
  const auto found =
      endings(bytes_of(folder / "sound.mail"), mutations, [](const auto& path) { return read_mail(path); });
  EXPECT_EQ(found.meshes + found.sentences, mutations);
  EXPECT_GT(found.sentences, mutations / 4);
  EXPECT_GT(found.meshes, 0);
}

} // namespace
} // namespace rubato::mesh::fuzz_test
