// SPDX-License-Identifier: Apache-2.0
// How topics between boards begin, the same for the mirror and for the rights to topics.

#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace indurop::schema {

// The number is that of the protocol, the layout of idl/*.idl: boards of another one do not hear each other at all, but
// see each other's topics, which begin like this since the first release.
unsigned protocol() noexcept;
inline std::string topic_root() {
  return "indurop/" + std::to_string(protocol()) + "/";
}

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
  return topic_root() + topic_part(plant) + "/";
}
inline std::string board_topics(std::string_view plant, std::string_view board) {
  return plant_topics(plant) + topic_part(board) + "/";
}
inline std::string deploy_topics() {
  return topic_root() + "deploy/";
}
// Of the external plane, for InduRoP's own tools: what a board shows, and what a tool wants to see.
inline std::string directory_topic() {
  return topic_root() + "external/directory";
}
inline std::string wish_topic() {
  return topic_root() + "external/wish";
}

// Whose a topic is, of whatever release; empty if it is none of InduRoP's.
struct TopicSpeaker {
  unsigned protocol = 0;
  std::string plant;  // "deploy": agents and who speaks with them
  std::string board;  // of a plant; empty: the topic does not tell
};
std::optional<TopicSpeaker> speaker_of(std::string_view topic);

}  // namespace indurop::schema
