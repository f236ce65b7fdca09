// SPDX-License-Identifier: Apache-2.0
// Characters in rows: lines that become box-drawing characters, and text. It records which characters carry power; the
// caller decides how that looks.

#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace indurop::plc::draw {

// Consecutive characters of a row with the same look.
struct Run {
  enum class Look : std::uint8_t { Plain, Powered, Name, Value };
  std::string text;
  Look look = Look::Plain;
};
using Row = std::vector<Run>;

// Returns the text of a row without looks.
[[nodiscard]] std::string plain(const Row& row);

class Canvas {
 public:
  Canvas(int width, int height, bool unicode);

  // Draws a line, in halves of characters, as in Picture. Lines of one net join where they meet; net -1 joins with all.
  // Powered lines are heavy.
  void horizontal(int x1, int x2, int y, int net, bool powered);
  void vertical(int x, int y1, int y2, int net, bool powered);
  void text(int x, int y, std::string_view text, Run::Look look = Run::Look::Plain);
  // Sets one character in place of a line.
  void mark(int x, int y, std::string_view unicode, std::string_view ascii, Run::Look look = Run::Look::Plain);

  // Returns the rows without white space at their ends.
  [[nodiscard]] std::vector<Row> rows() const;

 private:
  struct Cell {
    std::uint8_t arms = 0;
    int across = kNoNet;
    int down = kNoNet;
    bool powered = false;
    std::string glyph;
    Run::Look look = Run::Look::Plain;
  };
  static constexpr int kNoNet = -2;

  Cell* cell(int x, int y);
  [[nodiscard]] std::string glyph_of(const Cell& cell) const;

  int width_;
  int height_;
  bool unicode_;
  std::vector<Cell> cells_;
};

}  // namespace indurop::plc::draw
