// SPDX-License-Identifier: Apache-2.0
// Addresses by hand, from RFC 3986 and docs/mqtt.md.

#include "doors/mqtt/serve/address.h"

#include <gtest/gtest.h>

#include "doors/mqtt/serve/http.h"

namespace indurop::mqtt {
namespace {

TEST(Address, Has_the_usual_ports) {
  EXPECT_EQ(read_address("mqtt://broker", kMqtt)->host_and_port(), "broker:1883");
  EXPECT_EQ(read_address("mqtts://broker.local/", kMqtt)->host_and_port(), "broker.local:8883");
  EXPECT_TRUE(read_address("mqtts://broker", kMqtt)->tls);
  EXPECT_EQ(read_address("http://127.0.0.1:8080", kHttp)->host_and_port(), "127.0.0.1:8080");
  EXPECT_EQ(read_address("https://[fe80::1]:9", kHttp)->host_and_port(), "[fe80::1]:9");
  EXPECT_EQ(read_address("https://[::1]", kHttp)->host_and_port(), "[::1]:443");
}

TEST(Address, Knows_this_machine) {
  for (const char* text : {"mqtt://127.0.0.1", "mqtt://localhost:1", "mqtt://[::1]"}) {
    EXPECT_TRUE(read_address(text, kMqtt)->is_loopback()) << text;
  }
  EXPECT_FALSE(read_address("mqtt://128.0.0.1", kMqtt)->is_loopback());
}

TEST(Address, Refuses_everything_else) {
  for (const char* text : {"", "broker", "http://broker", "mqtt://", "mqtt://:1", "mqtt://a:b", "mqtt://a:1x",
                           "mqtt://a:70000", "mqtt://[::1", "mqtt://[::1]x", "mqtt://u@h", "mqtt://a/b"}) {
    EXPECT_FALSE(read_address(text, kMqtt).ok()) << text;
  }
}

TEST(Address, A_name_is_one_part_of_a_path) {
  EXPECT_EQ(path_part("knu::Robot/a b%?"), "knu%3A%3ARobot%2Fa%20b%25%3F");
  EXPECT_EQ(path_part("press_1-a.b"), "press_1-a.b");
}

}  // namespace
}  // namespace indurop::mqtt
