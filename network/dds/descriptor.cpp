// SPDX-License-Identifier: Apache-2.0
#include "network/dds/descriptor.h"

namespace indurop::dds {

DescribedType described(const void* descriptor) {
  const auto& type = *static_cast<const TypeDescriptor*>(descriptor);
  return {type.m_typename == nullptr ? "" : type.m_typename, type.m_size, type.m_nkeys};
}

TypeDescriptor renamed(const void* descriptor, const std::string& name) noexcept {
  const auto& type = *static_cast<const TypeDescriptor*>(descriptor);
  if (name.empty()) {
    return type;
  }
  return {type.m_size,  type.m_align, type.m_flagset & ~DDS_TOPIC_XTYPES_METADATA,
          type.m_nkeys, name.c_str(), type.m_keys,
          type.m_nops,  type.m_ops,   type.m_meta,
          {},           {},           type.restrict_data_representation};
}

}  // namespace indurop::dds
