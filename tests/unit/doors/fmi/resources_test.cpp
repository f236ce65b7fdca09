// SPDX-License-Identifier: Apache-2.0
#include "doors/fmi/library/resources.h"

#include <gmock/gmock.h>

namespace indurop::fmi {
namespace {

TEST(Resources, Uris_of_files_are_paths) {
  EXPECT_EQ(path_of_uri("file:///tmp/a/resources"), "/tmp/a/resources");
  EXPECT_EQ(path_of_uri("file:/tmp/a"), "/tmp/a");
  EXPECT_EQ(path_of_uri("file://localhost/tmp/a"), "/tmp/a");
  EXPECT_EQ(path_of_uri("/tmp/a%20b"), "/tmp/a%20b");
  EXPECT_EQ(path_of_uri("file:///tmp/a%20%C3%A4%2f"), "/tmp/a \u00e4/");
  EXPECT_EQ(path_of_uri("file:///tmp/100%"), "/tmp/100%");
  EXPECT_EQ(path_of_uri("file:///tmp/%zz%0"), "/tmp/%zz%0");
  EXPECT_EQ(path_of_uri("file:///tmp/%00a"), "/tmp/%00a");
  EXPECT_EQ(path_of_uri("file://elsewhere/tmp"), "");
  EXPECT_EQ(path_of_uri("http://a/b"), "");
  EXPECT_EQ(path_of_uri(""), "");
}

TEST(Resources, What_is_written_is_read_again) {
  Contents contents{"{1}", "plant.xml", true, "/usr/bin", {"a.exe"}, {{"x[1].y", {"left", "right"}, true}}};
  const auto read = read_contents(to_text(contents));
  ASSERT_TRUE(read) << read.error().text;
  EXPECT_EQ(to_text(*read), to_text(contents));
  EXPECT_EQ(read->variables.at(0).boards, (std::vector<std::string>{"left", "right"}));
  for (const char* text : {"", "{}", "[1]", R"({"indurop_fmu":2})", R"({"indurop_fmu":1,"token":3})"}) {
    EXPECT_FALSE(read_contents(text)) << text;
  }
  EXPECT_FALSE(open_resources("/nowhere"));
}

}  // namespace
}  // namespace indurop::fmi
