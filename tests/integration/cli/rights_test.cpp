// SPDX-License-Identifier: Apache-2.0
// Files and folders that a user may not read: `indurop` says so, and what to do, instead of what it takes them for.
#include <sys/stat.h>

#include <string>
#include <utility>
#include <vector>

#include "fixture.h"
#include "tests/support/unprivileged.h"

namespace indurop::test {
namespace {

class Rights : public CommandLine {
 protected:
  void SetUp() override {
    CommandLine::SetUp();
    std::filesystem::create_directories(folder_);
    ASSERT_EQ(::chmod(folder_.c_str(), 0777), 0);
  }
  void TearDown() override {
    (void)::chmod((folder_ / "state").c_str(), 0755);
    std::filesystem::remove_all(folder_);
  }
  [[nodiscard]] std::string path(const std::string& name) const { return folder_ / name; }
  // A file that only root may read.
  [[nodiscard]] std::string closed(const std::string& name, const std::string& text) const {
    put(path(name), text);
    EXPECT_EQ(::chmod(path(name).c_str(), 0), 0);
    return path(name);
  }
  Outcome run(const std::vector<std::string>& arguments, std::vector<std::string> variables = {}) const {
    variables.push_back("INDUROP_STATE_DIR=" + path("state"));
    Environment environment{.variables = variables, .user = unprivileged_instead_of_root()};
    return Program(indurop_command(arguments), environment).finish();
  }

  const std::filesystem::path folder_ = scratch() / "rights";
};

TEST_F(Rights, A_manifest_and_a_bundle_that_cannot_be_read_are_not_taken_for_other_files) {
  for (const char* name : {"plant.xml", "cell.bundle"}) {
    const std::string file = closed(name, "<plant/>");
    for (const std::vector<std::string>& arguments : {std::vector<std::string>{"deploy", file, "--one-host"},
                                                      {"pack", file, "-o", path("a.bundle")},
                                                      {"package", file, "--package-version", "1"},
                                                      {"diff", file, "--one-host"}}) {
      const Outcome sut = run(arguments);
      EXPECT_EQ(sut.code, 1) << arguments[0];
      EXPECT_THAT(sut.err, HasSubstr("cannot read " + file + ": Permission denied; check its permissions"));
    }
  }
}

TEST_F(Rights, A_release_and_an_installation_that_cannot_be_read_are_named) {
  const std::string file = closed("x.release", "");
  const Outcome deployed = run({"platform", "deploy", file, "--one-host"});
  EXPECT_EQ(deployed.code, 1);
  EXPECT_THAT(deployed.err, HasSubstr("cannot read " + file + ": Permission denied"));
  // Without it, the release would have no indurop-pools.
  std::filesystem::create_directories(folder_ / "usr/bin");
  const std::string program = closed("usr/bin/indurop-pools", "");
  const Outcome packed = run({"platform", "pack", path("usr"), "--release-version", "1", "-o", path("y.release")});
  EXPECT_EQ(packed.code, 1);
  EXPECT_THAT(packed.err, HasSubstr("cannot read " + program + ": Permission denied"));
}

TEST_F(Rights, A_temporary_folder_that_cannot_be_created_is_named_with_the_reason) {
  put(path("plant.xml"), "<plant name=\"cell\"><board name=\"a\"></board></plant>");
  for (const auto& [place, reason] : {std::pair("/proc", "No such file or directory"), {"/", "Permission denied"}}) {
    const Outcome sut = run({"pack", path("plant.xml"), "-o", path("a.bundle")}, {std::string("TMPDIR=") + place});
    EXPECT_EQ(sut.code, 1);
    EXPECT_THAT(sut.err, HasSubstr(std::string("cannot create a temporary folder in ") + place + ": "));
    EXPECT_THAT(sut.err, ::testing::AnyOf(HasSubstr(reason), HasSubstr("Permission denied")));
  }
}

TEST_F(Rights, Keys_that_cannot_be_read_are_not_called_missing) {
  const std::string keys = path("keys");
  put(path("plant.xml"), "<plant name=\"cell\"><board name=\"a\"></board></plant>");
  ASSERT_EQ(run({"keys", "init", path("plant.xml"), "--dir", keys}).code, 0);
  const std::string issued = keys + "/issued.txt";
  ASSERT_EQ(::chmod(issued.c_str(), 0), 0);
  const Outcome revoked = run({"keys", "revoke", "a", "--dir", keys});
  EXPECT_EQ(revoked.code, 1) << "nothing would be revoked";
  EXPECT_THAT(revoked.err, HasSubstr("cannot read " + issued + ": Permission denied"));
  ASSERT_EQ(::chmod(issued.c_str(), 0600), 0);
  ASSERT_EQ(::chmod((keys + "/deployer").c_str(), 0), 0);
  const Outcome packed = run({"pack", path("plant.xml"), "-o", path("a.bundle"), "--keys", keys});
  EXPECT_EQ(packed.code, 1);
  EXPECT_THAT(packed.err, HasSubstr("cannot read " + keys + "/deployer/identity.pem: Permission denied"));
  const Outcome listed = run({"keys", "list", "--dir", keys});
  EXPECT_EQ(listed.code, 1);
  EXPECT_THAT(listed.out, HasSubstr("deployer/identity.pem: Permission denied"));
  EXPECT_THAT(listed.out, Not(HasSubstr("1970")));
  ASSERT_EQ(::chmod((keys + "/deployer").c_str(), 0700), 0);
}

TEST_F(Rights, State_that_cannot_be_read_is_not_called_empty) {
  std::filesystem::create_directories(folder_ / "state/a/deployments");
  std::filesystem::create_directories(folder_ / "state/serve");
  put(path("state/serve/audit.jsonl"), "");
  ASSERT_EQ(::chmod(path("state/a").c_str(), 0), 0);
  ASSERT_EQ(::chmod(path("state/serve").c_str(), 0), 0);
  const Outcome verified = run({"verify"});
  EXPECT_EQ(verified.code, 1);
  EXPECT_THAT(verified.err, HasSubstr("Permission denied; run this as the user of the agents"));
  const Outcome audit = run({"audit"});
  EXPECT_EQ(audit.code, 1);
  EXPECT_THAT(audit.err, HasSubstr("cannot read " + path("state/serve/audit.jsonl") + ": Permission denied"));
  ASSERT_EQ(::chmod(path("state/a").c_str(), 0755), 0);
  ASSERT_EQ(::chmod(path("state/serve").c_str(), 0755), 0);
  EXPECT_EQ(run({"audit"}).code, 0);
}

}  // namespace
}  // namespace indurop::test
