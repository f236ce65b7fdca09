// SPDX-License-Identifier: Apache-2.0
#include "core/keys/web_socket_key.h"

#include <gtest/gtest.h>

namespace indurop::keys {
namespace {

// The example of RFC 6455, 1.3.
TEST(WebSocketKey, Is_answered_as_the_standard_says) {
  EXPECT_EQ(web_socket_accept("dGhlIHNhbXBsZSBub25jZQ=="), "s3pPLMBiTxaQ9kYGzzhZRbK+xOo=");
  EXPECT_EQ(web_socket_accept("dGhlIHNhbXBsZSBub25jZQ"), "");
  EXPECT_EQ(web_socket_accept(""), "");
}

TEST(WebSocketKey, Of_a_client_is_another_one_each_time_and_valid) {
  const std::string key = web_socket_key();
  EXPECT_EQ(web_socket_accept(key).size(), 28U);
  EXPECT_NE(key, web_socket_key());
}

}  // namespace
}  // namespace indurop::keys
