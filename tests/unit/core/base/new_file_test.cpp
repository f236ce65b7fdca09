// SPDX-License-Identifier: Apache-2.0
#include "core/base/new_file.h"

#include <gmock/gmock.h>

#include <cerrno>
#include <string>

#include "core/base/read_file.h"
#include "folder.h"

namespace indurop::base {
namespace {

class NewFileTest : public FolderTest {};

TEST_F(NewFileTest, Has_the_parts_in_place_of_what_was_there) {
  for (const std::string& first : {std::string(200'000, 'x'), std::string()}) {
    NewFile sut(at("file"));
    EXPECT_TRUE(sut.write(first));
    EXPECT_TRUE(sut.write("end"));
    EXPECT_TRUE(sut.close().ok());
    EXPECT_EQ(*read_file(at("file")), first + "end");
  }
}

TEST_F(NewFileTest, Tells_the_first_error) {
  NewFile full("/dev/full");
  EXPECT_TRUE(full.write(""));
  EXPECT_FALSE(full.write("x"));
  EXPECT_FALSE(full.write("y"));
  const auto closed = full.close();
  ASSERT_FALSE(closed.ok());
  EXPECT_EQ(closed.error().sys_errno, ENOSPC);
  NewFile absent(at("no/such/folder"));
  EXPECT_FALSE(absent.good()) << "before anything is written";
  EXPECT_FALSE(absent.write(""));
  EXPECT_EQ(absent.close().error().sys_errno, ENOENT);
}

}  // namespace
}  // namespace indurop::base
