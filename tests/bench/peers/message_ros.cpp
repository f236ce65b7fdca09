// SPDX-License-Identifier: Apache-2.0
// ROS 1 (roscpp): a topic within one node. A rosmaster has to run.
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <std_msgs/UInt8MultiArray.h>

#include <cstdint>
#include <string>

#include "measure.h"

namespace {

void exchange(ros::NodeHandle& node, std::size_t bytes) {
  std::uint8_t got = 0;
  const std::string name = "peers_" + std::to_string(bytes);
  const ros::Subscriber subscriber = node.subscribe<std_msgs::UInt8MultiArray>(
      name, 1, [&](const std_msgs::UInt8MultiArray::ConstPtr& message) { got = message->data[0]; });
  const ros::Publisher publisher = node.advertise<std_msgs::UInt8MultiArray>(name, 1);
  while (publisher.getNumSubscribers() == 0) {
    ros::WallDuration(0.01).sleep();
  }
  std_msgs::UInt8MultiArray message;
  message.data.resize(bytes);
  std::uint8_t count = 0;
  peers::measure(bytes, [&] {
    message.data[0] = ++count;
    publisher.publish(message);
    // The message comes through a thread of roscpp.
    for (int tries = 0; got != count && tries < 100; ++tries) {
      ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.01));
    }
    return got == count;
  });
}

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "peers_message", ros::init_options::NoSigintHandler | ros::init_options::NoRosout);
  ros::NodeHandle node;
  exchange(node, 64);
  exchange(node, 256);
  exchange(node, 4096);
  return 0;
}
