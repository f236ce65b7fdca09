// SPDX-License-Identifier: Apache-2.0
#include "tools/serve/boards/write_request.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace indurop::serve {
namespace {

TEST(WriteRequests, Are_read) {
  const auto sut = read_write_request(R"({"values":{"a":1.5,"b":"x","c":[1,2]},"reason":"trial","lease":true})");
  ASSERT_TRUE(sut);
  using Value = std::pair<std::string, std::string>;
  EXPECT_EQ(sut->values, (std::vector<Value>{{"a", "1.5"}, {"b", "x"}, {"c", "[1,2]"}}));
  EXPECT_EQ(sut->reason, "trial");
  EXPECT_TRUE(sut->lease);
  EXPECT_EQ(sut->for_ns, 0);
  EXPECT_EQ(read_write_request(R"({"names":["a"],"all":false})")->names, std::vector<std::string>{"a"});
}

TEST(WriteRequests, With_a_time_that_is_none_say_which_times_there_are) {
  for (const char* const time : {"0", "-1", "0.5", "1e30", "99999999999999999999", "\"5s\""}) {
    const auto sut = read_write_request(R"({"values":{"a":1},"for_ns":)" + std::string(time) + "}");
    ASSERT_FALSE(sut) << time;
    EXPECT_EQ(sut.error(), "for_ns is a whole number of nanoseconds from 1 to 9223372036854775807") << time;
  }
  EXPECT_EQ(read_write_request(R"({"values":{"a":1},"for_ns":9223372036854775807})")->for_ns, INT64_MAX);
}

// What is not understood is never left out: a force would be held for ever.
TEST(WriteRequests, With_members_of_another_type_are_refused) {
  for (const char* const member :
       {R"("lease":"true")", R"("lease":1)", R"("lease":null)", R"("lease":[true])", R"("for_ns":"5s")",
        R"("for_ns":0)", R"("for_ns":-1)", R"("for_ns":1e30)", R"("for_ns":null)", R"("lease":true,"for_ns":5)",
        R"("reason":7)", R"("names":"a")", R"("names":[1])", R"("all":"yes")"}) {
    EXPECT_FALSE(read_write_request(R"({"values":{"a":1},)" + std::string(member) + "}")) << member;
  }
  for (const char* const text :
       {"", "[]", "1", "{", R"({"values":})", R"({"values":[1]})", R"({"values":{}})", R"({"lease":true)"}) {
    EXPECT_FALSE(read_write_request(text)) << text;
  }
}

}  // namespace
}  // namespace indurop::serve
