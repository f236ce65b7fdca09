// SPDX-License-Identifier: Apache-2.0
// Releases of the platform: their versions, their packages, and the file by which an agent hands over to its successor.

#include <gmock/gmock.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>

#include "core/keys/digest.h"
#include "deploy/disk/last_switch.h"
#include "deploy/transaction/release_package.h"
#include "deploy/words/release_version.h"

namespace indurop::deploy {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(ReleaseVersion, Orders_as_documented) {
  const std::vector<std::string> order{"0.3~rc1", "0.3", "0.3.0", "0.3.0+line2", "0.3.1", "0.10", "1"};
  for (std::size_t a = 0; a < order.size(); ++a) {
    for (std::size_t b = 0; b < order.size(); ++b) {
      EXPECT_EQ(is_older_release(order[a], order[b]), a < b) << order[a] << " and " << order[b];
    }
  }
}

TEST(ReleaseVersion, Orders_as_dpkg_does) {
  if (std::system("dpkg --compare-versions 1 lt 2") != 0) {
    GTEST_SKIP() << "there is no dpkg";
  }
  std::mt19937 random(7);
  const auto version = [&random] {
    std::string text = std::to_string(random() % 12);
    for (auto more = random() % 4; more > 0; --more) {
      text += std::string(1, ".+~ab"[random() % 5]) + std::to_string(random() % 12);
    }
    return text;
  };
  for (int i = 0; i < 300; ++i) {
    const std::string a = version();
    const std::string b = version();
    ASSERT_TRUE(is_release_version(a));
    const bool older = std::system(("dpkg --compare-versions '" + a + "' lt '" + b + "'").c_str()) == 0;
    EXPECT_EQ(is_older_release(a, b), older) << a << " and " << b;
  }
}

TEST(ReleaseVersion, Is_one_word) {
  for (const char* bad : {"", "v1", "1 2", "1/2", "1-2", "../1"}) {
    EXPECT_FALSE(is_release_version(bad)) << bad;
  }
}

class ReleasePackage : public testing::Test {
 protected:
  ReleasePackage() : folder_(fs::temp_directory_path() / ("indurop-release-" + std::to_string(::getpid()))) {
    fs::remove_all(folder_);
  }
  ~ReleasePackage() override { fs::remove_all(folder_); }
  void write(const std::string& path, const std::string& content) const {
    fs::create_directories((folder_ / path).parent_path());
    std::ofstream(folder_ / path, std::ios::binary) << content;
  }
  // A file that begins as a program for this processor does.
  void write_program(const std::string& path, char machine) const {
    write(path, std::string("\x7f"
                            "ELF\x02\x01\x01",
                            7) +
                    std::string(11, '\0') + std::string(1, machine) + '\0' + path);
  }
  fs::path install(const std::string& name, char machine) const {
    for (const char* program : {"indurop", "indurop-agent", "indurop-node"}) {
      write_program(name + "/bin/" + program, machine);
    }
    write(name + "/lib/x/libindurop.so.0.2", "library");
    write(name + "/lib/libindurop_testing.so.0.2", "not needed on a board");
    write(name + "/share/indurop/web/index.html", "page");
    return folder_ / name;
  }
  std::string problem(const std::vector<fs::path>& prefixes) const {
    const auto packed = pack_release(prefixes, "1.0", "");
    return packed ? "" : packed.error().text;
  }
  static constexpr char kAmd64 = 62;
  static constexpr char kArm64 = static_cast<char>(183);
  fs::path folder_;
};

TEST_F(ReleasePackage, Has_the_files_of_each_architecture) {
  const auto sut = pack_release({install("one", kAmd64), install("two", kArm64)}, "1.0+x", "why");
  ASSERT_TRUE(sut) << sut.error().text;
  std::vector<std::string> paths;
  for (const PackageFile& file : sut->package.files) {
    paths.push_back(file.path);
  }
  EXPECT_THAT(paths, ElementsAre("amd64/bin/indurop", "amd64/bin/indurop-agent", "amd64/bin/indurop-node",
                                 "amd64/lib/x/libindurop.so.0.2", "amd64/share/indurop/web/index.html",
                                 "arm64/bin/indurop", "arm64/bin/indurop-agent", "arm64/bin/indurop-node",
                                 "arm64/lib/x/libindurop.so.0.2", "arm64/share/indurop/web/index.html"));
  EXPECT_THAT(architectures_of(sut->package), ElementsAre("amd64", "arm64"));
  const auto read = read_package(sut->text);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->release, "1.0+x");
  EXPECT_EQ(read->comment, "why");
}

TEST_F(ReleasePackage, Needs_a_whole_installation_for_each_architecture_once) {
  EXPECT_THAT(problem({folder_ / "none"}), HasSubstr("bin/indurop is missing"));
  const fs::path one = install("one", kAmd64);
  EXPECT_THAT(problem({one, install("again", kAmd64)}), HasSubstr("the second installation for amd64"));
  write_program("one/bin/indurop-node", kArm64);
  EXPECT_THAT(problem({one}), HasSubstr("bin/indurop-node is missing, or of another architecture"));
  const fs::path bare = install("bare", kAmd64);
  fs::remove_all(bare / "lib");
  EXPECT_THAT(problem({bare}), HasSubstr("has no libindurop.so"));
}

TEST_F(ReleasePackage, Is_never_a_plant_as_well) {
  const std::string id(64, 'a');
  const auto text = [&](const std::string& words) {
    return R"({"indurop_package":1,)" + words + R"("files":[{"path":"p","sha256":")" + id +
           R"(","size":1,"executable":false}]})";
  };
  EXPECT_TRUE(read_package(text(R"("release":"1",)")));
  EXPECT_TRUE(read_package(text(R"("plant":"c","manifest":"p","boards":["a"],)")));
  EXPECT_FALSE(read_package(text(R"("release":"1","plant":"c","manifest":"p","boards":["a"],)")));
  EXPECT_FALSE(read_package(text(R"("release":"1","plant":"c",)")));
  EXPECT_FALSE(read_package(text(R"("release":"../1",)")));
  EXPECT_FALSE(read_package(text("")));
}

LastSwitch some_switch() {
  LastSwitch last;
  last.order.deployment = "installed";
  last.order.size = 1;
  last.order.generation = 2;
  last.order.plant = "cell";
  last.order.boards = {"a", "b"};
  last.order.grant = "grant";
  last.order.deployer = 3;
  last.order.host = "desk";
  last.order.health_ns = 4;
  last.joining = true;
  last.session = 5;
  last.begun_ns = 6;
  last.starts = 7;
  last.ended = "why";
  last.installed = "0.2.0";
  return last;
}

TEST(LastSwitch, Comes_back_as_it_was) {
  for (const bool expired : {false, true}) {
    LastSwitch last = some_switch();
    last.expired = expired;
    const auto sut = read_switch(switch_text(last));
    ASSERT_TRUE(sut);
    EXPECT_EQ(switch_text(*sut), switch_text(last));
    EXPECT_EQ(sut->session, 5U);
    EXPECT_THAT(sut->order.boards, ElementsAre("a", "b"));
    EXPECT_EQ(sut->expired, expired);
  }
}

TEST(LastSwitch, Is_read_whole_or_not_at_all) {
  const std::string text = switch_text(some_switch());
  EXPECT_FALSE(read_switch(""));
  EXPECT_FALSE(read_switch(text.substr(0, text.size() / 2)));
  for (std::size_t i = 0; i < text.size(); ++i) {
    std::string changed = text;
    changed[i] = static_cast<char>(changed[i] ^ 1);
    const auto sut = read_switch(changed);
    EXPECT_TRUE(!sut || switch_text(*sut) == text) << "byte " << i << " decides something";
  }
}

}  // namespace
}  // namespace indurop::deploy
