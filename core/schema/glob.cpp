// SPDX-License-Identifier: Apache-2.0
// Shell patterns over variable names.

#include <fnmatch.h>

#include "core/schema/schema.h"

namespace indurop::schema {
namespace {

// Replaces '.' by "::", as names are written. A backslash at the end is an ordinary character.
std::string with_colons(std::string_view pattern) {
  std::string out;
  bool escaped = false;
  for (const char c : pattern) {
    escaped = c == '\\' && !escaped;
    if (c == '.') {
      out += "::";
    } else {
      out += c;
    }
  }
  return escaped ? out + '\\' : out;
}

bool match(const std::string& pattern, std::string_view name) {
  return ::fnmatch(pattern.c_str(), std::string(name).c_str(), 0) == 0;
}

}  // namespace

bool glob_match(std::string_view pattern, std::string_view name) {
  const std::string full = with_colons(pattern);
  if (match(full, name)) {
    return true;
  }
  if (!is_glob(pattern)) {  // a name, without leading namespaces
    return !full.empty() && name.ends_with("::" + full);
  }
  const std::size_t last = name.rfind("::");
  return full.find("::") == std::string::npos && last != std::string_view::npos && match(full, name.substr(last + 2));
}

bool is_glob(std::string_view text) {
  if (text.find_first_of("*?") != std::string_view::npos) {
    return true;
  }
  // "[...]" is a set of letters unless it is an index.
  for (auto open = text.find('['); open != std::string_view::npos; open = text.find('[', open + 1)) {
    const auto close = text.find(']', open);
    if (close == std::string_view::npos) {
      return false;
    }
    const auto inner = text.substr(open + 1, close - open - 1);
    if (inner.empty() || inner.find_first_not_of("0123456789 ") != std::string_view::npos) {
      return true;
    }
  }
  return false;
}

}  // namespace indurop::schema
