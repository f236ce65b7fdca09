// SPDX-License-Identifier: Apache-2.0
#include "deploy/words/release_version.h"

#include <algorithm>

namespace indurop::deploy {
namespace {

constexpr std::size_t kLongestVersion = 60;

bool is_digit(char c) noexcept {
  return c >= '0' && c <= '9';
}

bool is_letter(char c) noexcept {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

bool begins_with_word(std::string_view text) noexcept {
  return !text.empty() && !is_digit(text.front());
}

// Returns the place of the first character in the order of Debian's versions: '~' before the end, letters before all
// others.
int rank_of(std::string_view text) noexcept {
  constexpr int kAfterLetters = 256;
  if (!begins_with_word(text)) {
    return 0;
  }
  const char c = text.front();
  return c == '~' ? -1 : is_letter(c) ? c : c + kAfterLetters;
}

// Takes the digits at the begin of `text`, without leading zeros.
std::string_view take_number(std::string_view& text) noexcept {
  const auto end = static_cast<std::size_t>(std::find_if_not(text.begin(), text.end(), is_digit) - text.begin());
  std::string_view number = text.substr(0, end);
  text.remove_prefix(end);
  number.remove_prefix(std::min(number.find_first_not_of('0'), number.size()));
  return number;
}

}  // namespace

bool is_release_version(std::string_view text) noexcept {
  return !text.empty() && text.size() <= kLongestVersion && is_digit(text.front()) &&
         std::all_of(text.begin(), text.end(),
                     [](char c) { return is_digit(c) || is_letter(c) || c == '.' || c == '+' || c == '~'; });
}

bool is_older_release(std::string_view a, std::string_view b) noexcept {
  while (!a.empty() || !b.empty()) {
    while (begins_with_word(a) || begins_with_word(b)) {
      const int left = rank_of(a);
      const int right = rank_of(b);
      if (left != right) {
        return left < right;
      }
      a.remove_prefix(1);
      b.remove_prefix(1);
    }
    const std::string_view left = take_number(a);
    const std::string_view right = take_number(b);
    if (left != right) {
      return left.size() != right.size() ? left.size() < right.size() : left < right;
    }
  }
  return false;
}

}  // namespace indurop::deploy
