// SPDX-License-Identifier: LGPL-3.0-or-later
/// Inside the project only: a .msh file from its first byte to its last, value by value.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace rubato::mesh::msh {

/// How the numbers between the lines that begin with '$' are written (line $MeshFormat).
struct Encoding {
  bool binary = false;
  bool swapped = false; ///< the other byte order than this machine's
  int size_bytes = 8;   ///< of the numbers that version 4 writes as size_t: 4 or 8
};

/// The whole file and a position in it. What it reads it moves past. Faults are InputErrors that say at which
/// line, of binary files at which byte.
class Input {
public:
  /// `called`: what faults call the file when not by its path.
  Input(const std::filesystem::path& path, const std::filesystem::path& called);

  void set_encoding(Encoding encoding) { encoding_ = encoding; }
  bool is_binary() const { return encoding_.binary; }

  /// The next numbers in the file's encoding: int, size_t, double. `what` they are, for faults.
  std::int64_t integer(std::string_view what);
  std::int64_t size(std::string_view what);
  double real(std::string_view what);
  /// A number of things, each of which takes at least `integers` and `sizes` and `reals`: no more than the
  /// rest of the file can hold.
  struct Least {
    int integers = 0;
    int sizes = 0;
    int reals = 0;
  };
  std::size_t count(std::int64_t count, Least each, std::string_view what) const;

  /// What is text in binary files too: an integer, a word up to the next blank, the rest of the line.
  std::int64_t text_integer(std::string_view what);
  std::string_view word();
  std::string_view rest_of_line();

  /// Moves behind the next line "$Name" and returns the name; empty at the file's end. Lines between sections
  /// are passed over, as Gmsh does.
  std::string_view next_section();
  /// Moves behind "$EndName", which must come next.
  void end_section(std::string_view name);
  void skip_section(std::string_view name);

  [[noreturn]] void refuse(std::string_view text) const;       ///< "mesh file 'a.msh' " + text
  [[noreturn]] void refuse_here(std::string_view text) const;  ///< with the place
  [[noreturn]] void refuse_found(std::string_view what) const; ///< found …, expected `what`

private:
  void skip_blanks();
  std::string_view rest() const { return std::string_view(text_).substr(at_); }
  template <class T> T parsed(std::string_view what);
  template <class T> T raw(std::string_view what);

  std::filesystem::path called_;
  std::string text_;
  std::size_t at_ = 0;
  Encoding encoding_;
};

} // namespace rubato::mesh::msh
