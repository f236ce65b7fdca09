// SPDX-License-Identifier: Apache-2.0
// Reads idlc's description of a type, for types from users' libraries, which are opaque elsewhere.

#pragma once

#include <cstdint>
#include <string>

#include "network/dds/entity.h"

namespace indurop::dds {

struct DescribedType {
  std::string name;  // "cell::Encoder"; empty: not known
  std::uint64_t size = 0;
  std::uint32_t keys = 0;
};
// `descriptor`: a TypeDescriptor.
DescribedType described(const void* descriptor);

// Returns the same type under another name, which is borrowed; an empty name changes nothing. A renamed type has no
// type description for the network, because DDS refuses to connect two different descriptions.
TypeDescriptor renamed(const void* descriptor, const std::string& name) noexcept;

}  // namespace indurop::dds
