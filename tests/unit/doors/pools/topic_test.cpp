// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "doors/pools/sender.h"

namespace indurop::pool_door {
namespace {

TEST(PoolTopic, Is_the_path_of_the_name_as_for_variables) {
  EXPECT_EQ(topic_of("cell::Vision::camera"), "cell/Vision/camera");
  EXPECT_EQ(topic_of("camera"), "camera");
}

}  // namespace
}  // namespace indurop::pool_door
