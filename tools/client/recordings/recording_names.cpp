// SPDX-License-Identifier: Apache-2.0
// The names of the columns of a recording in a picture.

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <utility>

#include "core/base/text.h"
#include "tools/client/recordings/recording.h"

namespace indurop::tools {
namespace {

constexpr std::size_t kMostWords = 1000;

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(' ');
  return first == std::string_view::npos ? std::string_view()
                                         : text.substr(first, text.find_last_not_of(' ') - first + 1);
}

std::optional<std::size_t> whole(std::string_view text) {
  std::size_t value = 0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  return code == std::errc() && end == text.data() + text.size() ? std::optional(value) : std::nullopt;
}

// "joint [deg]" also matches the name "joint".
bool is_called(const std::string& full, std::string_view name) {
  const std::string_view plain = std::string_view(full).substr(0, full.find(" ["));
  return full == name || plain == name ||
         (plain.size() > name.size() + 2 && plain.ends_with(name) &&
          plain.substr(plain.size() - name.size() - 2, 2) == "::");
}

Series* find(Recording& recording, std::string_view name) {
  const auto found = std::find_if(recording.series.begin(), recording.series.end(),
                                  [name](const Series& series) { return is_called(series.name, name); });
  return found == recording.series.end() ? nullptr : &*found;
}

std::string no_such(const Recording& recording, std::string_view name) {
  std::vector<std::string> names;
  std::transform(recording.series.begin(), recording.series.end(), std::back_inserter(names),
                 [](const Series& series) { return series.name; });
  return fmt::format("no column {}; there are {}", base::in_quotes(name), base::enumerate(names));
}

}  // namespace

std::string part_name(const Series& series, std::size_t line) {
  return line < series.parts.size() && !series.parts[line].empty() ? series.parts[line] : fmt::format("[{}]", line);
}

std::optional<std::string> rename(Recording& recording, std::string_view rule) {
  const std::size_t is = rule.find('=');
  if (is == std::string_view::npos || is == 0 || is + 1 == rule.size()) {
    return fmt::format("{} is no new name; write OLD=NEW", base::in_quotes(rule));
  }
  const std::string_view old = rule.substr(0, is);
  const std::string shown(rule.substr(is + 1));
  if (Series* series = find(recording, old)) {
    series->name = shown;
    return std::nullopt;
  }
  const std::size_t bracket = old.rfind('[');
  const auto line = bracket != std::string_view::npos && old.ends_with(']')
                        ? whole(old.substr(bracket + 1, old.size() - bracket - 2))
                        : std::nullopt;
  Series* series = line ? find(recording, old.substr(0, bracket)) : nullptr;
  if (series == nullptr || *line >= series->lines.size()) {
    return no_such(recording, old);
  }
  series->parts.resize(series->lines.size());
  series->parts[*line] = shown;
  return std::nullopt;
}

std::optional<std::string> give_words(Recording& recording, std::string_view rule) {
  const std::size_t is = rule.find('=');
  Series* series = is == std::string_view::npos ? nullptr : find(recording, rule.substr(0, is));
  if (series == nullptr) {
    return is == std::string_view::npos
               ? fmt::format("{} gives no words; write NAME=0 off, 1 on", base::in_quotes(rule))
               : no_such(recording, rule.substr(0, is));
  }
  std::vector<std::string> words;
  for (std::string_view rest = rule.substr(is + 1); !rest.empty();) {
    const std::size_t comma = std::min(rest.find(','), rest.size());
    const std::string_view part = trimmed(rest.substr(0, comma));
    rest.remove_prefix(std::min(comma + 1, rest.size()));
    const std::size_t space = part.find(' ');
    const auto value = whole(part.substr(0, space));
    if (!value || *value >= kMostWords || space == std::string_view::npos) {
      return fmt::format("{} is no number with its word; write 0 off, 1 on", base::in_quotes(part));
    }
    words.resize(std::max(words.size(), *value + 1));
    words[*value] = trimmed(part.substr(space));
  }
  for (const auto& line : series->lines) {
    for (const double value : line) {
      if (std::isnan(value)) {
        continue;
      }
      if (!series->words.empty() || value < 0 || value >= static_cast<double>(kMostWords) ||
          value != std::floor(value)) {
        return fmt::format("{} cannot have words: it is no small whole number", series->name);
      }
      const auto at = static_cast<std::size_t>(value);
      words.resize(std::max(words.size(), at + 1));
    }
  }
  for (std::size_t i = 0; i < words.size(); ++i) {
    words[i] = words[i].empty() ? std::to_string(i) : words[i];
  }
  series->words = std::move(words);
  series->steps = series->lines.size() == 1;
  return std::nullopt;
}

std::optional<Series> take_series(Recording& recording, std::string_view name) {
  Series* series = find(recording, name);
  if (series == nullptr) {
    return std::nullopt;
  }
  Series taken = std::move(*series);
  recording.series.erase(recording.series.begin() + (series - recording.series.data()));
  return taken;
}

void drop_common_namespace(Recording& recording) {
  if (recording.series.empty()) {
    return;
  }
  const std::string first = recording.series.front().name;
  const std::size_t end = first.find("::");
  const std::string space = end == std::string::npos ? "" : first.substr(0, end + 2);
  const bool all = !space.empty() && std::all_of(recording.series.begin(), recording.series.end(),
                                                 [&](const Series& s) { return s.name.starts_with(space); });
  if (all) {
    for (Series& series : recording.series) {
      series.name.erase(0, space.size());
    }
  }
}

}  // namespace indurop::tools
