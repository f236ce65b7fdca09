// SPDX-License-Identifier: Apache-2.0
#include "network/mirror/frames/plane_topics.h"

#include <array>

#include "core/schema/topic_name.h"

namespace indurop::mirror {
namespace {

constexpr std::array<const char*, kStreams> kStreamNames = {"prompt", "loose", "bulk"};

}  // namespace

std::string frames_topic(const std::string& plant, const std::string& board, Stream stream) {
  return schema::board_topics(plant, board) + kStreamNames[static_cast<std::size_t>(stream)];
}

std::string catalogue_topic(const std::string& plant) {
  return schema::plant_topics(plant) + "catalogue";
}

std::string beacon_topic(const std::string& plant) {
  return schema::plant_topics(plant) + "beacon";
}

dds::Qos plane_qos(Stream stream) {
  return dds::make_qos({.reliable = stream != Stream::BestEffort});
}

dds::Qos beacon_qos(const Settings& settings) {
  // A beacon that is repeated late would only report a wrong time.
  return dds::make_qos({.reliable = false, .lease_ns = settings.network.lease_ns, .written = true});
}

}  // namespace indurop::mirror
