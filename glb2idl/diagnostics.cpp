// SPDX-License-Identifier: Apache-2.0
// Messages with source line and caret.

#include "glb2idl/diagnostics.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace indurop::glb2idl {
namespace {

constexpr std::size_t kShown = 120;  // characters of a source line

// One element per character; what a terminal might misread becomes '?'.
std::vector<std::string> characters(std::string_view line) {
  std::vector<std::string> out;
  for (std::size_t i = 0; i < line.size();) {
    std::size_t length = 1;
    while (i + length < line.size() && (static_cast<unsigned char>(line[i + length]) & 0xC0U) == 0x80U) {
      ++length;
    }
    const std::string_view one = line.substr(i, length);
    const auto first = static_cast<unsigned char>(one[0]);
    const bool control = (first < 0x20 && first != '\t') || first == 0x7F || one.starts_with("\xC2\x80");
    out.emplace_back(control || first_invalid_utf8(one) ? "?" : std::string(one));
    i += length;
  }
  return out;
}

// The source line and, below it, a caret under column `column` with `width` characters underlined.
std::string picture(std::string_view line, std::size_t column, std::size_t width) {
  const std::vector<std::string> shown = characters(line);
  const std::size_t at = std::min(column - 1, shown.size());
  const std::size_t from = at > kShown * 3 / 4 ? at - kShown * 3 / 4 : 0;
  const std::size_t to = std::min(shown.size(), from + kShown);
  std::string text = "    ";
  std::string mark = "    ";
  for (std::size_t i = from; i < to; ++i) {
    text += shown[i];
    if (i < at) {
      mark += shown[i] == "\t" ? '\t' : ' ';
    } else if (i > at && i < at + width) {
      mark += '~';
    } else if (i == at) {
      mark += '^';
    }
  }
  if (at >= to) {
    mark += '^';
  }
  return text + "\n" + mark + "\n";
}

}  // namespace

void Diagnostics::add(std::optional<Span> at, std::string text) {
  const auto same = [&](const Message& m) {
    return m.text == text && m.at.has_value() == at.has_value() &&
           (!at || (m.at->file == at->file && m.at->offset == at->offset));
  };
  if (std::any_of(messages_.begin(), messages_.end(), same) || errors_++ >= kLimit) {
    return;
  }
  messages_.push_back({at, std::move(text)});
}

std::string Diagnostics::place(Span at) const {
  return fmt::format("{}:{}", sources_.file(at.file).path, sources_.line_of(at));
}

std::string Diagnostics::render() const {
  std::vector<const Message*> sorted;
  for (const Message& m : messages_) {
    sorted.push_back(&m);
  }
  const auto key = [](const Message* m) {
    return m->at ? std::pair<std::int64_t, std::uint32_t>(m->at->file, m->at->offset)
                 : std::pair<std::int64_t, std::uint32_t>(-1, 0);
  };
  std::stable_sort(sorted.begin(), sorted.end(), [&](const Message* a, const Message* b) { return key(a) < key(b); });
  std::string out;
  for (const Message* m : sorted) {
    if (!m->at) {
      out += fmt::format("glb2idl: error: {}\n", m->text);
      continue;
    }
    const LineColumn place = sources_.place_of(*m->at);
    out += fmt::format("{}:{}:{}: error: {}\n", sources_.file(m->at->file).path, place.line, place.column, m->text);
    out += picture(sources_.line_text(m->at->file, place.line), place.column, m->at->length);
  }
  if (errors_ > kLimit) {
    out += fmt::format("glb2idl: error: too many errors, the first {} are shown\n", kLimit);
  }
  return out;
}

}  // namespace indurop::glb2idl
