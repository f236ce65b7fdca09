// SPDX-License-Identifier: Apache-2.0
// Checksums of std_msgs are those that ROS 1 has published; that of a struct was computed by genmsg (gendeps --md5).
#include "doors/ros/ros1/message.h"

#include <gmock/gmock.h>

namespace indurop::ros {
namespace {

MessageType type_of(const std::string& layout) {
  return message_type("knu::Robot::joints", *read_layout(layout));
}

TEST(RosMessage, Numbers_and_arrays_of_numbers_are_those_of_std_msgs) {
  const struct {
    const char* layout;
    const char* name;
    const char* md5;
  } kKnown[] = {{"f64", "std_msgs/Float64", "fdb28210bfa9d7c91146260178d9a584"},
                {"f32", "std_msgs/Float32", "73fcbf46b49191e672908e50842a83d4"},
                {"i32", "std_msgs/Int32", "da5909fbe378aeaf85e547e830cc1bb7"},
                {"enum{A=0,B=1}", "std_msgs/Int32", "da5909fbe378aeaf85e547e830cc1bb7"},
                {"bool", "std_msgs/Bool", "8b94c1b53db61fb6aed406028ad6332a"},
                {"text(8)", "std_msgs/String", "992ce8a1687cec8c8bd883ec73ca41d1"},
                {"f64[2][3]", "std_msgs/Float64MultiArray", "4b7d974086d4060e7db4613a7e6c3ba4"},
                {"i16[4]", "std_msgs/Int16MultiArray", "d9338d7f523fcb692fae9d0a0e9f067c"},
                {"bool[4]", "std_msgs/UInt8MultiArray", "82373f1612381bb6ee473b5cd6f5d89c"}};
  for (const auto& known : kKnown) {
    const MessageType type = type_of(known.layout);
    EXPECT_EQ(type.name, known.name);
    EXPECT_EQ(type.md5, known.md5) << known.layout;
  }
}

TEST(RosMessage, A_struct_has_the_names_of_ros_2_and_those_of_its_parts) {
  const MessageType type =
      type_of("struct(32,8){dCurJoint@0:f64[2],part@16:struct(4,4){x@0:f32}[2],name@24:text(6)}[3]");
  EXPECT_EQ(type.name, "knu_robot_msgs/Joints");
  EXPECT_EQ(type.definition,
            "knu_robot_msgs/JointsValue[3] value\n" + std::string(80, '=') +
                "\nMSG: knu_robot_msgs/JointsValuePart\nfloat32 x\n" + std::string(80, '=') +
                "\nMSG: knu_robot_msgs/JointsValue\nfloat64[2] d_cur_joint\nknu_robot_msgs/JointsValuePart[2] part\n"
                "string name\n");
}

TEST(RosMessage, Bytes_follow_each_other_without_gaps) {
  const Layout layout = *read_layout("struct(16,4){a@0:u8,b@4:u16[2],name@8:text(4),c@12:i32}[1]");
  const std::vector<std::uint8_t> value = {7, 0, 0, 0, 1, 2, 3, 4, 'a', 'b', 0, 'x', 5, 6, 7, 8};
  std::vector<std::uint8_t> message;
  write_message(layout, value, message);
  EXPECT_THAT(message, testing::ElementsAre(7, 1, 2, 3, 4, 2, 0, 0, 0, 'a', 'b', 5, 6, 7, 8));
}

TEST(RosMessage, An_array_says_its_dimensions) {
  std::vector<std::uint8_t> message;
  const std::vector<std::uint8_t> value = {1, 2, 3, 4, 5, 6};
  write_message(*read_layout("u8[2][3]"), value, message);
  const std::vector<std::uint8_t> expected = {2, 0, 0, 0,                                      //
                                              0, 0, 0, 0, 2, 0, 0, 0, 6, 0, 0, 0,              //
                                              0, 0, 0, 0, 3, 0, 0, 0, 3, 0, 0, 0, 0, 0, 0, 0,  //
                                              6, 0, 0, 0, 1, 2, 3, 4, 5, 6};
  EXPECT_EQ(message, expected);
}

}  // namespace
}  // namespace indurop::ros
