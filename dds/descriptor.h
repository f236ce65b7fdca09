// SPDX-License-Identifier: Apache-2.0
// What idlc's description of a type tells, for types from libraries of users: opaque until here.

#pragma once

#include <cstdint>
#include <string>

#include "dds/entity.h"

namespace indurop::dds {

struct DescribedType {
  std::string name;  // "cell::Encoder"; empty: not told
  std::uint64_t size = 0;
  std::uint32_t keys = 0;
};
// `descriptor`: a TypeDescriptor.
DescribedType described(const void* descriptor);

// The same bytes under another name, which is borrowed, unless that is empty. Then without the description of the type
// that the network is told, because DDS would refuse to connect two descriptions that differ.
TypeDescriptor renamed(const void* descriptor, const std::string& name) noexcept;

}  // namespace indurop::dds
