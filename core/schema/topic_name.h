// SPDX-License-Identifier: Apache-2.0
// The prefixes of topics between boards, shared by the mirror and by the access rights to topics.

#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace indurop::schema {

// The version of the protocol, the layout of idl/*.idl. Boards with different versions receive nothing from each other,
// but discover each other's topics, which have had this prefix since the first release.
unsigned protocol() noexcept;
inline std::string topic_root() {
  return "indurop/" + std::to_string(protocol()) + "/";
}

// Topic names must not contain '-': it is written "_m", and '_' is written "__", so that different names stay
// different.
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

// Prefixes of all topics of a plant, of one of its boards, and of deployments.
inline std::string plant_topics(std::string_view plant) {
  return topic_root() + topic_part(plant) + "/";
}
inline std::string board_topics(std::string_view plant, std::string_view board) {
  return plant_topics(plant) + topic_part(board) + "/";
}
inline std::string deploy_topics() {
  return topic_root() + "deploy/";
}
// The update of the platform itself. Its topics keep the number of the first release that had them: boards and desk are
// of different releases then, perhaps of different protocols. They lie where every board's keys let it publish and
// every participant listen; orders count by their signature.
inline std::string platform_topics() {
  return "indurop/6/deploy/blob/platform/";
}
// Topics of the external plane for InduRoP's own tools: the variables a board offers, and those a tool requests.
inline std::string directory_topic() {
  return topic_root() + "external/directory";
}
inline std::string request_topic() {
  return topic_root() + "external/wish";
}

// The sender of a topic, for topics of any release; empty if it is not an InduRoP topic.
struct TopicSender {
  unsigned protocol = 0;
  std::string plant;  // "deploy": agents and their clients
  std::string board;  // of a plant; empty: not part of the topic name
};
std::optional<TopicSender> sender_of_topic(std::string_view topic);

}  // namespace indurop::schema
