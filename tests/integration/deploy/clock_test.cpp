// SPDX-License-Identifier: Apache-2.0
// Clocks that are an hour off, or begin in 1970, of a board and of a deployer: nothing waits for them, and they are
// reported.

#include <cstdlib>
#include <ctime>
#include <fstream>

#include "agents_fixture.h"

namespace indurop::test {
namespace {

using testing::HasSubstr;

constexpr std::int64_t kHour = 3600;

class Clock : public AgentsTest {
 protected:
  void SetUp() override {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "the library that moves the clock cannot be loaded before that of the sanitizer";
#endif
    v1_ = manifest("v1.xml", {{"a", "steady"}, {"b", "steady"}});
    v2_ = manifest("v2.xml", {{"a", "other"}, {"b", "steady"}});
  }
  // For programs started while it lives.
  class Moved {
   public:
    explicit Moved(std::int64_t seconds) {
      ::setenv("LD_PRELOAD", MOVED_CLOCK, 1);
      ::setenv("IRP_TEST_CLOCK_S", std::to_string(seconds).c_str(), 1);
    }
    Moved(const Moved&) = delete;
    Moved& operator=(const Moved&) = delete;
    ~Moved() {
      ::unsetenv("LD_PRELOAD");
      ::unsetenv("IRP_TEST_CLOCK_S");
    }
  };
  static bool about(const Json& ns, std::int64_t seconds) {
    return ns.is_number() && std::llabs(ns.get<std::int64_t>() / 1'000'000'000 - seconds) < 60;
  }
  std::string v1_;
  std::string v2_;
};

TEST_F(Clock, Of_a_board_is_an_hour_ahead) {
  start_agent("a");
  {
    const Moved moved(kHour);
    start_agent("b");
  }
  const Outcome done = deploy(v1_);
  ASSERT_EQ(done.code, 0) << done.err;
  const std::string id = done.json()["deployment"];
  EXPECT_TRUE(runs("a", id) && runs("b", id));
  const Json seen = report("b");
  EXPECT_TRUE(about(seen["clock_offset_ns"], kHour)) << seen;
  EXPECT_THAT(seen["message"].get<std::string>(),
              HasSubstr("s from the deployer's; it switches on the deployer's order"));
  EXPECT_EQ(report("a")["message"], "");
  // The nodes hear each other and know it too.
  EXPECT_TRUE(wait_until([&] {
    const Json all = indurop_here({"status", "--node", board("a"), "-o", "json"}).json();
    const Json peer = all.is_object() && all["mirror"].is_object() ? all["mirror"]["boards"][0] : Json{};
    return peer.is_object() && peer["state"] == "alive" && about(peer["clock_offset_ns"], -kHour);
  }));
  // The clock is put right while the board is off: what was committed counts.
  stop_agent("b", SIGKILL);
  kill_node(board("b"));
  start_agent("b");
  EXPECT_TRUE(wait_until([&] { return runs("b", id); }));
}

// As that of a board without a battery: its certificates must be valid then, too.
TEST_F(Clock, Of_a_board_begins_in_1970) {
  constexpr std::int64_t kBootSeconds = 20;
  const std::int64_t back = static_cast<std::int64_t>(std::time(nullptr)) - kBootSeconds;
  for (const bool with_keys : {false, true}) {
    SCOPED_TRACE(with_keys);
    if (with_keys) {
      for (const char* const name : {"a", "b"}) {
        stop_agent(name, SIGKILL);
        kill_node(board(name));
      }
      bring_keys(v1_, {"a", "b"});
      speak_with_keys(path("keys"));
    }
    start_agent("a");
    {
      const Moved moved(-back);
      start_agent("b");
    }
    const Outcome done = deploy(with_keys ? v2_ : v1_);
    ASSERT_EQ(done.code, 0) << done.err << agent("b").err();
    const std::string id = done.json()["deployment"];
    EXPECT_TRUE(runs("a", id) && runs("b", id));
    EXPECT_TRUE(about(report("b")["clock_offset_ns"], -back)) << report("b");
    EXPECT_TRUE(wait_until([&] {
      const Json all = indurop_here({"status", "--node", board("a"), "-o", "json"}).json();
      const Json peer = all.is_object() && all["mirror"].is_object() ? all["mirror"]["boards"][0] : Json{};
      return peer.is_object() && peer["state"] == "alive";
    }));
  }
}

TEST_F(Clock, Set_back_while_an_agent_runs_makes_no_board_lose_another) {
  const std::filesystem::path clock = folder() / "clock";
  const auto put = [&](std::int64_t seconds) {
    std::fstream file(clock, std::ios::in | std::ios::out | std::ios::binary);
    file.write(reinterpret_cast<const char*>(&seconds), sizeof seconds);
  };
  std::ofstream(clock, std::ios::binary) << std::string(sizeof(std::int64_t), '\0');
  start_agent("b");
  {
    const Moved moved(0);
    ::setenv("IRP_TEST_CLOCK_FILE", clock.c_str(), 1);
    start_agent("a");
    ::unsetenv("IRP_TEST_CLOCK_FILE");
  }
  const Outcome done = deploy(v1_);
  ASSERT_EQ(done.code, 0) << done.err;
  const std::string id = done.json()["deployment"];
  for (std::int64_t back = kHour; back <= 3 * kHour; back += kHour) {
    put(-back);
    // Each is a newcomer that has to find the agent, and the other board's node has to go on hearing that board's.
    for (int i = 0; i < 3; ++i) {
      EXPECT_TRUE(runs("a", id) && runs("b", id)) << back << ' ' << i;
    }
    const Json all = indurop_here({"status", "--node", board("b"), "-o", "json"}).json();
    EXPECT_EQ(all["mirror"]["boards"][0]["state"], "alive") << back;
  }
  EXPECT_EQ(deploy(v2_).code, 0);
}

TEST_F(Clock, Of_deployers_jumps_back_and_forth) {
  start_agent("a");
  start_agent("b");
  std::uint64_t generation = 0;
  for (const std::int64_t seconds : {kHour, std::int64_t{0}, -kHour}) {
    SCOPED_TRACE(seconds);
    const bool odd = seconds == 0;
    const Moved moved(seconds);
    const Outcome done = deploy(odd ? v2_ : v1_);
    ASSERT_EQ(done.code, 0) << done.err;
    EXPECT_TRUE(runs("a", done.json()["deployment"]) && runs("b", done.json()["deployment"]));
    EXPECT_GT(done.json()["generation"].get<std::uint64_t>(), generation) << "the later deployment is the newer one";
    generation = done.json()["generation"].get<std::uint64_t>();
  }
}

}  // namespace
}  // namespace indurop::test
