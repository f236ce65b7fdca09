// SPDX-License-Identifier: Apache-2.0
#include "doors/ros/ros2/participant.h"

#include <fmt/format.h>

#include <algorithm>

#include "network/dds/descriptor.h"

namespace indurop::ros {
namespace {

using Gid = rmw_dds_common_msg_dds__Gid_;

Gid gid_of(const dds::Guid& guid) {
  Gid gid{};
  std::copy(guid.begin(), guid.end(), std::begin(gid.data));
  return gid;
}

std::vector<Gid> gids_of(const std::vector<dds::Guid>& guids) {
  std::vector<Gid> gids;
  std::transform(guids.begin(), guids.end(), std::back_inserter(gids), gid_of);
  return gids;
}

// ROS 2 tells types apart by their names and hashes. Its middlewares announce no other description.
dds::TypeDescriptor by_name(const dds::TypeDescriptor& type, const std::string& name) {
  return dds::renamed(&type, name);
}

template <class Make>
Result<dds::Endpoint, base::Problem> made(MessageKind kind, const std::string& topic, RosQuality quality,
                                          const std::string& mark, Make make) {
  dds::QosChoice choice;
  choice.for_late_ones = quality.for_late_ones;
  choice.depth = quality.depth;
  const std::string data = fmt::format("{}typehash={};", mark, kind.hash);
  choice.mark = data;
  const std::string name = kind.type.m_typename;
  dds::Endpoint end = make(by_name(kind.type, name), dds::make_qos(choice));
  if (!end.ok()) {
    return base::Problem{fmt::format("DDS topic {}: {}", topic, end.why())};
  }
  return end;
}

}  // namespace

Result<std::string, base::Problem> Ros2Participant::join(const dds::NetworkSettings& settings) {
  dds::NetworkSettings with_data = settings;
  with_data.user_data = "enclave=/;";
  auto joined = dds::join_network(with_data);
  if (!joined) {
    return std::move(joined).error();
  }
  participant_ = std::move(joined->participant);
  return std::move(joined->note);
}

Result<dds::Endpoint, base::Problem> Ros2Participant::writer(MessageKind kind, const std::string& topic,
                                                             RosQuality quality, const std::string& mark) {
  auto end = made(kind, topic, quality, mark, [&](const dds::TypeDescriptor& type, const dds::Qos& qos) {
    return dds::make_writer(participant_.get(), type, topic, qos);
  });
  if (end) {
    writers_.push_back(dds::guid_of(end->get()));
  }
  return end;
}

Result<dds::Endpoint, base::Problem> Ros2Participant::reader(MessageKind kind, const std::string& topic,
                                                             RosQuality quality, const std::string& mark) {
  auto end = made(kind, topic, quality, mark, [&](const dds::TypeDescriptor& type, const dds::Qos& qos) {
    return dds::make_reader(participant_.get(), type, topic, qos);
  });
  if (end) {
    readers_.push_back(dds::guid_of(end->get()));
  }
  return end;
}

// The number of the participant, with that of the service at its end.
std::string Ros2Participant::next_service() {
  constexpr std::size_t kPrefix = 12;
  dds::Guid id = dds::guid_of(participant_.get());
  std::fill(id.begin() + kPrefix, id.end(), std::uint8_t{0});
  id.back() = static_cast<std::uint8_t>(++services_);
  std::string text;
  for (const std::uint8_t byte : id) {
    text += fmt::format("{}{:x}", text.empty() ? "" : ".", byte);
  }
  return fmt::format("serviceid={};", text);
}

Result<void, base::Problem> Ros2Participant::announce() {
  std::vector<Gid> readers = gids_of(readers_);
  std::vector<Gid> writers = gids_of(writers_);
  rmw_dds_common_msg_dds__NodeEntitiesInfo_ node{};
  const std::string space = space_.empty() ? "/" : space_;
  space.copy(node.node_namespace, sizeof(node.node_namespace) - 1);
  node_.copy(node.node_name, sizeof(node.node_name) - 1);
  const auto fill = [](auto& sequence, std::vector<Gid>& gids) {
    sequence._length = sequence._maximum = static_cast<std::uint32_t>(gids.size());
    sequence._buffer = gids.data();
  };
  fill(node.reader_gid_seq, readers);
  fill(node.writer_gid_seq, writers);
  DiscoveryMessage message{};
  message.gid = gid_of(dds::guid_of(participant_.get()));
  message.node_entities_info_seq._length = message.node_entities_info_seq._maximum = 1;
  message.node_entities_info_seq._buffer = &node;
  auto end = writer(kind_of<DiscoveryMessage>(), "ros_discovery_info", {1, true}, "");
  if (!end) {
    return std::move(end).error();
  }
  discovery_ = std::move(*end);
  const dds::Written written = dds::write(discovery_.get(), message);
  return written.ok() ? Result<void, base::Problem>() : base::Problem{"ros_discovery_info: " + written.why()};
}

}  // namespace indurop::ros
