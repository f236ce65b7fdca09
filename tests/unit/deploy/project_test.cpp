// SPDX-License-Identifier: Apache-2.0
// Sources as one file: the same each time, read back, and refused where they lead outside.
#include "deploy/bundle/project.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "gnu_tar.h"

namespace indurop::deploy {
namespace {

namespace files = std::filesystem;

class ProjectArchive : public testing::Test {
 protected:
  ProjectArchive() {
    std::string name = (files::temp_directory_path() / "indurop-project-XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
    files::create_directory(folder_ / "out");
  }
  ~ProjectArchive() override { files::remove_all(folder_); }
  files::path make(const std::string& name, const std::string& content) {
    std::ofstream(folder_ / name, std::ios::binary) << content;
    return folder_ / name;
  }
  static std::string content_of(const files::path& file) {
    std::ifstream from(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(from), {}};
  }
  std::string problem() {
    const auto sut = open_project(folder_ / "p", folder_ / "out");
    return sut ? "" : sut.error().text;
  }
  files::path folder_;
};

TEST_F(ProjectArchive, Is_unpacked_as_it_was_packed) {
  const files::path script = make("s", "#!/bin/sh\n");
  files::permissions(script, files::perms::owner_exec, files::perm_options::add);
  const std::vector<ProjectFile> sources{
      {"a/b/run.sh", script}, {"empty", make("e", "")}, {"z", make("z", std::string("\0x", 2))}};
  ASSERT_TRUE(write_project({{"manifest", "z"}}, sources, folder_ / "p"));
  ASSERT_TRUE(write_project({{"manifest", "z"}}, sources, folder_ / "q"));
  EXPECT_EQ(content_of(folder_ / "p"), content_of(folder_ / "q"));
  const auto sut = open_project(folder_ / "p", folder_ / "out");
  ASSERT_TRUE(sut) << sut.error().text;
  EXPECT_EQ(sut->about["manifest"].text(), "z");
  EXPECT_THAT(sut->paths, testing::ElementsAre("a/b/run.sh", "empty", "z"));
  for (const ProjectFile& one : sources) {
    EXPECT_EQ(content_of(folder_ / "out" / one.path), content_of(one.source));
  }
  EXPECT_EQ(::access((folder_ / "out/a/b/run.sh").c_str(), X_OK), 0);
}

// Made by tar: what write_project() never writes.
TEST_F(ProjectArchive, Paths_that_lead_outside_and_links_are_refused) {
  if (!has_gnu_tar()) {
    GTEST_SKIP() << "there is no GNU tar";
  }
  make("project.json", "{}");
  files::create_directories(folder_ / "source");
  const std::string tar = "cd " + folder_.string() + " && ";
  make("source/x", "x");
  const char* const transforms[] = {"s,source/x,source/../escaped,", "s,source/x,/tmp/indurop-escaped,",
                                    "s,source/x,other/x,"};
  for (const std::string transform : transforms) {
    const std::string pack = tar + "tar --zstd -P -cf p --transform '" + transform + "' project.json source/x";
    ASSERT_EQ(std::system(pack.c_str()), 0);
    EXPECT_THAT(problem(), testing::HasSubstr("damaged")) << transform;
  }
  EXPECT_FALSE(files::exists(folder_ / "escaped"));
  ASSERT_EQ(std::system((tar + "ln -s /etc/passwd source/l && tar --zstd -cf p project.json source/l").c_str()), 0);
  EXPECT_THAT(problem(), testing::HasSubstr("damaged"));
  make("p", "something else");
  EXPECT_THAT(problem(), testing::HasSubstr("damaged"));
}

TEST_F(ProjectArchive, Names_are_bytes) {
  if (!has_gnu_tar()) {
    GTEST_SKIP() << "there is no GNU tar";
  }
  const std::string umlaut = "m\xc3\xbcller.txt";  // UTF-8
  const std::string other = "bad\xff\xfe";
  const std::string odd = "a\nb 'c' \"d\"";
  const files::path text = make("t", "x");
  ASSERT_TRUE(write_project({{"manifest", "z"}}, {{umlaut, text}, {other, text}, {odd, text}}, folder_ / "p"));
  const auto sut = open_project(folder_ / "p", folder_ / "out");
  ASSERT_TRUE(sut) << sut.error().text;
  EXPECT_THAT(sut->paths, testing::ElementsAre(umlaut, other, odd));
  EXPECT_EQ(content_of(folder_ / "out" / umlaut), "x");
  const std::string list =
      "LC_ALL=C.UTF-8 tar --zstd -tf " + (folder_ / "p").string() + " > " + (folder_ / "list").string();
  ASSERT_EQ(std::system(list.c_str()), 0);
  EXPECT_THAT(content_of(folder_ / "list"), testing::HasSubstr("source/" + umlaut + "\n"));
}

// Made by tar, again.
TEST_F(ProjectArchive, Nothing_is_left_of_one_that_is_refused) {
  if (!has_gnu_tar()) {
    GTEST_SKIP() << "there is no GNU tar";
  }
  make("project.json", "{}");
  files::create_directories(folder_ / "source/a/.git");
  make("source/a/good", "x");
  make("source/a/.git/config", "[core]\n");
  const std::string tar = "cd " + folder_.string() + " && ";
  const auto refused = [&](const std::string& members) {
    EXPECT_EQ(std::system((tar + "tar --zstd -cf p project.json " + members).c_str()), 0);
    EXPECT_THAT(problem(), testing::HasSubstr("damaged")) << members;
    EXPECT_TRUE(files::is_empty(folder_ / "out")) << members;
  };
  refused("source/a/good source/a/.git/config");
  refused("--hard-dereference source/a/good source/a/good");
  files::resize_file(make("source/huge", ""), kMaxProjectBytes / 2 + 1);
  files::copy_file(folder_ / "source/huge", folder_ / "source/second");
  refused("source/a/good source/huge source/second");
}

}  // namespace
}  // namespace indurop::deploy
