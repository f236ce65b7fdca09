// SPDX-License-Identifier: Apache-2.0
#include "network/dds/descriptor.h"

#include <gtest/gtest.h>
#include <indurop/idl/wire.h>

#include "network/dds/plain_type.h"

namespace indurop::dds {
namespace {

TEST(Descriptor, Tells_name_size_and_keys_of_a_generated_type) {
  const DescribedType sut = described(&indurop_wire_Frame_desc);
  EXPECT_EQ(sut.name, "indurop::wire::Frame");
  EXPECT_EQ(sut.size, sizeof(indurop_wire_Frame));
  EXPECT_EQ(sut.keys, 1U);
}

TEST(Descriptor, Without_another_name_it_is_the_same) {
  const TypeDescriptor sut = renamed(&indurop_wire_Frame_desc, {});
  EXPECT_EQ(sut.m_typename, indurop_wire_Frame_desc.m_typename);
  EXPECT_EQ(sut.m_flagset, indurop_wire_Frame_desc.m_flagset);
}

TEST(Descriptor, Under_another_name_the_bytes_are_the_same_and_no_type_is_announced) {
  const std::string name = "lab::dds_::Frame_";
  const TypeDescriptor sut = renamed(&indurop_wire_Frame_desc, name);
  EXPECT_EQ(described(&sut).name, name);
  EXPECT_EQ(described(&sut).size, sizeof(indurop_wire_Frame));
  EXPECT_EQ(sut.m_ops, indurop_wire_Frame_desc.m_ops);
  EXPECT_EQ(sut.m_flagset & DDS_TOPIC_XTYPES_METADATA, 0U);
}

TEST(Descriptor, Of_a_variable_has_its_size_and_no_key) {
  for (const schema::Base base :
       {schema::Base::Bool, schema::Base::Int16, schema::Base::UInt64, schema::Base::Double}) {
    for (std::uint32_t count = 0; count < 5; ++count) {
      schema::Type type;
      type.base = base;
      type.element_size = type.align = schema::size_of(base);
      if (count > 0) {
        type.dims = {count};
      }
      const PlainType plain(type, "lab::value_");
      const TypeDescriptor sut = plain.descriptor();
      EXPECT_EQ(described(&sut).name, "lab::value_");
      EXPECT_EQ(described(&sut).size, type.size());
      EXPECT_EQ(described(&sut).keys, 0U);
    }
  }
}

}  // namespace
}  // namespace indurop::dds
