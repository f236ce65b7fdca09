// SPDX-License-Identifier: Apache-2.0
#include "core/base/text.h"

#include <algorithm>
#include <charconv>
#include <sstream>

#include "core/base/nearest.h"
#include "core/base/utf8.h"

namespace indurop::base {

std::string_view trimmed(std::string_view text) noexcept {
  constexpr const char* kSpace = " \t\r\n";
  const std::size_t first = text.find_first_not_of(kSpace);
  return first == std::string_view::npos ? std::string_view{}
                                         : text.substr(first, text.find_last_not_of(kSpace) - first + 1);
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t kShown = 60;
  return "'" + shortened(text, kShown) + "'";
}

std::string path_in_quotes(std::string_view path) {
  constexpr std::size_t kShown = 300;
  if (path.size() <= kShown) {
    return "'" + std::string(path) + "'";
  }
  path.remove_prefix(path.size() - kShown);
  while (!path.empty() && continues_utf8(path.front())) {
    path.remove_prefix(1);
  }
  return "'\u2026" + std::string(path) + "'";
}

std::string closest_name(std::string_view name, const std::vector<std::string>& known) {
  constexpr std::size_t kLongestName = 100;
  constexpr std::size_t kShortestPart = 3;
  if (name.size() > kLongestName) {
    return {};
  }
  std::string near = nearest(name, known);
  for (const std::string& candidate : known) {
    const bool part = name.size() >= kShortestPart && candidate.find(name) != std::string::npos;
    near = near.empty() && part ? candidate : near;
  }
  return near;
}

std::string suggestion(std::string_view name, const std::vector<std::string>& known) {
  const std::string near = closest_name(name, known);
  if (!near.empty()) {
    return "; did you mean " + in_quotes(near) + "?";
  }
  return known.empty() ? std::string{} : "; known are: " + enumerate(known, known.size());
}

std::string enumerate(const std::vector<std::string>& names, std::size_t most) {
  std::string text;
  const std::size_t shown = names.size() > most ? most : names.size();
  for (std::size_t i = 0; i < shown; ++i) {
    const bool last = i + 1 == names.size();
    text += i == 0 ? "" : last ? " and " : ", ";
    text += names[i];
  }
  if (shown < names.size()) {
    text += " and " + std::to_string(names.size() - shown) + " more";
  }
  return text;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    lines.push_back(line);
  }
  return lines;
}

std::string_view take_line(std::string_view& text) noexcept {
  const std::size_t end = std::min(text.find('\n'), text.size());
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return line;
}

std::optional<std::uint64_t> whole_number(std::string_view text) noexcept {
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size() ? std::optional(number) : std::nullopt;
}

std::size_t characters(std::string_view text) noexcept {
  std::size_t count = 0;
  for (const char c : text) {
    count += continues_utf8(c) ? 0U : 1U;
  }
  return count;
}

std::string shortened(std::string_view text, std::size_t most) {
  if (characters(text) <= most) {
    return std::string(text);
  }
  std::size_t end = 0;
  for (std::size_t kept = 0; end < text.size(); ++end) {
    if (!continues_utf8(text[end]) && ++kept == most) {
      break;
    }
  }
  return std::string(text.substr(0, end)) + "\u2026";
}

}  // namespace indurop::base
