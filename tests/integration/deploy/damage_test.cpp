// SPDX-License-Identifier: Apache-2.0
// Files of a board that the disk has changed by one bit: they are not run, and come again from another board or from
// any deployer.

#include <algorithm>
#include <fstream>

#include "agents_fixture.h"
#include "core/keys/digest.h"

namespace indurop::test {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

class Damaged : public AgentsTest {
 protected:
  Damaged()
      : v1_(manifest("v1.xml", {{"a", "steady"}, {"b", "steady"}})),
        v2_(manifest("v2.xml", {{"a", "other"}, {"b", "other"}})),
        steady_(keys::digest_of_file(folder() / "steady.so")->digest) {}
  void start_both() {
    start_agent("a");
    start_agent("b");
  }
  std::string deployed(const std::string& file) {
    const Outcome done = deploy(file);
    EXPECT_EQ(done.code, 0) << done.err;
    return done.code == 0 ? done.json()["deployment"].get<std::string>() : "";
  }
  [[nodiscard]] fs::path state(const std::string& name) const { return folder() / "state" / board(name); }
  static void flip(const fs::path& file) {
    std::fstream at(file, std::ios::in | std::ios::out | std::ios::binary);
    ASSERT_TRUE(at) << file;
    const auto place = static_cast<std::streamoff>(std::min<std::uintmax_t>(1000, fs::file_size(file) / 2));
    at.seekg(place);
    const auto byte = static_cast<char>(at.get() ^ 4);
    at.seekp(place);
    at.put(byte);
  }
  Outcome roll_back() { return indurop({"rollback", "--health", "500ms"}); }
  // Every copy of a module on a board.
  [[nodiscard]] std::vector<fs::path> copies(const std::string& name) const {
    std::vector<fs::path> all{state(name) / "files" / steady_};
    for (const auto& entry : fs::recursive_directory_iterator(state(name) / "deployments")) {
      if (entry.path().filename() == "steady.so") {
        all.push_back(entry.path());
      }
    }
    return all;
  }
  void flip_copies(const std::string& name) {
    const auto all = copies(name);
    ASSERT_EQ(all.size(), 2U);
    std::for_each(all.begin(), all.end(), flip);
  }
  [[nodiscard]] bool is_sound(const std::string& name) const {
    const auto all = copies(name);
    return std::all_of(all.begin(), all.end(), [this](const fs::path& file) {
      const auto found = keys::digest_of_file(file);
      return found && found->digest == steady_;
    });
  }
  void power_off(const std::string& name) {
    stop_agent(name, SIGKILL);
    kill_node(board(name));
    EXPECT_TRUE(wait_until([&] { return vars::running_node(board(name)) == 0; }));
  }
  std::string v1_;
  std::string v2_;
  std::string steady_;  // its SHA-256
};

TEST_F(Damaged, A_deployment_brings_what_is_damaged_again) {
  start_both();
  const std::string id = deployed(v1_);
  flip_copies("a");
  EXPECT_EQ(deployed(v1_), id);
  EXPECT_TRUE(is_sound("a"));
  EXPECT_TRUE(runs("a", id));
}

TEST_F(Damaged, A_board_that_resumes_takes_it_from_its_other_copy_or_from_another_board) {
  start_both();
  const std::string id = deployed(v1_);
  power_off("a");
  flip(copies("a")[1]);
  start_agent("a");
  EXPECT_TRUE(wait_until([&] { return runs("a", id); }));
  EXPECT_TRUE(is_sound("a"));
  power_off("a");
  flip_copies("a");
  start_agent("a");
  EXPECT_TRUE(wait_until([&] { return runs("a", id); }));
  EXPECT_TRUE(is_sound("a"));
  EXPECT_EQ(indurop({"history", "--board", board("a"), "-o", "json"}).json()["deployments"].size(), 1U);
}

TEST_F(Damaged, Alone_it_does_not_run_and_says_what_is_damaged_until_another_board_comes) {
  start_both();
  const std::string id = deployed(v1_);
  power_off("a");
  power_off("b");
  flip_copies("a");
  start_agent("a");
  ASSERT_TRUE(wait_until([&] { return report("a")["state"] == "failed"; }));
  EXPECT_THAT(report("a")["message"].get<std::string>(), AllOf(HasSubstr("steady.so"), HasSubstr(steady_)));
  EXPECT_EQ(vars::running_node(board("a")), 0);
  start_agent("b");
  EXPECT_TRUE(wait_until([&] { return runs("a", id) && runs("b", id); }));
  EXPECT_TRUE(is_sound("a"));
}

TEST_F(Damaged, A_rollback_takes_it_from_another_board_or_is_refused_with_file_and_digest) {
  start_both();
  const std::string first = deployed(v1_);
  const std::string second = deployed(v2_);
  flip_copies("a");
  const Outcome back = indurop({"rollback", "--health", "500ms"});
  EXPECT_EQ(back.code, 0) << back.err;
  EXPECT_TRUE(runs("a", first) && is_sound("a"));
  EXPECT_EQ(deployed(v2_), second);
  flip_copies("a");
  flip_copies("b");
  const Outcome refused = indurop({"rollback", "--health", "500ms"});
  EXPECT_EQ(refused.code, 1);
  EXPECT_THAT(refused.err, AllOf(HasSubstr("steady.so"), HasSubstr(steady_)));
  EXPECT_TRUE(wait_until([&] { return runs("a", second) && runs("b", second); }));
}

TEST_F(Damaged, A_rollback_takes_the_list_of_files_from_a_board_that_has_it) {
  start_both();
  const std::string first = deployed(v1_);
  deployed(v2_);
  flip(state("a") / "files" / first);
  const Outcome seen = indurop_here({"verify"});
  EXPECT_EQ(seen.code, 4);
  EXPECT_THAT(seen.err, AllOf(HasSubstr(board("a") + ": the package of deployment"), HasSubstr(first)));
  const Outcome back = roll_back();
  EXPECT_EQ(back.code, 0) << back.err;
  EXPECT_TRUE(runs("a", first) && runs("b", first));
  EXPECT_EQ(indurop_here({"verify"}).code, 0);
}

TEST_F(Damaged, A_rollback_of_one_board_takes_a_file_from_its_other_copy) {
  start_agent("a");
  const std::string first = deployed(manifest("first.xml", {{"a", "steady"}}));
  deployed(manifest("second.xml", {{"a", "other"}}));
  flip(state("a") / "files" / steady_);
  const Outcome back = roll_back();
  EXPECT_EQ(back.code, 0) << back.err;
  EXPECT_TRUE(runs("a", first) && is_sound("a"));
}

TEST_F(Damaged, A_list_of_files_that_no_board_has_is_named_and_comes_with_a_deployment) {
  start_agent("a");
  const std::string alone = manifest("first.xml", {{"a", "steady"}});
  const std::string first = deployed(alone);
  const std::string second = deployed(manifest("second.xml", {{"a", "other"}}));
  flip(state("a") / "files" / first);
  for (int i = 0; i < 2; ++i) {  // once it is damaged, then it is missing
    SCOPED_TRACE(i);
    const Outcome refused = roll_back();
    EXPECT_EQ(refused.code, 1);
    EXPECT_THAT(refused.err, AllOf(HasSubstr(first), HasSubstr("deploy its files again (indurop deploy)")));
    EXPECT_EQ(indurop_here({"verify"}).code, 4);
    EXPECT_TRUE(runs("a", second));
  }
  stop_agent("a", SIGTERM);  // what it needs without the list stays on the disk
  start_agent("a");
  EXPECT_TRUE(wait_until([&] { return runs("a", second); }));
  EXPECT_TRUE(fs::exists(state("a") / "files" / steady_));
  EXPECT_EQ(deployed(alone), first);
  EXPECT_EQ(indurop_here({"verify"}).code, 0);
  EXPECT_EQ(roll_back().code, 0);
  EXPECT_TRUE(runs("a", second));
}

TEST_F(Damaged, Verify_names_it_and_an_agent_that_is_asked_repairs_it) {
  start_both();
  const std::string id = deployed(v1_);
  EXPECT_EQ(indurop_here({"verify"}).code, 0);
  flip(copies("a")[0]);
  const Outcome here = indurop_here({"verify"});
  EXPECT_EQ(here.code, 4);
  EXPECT_THAT(here.err, AllOf(HasSubstr(board("a") + ": steady.so"), HasSubstr(steady_)));
  const Outcome plant = indurop({"verify", "--plant", "-o", "json"});
  EXPECT_EQ(plant.code, 4) << plant.err;
  EXPECT_THAT(plant.err, AllOf(HasSubstr(board("a") + ": steady.so"), HasSubstr(steady_)));
  ASSERT_EQ(plant.json()["boards"].size(), 2U);
  EXPECT_TRUE(is_sound("a"));
  EXPECT_EQ(indurop({"verify", "--plant"}).code, 0);
  flip_copies("a");
  EXPECT_EQ(indurop({"verify", "--board", board("a")}).code, 4);
  EXPECT_TRUE(wait_until([&] { return is_sound("a"); })) << "from board b";
  EXPECT_TRUE(wait_until([&] { return runs("a", id); }));
}

TEST_F(Damaged, What_is_committed_is_not_believed_and_comes_from_another_board) {
  start_both();
  const std::string id = deployed(v1_);
  const fs::path file = state("a") / "committed.json";
  power_off("a");
  std::fstream at(file, std::ios::in | std::ios::out);
  std::string text((std::istreambuf_iterator<char>(at)), {});
  text[text.find(id) + 1] ^= 1;
  at.close();
  std::ofstream(file) << text;
  start_agent("a");
  EXPECT_TRUE(wait_until([&] { return agent("a").err().find("committed.json is damaged") != std::string::npos; }));
  EXPECT_TRUE(wait_until([&] { return runs("a", id); }));
}

TEST_F(Damaged, A_module_is_not_started_again_from_a_damaged_file) {
  start_agent("a");
  deployed(manifest("alone.xml", {{"a", "steady"}}));
  flip_copies("a");
  EXPECT_EQ(indurop({"stop", "steady@" + board("a")}).code, 0);
  const Outcome refused = indurop({"start", "steady@" + board("a")});
  EXPECT_EQ(refused.code, 1);
  EXPECT_THAT(refused.err, HasSubstr("its files are not what was deployed"));
}

TEST_F(Damaged, A_process_that_died_is_not_started_again_from_a_damaged_file) {
  fs::copy_file(std::string(MODULE_FOLDER) + "/waits", folder() / "waits");
  start_agent("a");
  const std::string id =
      deployed(manifest("alone.xml", {{"a", "steady"}},
                        "<module><filename>./waits</filename><moduletype>process</moduletype>"
                        "<operationtype>non-real</operationtype><restart delay=\"10ms\" max=\"2\"/></module>"));
  const auto process = [&] {
    const Json all = indurop_here({"status", "--node", board("a"), "-o", "json"}).json();
    return all.is_object() && all["modules"].size() == 2 ? all["modules"][1] : Json();
  };
  ASSERT_TRUE(wait_until([&] { return process()["state"] == "running"; }));
  const Json first = process();
  const fs::path file = state("a") / "deployments" / id.substr(0, 16) / "waits";
  // A program that runs cannot be written to: the disk changes it all the same.
  fs::copy_file(file, folder() / "changed");
  flip(folder() / "changed");
  fs::rename(folder() / "changed", file);
  ASSERT_EQ(::kill(first["pid"].get<pid_t>(), SIGKILL), 0);
  EXPECT_TRUE(wait_until([&] { return agent("a").err().find("is not what was deployed") != std::string::npos; }));
  EXPECT_NE(process()["state"], "running");
}

}  // namespace
}  // namespace indurop::test
