// SPDX-License-Identifier: Apache-2.0
// What an agent keeps on disk, and what it removes.

#include "deploy/agent/agent_state.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "core/keys/digest.h"

namespace indurop::deploy {
namespace {

namespace fs = std::filesystem;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

class AgentStateTest : public testing::Test {
 protected:
  AgentStateTest() : root_(fs::temp_directory_path() / ("indurop-agent-state-" + std::to_string(::getpid()))) {
    fs::remove_all(root_);
    ::setenv("INDUROP_STATE_DIR", root_.c_str(), 1);
    auto opened = AgentState::open("a");
    EXPECT_TRUE(opened) << opened.error().text;
    state_.emplace(std::move(*opened));
  }
  ~AgentStateTest() override {
    ::unsetenv("INDUROP_STATE_DIR");
    fs::remove_all(root_);
  }
  static void write(const fs::path& file, const std::string& text) { std::ofstream(file) << text; }
  // A deployment of one file besides its package, as it is on the board when it has been fetched.
  std::string fetched(const std::string& content) {
    Package package;
    package.plant = "cell";
    package.manifest = "plant.xml";
    package.boards = {"a"};
    package.files = {{"plant.xml", keys::digest_of(content), content.size(), false}};
    const std::string text = to_text(package);
    const std::string id = keys::digest_of(text);
    write(state_->file(id), text);
    write(state_->file(keys::digest_of(content)), content);
    EXPECT_TRUE(state_->install(id));
    return id;
  }
  void commit(const std::string& id) {
    Committed next = state_->committed();
    next.previous = next.current;
    next.current = id;
    next.history.push_back({id, "cell", ++next.generation, "desk", 0, "committed", {}});
    const auto committed = state_->commit(std::move(next));
    ASSERT_TRUE(committed) << committed.error().text;
  }
  std::vector<std::string> in(const std::string& folder) const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(state_->folder() / folder)) {
      names.push_back(entry.path().filename());
    }
    return names;
  }
  fs::path root_;
  std::optional<AgentState> state_;
};

TEST_F(AgentStateTest, What_was_taken_back_leaves_nothing) {
  const std::string good = fetched("good");
  commit(good);
  fetched("bad");
  write(state_->part(std::string(64, 'c')), "half");
  state_->collect_garbage();
  EXPECT_THAT(in("files"), UnorderedElementsAre(good, keys::digest_of("good")));
  EXPECT_EQ(in("deployments").size(), 1U);
  EXPECT_THAT(in("parts"), IsEmpty());
}

TEST_F(AgentStateTest, Of_those_given_up_the_newest_attempt_stays) {
  const std::string good = fetched("good");
  commit(good);
  fetched("first try");
  const std::string second = fetched("second try");
  write(state_->part(keys::digest_of("second try")), "half");
  write(state_->part(keys::digest_of("first try")), "half");
  state_->collect_garbage(second);
  EXPECT_THAT(in("files"), UnorderedElementsAre(good, keys::digest_of("good"), second, keys::digest_of("second try")));
  EXPECT_THAT(in("parts"), UnorderedElementsAre(keys::digest_of("second try")));
}

TEST_F(AgentStateTest, At_the_start_only_what_is_old_goes) {
  const std::string good = fetched("good");
  commit(good);
  const std::string fresh = fetched("fresh");
  const std::string old = fetched("old");
  const auto yesterday = fs::file_time_type::clock::now() - std::chrono::hours(25);
  for (const std::string& name : {old, keys::digest_of("old"), good, keys::digest_of("good")}) {
    fs::last_write_time(state_->file(name), yesterday);
  }
  state_->collect_old_garbage();
  EXPECT_THAT(in("files"), UnorderedElementsAre(good, keys::digest_of("good"), fresh, keys::digest_of("fresh")));
}

TEST_F(AgentStateTest, The_folder_that_a_node_runs_from_stays) {
  const std::string first = fetched("first");
  commit(first);
  state_->keep_folder_of(state_->manifest(first));
  for (const char* content : {"1", "2", "3", "4", "5", "6", "7"}) {
    commit(fetched(content));
    state_->collect_garbage();
  }
  EXPECT_TRUE(fs::exists(state_->manifest(first))) << "it may still start processes from there";
  EXPECT_EQ(in("deployments").size(), kDeploymentsKept + 1);
  state_->keep_folder_of("/somewhere/else/plant.xml");
  state_->collect_garbage();
  EXPECT_EQ(in("deployments").size(), kDeploymentsKept);
}

}  // namespace
}  // namespace indurop::deploy
