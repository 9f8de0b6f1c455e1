// SPDX-License-Identifier: LGPL-3.0-or-later
/// What several runs say at once: whole lines, and on a terminal one line that shows how far all are.
#pragma once

#include <string>
#include <string_view>

namespace rubato::app {

/// Cuts what a run says into lines.
class Lines {
public:
  /// The whole lines that there are now.
  std::string add(std::string_view text);
  /// What was left, as a line.
  std::string rest();

private:
  std::string open_;
};

/// Standard error, where runs that stand below one another have one line at the end.
class SharedStream {
public:
  explicit SharedStream(bool quiet);

  bool is_terminal() const { return terminal_; }
  /// Whether there is a line that shows how far runs are.
  bool has_status() const { return terminal_ && !quiet_; }
  /// Columns of the terminal.
  std::size_t columns() const;
  /// Prints whole lines above the status.
  void print(std::string_view lines);
  /// To standard output.
  void print_result(std::string_view lines);
  /// Rewrites the line at the end.
  void show(std::string status);
  /// Takes that line away.
  void clear();

private:
  bool quiet_;
  bool terminal_;
  std::string status_; ///< as it is shown
};

} // namespace rubato::app
