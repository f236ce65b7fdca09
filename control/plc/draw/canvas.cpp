// SPDX-License-Identifier: Apache-2.0
#include "control/plc/draw/canvas.h"

#include <array>

#include "core/base/utf8.h"

namespace indurop::plc::draw {
namespace {

constexpr std::uint8_t kUp = 1;
constexpr std::uint8_t kDown = 2;
constexpr std::uint8_t kArmLeft = 4;
constexpr std::uint8_t kArmRight = 8;

// By arms.
constexpr std::array<const char*, 16> kUnicode{" ", "│", "│", "│", "─", "┘", "┐", "┤",
                                               "─", "└", "┌", "├", "─", "┴", "┬", "┼"};
constexpr std::array<const char*, 16> kHeavy{" ", "┃", "┃", "┃", "━", "┛", "┓", "┫",
                                             "━", "┗", "┏", "┣", "━", "┻", "┳", "╋"};
constexpr std::array<const char*, 16> kAscii{" ", "|", "|", "|", "-", "+", "+", "+",
                                             "-", "+", "+", "+", "-", "+", "+", "+"};

}  // namespace

std::string plain(const Row& row) {
  std::string text;
  for (const Run& run : row) {
    text += run.text;
  }
  return text;
}

Canvas::Canvas(int width, int height, bool unicode)
    : width_(width),
      height_(height),
      unicode_(unicode),
      cells_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {}

Canvas::Cell* Canvas::cell(int x, int y) {
  const bool inside = x >= 0 && x < width_ && y >= 0 && y < height_;
  return inside ? &cells_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)]
                : nullptr;
}

void Canvas::horizontal(int x1, int x2, int y, int net, bool powered) {
  for (int x = x1; x < x2; ++x) {
    if (Cell* at = cell(x / 2, y / 2)) {
      at->arms = static_cast<std::uint8_t>(at->arms | (x % 2 == 0 ? kArmLeft : kArmRight));
      at->across = net;
      at->powered = at->powered || powered;
    }
  }
}

void Canvas::vertical(int x, int y1, int y2, int net, bool powered) {
  for (int y = y1; y < y2; ++y) {
    if (Cell* at = cell(x / 2, y / 2)) {
      at->arms = static_cast<std::uint8_t>(at->arms | (y % 2 == 0 ? kUp : kDown));
      at->down = net;
      at->powered = at->powered || powered;
    }
  }
}

void Canvas::text(int x, int y, std::string_view text, Run::Look look) {
  for (std::size_t i = 0; i < text.size(); ++x) {
    std::size_t end = i + 1;
    while (end < text.size() && base::continues_utf8(text[end])) {
      ++end;
    }
    if (Cell* at = cell(x, y)) {
      at->glyph = text.substr(i, end - i);
      at->look = look;
    }
    i = end;
  }
}

void Canvas::mark(int x, int y, std::string_view unicode, std::string_view ascii, Run::Look look) {
  text(x, y, unicode_ ? unicode : ascii, look);
}

std::string Canvas::glyph_of(const Cell& cell) const {
  if (!cell.glyph.empty()) {
    return cell.glyph;
  }
  const bool crossing =
      cell.across != kNoNet && cell.down != kNoNet && cell.across != cell.down && cell.across != -1 && cell.down != -1;
  const std::size_t arms = crossing ? std::size_t{kUp | kDown} : cell.arms;
  return (!unicode_ ? kAscii : cell.powered ? kHeavy : kUnicode)[arms];
}

std::vector<Row> Canvas::rows() const {
  std::vector<Row> rows;
  for (int y = 0; y < height_; ++y) {
    Row row;
    std::size_t spaces = 0;
    for (int x = 0; x < width_; ++x) {
      const Cell& at =
          cells_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)];
      const std::string glyph = glyph_of(at);
      if (glyph == " ") {
        ++spaces;
        continue;
      }
      const Run::Look look = at.glyph.empty() && at.powered ? Run::Look::Powered : at.look;
      if (row.empty() || row.back().look != look) {
        row.push_back({{}, look});
      }
      row.back().text += std::string(spaces, ' ') + glyph;
      spaces = 0;
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace indurop::plc::draw
