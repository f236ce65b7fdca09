// SPDX-License-Identifier: Apache-2.0
#include "deploy/report.h"

#include "schema/nearest.h"

namespace indurop::deploy {

void Report::add(Diagnostic::Severity severity, Place place, std::string text) {
  std::size_t& count = count_.at(static_cast<std::size_t>(severity));
  if (++count <= kMost) {
    out_.push_back({severity, file_, place, std::move(text)});
  } else if (count == kMost + 1) {
    out_.push_back({severity, file_, {}, "there are more than these " + std::to_string(kMost) +
                                             "; the others show when these are gone"});
  }
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t kShown = 60;
  if (text.size() <= kShown) {
    return "'" + std::string(text) + "'";
  }
  std::size_t end = kShown;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80) {
    --end;  // not in the middle of a character
  }
  return "'" + std::string(text.substr(0, end)) + "...'";
}

std::string suggestion(std::string_view name, const std::vector<std::string>& known) {
  constexpr std::size_t kLongestName = 100;
  const std::string near = name.size() <= kLongestName ? schema::nearest(name, known) : std::string{};
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

}  // namespace indurop::deploy
