// SPDX-License-Identifier: Apache-2.0
// A variable as a message of ROS 1: its type, its definition and its bytes. Numbers, texts and arrays of numbers are
// messages of std_msgs, all others are made from the struct, with the names of docs/external.md.

#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "doors/ros/model/layout.h"

namespace indurop::ros {

struct MessageType {
  std::string name;        // "std_msgs/Float64"
  std::string definition;  // with those of all messages in it
  std::string md5;
};

// `variable`: its full name, after which types without a name of their own are called.
MessageType message_type(const std::string& variable, const Layout& layout);
// Appends the value as a message has it.
void write_message(const Layout& layout, std::span<const std::uint8_t> value, std::vector<std::uint8_t>& to);

}  // namespace indurop::ros
