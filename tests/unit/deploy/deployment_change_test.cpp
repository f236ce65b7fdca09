// SPDX-License-Identifier: Apache-2.0
// What a change between two deployments means for a board, as their files say it.

#include "deploy/agent/deployment_change.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <optional>

#include "core/keys/digest.h"

namespace indurop::deploy {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using Act = ModulePlan::Act;
using Files = std::map<std::string, std::string>;

class DeploymentChangeTest : public testing::Test {
 protected:
  DeploymentChangeTest() : root_(fs::temp_directory_path() / ("indurop-change-" + std::to_string(::getpid()))) {
    fs::remove_all(root_);
    ::setenv("INDUROP_STATE_DIR", root_.c_str(), 1);
    auto opened = AgentState::open("a");
    EXPECT_TRUE(opened);
    state_.emplace(std::move(*opened));
  }
  ~DeploymentChangeTest() override {
    ::unsetenv("INDUROP_STATE_DIR");
    fs::remove_all(root_);
  }

  static std::string module(const std::string& name, const std::string& file, const std::string& more = "") {
    return "<module><name>" + name + "</name><filename>" + file +
           "</filename><moduletype>thread</moduletype><operationtype>periodic</operationtype><period>1ms</period>"
           "<priority>1</priority>" +
           more + "</module>";
  }
  static std::string plant(const std::string& modules_of_a, const std::string& modules_of_b = "") {
    return "<plant name=\"cell\"><board name=\"a\">" + modules_of_a + "</board><board name=\"b\">" + modules_of_b +
           "</board></plant>";
  }
  // A deployment as it is on the board when it has been fetched: contents by path.
  std::string fetched(const Files& files, const std::string& manifest = "plant.xml") {
    Package package;
    package.plant = "cell";
    package.manifest = manifest;
    package.boards = {"a", "b"};
    for (const auto& [path, content] : files) {
      package.files.push_back({path, keys::digest_of(content), content.size(), false});
      std::ofstream(state_->file(keys::digest_of(content))) << content;
    }
    const std::string text = to_text(package);
    std::ofstream(state_->file(keys::digest_of(text))) << text;
    EXPECT_TRUE(state_->install(keys::digest_of(text)));
    return keys::digest_of(text);
  }
  DeploymentChange change(const Files& before, const Files& after,
                          const std::map<std::string, std::string>& running = {}) {
    return change_between(*state_, "a", fetched(before), fetched(after), running);
  }
  static std::vector<Act> acts(const DeploymentChange& change) {
    std::vector<Act> all;
    for (const ModulePlan& one : change.plan.modules) {
      all.push_back(one.act);
    }
    return all;
  }

  fs::path root_;
  std::optional<AgentState> state_;
  const std::string two_ =
      plant(module("press", "./press.so") + module("belt", "./belt.so"), module("eye", "./eye.so"));
  const Files before_ = {{"plant.xml", two_}, {"press.so", "p1"}, {"belt.so", "b1"}, {"eye.so", "e1"}};
};

TEST_F(DeploymentChangeTest, Modules_whose_file_differs_are_exchanged_and_the_others_kept) {
  Files after = before_;
  after["press.so"] = "p2";
  after["eye.so"] = "e2";  // of the other board
  const DeploymentChange sut = change(before_, after);
  EXPECT_EQ(sut.plan.restart, "");
  EXPECT_THAT(acts(sut), ElementsAre(Act::Exchanged, Act::Kept));
  ASSERT_EQ(sut.exchanged.size(), 1U);
  EXPECT_EQ(sut.exchanged[0].name, "press");
  EXPECT_EQ(keys::digest_of_file(sut.exchanged[0].file)->digest, keys::digest_of("p2"));
}

TEST_F(DeploymentChangeTest, What_runs_counts_and_not_what_was_deployed) {
  Files after = before_;
  after["press.so"] = "p2";
  EXPECT_THAT(acts(change(before_, after, {{"press", keys::digest_of("p2")}, {"belt", keys::digest_of("by hand")}})),
              ElementsAre(Act::Kept, Act::Exchanged));
}

TEST_F(DeploymentChangeTest, Another_file_that_differs_needs_a_restart) {
  Files with_job = before_;
  with_job["pick.job"] = "1";
  Files other_job = with_job;
  other_job["pick.job"] = "2";
  EXPECT_EQ(change(with_job, other_job).plan.restart, "pick.job has changed");
  EXPECT_EQ(change(before_, with_job).plan.restart, "pick.job is new");
  EXPECT_EQ(change(with_job, before_).plan.restart, "pick.job is gone");
  EXPECT_THAT(change(with_job, other_job).exchanged, IsEmpty());
  Files sources = before_;
  sources[".indurop/project.tar.zst"] = "whatever";
  EXPECT_EQ(change(before_, sources).plan.restart, "") << "sources run nowhere";
}

TEST_F(DeploymentChangeTest, Other_pools_need_no_restart) {
  const auto with = [&](const std::string& pools) {
    Files files = before_;
    files["plant.xml"].insert(two_.find("</plant>"), pools);
    return files;
  };
  const auto acts_of = [&](const std::string& before, const std::string& after) {
    const DeploymentChange sut = change(with(before), with(after));
    EXPECT_EQ(sut.plan.restart, "");
    EXPECT_THAT(acts(sut), ElementsAre(Act::Kept, Act::Kept));
    std::vector<std::pair<std::string, Act>> all;
    for (const PoolPlan& one : sut.plan.pools) {
      all.emplace_back(one.pool, one.act);
    }
    return all;
  };
  using Pools = std::vector<std::pair<std::string, Act>>;
  const std::string eye = R"(<pool name="eye" from="a" to="b"/>)";
  const std::string left = R"(<pool name="left" from="b" to="a"/>)";
  EXPECT_EQ(acts_of("", eye), (Pools{{"eye", Act::Added}}));
  EXPECT_EQ(acts_of(eye, eye), (Pools{{"eye", Act::Kept}}));
  EXPECT_EQ(acts_of(eye, eye + left), (Pools{{"eye", Act::Restarted}, {"left", Act::Added}}));
  EXPECT_EQ(acts_of(eye + left, left), (Pools{{"left", Act::Restarted}, {"eye", Act::Ended}}));
  EXPECT_EQ(acts_of(eye, R"(<pool name="eye" from="a" to="b" every="1s"/>)"), (Pools{{"eye", Act::Restarted}}));
}

TEST_F(DeploymentChangeTest, A_process_in_the_background_is_exchanged_too) {
  const auto with = [&](const std::string& content) {
    Files files = before_;
    files["plant.xml"] = plant(module("press", "./press.so") +
                               "<module><name>eye</name><filename>./eye.exe</filename><moduletype>process"
                               "</moduletype><operationtype>non-real</operationtype></module>");
    files["eye.exe"] = content;
    return files;
  };
  const DeploymentChange sut = change(with("1"), with("2"));
  EXPECT_EQ(sut.plan.restart, "");
  EXPECT_THAT(acts(sut), ElementsAre(Act::Kept, Act::Exchanged));
}

TEST_F(DeploymentChangeTest, A_manifest_that_says_something_else_needs_a_restart) {
  Files after = before_;
  after["plant.xml"] =
      plant(module("press", "./press.so", "<core>1</core>") + module("drum", "./belt.so"), module("eye", "./eye.so"));
  const DeploymentChange sut = change(before_, after);
  EXPECT_THAT(sut.plan.restart, HasSubstr("board a, module press"));
  EXPECT_THAT(acts(sut), ElementsAre(Act::Kept, Act::Added, Act::Ended));
  EXPECT_EQ(sut.manifest, "");
}

// Also of the same schedule: what the boards exchange may be something else.
TEST_F(DeploymentChangeTest, Another_schedule_on_whatever_board_follows_by_its_manifest) {
  Files after = before_;
  EXPECT_NE(change(before_, after).manifest, "");
  after["drum.so"] = "d1";
  after["press.so"] = "p2";
  after["plant.xml"] = plant(module("press", "./press.so", "<budget>1s</budget>") + module("drum", "./drum.so"),
                             module("eye", "./eye.so"));
  const DeploymentChange sut = change(before_, after);
  EXPECT_EQ(sut.plan.restart, "");
  EXPECT_THAT(acts(sut), ElementsAre(Act::Exchanged, Act::Added, Act::Ended));
  EXPECT_EQ(sut.exchanged.size(), 1U);
  EXPECT_EQ(keys::digest_of_file(sut.manifest)->digest, keys::digest_of(after["plant.xml"]));
  after = before_;
  after["plant.xml"] = plant(module("press", "./press.so") + module("belt", "./belt.so"),
                             module("eye", "./eye.so", "<budget>1s</budget>"));
  EXPECT_NE(change(before_, after).manifest, "") << "of the other board";
  EXPECT_THAT(acts(change(before_, after)), ElementsAre(Act::Kept, Act::Kept));
}

TEST_F(DeploymentChangeTest, Files_may_have_other_names_and_places) {
  const std::string id = fetched(before_);
  const std::string moved =
      fetched({{"cell/plant.xml",
                plant(module("press", "./v2/press.so") + module("belt", "./belt.so"), module("eye", "./eye.so"))},
               {"cell/v2/press.so", "p2"},
               {"cell/belt.so", "b1"},
               {"cell/eye.so", "e1"}},
              "cell/plant.xml");
  const DeploymentChange sut = change_between(*state_, "a", id, moved, {});
  EXPECT_EQ(sut.plan.restart, "");
  EXPECT_THAT(acts(sut), ElementsAre(Act::Exchanged, Act::Kept));
}

TEST_F(DeploymentChangeTest, Without_a_deployment_before_there_is_nothing_to_exchange) {
  EXPECT_EQ(change_between(*state_, "a", "", fetched(before_), {}).plan.restart, "nothing was deployed to it");
  EXPECT_NE(change_between(*state_, "a", std::string(64, 'f'), fetched(before_), {}).plan.restart, "");
  EXPECT_EQ(change_between(*state_, "z", fetched(before_), fetched(before_), {}).plan.restart,
            "the plant does not have this board any more");
}

}  // namespace
}  // namespace indurop::deploy
