// SPDX-License-Identifier: Apache-2.0
// A participant of DDS as ROS 2 makes them (rmw_cyclonedds_cpp of jazzy): names of topics, hashes of types, and the one
// node in it, which `ros2 node list` shows. For one thread.

#pragma once

#include <indurop/result.h>

#include <string>
#include <utility>
#include <vector>

#include "core/base/problem.h"
#include "doors/ros/ros2/kinds.h"
#include "network/dds/endpoint.h"
#include "network/dds/guid.h"
#include "network/dds/network_settings.h"
#include "network/dds/setup.h"

namespace indurop::ros {

// Quality of service of a topic.
struct RosQuality {
  int depth = 10;
  bool for_late_ones = false;  // "transient local"
};

class Ros2Participant {
 public:
  // `space`: namespace of the node and of all names, such as "/cell"; empty: none.
  Ros2Participant(std::string space, std::string node) : space_(std::move(space)), node_(std::move(node)) {}

  // Returns a message for the user, or none. Errors: the network is not available now.
  Result<std::string, base::Problem> join(const dds::NetworkSettings& settings);

  // Names are without the namespace and a first slash. Errors: DDS refuses.
  template <class Message>
  Result<dds::Endpoint, base::Problem> publisher(const std::string& name, RosQuality quality = {}) {
    return writer(kind_of<Message>(), "rt" + space_ + "/" + name, quality, "");
  }
  template <class Message>
  Result<dds::Endpoint, base::Problem> subscription(const std::string& name, RosQuality quality = {}) {
    return reader(kind_of<Message>(), "rt" + space_ + "/" + name, quality, "");
  }
  // Both ends of a service.
  struct ServiceEnds {
    dds::Endpoint requests;
    dds::Endpoint replies;
  };
  template <class Request, class Reply>
  Result<ServiceEnds, base::Problem> service(const std::string& name) {
    const std::string mark = next_service();
    auto requests = reader(kind_of<Request>(), "rq" + space_ + "/" + name + "Request", {}, mark);
    if (!requests) {
      return std::move(requests).error();
    }
    auto replies = writer(kind_of<Reply>(), "rr" + space_ + "/" + name + "Reply", {}, mark);
    if (!replies) {
      return std::move(replies).error();
    }
    return ServiceEnds{std::move(*requests), std::move(*replies)};
  }
  // Tells the others which of the ends are those of the node. Call it when all are there.
  Result<void, base::Problem> announce();

 private:
  Result<dds::Endpoint, base::Problem> writer(MessageKind kind, const std::string& topic, RosQuality quality,
                                              const std::string& mark);
  Result<dds::Endpoint, base::Problem> reader(MessageKind kind, const std::string& topic, RosQuality quality,
                                              const std::string& mark);
  // Tells clients which reader and writer are one service.
  std::string next_service();

  std::string space_;
  std::string node_;
  dds::Participant participant_;
  std::vector<dds::Guid> readers_;
  std::vector<dds::Guid> writers_;
  unsigned services_ = 0;
  dds::Endpoint discovery_;
};

}  // namespace indurop::ros
