// SPDX-License-Identifier: Apache-2.0
#include "core/base/inside_folder.h"

#include <gtest/gtest.h>

#include "folder.h"

namespace indurop::base {
namespace {

namespace fs = std::filesystem;

class InsideFolder : public FolderTest {};

TEST_F(InsideFolder, Links_and_dots_lead_where_they_lead) {
  fs::create_directories(at("project/inner"));
  write("project/file", "");
  write("other", "");
  fs::create_symlink(at("other"), at("project/out"));
  fs::create_symlink("..", at("project/up"));
  fs::create_symlink("file", at("project/in"));
  fs::create_symlink(at("project"), at("link"));
  EXPECT_TRUE(lies_inside(at("project/file"), at("project")));
  EXPECT_TRUE(lies_inside(at("project/file"), at("project") / ""));
  EXPECT_TRUE(lies_inside(at("project/inner/../file"), at("project")));
  EXPECT_TRUE(lies_inside(at("project/in"), at("project")));
  EXPECT_TRUE(lies_inside(at("project/not_there"), at("project")));
  EXPECT_TRUE(lies_inside(at("link/file"), at("project")));
  EXPECT_TRUE(lies_inside(at("project/file"), at("link")));
  EXPECT_FALSE(lies_inside(at("project/out"), at("project")));
  EXPECT_FALSE(lies_inside(at("project/up/other"), at("project")));
  EXPECT_FALSE(lies_inside(at("project/../other"), at("project")));
  EXPECT_FALSE(lies_inside(at("project_2"), at("project")));
  EXPECT_FALSE(lies_inside("/etc/passwd", at("project")));
  EXPECT_TRUE(lies_inside("/etc/passwd", "/"));
  EXPECT_TRUE(lies_inside("here", ""));
}

}  // namespace
}  // namespace indurop::base
