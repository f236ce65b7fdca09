// SPDX-License-Identifier: Apache-2.0
#include "core/base/clone_file.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "core/base/read_file.h"
#include "folder.h"

namespace indurop::base {
namespace {

using testing::HasSubstr;

class CloneFile : public FolderTest {
 protected:
  [[nodiscard]] std::filesystem::path file(const std::string& name, const std::string& text) const {
    std::ofstream(at(name)) << text;
    return at(name);
  }
};

TEST_F(CloneFile, Replaces_what_is_there) {
  for (const std::string& text : {std::string(300'000, 'x'), std::string("short"), std::string()}) {
    const auto to = file("to", "older and longer than the new content");
    ASSERT_TRUE(clone_file(file("from", text), to).ok());
    EXPECT_EQ(*read_file(to), text);
  }
}

TEST_F(CloneFile, Names_the_cause) {
  const auto full = clone_file(file("from", std::string(300'000, 'x')), "/dev/full");
  ASSERT_FALSE(full.ok());
  EXPECT_THAT(full.error().text, HasSubstr("cannot write /dev/full: No space left on device"));
  const auto absent = clone_file("/nowhere/from", file("to", ""));
  ASSERT_FALSE(absent.ok());
  EXPECT_THAT(absent.error().text, HasSubstr("cannot read /nowhere/from: No such file or directory"));
}

}  // namespace
}  // namespace indurop::base
