// SPDX-License-Identifier: Apache-2.0
// The type of a topic made from that of a variable, for topics that carry no description of their type: those with the
// names of ROS 2. Their bytes are known all the same, from what the board tells of its variables.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "dds/entity.h"
#include "schema/schema.h"

namespace indurop::dds {

class PlainType {
 public:
  // `name`: of the type on the network.
  PlainType(const schema::Type& type, std::string name);
  PlainType(const PlainType&) = delete;
  PlainType& operator=(const PlainType&) = delete;

  // Valid as long as this lives; samples have the layout of the variable.
  [[nodiscard]] TypeDescriptor descriptor() const noexcept;

 private:
  // What is at `offset`. A struct is its fields: without keys and of fixed layout it adds nothing to the bytes.
  void add(const schema::Type& type, std::uint32_t offset);
  void add_plain(const schema::Type& type, std::uint32_t offset, std::uint32_t count);

  std::string name_;
  std::uint32_t size_;
  std::uint32_t align_;
  std::vector<std::uint32_t> operations_;  // how DDS writes and reads it
  std::uint32_t instructions_ = 0;
};

}  // namespace indurop::dds
