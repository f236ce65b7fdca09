// SPDX-License-Identifier: Apache-2.0
// Which file a <filename> means, written with and without what its beginning and ending may be.

#include "config/xml/module_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "core/base/program_folder.h"
#include "module_file.h"

namespace indurop::config {
namespace {

class ModuleName : public testing::Test {
 protected:
  void put(const std::string& name) const { std::ofstream(folder_ / name) << "x"; }
  // Relative to the folder.
  [[nodiscard]] std::string meant(const std::string& text) const {
    return module_file(folder_ / "", text).lexically_relative(folder_ / "").string();
  }
  ModuleFolder folder_;
};

TEST_F(ModuleName, Without_ending_means_what_is_there) {
  EXPECT_EQ(meant("arm"), "arm") << "as written, for the message that there is no such file";
  put("arm.exe");
  EXPECT_EQ(meant("arm"), "arm.exe");
  put("libarm.so");
  EXPECT_EQ(meant("arm"), "libarm.so");
  put("arm.so");
  EXPECT_EQ(meant("arm"), "arm.so");
  put("arm");
  EXPECT_EQ(meant("arm"), "arm");
  EXPECT_EQ(meant("libarm.so"), "libarm.so");
}

TEST_F(ModuleName, With_a_folder_is_a_path) {
  put("libarm.so");
  EXPECT_EQ(meant("./arm"), "arm");
  EXPECT_EQ(meant("x/../arm"), "arm");
  EXPECT_EQ(module_file(folder_ / "", "/arm"), "/arm");
}

TEST_F(ModuleName, Of_the_installation_is_found_after_those_of_the_folder) {
  const std::filesystem::path library = base::program_folder().parent_path() / "lib/libiodispat.so";
  ASSERT_TRUE(std::filesystem::exists(library));
  EXPECT_EQ(module_file(folder_ / "", "iodispat"), library);
  EXPECT_EQ(module_file(folder_ / "", "libiodispat.so"), library);
  EXPECT_EQ(meant("./libiodispat.so"), "libiodispat.so") << "a path is not looked for";
  put("libiodispat.so");
  EXPECT_EQ(meant("iodispat"), "libiodispat.so");
}

}  // namespace
}  // namespace indurop::config
