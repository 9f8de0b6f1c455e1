// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/plot/picture_file.hpp"
#include "rubato/plot/svg.hpp"

#include <gtest/gtest.h>

#include "support/faults.hpp"
#include "support/scratch_folder.hpp"
#include <fstream>
#include <iterator>

namespace rubato::plot::picture_file_test {
namespace {

std::string text_of(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::string small_picture() {
  Svg svg({120, 80}, "small");
  svg.text({10, 40}, "µ = 0.3", {});
  return std::move(svg).finish();
}

TEST(PictureFiles, AreTheSvgItselfOrItsPixels) {
  const test::ScratchFolder folder;
  write_picture(folder / "a.svg", small_picture());
  EXPECT_EQ(text_of(folder / "a.svg"), small_picture());
  write_picture(folder / "a.PNG", small_picture());
  const auto png = text_of(folder / "a.PNG");
  EXPECT_TRUE(png.starts_with("\x89PNG\r\n\x1a\n"));
  EXPECT_EQ(png.substr(16, 8), std::string("\0\0\0\x78\0\0\0\x50", 8)) << "120 by 80";
}

TEST(PictureFiles, AreNotBegunWhereTheyCannotBeMade) {
  const test::ScratchFolder folder;
  const auto fault = [&](const std::string& name) {
    return test::fault_of([&] { write_picture(folder / name, small_picture()); });
  };
  EXPECT_EQ(fault("a.jpg"), (folder / "a.jpg").string() + ": found the ending '.jpg', expected .svg or .png");
  EXPECT_EQ(fault("none/a.svg"),
            (folder / "none/a.svg").string() + ": cannot be written: there is no such folder");
  std::filesystem::create_directory(folder / "b.svg");
  EXPECT_EQ(fault("b.svg"), (folder / "b.svg").string() + ": cannot be written: it is a folder");
  EXPECT_THROW(write_picture(folder / "a.png", "no picture"), std::runtime_error);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

} // namespace
} // namespace rubato::plot::picture_file_test
