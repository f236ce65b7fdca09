// SPDX-License-Identifier: Apache-2.0
// indurop-iceoryx with a real RouDi and the programs of examples/iceoryx. RouDi is one per machine because of fixed
// names in /tmp and /dev/shm: each test process has these two folders for itself, and what killed programs leave goes
// with them.

#include <fcntl.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <random>
#include <sstream>

#include "core/schema/elf.h"
#include "node_fixture.h"
#include "store/vars/store.h"

namespace indurop::test {
namespace {

struct Reading {
  std::uint64_t count;
  double litres;
  std::int32_t backwards;
  std::uint8_t odd;
};

bool right(const Reading& r) {
  return r.count > 0 && r.litres == 0.5 * static_cast<double>(r.count) &&
         r.backwards == -static_cast<std::int32_t>(r.count) && r.odd == r.count % 2;
}

// Gives this process a /tmp of its own, with the folder of /tmp that holds the build, if one does.
bool mount_own_tmp() {
  const std::string_view program = GATEWAY;
  const std::string top(program.starts_with("/tmp/") ? program.substr(0, program.find('/', 5)) : "");
  const int build = top.empty() ? -1 : ::open(top.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC);
  if (::mount("tmpfs", "/tmp", "tmpfs", 0, "mode=1777") != 0) {
    return false;
  }
  if (top.empty()) {
    return true;
  }
  const std::string covered = "/proc/self/fd/" + std::to_string(build);
  const bool seen = build >= 0 && ::mkdir(top.c_str(), 0755) == 0 &&
                    ::mount(covered.c_str(), top.c_str(), nullptr, MS_BIND | MS_REC, nullptr) == 0;
  ::close(build);
  return seen;
}

std::string why_not_here() {
  if (!std::string_view(ROUDI).starts_with('/') || ::access(ROUDI, X_OK) != 0) {
    return "iox-roudi is missing (package iceoryx)";
  }
  if (!own_mounts() || ::mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0 || !mount_own_tmp() ||
      ::mount("tmpfs", "/dev/shm", "tmpfs", 0, "mode=1777,size=256m") != 0) {
    return "a private /tmp and /dev/shm cannot be made here (root or user namespaces are needed)";
  }
  return {};
}

class Gateway : public NodeTest {
 protected:
  static void SetUpTestSuite() { obstacle() = why_not_here(); }
  void SetUp() override {
    if (!obstacle().empty()) {
      GTEST_SKIP() << obstacle();
    }
  }

  Program& start_meter() {
    Program& program = start({{.file = EXAMPLE_FOLDER "/meter.so", .name = "meter"}}, {"--node", node()});
    EXPECT_TRUE(wait_until_running(program)) << program.err();
    EXPECT_TRUE(runs_reach("meter", 1));
    return program;
  }
  Program& begin(const std::vector<std::string>& command) {
    programs_.push_back(std::make_unique<Program>(command, environment()));
    return *programs_.back();
  }
  // `size`: the largest value it has memory for.
  Program& start_roudi(int size = 128) {
    Program& program = begin({ROUDI, "-c",
                              write("roudi.toml", "[general]\nversion = 1\n[[segment]]\n[[segment.mempool]]\nsize = " +
                                                      std::to_string(size) + "\ncount = 1000\n")});
    EXPECT_TRUE(program.prints("RouDi is ready for clients")) << program.err();
    return program;
  }
  Program& start_gateway(const std::vector<std::string>& more = {}) {
    std::vector<std::string> command = {GATEWAY, "--node", node()};
    command.insert(command.end(), more.begin(), more.end());
    return begin(command);
  }
  Program& start_watch(const std::string& name) { return begin({EXAMPLE_FOLDER "/" + name, node()}); }

  // How many readings it has printed; each of them has to be right.
  static int readings(Program& program) {
    std::istringstream all(program.out());
    int seen = 0;
    for (std::string line; std::getline(all, line);) {
      std::istringstream in(line);
      std::string word;
      Reading reading{};
      int odd = -1;
      if (in >> word >> reading.count >> word >> reading.litres >> word >> reading.backwards >> word >> odd) {
        reading.odd = static_cast<std::uint8_t>(odd);
        EXPECT_TRUE(right(reading)) << line;
        ++seen;
      }
    }
    return seen;
  }
  static bool reads(Program& program, int more = 3, std::chrono::milliseconds patience = kPatience) {
    const int before = readings(program);
    return wait_until([&] { return readings(program) >= before + more; }, patience);
  }
  // The process in which the gateway calls iceoryx; 0 if there is none at the moment.
  static pid_t worker_of(const Program& gateway) {
    const std::string pid = std::to_string(gateway.pid());
    std::ifstream children("/proc/" + pid + "/task/" + pid + "/children");
    pid_t worker = 0;
    children >> worker;
    return worker;
  }
  void expect_undisturbed(Program& node_program) {
    EXPECT_TRUE(runs_reach("meter", module("meter").runs.load() + 20));
    EXPECT_TRUE(node_program.running());
    EXPECT_EQ(run()->state.load(), scheduler::NodeState::Running);
    EXPECT_EQ(module("meter").faults.load(), 0U);
    EXPECT_TRUE(right(value<Reading>("meter::reading")));
  }

 private:
  static std::string& obstacle() {
    static std::string text;
    return text;
  }
};

TEST_F(Gateway, Subscribers_in_both_languages_get_what_the_module_writes) {
  start_meter();
  start_roudi();
  Program& sut = start_gateway();
  Program& cpp = start_watch("watch_iceoryx");
  Program& c = start_watch("watch_iceoryx_c");
  EXPECT_TRUE(reads(cpp, 20)) << sut.err();
  EXPECT_TRUE(reads(c, 20)) << sut.err();
  sut.signal(SIGTERM);
  EXPECT_EQ(sut.wait(), 128 + SIGTERM);
  EXPECT_CONTAINS(sut.err(), "publishes 1 variable of node '" + node() + "'");
}

TEST_F(Gateway, Waits_for_RouDi_and_for_its_return) {
  Program& meter = start_meter();
  Program& sut = start_gateway({"--hz", "50", "meter::*"});
  EXPECT_TRUE(sut.says("RouDi does not run on this machine; waiting for it. Start it: iox-roudi"));
  for (int life = 0; life < 2; ++life) {
    Program& roudi = start_roudi();
    Program& watch = start_watch("watch_iceoryx_c");
    EXPECT_TRUE(reads(watch)) << sut.err();
    roudi.kill();
    watch.kill();
    EXPECT_TRUE(sut.says("RouDi has ended"));
  }
  expect_undisturbed(meter);
}

TEST_F(Gateway, Follows_a_node_that_comes_back) {
  Program& first = start_meter();
  start_roudi();
  Program& sut = start_gateway();
  Program& watch = start_watch("watch_iceoryx");
  EXPECT_TRUE(reads(watch)) << sut.err();
  first.kill();
  start_meter();
  EXPECT_TRUE(reads(watch, 20)) << sut.err();
}

TEST_F(Gateway, Late_subscriber_gets_a_value_that_does_not_change_any_more) {
  Program& meter = start_meter();
  start_roudi();
  Program& sut = start_gateway();
  Program& early = start_watch("watch_iceoryx");
  EXPECT_TRUE(reads(early)) << sut.err();
  meter.signal(SIGTERM);
  EXPECT_EQ(meter.wait(), 0);
  EXPECT_TRUE(reads(start_watch("watch_iceoryx_c"), 1)) << sut.err();
}

TEST_F(Gateway, What_cannot_be_published_is_refused) {
  start_meter();
  Program& part = start_gateway({"meter::reading.count"});
  EXPECT_EQ(part.wait(), 2);
  EXPECT_CONTAINS(part.err(), "meter::reading.count is a part; variables are published whole: meter::reading");
  Program& unknown = start_gateway({"pump::*"});
  EXPECT_EQ(unknown.wait(), 1);
  EXPECT_CONTAINS(unknown.err(), "no variable of node '" + node() + "' matches 'pump::*'");
  Program& rate = start_gateway({"--hz", "0"});
  EXPECT_EQ(rate.wait(), 2);
}

TEST_F(Gateway, Too_many_variables_and_too_long_names_are_refused) {
  const auto file = schema::read_module_file(EXAMPLE_FOLDER "/meter.so");
  ASSERT_TRUE(file.ok());
  schema::Schema many = schema::from_json(file.value().schema_json).value();
  const schema::Variable pattern = many.variables.front();
  for (int i = 0; i < 600; ++i) {
    many.variables.push_back(pattern);
    many.variables.back().name = "meter::more" + std::to_string(i);
  }
  many.variables.back().name = "meter::" + std::string(100, 'x');
  const auto store = vars::Store::create(node(), many);
  ASSERT_TRUE(store.ok());
  Program& sut = start_gateway();
  EXPECT_EQ(sut.wait(), 2);
  EXPECT_CONTAINS(sut.err(), "601 variables are selected, iceoryx has publishers for ");
  EXPECT_CONTAINS(sut.err(), "select fewer with a GLOB");
  EXPECT_CONTAINS(sut.err(), "has 107 letters, iceoryx allows 100");
}

TEST_F(Gateway, A_value_larger_than_the_memory_of_RouDi_ends_it_with_an_explanation) {
  Program& meter = start_meter();
  start_roudi(8);
  Program& sut = start_gateway();
  EXPECT_EQ(sut.wait(), 1);
  EXPECT_CONTAINS(sut.err(), "(meter::reading, 24 bytes) has to fit into a memory pool of RouDi");
  expect_undisturbed(meter);
}

TEST_F(Gateway, A_second_gateway_of_a_node_is_refused) {
  start_meter();
  Program& first = start_gateway();
  ASSERT_TRUE(first.says("waiting for it"));
  Program& second = start_gateway();
  EXPECT_EQ(second.wait(), 1);
  EXPECT_CONTAINS(second.err(), "another indurop-iceoryx publishes node '" + node() + "' already");
  EXPECT_TRUE(first.running());
}

// RouDi that is stopped stands for one that hangs on a lock of a killed program.
TEST_F(Gateway, A_RouDi_that_does_not_answer_is_named) {
  Program& meter = start_meter();
  Program& roudi = start_roudi();
  roudi.signal(SIGSTOP);
  Program& sut = start_gateway();
  EXPECT_TRUE(sut.says("iceoryx did not answer for 5 s"));
  expect_undisturbed(meter);
  roudi.signal(SIGCONT);
  EXPECT_TRUE(reads(start_watch("watch_iceoryx"))) << sut.err();
}

// Everything of iceoryx is killed again and again. iceoryx itself may then stand still until its daemon is restarted
// (killed programs leave locks behind); the node must not notice, and after a new start all is well.
class Storm : public Gateway {
 protected:
  struct Party {
    Program* roudi = nullptr;
    Program* gateway = nullptr;
    Program* cpp = nullptr;
    Program* c = nullptr;
  };

  void kill_one(unsigned which) {
    if (which == 4) {
      const pid_t worker = worker_of(*party_.gateway);
      if (worker > 0) {
        ::kill(worker, SIGKILL);
      }
      return;
    }
    Program* const all[] = {party_.roudi, party_.gateway, party_.cpp, party_.c};
    all[which]->kill();
  }
  void revive() {
    if (party_.roudi == nullptr || !party_.roudi->running()) {
      party_.roudi = &start_roudi();
      for (Program* watch : {party_.cpp, party_.c}) {
        if (watch != nullptr) {
          watch->kill();  // it sees the memory of the RouDi before
        }
      }
    }
    if (party_.gateway == nullptr || !party_.gateway->running()) {
      party_.gateway = &start_gateway({"--hz", "1000"});  // nearly always in the middle of something
    }
    if (party_.cpp == nullptr || !party_.cpp->running()) {
      party_.cpp = &start_watch("watch_iceoryx");
    }
    if (party_.c == nullptr || !party_.c->running()) {
      party_.c = &start_watch("watch_iceoryx_c");
    }
  }
  void kill_all() {
    for (Program* program : {party_.cpp, party_.c, party_.gateway, party_.roudi}) {
      program->kill();
    }
    party_ = {};
  }

  Party party_;
};

TEST_F(Storm, Kills_do_not_reach_the_node) {
  Program& meter = start_meter();
  constexpr int kKills = 20;
  constexpr std::uint32_t kSeed = 20;
  std::mt19937 random(kSeed);
  int heard = 0;
  for (int i = 0; i < kKills; ++i) {
    revive();
    heard += reads(*party_.cpp, 2, std::chrono::seconds(4)) && reads(*party_.c, 2, std::chrono::seconds(1)) ? 1 : 0;
    // At any moment between two values.
    ASSERT_TRUE(runs_reach("meter", module("meter").runs.load() + random() % 50));
    kill_one(static_cast<unsigned>(random() % 5));
    expect_undisturbed(meter);
  }
  EXPECT_GE(heard, kKills / 2) << "too few kills hit programs at work";
  kill_all();
  revive();
  EXPECT_TRUE(reads(*party_.cpp)) << party_.gateway->err();
  EXPECT_TRUE(reads(*party_.c)) << party_.gateway->err();
  expect_undisturbed(meter);
  meter.signal(SIGTERM);
  EXPECT_EQ(meter.wait(), 0);
}

}  // namespace
}  // namespace indurop::test
