// SPDX-License-Identifier: Apache-2.0
#include "doors/mqtt/plain/topics.h"

#include <algorithm>

namespace indurop::mqtt {
namespace {

// Removes the first level of a topic and returns it.
std::string_view take_level(std::string_view& topic) {
  const std::string_view level = topic.substr(0, topic.find('/'));
  topic.remove_prefix(std::min(topic.size(), level.size() + 1));
  return level;
}

}  // namespace

std::string levels_of(std::string_view variable) {
  std::string out;
  for (std::size_t i = 0; i < variable.size(); ++i) {
    if (variable.substr(i).starts_with("::")) {
      out += '/';
      ++i;
    } else {
      out += variable[i];
    }
  }
  return out;
}

std::string variable_of(std::string_view levels) {
  std::string out;
  for (const char c : levels) {
    out += c == '/' ? "::" : std::string(1, c);
  }
  return out;
}

bool is_level(std::string_view text) {
  return !text.empty() && text.find_first_of(std::string_view("/+#\0", 4)) == std::string_view::npos;
}

std::optional<SetTopic> read_set_topic(std::string_view prefix, std::string_view topic) {
  if (!topic.starts_with(prefix) || topic.size() <= prefix.size() || topic[prefix.size()] != '/') {
    return std::nullopt;
  }
  topic.remove_prefix(prefix.size() + 1);
  SetTopic out;
  out.board = take_level(topic);
  if (take_level(topic) != "set") {
    return std::nullopt;
  }
  out.user = take_level(topic);
  out.variable = variable_of(topic);
  return out.board.empty() || out.user.empty() ? std::nullopt : std::optional(out);
}

}  // namespace indurop::mqtt
