// SPDX-License-Identifier: Apache-2.0
// Which files of a folder are the sources that are sent; the yardstick is what git itself lists.
#include "tools/cli/plant/project_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <tuple>

#include "core/base/temporary_folder.h"
#include "tests/support/unprivileged.h"

namespace indurop::tools {
namespace {

namespace fs = std::filesystem;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;
using testing::UnorderedElementsAre;

class ProjectFiles : public testing::Test {
 protected:
  ProjectFiles() { put("CMakeLists.txt"), put("plant.xml"), put("src/tick.cpp"); }
  void SetUp() override {
    if (std::system("git --version >/dev/null 2>&1") != 0) {
      GTEST_SKIP() << "git is not installed";
    }
  }

  void put(const std::string& file, const std::string& text = "text\n") const {
    const fs::path path = folder() / file;
    fs::create_directories(path.parent_path());
    std::ofstream(path) << text;
  }
  void run(const std::string& command) const {
    const std::string whole = "cd '" + folder().string() + "' && { " + command + "; } >/dev/null 2>&1";
    ASSERT_EQ(std::system(whole.c_str()), 0) << command;
  }
  void make_repository() const {
    put(".gitignore", "secret.env\n");
    put("secret.env");
    run("git init -q . && git add . && git -c user.name=x -c user.email=x commit -qm first");
  }
  Result<std::optional<Project>, base::Problem> find(const std::vector<fs::path>& also = {}) {
    plant_.file = folder() / "plant.xml";
    return find_project(plant_, also);
  }
  std::vector<std::string> paths() {
    const auto sut = find();
    EXPECT_TRUE(sut.ok()) << sut.error().text;
    std::vector<std::string> names;
    for (const deploy::ProjectFile& file : (*sut)->files) {
      names.push_back(file.path);
    }
    return names;
  }
  std::string problem(const std::vector<fs::path>& also = {}) {
    const auto sut = find(also);
    return sut ? "" : sut.error().text;
  }
  [[nodiscard]] fs::path folder() const { return outer_.path() / "project"; }

  base::TemporaryFolder outer_;
  config::Plant plant_;
};

TEST_F(ProjectFiles, Recordings_and_what_was_built_are_no_sources) {
  for (const char* file : {"run.mcap", "recordings/night.2.mcap", "build/tick.o", "build-arm64/tick.o", ".cache/index",
                           "mcap/notes.txt", "keys/governance.p7s", "keys/ca.pem", "keys/viewer/identity.pem"}) {
    put(file);
  }
  EXPECT_THAT(paths(), UnorderedElementsAre("CMakeLists.txt", "plant.xml", "src/tick.cpp", "mcap/notes.txt"));
}

// Others would get a plant that they cannot build.
TEST_F(ProjectFiles, That_cannot_be_read_are_named_and_not_left_out) {
  put("lib/part.cpp");
  fs::permissions(outer_.path(), fs::perms(0755));
  const fs::path part = folder() / "lib/part.cpp";
  for (const auto& [path, rights, named] : {std::tuple(folder() / "lib", 0444, folder() / "lib"),
                                            {folder() / "lib", 0000, folder() / "lib"},
                                            {part, 0000, part}}) {
    const fs::perms before = fs::status(path).permissions();
    fs::permissions(path, fs::perms(rights));
    {
      const test::WithoutRoot user;
      if (user.held()) {
        EXPECT_THAT(problem(), HasSubstr("cannot read " + named.string() + ": Permission denied"));
        EXPECT_THAT(problem(), HasSubstr("<sources>off</sources>"));
      }
    }
    fs::permissions(path, before);
  }
}

TEST_F(ProjectFiles, In_a_work_tree_they_are_what_git_lists) {
  make_repository();
  put("src/new.cpp");
  EXPECT_THAT(paths(),
              UnorderedElementsAre(".gitignore", "CMakeLists.txt", "plant.xml", "src/tick.cpp", "src/new.cpp"));
  EXPECT_TRUE((*find())->about["git"]["changed"].boolean().value_or(false));
}

// As in a work tree of another user, which git refuses: what is ignored would be sent.
TEST_F(ProjectFiles, What_git_cannot_list_is_not_sent) {
  make_repository();
  put(".git/index", "not an index");
  EXPECT_THAT(problem(), HasSubstr("git cannot tell which files of " + folder().string() + " are sources: "));
  fs::remove_all(folder() / ".git");
  put(".git", "gitdir: /nonexistent\n");
  EXPECT_THAT(problem(), HasSubstr("so files that it ignores must not be sent"));
}

TEST_F(ProjectFiles, The_repository_of_a_hook_that_runs_us_does_not_count) {
  make_repository();
  run("git init -q ../other");
  ::setenv("GIT_DIR", (outer_.path() / "other/.git").c_str(), 1);
  const auto sut = find();
  ::unsetenv("GIT_DIR");
  ASSERT_TRUE(sut.ok());
  EXPECT_TRUE((*sut)->about["git"].is_object());
}

TEST_F(ProjectFiles, A_monitor_that_a_repository_names_is_not_run) {
  make_repository();
  run("git config core.fsmonitor 'touch \"" + (outer_.path() / "ran").string() + "\"; false'");
  EXPECT_THAT(paths(), Contains("src/tick.cpp"));
  EXPECT_FALSE(fs::exists(outer_.path() / "ran"));
}

TEST_F(ProjectFiles, A_folder_that_is_a_link_now_leads_nowhere) {
  put("data/notes.txt");
  make_repository();
  fs::rename(folder() / "data", outer_.path() / "elsewhere");
  fs::create_directory_symlink(outer_.path() / "elsewhere", folder() / "data");
  EXPECT_THAT(paths(), Not(Contains("data/notes.txt")));
}

TEST_F(ProjectFiles, Links_and_repositories_in_it_are_named) {
  make_repository();
  run("ln -s src/tick.cpp alias.cpp && git init -q library && touch library/a.c");
  const auto sut = find();
  ASSERT_TRUE(sut.ok());
  ASSERT_EQ((*sut)->skipped.size(), 2U);
  EXPECT_EQ((*sut)->skipped[0].path, "alias.cpp");
  EXPECT_EQ((*sut)->skipped[0].reason, Project::Skipped::Link);
  EXPECT_EQ((*sut)->skipped[1].path, "library/");
  EXPECT_EQ((*sut)->skipped[1].reason, Project::Skipped::Repository);
}

TEST_F(ProjectFiles, A_folder_elsewhere_must_be_allowed) {
  fs::create_directory(outer_.path() / "home");
  std::ofstream(outer_.path() / "home/notes.txt") << "mine\n";
  plant_.sources_folder = folder() / "../home";
  EXPECT_THAT(problem(), HasSubstr("is not in the manifest's folder; if the plant needs it, allow it: --also"));
  EXPECT_EQ(problem({outer_.path() / "home"}), "");
  plant_.sources_folder = folder() / "src";
  EXPECT_THAT(paths(), UnorderedElementsAre("tick.cpp"));
}

// By tar, as bundles are.
TEST_F(ProjectFiles, Bundles_and_packages_in_the_folder_are_no_sources) {
  make_repository();
  run("touch package.json && tar --zstd -cf cell.bundle package.json && tar --zstd -cf data.tar.zst src && "
      "rm package.json && touch indurop-plant-cell_1.0_all.deb");
  EXPECT_THAT(paths(),
              UnorderedElementsAre(".gitignore", "CMakeLists.txt", "plant.xml", "src/tick.cpp", "data.tar.zst"));
  EXPECT_TRUE((*find())->about["git"]["changed"].boolean().value_or(false)) << "by data.tar.zst";
  fs::remove(folder() / "data.tar.zst");
  EXPECT_FALSE((*find())->about["git"]["changed"].boolean().value_or(true));
}

}  // namespace
}  // namespace indurop::tools
