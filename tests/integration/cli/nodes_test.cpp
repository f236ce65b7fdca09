// SPDX-License-Identifier: Apache-2.0
// Which node is meant, status, and files that are no node.
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <thread>

#include "fixture.h"

namespace indurop::test {
namespace {

TEST_F(WithNode, Status_shows_node_rights_and_modules) {
  const auto sut = indurop({"status"});
  EXPECT_EQ(sut.code, 0) << sut.err;
  EXPECT_THAT(sut.out, StartsWith("local  running  pid "));
  EXPECT_THAT(sut.out, HasSubstr("basic period 1 ms, macro period 2 ms"));
  EXPECT_THAT(sut.out, HasSubstr("no FIFO"));
  EXPECT_THAT(sut.out, HasSubstr("SCHED_FIFO refused"));
  EXPECT_THAT(sut.out, ContainsRegex("output +process +2 ms +2 +running"));
  EXPECT_THAT(sut.out, HasSubstr("SIGSEGV at address 0x0 (tick 42)"));
}

TEST_F(WithNode, Status_as_json_has_ns_and_stable_names) {
  const auto json = indurop({"status", "-o", "json"}).json();
  EXPECT_EQ(json["schema_version"], 1);
  EXPECT_EQ(json["running"], true);
  EXPECT_EQ(json["basic_period_ns"], 1'000'000);
  EXPECT_EQ(json["rt"]["fifo"], false);
  ASSERT_EQ(json["modules"].size(), 3U);
  EXPECT_EQ(json["modules"][0]["name"], "modify");
  EXPECT_GT(json["modules"][0]["runs"], 0);
  EXPECT_EQ(json["modules"][0]["last_exec_ns"], 20'000);
  EXPECT_EQ(json["modules"][1]["restarts"], 1);
}

TEST_F(WithNode, Status_of_a_killed_node_shows_its_last_figures) {
  kill_node();
  const auto sut = indurop({"status"});
  EXPECT_EQ(sut.code, 6);
  EXPECT_THAT(sut.out, StartsWith("local  killed"));
  EXPECT_THAT(sut.out, HasSubstr("modify"));
  EXPECT_EQ(indurop({"nodes", "--all", "-o", "json"}).json()["nodes"][0]["state"], "killed");
}

TEST_F(WithNode, Status_repeats_as_often_as_asked) {
  const auto sut = indurop({"status", "-w", "-n", "3", "--interval", "20ms", "-o", "json"});
  EXPECT_EQ(sut.code, 0);
  EXPECT_EQ(std::count(sut.out.begin(), sut.out.end(), '\n'), 3);
}

TEST_F(CommandLine, The_only_node_is_taken_whatever_its_name) {
  Program node(fake_node("press_2"), background());
  ASSERT_TRUE(node.prints("ready"));
  EXPECT_EQ(indurop({"get", "gain"}).out, "1\n");
  EXPECT_EQ(indurop({"nodes", "--names"}).out, "press_2\n");
}

TEST_F(CommandLine, Of_several_nodes_one_must_be_named) {
  Program first(fake_node("press_1"), background());
  Program second(fake_node("press_2"), background());
  ASSERT_TRUE(first.prints("ready") && second.prints("ready"));
  const auto which = indurop({"status"});
  EXPECT_EQ(which.code, 2);
  EXPECT_THAT(which.err, HasSubstr("press_1, press_2"));
  EXPECT_EQ(indurop({"set", "gain", "7", "--node", "press_2"}).code, 0);
  EXPECT_EQ(indurop({"get", "gain"}, {.variables = {"INDUROP_NODE=press_2"}}).out, "7\n");
  EXPECT_EQ(indurop({"--node", "press_1", "get", "gain"}).out, "1\n");
  const auto wrong = indurop({"status", "--node", "pres_1"});
  EXPECT_EQ(wrong.code, 6);
  EXPECT_THAT(wrong.err, HasSubstr("Did you mean 'press_1'?"));
  Program local(fake_node("local"), background());
  ASSERT_TRUE(local.prints("ready"));
  EXPECT_EQ(indurop({"status", "-o", "json"}).json()["node"], "local");
}

TEST_F(CommandLine, Ended_nodes_are_listed_apart_and_do_not_count) {
  Program ended(fake_node("local"), background());
  ASSERT_TRUE(ended.prints("ready"));
  ended.signal(SIGKILL);
  ASSERT_EQ(ended.wait(), 128 + SIGKILL);
  Program node(fake_node("press_1"), background());
  ASSERT_TRUE(node.prints("ready"));
  EXPECT_EQ(indurop({"status", "-o", "json"}).json()["node"], "press_1");
  const auto listed = indurop({"nodes"});
  EXPECT_THAT(listed.out, HasSubstr("press_1"));
  EXPECT_THAT(listed.out, Not(HasSubstr("local")));
  EXPECT_THAT(listed.err, HasSubstr("ended, but left values behind: local"));
  EXPECT_EQ(indurop({"nodes", "--all", "-o", "json"}).json()["nodes"][1]["node"], "local");
}

TEST_F(CommandLine, Programs_that_no_node_started_have_nothing_to_do_with_one_that_ended) {
  const auto alone = [](const std::string& node) {
    Environment environment;
    if (!node.empty()) {
      environment.variables.push_back("INDUROP_NODE=" + node);
    }
    return Program({LONER_PROGRAM}, environment).finish();
  };
  Program node(fake_node("local"), background());
  ASSERT_TRUE(node.prints("ready")) << node.out();
  const Outcome local = alone("");
  EXPECT_EQ(local.out, "2.5\n");
  EXPECT_THAT(local.err, HasSubstr("node 'local' does not have it"));
  node.signal(SIGKILL);
  ASSERT_EQ(node.wait(), 128 + SIGKILL);
  const Outcome after = alone("");
  EXPECT_EQ(after.out, "2.5\n");
  EXPECT_THAT(after.err, IsEmpty());
  EXPECT_THAT(alone("local").err, HasSubstr("node 'local' does not have it")) << "it was asked for";
}

TEST_F(CommandLine, A_node_that_is_just_starting_is_waited_for) {
  Outcome sut;
  // On a machine that is busy a node may need longer to start than verbs wait.
  for (int attempt = 0; attempt < 5 && sut.code != 0; ++attempt) {
    Program node(indurop_command({"run", std::string(PLC_EXAMPLE) + "/module.xml", "-q"}), background());
    sut = indurop({"vars"});
    EXPECT_TRUE(sut.code != 0 || indurop({"status"}).code == 0);
    node.signal(SIGTERM);
    EXPECT_NE(node.wait(), -1);
  }
  EXPECT_EQ(sut.code, 0) << sut.err;
}

TEST_F(CommandLine, A_module_that_is_stopped_is_something_wrong) {
  const std::string config = std::string(PLC_EXAMPLE) + "/module.xml";
  ASSERT_EQ(indurop({"run", config, "--detach", "--duration", "60s"}).code, 0);
  const auto well = indurop({"status", "--check"});
  EXPECT_EQ(well.code, 0) << well.out;
  EXPECT_THAT(well.out, Not(HasSubstr("wrong")));
  ASSERT_EQ(indurop({"stop", "conveyor"}).code, 0);
  const auto wrong = indurop({"status", "--check"});
  EXPECT_EQ(wrong.code, 4);
  EXPECT_THAT(wrong.out, HasSubstr("wrong     module conveyor is stopped"));
  const auto shown = indurop({"status", "-o", "json"});
  EXPECT_EQ(shown.code, 0);
  EXPECT_EQ(shown.json()["trouble"], (nlohmann::json{"module conveyor is stopped"}));
  ASSERT_EQ(indurop({"start", "conveyor"}).code, 0);
  EXPECT_EQ(indurop({"status", "--check"}).code, 0);
  ASSERT_EQ(indurop({"stop"}).code, 0);
  EXPECT_EQ(indurop({"status", "--check"}).code, 6);
}

TEST_F(WithNode, Alarms_that_no_process_evaluates_are_something_wrong) {
  const auto unwatched = indurop({"status", "--check"});
  EXPECT_EQ(unwatched.code, 4);
  EXPECT_THAT(unwatched.out, HasSubstr("wrong     no process is evaluating the declared alarms: run indurop-agent"));
  Program watching(indurop_command({"alarms", "watch"}), background());
  ASSERT_TRUE(watching.prints("Ctrl-C")) << watching.out();
  EXPECT_THAT(indurop({"status"}).out, Not(HasSubstr("no process is evaluating")));
  watching.signal(SIGINT);
  EXPECT_EQ(watching.wait(), 130);
}

TEST_F(CommandLine, Nodes_of_one_host_take_different_cores) {
  const std::string config = std::string(PLC_EXAMPLE) + "/module.xml";
  for (const char* name : {"left", "right"}) {
    ASSERT_EQ(indurop({"run", config, "--detach", "--duration", "60s", "--node", name}).code, 0);
  }
  const auto left = indurop({"status", "--node", "left", "-o", "json"}).json()["rt"];
  const auto right = indurop({"status", "--node", "right", "-o", "json"}).json()["rt"];
  EXPECT_EQ(indurop({"run", config, "--detach", "--duration", "60s", "--node", "third", "--core", "0"}).code, 0);
  const auto third = indurop({"status", "--node", "third"});
  for (const char* name : {"left", "right", "third"}) {
    EXPECT_EQ(indurop({"stop", "--node", name}).code, 0);
  }
  // What it left under its own name does not drive it away.
  EXPECT_EQ(indurop({"run", config, "--detach", "--duration", "60s", "--node", "left"}).code, 0);
  EXPECT_EQ(indurop({"status", "--node", "left", "-o", "json"}).json()["rt"]["core"], left["core"]);
  EXPECT_EQ(indurop({"stop", "--node", "left"}).code, 0);
  if (!left["pinned"].get<bool>() || std::thread::hardware_concurrency() != 2) {
    GTEST_SKIP() << "needs real-time privileges and two cores";
  }
  EXPECT_NE(left["core"], right["core"]);
  EXPECT_THAT(third.out, HasSubstr("shares core 0 with"));
}

TEST_F(CommandLine, Nodes_that_start_at_once_share_the_cores_evenly) {
  const std::string config = std::string(PLC_EXAMPLE) + "/module.xml";
  for (int round = 0; round < 5; ++round) {
    std::vector<std::unique_ptr<Program>> nodes;
    for (const char* name : {"a", "b", "c", "d"}) {
      nodes.push_back(std::make_unique<Program>(indurop_command({"run", config, "-q", "--node", name}), background()));
    }
    std::map<int, int> on_core;
    bool pinned = true;
    for (const char* name : {"a", "b", "c", "d"}) {
      ASSERT_TRUE(wait_until([&] {
        return indurop({"status", "--node", name, "-o", "json"}).json()["state"] == "running";
      }));
      const auto rt = indurop({"status", "--node", name, "-o", "json"}).json()["rt"];
      pinned = pinned && rt["pinned"].get<bool>();
      ++on_core[rt["core"].get<int>()];
    }
    for (const auto& node : nodes) {
      node->signal(SIGTERM);
      EXPECT_EQ(node->wait(), 0) << node->out();
    }
    if (!pinned || std::thread::hardware_concurrency() != 2) {
      GTEST_SKIP() << "needs real-time privileges and two cores";
    }
    EXPECT_EQ(on_core[0], 2) << "round " << round;
    EXPECT_EQ(on_core[1], 2) << "round " << round;
  }
}

TEST_F(CommandLine, Nodes_of_another_user_do_not_block_the_default_name) {
  constexpr uid_t kUnprivileged = 65534;
  if (geteuid() != 0) {
    GTEST_SKIP() << "needs root to become another user";
  }
  Program other(fake_node("local"), background());
  ASSERT_TRUE(other.prints("ready"));
  const auto folder = scratch() / "unprivileged";
  std::filesystem::create_directories(folder);
  ASSERT_EQ(chown(folder.c_str(), kUnprivileged, kUnprivileged), 0);
  const Environment unprivileged{.variables = {"INDUROP_STATE_DIR=" + folder.string()}, .user = kUnprivileged};
  const auto sut = indurop({"run", std::string(PLC_EXAMPLE) + "/module.xml", "--duration", "0.2s"}, unprivileged);
  EXPECT_EQ(sut.code, 0) << sut.err;
  EXPECT_THAT(sut.err, HasSubstr("the name 'local' is in use by user root: this node is 'local_65534'"));
  const auto cleaned = indurop({"clean", "--all"}, unprivileged);
  EXPECT_EQ(cleaned.code, 0) << cleaned.err;
  EXPECT_THAT(cleaned.out, HasSubstr("'local_65534'"));
  EXPECT_THAT(cleaned.err, HasSubstr("node 'local' is user root's: left alone"));
}

TEST_F(CommandLine, Garbage_in_shared_memory_is_an_error_and_never_a_crash) {
  std::mt19937_64 random(11);
  for (const std::size_t size : {0UL, 1UL, 100UL, 4096UL, 100'000UL}) {
    std::string bytes(size, '\0');
    for (char& c : bytes) {
      c = static_cast<char>(random());
    }
    put("/dev/shm/indurop.junk", bytes);
    put("/dev/shm/indurop.junk.run", bytes);
    for (const auto& words : std::vector<std::vector<std::string>>{
             {"status"}, {"vars"}, {"get", "x"}, {"watch", "--once", "*"}, {"jitter"}, {"log"}}) {
      const auto sut = indurop(words);
      EXPECT_TRUE(sut.code == 1 || sut.code == 6) << words[0] << " " << size << " code " << sut.code;
      EXPECT_THAT(sut.err, HasSubstr("junk")) << words[0] << " " << size;
    }
    EXPECT_EQ(indurop({"nodes"}).code, 0);
  }
  EXPECT_EQ(indurop({"clean"}).code, 0);
  EXPECT_FALSE(std::filesystem::exists("/dev/shm/indurop.junk"));
  EXPECT_FALSE(std::filesystem::exists("/dev/shm/indurop.junk.run"));
}

TEST_F(WithNode, Damage_anywhere_in_the_run_block_never_crashes_a_reader) {
  kill_node();
  const int file = open("/dev/shm/indurop.local.run", O_RDWR | O_CLOEXEC);
  ASSERT_GE(file, 0);
  std::mt19937_64 random(5);
  for (int round = 0; round < 40; ++round) {
    for (int i = 0; i < 8; ++i) {
      const std::uint64_t value = random();
      ASSERT_EQ(pwrite(file, &value, sizeof value, static_cast<off_t>(8 + random() % 4096)), 8);
    }
    for (const char* verb : {"status", "jitter"}) {
      const auto sut = indurop({verb, "-o", "json"});
      EXPECT_TRUE(sut.code == 0 || sut.code == 1 || sut.code == 6 || sut.code == 8) << verb << " " << sut.code;
    }
  }
  close(file);
}

TEST_F(WithNode, One_that_does_nothing_any_more_is_hung) {
  node_->signal(SIGSTOP);
  EXPECT_TRUE(wait_until([] { return indurop({"nodes", "-o", "json"}).json()["nodes"][0]["state"] == "hung"; }));
  EXPECT_THAT(indurop({"status"}).out, StartsWith("local  hung  pid "));
  node_->signal(SIGCONT);
  EXPECT_TRUE(wait_until([] { return indurop({"nodes", "-o", "json"}).json()["nodes"][0]["state"] == "running"; }));
}

TEST_F(CommandLine, Nodes_of_strangers_are_left_out_unless_asked_for) {
  if (geteuid() != 0) {
    GTEST_SKIP() << "needs root to become another user";
  }
  Program node(fake_node("theirs"), {.variables = background().variables, .user = 65534, .one_output = true});
  if (!node.prints("ready")) {
    GTEST_SKIP() << "the build directory is closed to others";
  }
  const auto listed = indurop({"nodes"});
  EXPECT_THAT(listed.out, Not(HasSubstr("theirs")));
  EXPECT_THAT(listed.err, HasSubstr("1 of other users, left out: shown by --all"));
  const auto all = indurop({"nodes", "--all", "-o", "json"}).json()["nodes"];
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0]["node"], "theirs");
  EXPECT_EQ(all[0]["owner"], "nobody");
  EXPECT_EQ(indurop({"get", "gain", "--node", "theirs"}).out, "1\n");
  EXPECT_THAT(indurop({"nodes"}, {.user = 65534}).out, HasSubstr("theirs"));
}

TEST_F(WithNode, A_store_of_another_version_is_reported_with_its_format) {
  kill_node();
  const int file = open("/dev/shm/indurop.local", O_RDWR | O_CLOEXEC);
  const std::uint32_t other = 3;
  ASSERT_EQ(pwrite(file, &other, sizeof other, 8), 4);
  close(file);
  const auto sut = indurop({"get", "gain"});
  EXPECT_EQ(sut.code, 8);
  EXPECT_THAT(sut.err, HasSubstr("format of its store 3, here "));
}

TEST_F(WithNode, Memory_closed_to_others_is_explained) {
  if (geteuid() != 0) {
    GTEST_SKIP() << "needs root to become another user";
  }
  ASSERT_EQ(chmod("/dev/shm/indurop.local", 0600), 0);
  const auto sut = indurop({"get", "gain"}, {.user = 65534});
  if (sut.code == 127) {
    GTEST_SKIP() << "the build directory is closed to others";
  }
  EXPECT_EQ(sut.code, 1);
  EXPECT_THAT(sut.err, HasSubstr("no permission to"));
}

}  // namespace
}  // namespace indurop::test
