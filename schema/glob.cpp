// SPDX-License-Identifier: Apache-2.0
// Shell patterns over variable names.

#include "schema/schema.h"

namespace indurop::schema {
namespace {

// Where the set that starts behind '[' ends: the index of its ']', or npos (then '[' is a letter like any other).
// A ']' right at the beginning belongs to the set.
std::size_t set_end(std::string_view pattern, std::size_t at) noexcept {
  if (at < pattern.size() && (pattern[at] == '!' || pattern[at] == '^')) {
    ++at;
  }
  return pattern.find(']', at + 1);
}

bool in_set(std::string_view set, char c) noexcept {
  const bool negated = !set.empty() && (set.front() == '!' || set.front() == '^');
  set.remove_prefix(negated ? 1 : 0);
  bool found = false;
  for (std::size_t i = 0; i < set.size(); ++i) {
    const bool span = i + 2 < set.size() && set[i + 1] == '-';
    found = found || (span ? c >= set[i] && c <= set[i + 2] : c == set[i]);
    i += span ? 2 : 0;
  }
  return found != negated;
}

// Matches one pattern element other than '*' against `c`; moves `at` behind the element.
bool match_one(std::string_view pattern, std::size_t& at, char c) noexcept {
  const char p = pattern[at++];
  if (p == '?') {
    return true;
  }
  if (p == '[') {
    if (const std::size_t end = set_end(pattern, at); end != std::string_view::npos) {
      const std::string_view set = pattern.substr(at, end - at);
      at = end + 1;
      return in_set(set, c);
    }
  }
  return (p == '\\' && at < pattern.size() ? pattern[at++] : p) == c;
}

// Only the last '*' ever has to take more letters, so no recursion and at most pattern times name steps.
bool match(std::string_view pattern, std::string_view name) noexcept {
  constexpr std::size_t kNone = std::string_view::npos;
  std::size_t p = 0;
  std::size_t n = 0;
  std::size_t after_star = kNone;
  std::size_t star_name = 0;
  while (n < name.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      after_star = ++p;
      star_name = n;
      continue;
    }
    std::size_t next = p;
    if (p < pattern.size() && match_one(pattern, next, name[n])) {
      p = next;
      ++n;
    } else if (after_star != kNone) {
      p = after_star;
      n = ++star_name;
    } else {
      return false;
    }
  }
  while (p < pattern.size() && pattern[p] == '*') {
    ++p;
  }
  return p == pattern.size();
}

// '.' to "::", as names are written.
std::string with_colons(std::string_view pattern) {
  std::string out;
  for (const char c : pattern) {
    if (c == '.') {
      out += "::";
    } else {
      out += c;
    }
  }
  return out;
}

}  // namespace

bool glob_match(std::string_view pattern, std::string_view name) {
  const std::string full = with_colons(pattern);
  if (match(full, name)) {
    return true;
  }
  const std::size_t last = name.rfind("::");
  return full.find("::") == std::string::npos && last != std::string_view::npos && match(full, name.substr(last + 2));
}

}  // namespace indurop::schema
