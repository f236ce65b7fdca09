// SPDX-License-Identifier: Apache-2.0
// How topics between boards begin, the same for the mirror and for the rights to topics.

#pragma once

#include <string>
#include <string_view>

namespace indurop::schema {

// The number is that of the protocol, the layout of idl/*.idl: boards of another one do not see each other at all.
inline constexpr std::string_view kTopicRoot = "indurop/2/";

// Topic names may hold no '-': "_m" stands for it, "__" for '_', so that different names stay different.
inline std::string topic_part(std::string_view name) {
  std::string part;
  for (const char c : name) {
    if (c == '-') {
      part += "_m";
    } else if (c == '_') {
      part += "__";
    } else {
      part += c;
    }
  }
  return part;
}

// What the names of all topics of a plant, of one of its boards, or of deployments begin with.
inline std::string plant_topics(std::string_view plant) {
  return std::string(kTopicRoot) + topic_part(plant) + "/";
}
inline std::string board_topics(std::string_view plant, std::string_view board) {
  return plant_topics(plant) + topic_part(board) + "/";
}
inline std::string deploy_topics() {
  return std::string(kTopicRoot) + "deploy/";
}

}  // namespace indurop::schema
