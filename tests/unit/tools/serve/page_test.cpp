// SPDX-License-Identifier: Apache-2.0
#include "tools/serve/page.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

namespace indurop::serve {
namespace {

class PageFolder : public ::testing::Test {
 protected:
  PageFolder() : outside_(std::filesystem::path(::testing::TempDir()) / ("page" + std::to_string(getpid()))) {
    std::filesystem::create_directories(folder() / "assets");
    write(outside_ / "secret.txt", "secret");
    write(folder() / "index.html", "<p>here</p>");
    write(folder() / "assets/app.js", "1");
    write(folder() / ".hidden", "hidden");
    std::filesystem::create_symlink(outside_ / "secret.txt", folder() / "link.txt");
  }
  ~PageFolder() override { std::filesystem::remove_all(outside_); }
  PageFolder(const PageFolder&) = delete;
  PageFolder& operator=(const PageFolder&) = delete;

  [[nodiscard]] std::filesystem::path folder() const { return outside_ / "web"; }
  static void write(const std::filesystem::path& file, const std::string& text) { std::ofstream(file) << text; }

 private:
  std::filesystem::path outside_;
};

TEST_F(PageFolder, Shows_its_files) {
  const Page page(folder());
  EXPECT_TRUE(page.there());
  EXPECT_EQ(page.answer("/").body, "<p>here</p>");
  EXPECT_EQ(page.answer("/").type, "text/html; charset=utf-8");
  EXPECT_EQ(page.answer("/assets/app.js").type, "text/javascript; charset=utf-8");
  EXPECT_TRUE(page.answer("/assets/app.js").immutable);
  EXPECT_FALSE(page.answer("/").immutable);
}

TEST_F(PageFolder, Shows_nothing_else) {
  const Page page(folder());
  for (const char* path :
       {"/../secret.txt", "/assets/../../secret.txt", "/./../secret.txt", "//../secret.txt", "/..", "/link.txt",
        "/.hidden", "/assets", "/nothing", "/assets/..\\..\\secret.txt", "", "secret.txt"}) {
    EXPECT_EQ(page.answer(path).status, 404) << path;
  }
  EXPECT_EQ(page.answer(std::string_view("/index.html\0.png", 16)).status, 404);
}

TEST(Page, Says_what_is_missing) {
  const Page page("/nowhere");
  EXPECT_FALSE(page.there());
  EXPECT_EQ(page.answer("/").status, 404);
  EXPECT_NE(page.answer("/").body.find("npm"), std::string::npos);
}

}  // namespace
}  // namespace indurop::serve
