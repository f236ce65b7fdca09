// SPDX-License-Identifier: Apache-2.0
// Request and report of an exchange, as files of the node.

#include "store/operate/reload.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "store/operate/exchange_set.h"
#include "store/operate/remote_reload.h"
#include "store/vars/retain.h"

namespace indurop::operate {
namespace {

using testing::ElementsAre;

class ReloadFiles : public testing::Test {
 protected:
  ReloadFiles() {
    std::filesystem::create_directories(folder_);
    ::setenv("INDUROP_STATE_DIR", folder_.c_str(), 1);  // NOLINT(concurrency-mt-unsafe): one thread
  }
  ~ReloadFiles() override {
    ::unsetenv("INDUROP_STATE_DIR");  // NOLINT(concurrency-mt-unsafe): one thread
    std::filesystem::remove_all(folder_);
  }
  const std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("indurop-reload-" + std::to_string(::getpid()));
};

TEST_F(ReloadFiles, A_request_comes_as_it_was_written_and_once) {
  EXPECT_FALSE(take_reload_request("n"));
  ASSERT_TRUE(write_request("n", {"/a b/\"c\".so", true, true, 5, "x > 1"}).ok());
  const auto request = take_reload_request("n");
  ASSERT_TRUE(request);
  EXPECT_EQ(request->file, "/a b/\"c\".so");
  EXPECT_TRUE(request->lossy);
  EXPECT_TRUE(request->dry_run);
  EXPECT_EQ(request->health_ns, 5);
  EXPECT_EQ(request->guard, "x > 1");
  EXPECT_FALSE(take_reload_request("n"));
}

TEST_F(ReloadFiles, A_damaged_request_is_none_and_is_removed) {
  ASSERT_TRUE(write_request("n", {}).ok());
  std::ofstream(vars::state_directory("n") / "reload.request") << "{\"file\": ";
  EXPECT_FALSE(take_reload_request("n"));
  EXPECT_FALSE(std::filesystem::exists(vars::state_directory("n") / "reload.request"));
}

TEST_F(ReloadFiles, A_report_comes_as_it_was_written) {
  EXPECT_FALSE(read_report("n"));
  ReloadReport report;
  report.module = "m";
  report.text = "exchanged";
  report.errors = {"a", "b"};
  report.plan.with_state = true;
  report.plan.kept = {"k"};
  report.plan.changed = {"c"};
  report.plan.bytes = 72;
  report.from = "0a";
  report.to = "0b";
  report.version = 3;
  report.tick = 4711;
  report.left_out = 1;
  report.copying_ns = 300;
  report.response_ns = 2000;
  ASSERT_TRUE(write_report("n", report).ok());
  const auto read = read_report("n");
  ASSERT_TRUE(read);
  EXPECT_EQ(json_of(*read).dump(), json_of(report).dump());
  EXPECT_THAT(read->errors, ElementsAre("a", "b"));
  EXPECT_EQ(read->tick, 4711U);
}

TEST_F(ReloadFiles, One_process_commands_an_exchange_at_a_time) {
  {
    const auto first = ReloadLock::acquire("n");
    ASSERT_TRUE(first.ok());
    EXPECT_EQ(ReloadLock::acquire("n").error().code, Errc::Busy);
  }
  EXPECT_TRUE(ReloadLock::acquire("n").ok());
}

TEST(RemoteReload, Order_and_reply_come_as_they_were_sent) {
  const RemoteReload order{false, "ab12", 4711, {"", true, false, 5, "x > 1"}};
  const auto sent = parse_remote_reload(text_of(order));
  ASSERT_TRUE(sent);
  EXPECT_FALSE(sent->back);
  EXPECT_EQ(sent->digest, "ab12");
  EXPECT_EQ(sent->size, 4711U);
  EXPECT_TRUE(sent->request.lossy);
  EXPECT_FALSE(sent->request.dry_run);
  EXPECT_EQ(sent->request.health_ns, 5);
  EXPECT_EQ(sent->request.guard, "x > 1");
  RemoteReloadReply reply;
  reply.result = RemoteReloadReply::Result::Returned;
  reply.report.text = "the previous version runs again";
  reply.report.plan.kept = {"counted"};
  const auto answered = parse_remote_reload_reply(text_of(reply));
  ASSERT_TRUE(answered);
  EXPECT_EQ(answered->result, RemoteReloadReply::Result::Returned);
  EXPECT_EQ(answered->report.text, reply.report.text);
  EXPECT_THAT(answered->report.plan.kept, ElementsAre("counted"));
}

TEST(RemoteReload, Other_text_is_refused) {
  for (const char* text : {"", "{}", "[]", R"({"back": 1})", R"({"result": "perhaps"})"}) {
    EXPECT_FALSE(parse_remote_reload(text)) << text;
    EXPECT_FALSE(parse_remote_reload_reply(text)) << text;
  }
}

TEST_F(ReloadFiles, A_request_about_several_modules_comes_as_it_was_written_and_once) {
  using Act = SetRequest::Act;
  EXPECT_FALSE(take_set_request("n"));
  for (const Act act : {Act::Compare, Act::Prepare, Act::Exchange, Act::Decide}) {
    ASSERT_TRUE(
        write_set_request("n", {act, "0123", {{"press", "/a b/p.so"}, {"belt", ""}}, ~std::uint64_t{0}, "/a b/p.xml"})
            .ok());
    const auto request = take_set_request("n");
    ASSERT_TRUE(request);
    EXPECT_EQ(request->act, act);
    EXPECT_EQ(request->deployment, "0123");
    EXPECT_EQ(request->tick, ~std::uint64_t{0});
    EXPECT_EQ(request->config, "/a b/p.xml");
    ASSERT_EQ(request->modules.size(), 2U);
    EXPECT_EQ(request->modules[0].file, "/a b/p.so");
    EXPECT_EQ(request->modules[1].name, "belt");
    EXPECT_FALSE(take_set_request("n"));
  }
}

TEST_F(ReloadFiles, A_report_about_several_modules_comes_as_it_was_written) {
  using State = SetReport::State;
  EXPECT_FALSE(read_set_report("n"));
  for (const State state : {State::None, State::Preparing, State::Compared, State::Ready, State::Waiting,
                            State::Exchanged, State::Leaving, State::Undone, State::Stuck}) {
    SetReport sut;
    sut.state = state;
    sut.node_pid = 77;
    sut.problem = "why";
    sut.refused = "belt";
    sut.needs_restart = true;
    sut.modules.resize(2);
    sut.modules[1].module = "belt";
    sut.modules[1].tick = 5;
    sut.schedule = {{"press", "rescheduled", "period 1 ms -> 2 ms"}, {"belt", "kept", ""}};
    sut.schedule_tick = 6;
    sut.grid_ticks = 7;
    sut.grid_begin = 3;
    ASSERT_TRUE(write_set_report("n", sut).ok());
    const auto read = read_set_report("n");
    ASSERT_TRUE(read);
    EXPECT_EQ(read->state, state);
    EXPECT_EQ(read->node_pid, 77);
    EXPECT_EQ(read->problem, "why");
    EXPECT_EQ(read->refused, "belt");
    EXPECT_TRUE(read->needs_restart);
    ASSERT_EQ(read->modules.size(), 2U);
    EXPECT_EQ(read->modules[1].module, "belt");
    EXPECT_EQ(read->modules[1].tick, 5U);
    ASSERT_EQ(read->schedule.size(), 2U);
    EXPECT_EQ(read->schedule[0].name, "press");
    EXPECT_EQ(read->schedule[0].fate, "rescheduled");
    EXPECT_EQ(read->schedule[0].text, "period 1 ms -> 2 ms");
    EXPECT_EQ(read->schedule_tick, 6U);
    EXPECT_EQ(read->grid_ticks, 7U);
    EXPECT_EQ(read->grid_begin, 3U);
  }
}

}  // namespace
}  // namespace indurop::operate
