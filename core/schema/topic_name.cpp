// SPDX-License-Identifier: Apache-2.0
#include "core/schema/topic_name.h"

#include <charconv>
#include <vector>

namespace indurop::schema {
namespace {

// Reverses topic_part(). Other text stays unchanged.
std::string name_of_part(std::string_view part) {
  std::string name;
  for (std::size_t i = 0; i < part.size(); ++i) {
    const bool escaped = part[i] == '_' && i + 1 < part.size() && (part[i + 1] == 'm' || part[i + 1] == '_');
    name += escaped ? (part[i + 1] == 'm' ? '-' : '_') : part[i];
    i += escaped ? 1 : 0;
  }
  return name;
}

std::vector<std::string_view> split(std::string_view path) {
  std::vector<std::string_view> parts;
  for (std::size_t at = 0; at != std::string_view::npos;) {
    const std::size_t slash = path.find('/', at);
    parts.push_back(path.substr(at, slash == std::string_view::npos ? slash : slash - at));
    at = slash == std::string_view::npos ? slash : slash + 1;
  }
  return parts;
}

}  // namespace

std::optional<TopicSender> sender_of_topic(std::string_view topic) {
  const auto parts = split(topic);
  TopicSender speaker;
  if (parts.size() < 4 || parts.size() > 5 || parts[0] != "indurop") {
    return std::nullopt;
  }
  const char* end = parts[1].data() + parts[1].size();
  const auto [stop, error] = std::from_chars(parts[1].data(), end, speaker.protocol);
  if (error != std::errc{} || stop != end) {
    return std::nullopt;
  }
  speaker.plant = name_of_part(parts[2]);
  speaker.board = parts.size() == 5 ? name_of_part(parts[3]) : std::string{};
  return speaker;
}

}  // namespace indurop::schema
