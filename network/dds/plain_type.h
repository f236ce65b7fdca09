// SPDX-License-Identifier: Apache-2.0
// A topic type made from the type of a variable, for topics without a type description: those with ROS 2 names. Their
// layout is still known, from what the board announces about its variables.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/schema/schema.h"
#include "network/dds/entity.h"

namespace indurop::dds {

class PlainType {
 public:
  // `name`: type name on the network.
  PlainType(const schema::Type& type, std::string name);
  PlainType(const PlainType&) = delete;
  PlainType& operator=(const PlainType&) = delete;

  // Valid as long as this object; samples have the layout of the variable.
  [[nodiscard]] TypeDescriptor descriptor() const noexcept;

 private:
  // Adds the type at `offset`. A struct adds only its fields: without keys and with fixed layout it has no bytes of its
  // own.
  void add(const schema::Type& type, std::uint32_t offset);
  void add_plain(const schema::Type& type, std::uint32_t offset, std::uint32_t count);

  std::string name_;
  std::uint32_t size_;
  std::uint32_t align_;
  std::vector<std::uint32_t> operations_;  // DDS serialization program
  std::uint32_t instructions_ = 0;
};

}  // namespace indurop::dds
