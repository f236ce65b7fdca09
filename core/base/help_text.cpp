// SPDX-License-Identifier: Apache-2.0
#include "core/base/help_text.h"

#include <algorithm>
#include <vector>

namespace indurop::base {
namespace {

std::size_t columns_of(std::string_view text) {
  // Bytes that continue a code point of UTF-8 take no column.
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

std::vector<std::string_view> lines_of(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    lines.push_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

// Appends the words of `text` to `line`, in as many lines as it takes; all but the first begin with `indent` spaces.
void fill(std::string line, std::string_view text, std::size_t indent, std::string& out) {
  bool first = true;
  while (true) {
    text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
    if (text.empty()) {
      break;
    }
    const std::string_view word = text.substr(0, text.find(' '));
    const std::size_t gap = first ? 0 : 1;
    if (!first && columns_of(line) + gap + columns_of(word) > kHelpWidth) {
      out += line + '\n';
      line.assign(indent, ' ');
    } else if (!first) {
      line += ' ';
    }
    line += word;
    first = false;
    text.remove_prefix(word.size());
  }
  out += line + '\n';
}

bool is_plain(std::string_view line) {
  return !line.empty() && line.front() != ' ';
}

// Returns the number of lines of the paragraph that begins at `at`.
std::size_t paragraph_at(const std::vector<std::string_view>& lines, std::size_t at) {
  std::size_t count = 0;
  while (at + count < lines.size() && is_plain(lines[at + count])) {
    const bool indented_next = at + count + 1 < lines.size() && lines[at + count + 1].starts_with(' ');
    if (lines[at + count].ends_with(':') && indented_next) {
      break;
    }
    ++count;
  }
  return count;
}

// Returns the column in which a line that continues this one begins.
std::size_t continued_at(std::string_view line) {
  const bool option = !is_plain(line) && line.size() > kHelpDescription && line[kHelpDescription - 1] == ' ' &&
                      line[kHelpDescription] != ' ';
  return option ? kHelpDescription : std::min(line.find_first_not_of(' '), line.size());
}

}  // namespace

std::string wrapped_help(std::string_view text) {
  const std::vector<std::string_view> lines = lines_of(text);
  std::string out;
  for (std::size_t at = 0; at < lines.size();) {
    const std::size_t count = std::max<std::size_t>(paragraph_at(lines, at), 1);
    const auto first = lines.begin() + static_cast<std::ptrdiff_t>(at);
    const auto last = first + static_cast<std::ptrdiff_t>(count);
    at += count;
    if (std::all_of(first, last, [](std::string_view line) { return columns_of(line) <= kHelpWidth; })) {
      std::for_each(first, last, [&out](std::string_view line) { (out += line) += '\n'; });
      continue;
    }
    if (const std::size_t indent = continued_at(*first); indent > 0) {
      fill(std::string(first->substr(0, indent)), first->substr(indent), indent, out);
      continue;
    }
    std::string paragraph;
    std::for_each(first, last, [&paragraph](std::string_view line) { (paragraph += line) += ' '; });
    fill({}, paragraph, 0, out);
  }
  return out;
}

}  // namespace indurop::base
