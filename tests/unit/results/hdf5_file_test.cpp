// SPDX-License-Identifier: LGPL-3.0-or-later
// Named arrays and texts in a file.
#include "rubato/core/writing.hpp"
#include "rubato/results/hdf5_file.hpp"

#include <gtest/gtest.h>

#include "support/scratch_folder.hpp"
#include <bit>
#include <chrono>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <thread>

namespace rubato::results::hdf5_file_test {
namespace {

using Access = Hdf5File::Access;
using Numbers = std::vector<double>;
using Integers = std::vector<std::int64_t>;

class StoredArrays : public testing::Test {
protected:
  /// Calls `write` with a new file, and closes it.
  template <class Write>
  void store(const Write& write, const std::string& name = "file.h5", std::uint64_t user_block = 0) const {
    Hdf5File file(folder_ / name, Access::create, user_block);
    write(file);
    file.close();
  }
  Hdf5File stored(const std::string& name = "file.h5") const { return {folder_ / name, Access::read}; }
  std::string bytes(const std::string& name) const {
    std::ifstream file(folder_ / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  /// What is said when `call` fails; nothing when it doesn't.
  template <class Call> static std::string failure_of(const Call& call) {
    try {
      call();
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }

  test::ScratchFolder folder_;
};

TEST_F(StoredArrays, ComeBackBitForBit) {
  constexpr auto limits = std::numeric_limits<double>();
  const Numbers numbers{0.1, -0.0, limits.infinity(), limits.quiet_NaN(), limits.denorm_min(), limits.max()};
  const Integers integers{std::numeric_limits<std::int64_t>::min(), -1, 0, (std::int64_t{1} << 53) + 1,
                          std::numeric_limits<std::int64_t>::max()};
  store([&](Hdf5File& file) {
    file.write("numbers", numbers);
    file.write("integers", integers);
  });
  const auto file = stored();
  const auto back = file.numbers("numbers");
  ASSERT_EQ(back.size(), numbers.size());
  for (std::size_t i = 0; i < numbers.size(); ++i)
    EXPECT_EQ(std::bit_cast<std::uint64_t>(back[i]), std::bit_cast<std::uint64_t>(numbers[i])) << numbers[i];
  EXPECT_EQ(file.integers("integers"), integers);
}

TEST_F(StoredArrays, MayBeEmpty) {
  store([](Hdf5File& file) {
    file.write("numbers", Numbers{});
    file.write("integers", Integers{});
    file.write("text", std::string_view());
  });
  const auto file = stored();
  EXPECT_TRUE(file.has("numbers"));
  EXPECT_EQ(file.numbers("numbers"), Numbers{});
  EXPECT_EQ(file.integers("integers"), Integers{});
  EXPECT_EQ(file.text("text"), "");
}

TEST_F(StoredArrays, StandBesideTextsOfAnyLengthAndLanguage) {
  const std::string words = "λ = 3 μm\n\"name\": 'Größe'";
  const std::string longer(100000, 'x');
  store([&](Hdf5File& file) {
    file.write("short", words);
    file.write("long", longer);
    file.write("part", std::string_view(longer).substr(0, 3)); // not ended by a zero
  });
  const auto file = stored();
  EXPECT_EQ(file.text("short"), words);
  EXPECT_EQ(file.text("long"), longer);
  EXPECT_EQ(file.text("part"), "xxx");
}

TEST_F(StoredArrays, HaveNamesOfSeveralParts) {
  store([](Hdf5File& file) {
    file.write("state/u", Numbers{1});
    file.write("state/zones/u", Numbers{2, 3});
  });
  const auto file = stored();
  EXPECT_EQ(file.numbers("state/u"), Numbers{1});
  EXPECT_EQ(file.numbers("state/zones/u"), (Numbers{2, 3}));
  EXPECT_TRUE(file.has("state/u"));
  EXPECT_FALSE(file.has("state/v"));
  EXPECT_TRUE(file.has("state/zones"));
  EXPECT_FALSE(file.has("nowhere/u"));
}

TEST_F(StoredArrays, OfThatNameMustBeThere) {
  store([](Hdf5File& file) { file.write("u", Numbers{1}); });
  const auto file = stored();
  const auto sentence = (folder_ / "file.h5").string() + ": holds no 'v'";
  EXPECT_EQ(failure_of([&] { file.numbers("v"); }), sentence);
  EXPECT_EQ(failure_of([&] { file.integers("v"); }), sentence);
  EXPECT_EQ(failure_of([&] { file.text("v"); }), sentence);
}

TEST_F(StoredArrays, AreNoNumbersWhereATextStands) {
  store([](Hdf5File& file) { file.write("word", std::string_view("seven")); });
  EXPECT_EQ(failure_of([&] { stored().numbers("word"); }),
            (folder_ / "file.h5").string() + ": 'word' cannot be read");
}

TEST_F(StoredArrays, AreWrittenOnce) {
  Hdf5File file(folder_ / "file.h5", Access::create);
  file.write("u", Numbers{1});
  EXPECT_THROW(file.write("u", Numbers{2}), WriteError);
  file.close();
  EXPECT_EQ(stored().numbers("u"), Numbers{1});
}

TEST_F(StoredArrays, AreNotWrittenIntoAFileThatIsRead) {
  store([](Hdf5File& file) { file.write("u", Numbers{1}); });
  auto file = stored();
  EXPECT_THROW(file.write("v", Numbers{2}), WriteError);
}

/// HDF5 counts times in seconds.
TEST_F(StoredArrays, GiveTheSameBytesEachTime) {
  const auto write = [](Hdf5File& file) {
    file.write("state/u", Numbers{1, 2});
    file.write("name", std::string_view("run"));
  };
  store(write, "one.h5");
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));
  store(write, "other.h5");
  EXPECT_FALSE(bytes("one.h5").empty());
  EXPECT_EQ(bytes("one.h5"), bytes("other.h5"));
}

TEST_F(StoredArrays, TakeThePlaceOfAFormerFile) {
  store([](Hdf5File& file) { file.write("u", Numbers(1000, 1.0)); });
  store([](Hdf5File& file) { file.write("v", Numbers{2}); });
  EXPECT_FALSE(stored().has("u"));
  EXPECT_EQ(stored().numbers("v"), Numbers{2});
}

TEST_F(StoredArrays, LeaveTheBytesInFrontAlone) {
  const auto write = [](Hdf5File& file) { file.write("u", Numbers{1, 2}); };
  store(write, "plain.h5");
  store(write, "with_block.h5", 512);
  {
    std::fstream file(folder_ / "with_block.h5", std::ios::in | std::ios::out | std::ios::binary);
    file << std::string(512, '#');
  }
  EXPECT_EQ(bytes("with_block.h5").size(), bytes("plain.h5").size() + 512);
  EXPECT_EQ(stored("with_block.h5").numbers("u"), (Numbers{1, 2}));
  EXPECT_EQ(bytes("with_block.h5").substr(0, 512), std::string(512, '#'));
}

TEST_F(StoredArrays, NeedAnHdf5File) {
  std::ofstream(folder_ / "text.h5") << "no such file";
  for (const char* name : {"text.h5", "missing.h5"})
    EXPECT_EQ(failure_of([&] { stored(name); }),
              (folder_ / name).string() + ": cannot be opened as an HDF5 file");
  EXPECT_EQ(failure_of([&] { Hdf5File(folder_ / "missing/file.h5", Access::create); }),
            (folder_ / "missing/file.h5").string() + ": cannot be written");
}

} // namespace
} // namespace rubato::results::hdf5_file_test
