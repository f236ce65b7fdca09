// SPDX-License-Identifier: Apache-2.0
// indurop run PLANT --local: all boards on one host.

#include <csignal>

#include "turning_table_fixture.h"

namespace indurop::test {
namespace {

using ::testing::AnyOf;
using ::testing::HasSubstr;
using ::testing::Not;

class Local : public TurningTable {
 protected:
  Program& run(const std::string& plant, std::vector<std::string> more = {"-q"}) {
    more.insert(more.begin(), {"run", plant, "--local"});
    return indurop(more);
  }
  // A recording of the board control, begun when its controller knew something already.
  void expect_use_of(const std::string& recording, const std::string& why_ended) {
    const Outcome again = indurop({"replay", recording, "--node", board("replay")}).finish();
    EXPECT_TRUE(again.code == 0 || again.code == 4) << again.err;
    EXPECT_THAT(again.out, HasSubstr(" runs, "));
    const Outcome why = indurop({"explain", board("control"), "--from", recording}).finish();
    EXPECT_EQ(why.code, 0) << why.err;
    EXPECT_THAT(why.out, HasSubstr(why_ended));
  }
};

TEST_F(Local, Boards_close_a_loop_and_end_together) {
  const std::string report = folder() / "r.json";
  Program& sut = run(two_boards(), {"-q", "--duration", "60s", "--report", report});
  EXPECT_TRUE(wait_until([&] { return controlled(); })) << sut.err();
  const pid_t sensor = pid_of("sensor");
  const pid_t control = pid_of("control");
  sut.signal(SIGINT);
  EXPECT_EQ(sut.wait(), 130);
  EXPECT_FALSE(alive(sensor));
  EXPECT_FALSE(alive(control));
  for (const char* name : {"sensor", "control"}) {
    EXPECT_TRUE(std::filesystem::exists(folder() / ("r." + board(name) + ".json"))) << name;
  }
}

TEST_F(Local, All_boards_are_recorded_in_one_file_and_each_is_replayed) {
  const std::string plant = two_boards();
  Program& sut = run(plant);
  ASSERT_TRUE(wait_until([&] { return number("control", "cell::encoder", 16) > 0; })) << sut.err();
  const std::string file = (folder() / "plant.mcap").string();
  const Outcome recorded = indurop({"record", "--plant", plant, "-o", file, "--past", "--duration", "1s"}).finish();
  EXPECT_EQ(recorded.code, 0) << recorded.err;
  EXPECT_THAT(recorded.err, HasSubstr(" of 2 boards, "));
  const std::string parts = (folder() / "parts.mcap").string();
  EXPECT_EQ(indurop({"record", "--plant", plant, "-o", parts, "--split", "300ms", "--duration", "1s"}).wait(), 0);
  const Outcome wrong = indurop({"record", "missing", "--plant", plant, "-o", (folder() / "x.mcap").string()}).finish();
  EXPECT_THAT(wrong.err, HasSubstr("no board has a variable 'missing'"));
  sut.signal(SIGINT);
  EXPECT_EQ(sut.wait(), 130);
  for (const std::string& each : {file, (folder() / "parts.0002.mcap").string()}) {
    const Outcome info = indurop({"recording", "info", each}).finish();
    for (const char* name : {"sensor", "control"}) {
      EXPECT_THAT(info.out, HasSubstr(board(name) + "/cell::encoder")) << info.err;
      const Outcome again = indurop({"replay", each, "--board", board(name), "--node", board("replay")}).finish();
      // Both modules keep something inside, which a recording from the middle does not know; that is said.
      EXPECT_THAT(again.out + again.err, AnyOf(HasSubstr(" values: equal"), HasSubstr("are not in the recording")));
    }
  }
}

TEST_F(Local, A_board_that_is_killed_while_all_are_recorded_is_named) {
  const std::string plant = two_boards();
  Program& sut = run(plant);
  ASSERT_TRUE(wait_until([&] { return controlled(); })) << sut.err();
  const std::string file = folder() / "plant.mcap";
  Program& recorder = indurop({"record", "--plant", plant, "-o", file});
  ASSERT_TRUE(wait_until([&] { return std::filesystem::exists(file); }));
  ASSERT_EQ(::kill(pid_of("sensor"), SIGKILL), 0);
  sut.signal(SIGINT);
  sut.wait();
  EXPECT_EQ(recorder.wait(), 1) << recorder.err();
  EXPECT_THAT(recorder.err(), HasSubstr("board " + board("sensor") + " crashed or was killed"));
  EXPECT_THAT(recorder.err(), Not(HasSubstr("board " + board("control") + " crashed")));
}

TEST_F(Local, Each_board_is_recorded_from_its_first_run_on) {
  const std::string plant = two_boards();
  const std::string file = folder() / "r.mcap";
  EXPECT_EQ(run(plant, {"-q", "--duration", "1s", "--record", file}).wait(), 0);
  std::vector<std::string> join{"recording", "join", "-o", (folder() / "all.mcap").string()};
  for (const char* name : {"sensor", "control"}) {
    join.push_back(folder() / ("r." + board(name) + ".mcap"));
  }
  EXPECT_EQ(indurop(join).wait(), 0);
  for (const char* name : {"sensor", "control"}) {
    const Outcome again =
        indurop({"replay", folder() / "all.mcap", "--board", board(name), "--node", board("replay")}).finish();
    EXPECT_EQ(again.code, 0) << again.out << again.err;
    EXPECT_THAT(again.out, HasSubstr(" values: equal"));
  }
  const Outcome changed = indurop({"replay", folder() / "all.mcap", "--board", board("control"), "--node",
                                   board("replay"), "--with", OTHER_CONTROLLER})
                              .finish();
  EXPECT_EQ(changed.code, 4) << changed.out << changed.err;
  EXPECT_THAT(changed.err, HasSubstr("module controller: cell::torque was "));
  const Outcome elsewhere = indurop({"replay", folder() / "all.mcap", "--board", board("sensor"), "--node",
                                     board("replay"), "--with", OTHER_CONTROLLER})
                                .finish();
  EXPECT_EQ(elsewhere.code, 1);
  EXPECT_THAT(elsewhere.err, HasSubstr("no module has this name or such a file"));
}

TEST_F(Local, A_duration_ends_all_of_them) {
  EXPECT_EQ(run(two_boards(), {"-q", "--duration", "300ms"}).wait(), 0);
}

TEST_F(Local, A_killed_board_leaves_the_others_running_and_can_come_back) {
  const std::string plant = two_boards();
  Program& sut = run(plant);
  ASSERT_TRUE(wait_until([&] { return controlled(); })) << sut.err();
  ::kill(pid_of("control"), SIGKILL);
  EXPECT_TRUE(wait_until([&] { return torque("sensor") == 0; })) << "the declared fallback";
  EXPECT_TRUE(sut.says("board " + board("control") + " was ended by signal 9"));
  EXPECT_TRUE(sut.running());
  indurop({"run", plant, "--board", board("control"), "--one-host", "-q"});
  EXPECT_TRUE(wait_until([&] { return controlled(); }));
  const std::string boxes = indurop({"blackbox", "--node", board("control"), "-o", "csv"}).finish().out;
  const std::size_t file = boxes.rfind(',') + 1;  // the last column
  ASSERT_TRUE(boxes.ends_with(".mcap\n")) << boxes;
  expect_use_of(boxes.substr(file, boxes.size() - file - 1),
                "the node of " + board("control") + " ended: its process died in the middle of its work");
  const std::string live = folder() / "live.mcap";
  EXPECT_EQ(indurop({"record", "--node", board("control"), "-o", live, "--duration", "200ms"}).wait(), 0);
  expect_use_of(live, "the recording does not say that " + board("control") + " stopped");
  const Outcome now = indurop({"explain", board("control"), "--node", board("control")}).finish();
  EXPECT_THAT(now.out, HasSubstr("the node of " + board("control") + " runs"));
  sut.signal(SIGTERM);
  EXPECT_EQ(sut.wait(), 143);
}

TEST_F(Local, What_is_shown_of_a_board_that_has_just_died_is_explained) {
  Program& sut = run(two_boards());
  ASSERT_TRUE(wait_until([&] { return controlled(); })) << sut.err();
  const auto get = [&] { return indurop({"get", "cell::torque", "--node", board("sensor")}).finish(); };
  EXPECT_TRUE(wait_until([&] { return get().err.empty(); })) << "as long as it lives";
  kill_node(board("control"));
  EXPECT_TRUE(wait_until(
      [&] { return get().err.find("board " + board("control") + " is silent (last heard ") != std::string::npos; }));
  EXPECT_THAT(get().err, HasSubstr("its last values, or their fallback: cell::torque"));
  EXPECT_EQ(get().out, "0\n");
}

TEST_F(Local, A_killed_runner_takes_its_boards_along) {
  Program& sut = run(two_boards());
  ASSERT_TRUE(wait_until([&] { return controlled(); })) << sut.err();
  const pid_t sensor = pid_of("sensor");
  const pid_t control = pid_of("control");
  sut.kill();
  EXPECT_TRUE(wait_until([&] { return !alive(sensor) && !alive(control); }));
}

TEST_F(Local, A_standby_keeps_the_loop_closed) {
  Program& sut = run(write(element("sensor", "table") +
                           element("control", "controller", "<standby>" + board("backup") + "</standby>") +
                           element("backup", "")));
  ASSERT_TRUE(wait_until([&] { return controlled() && std::abs(speed("backup") - 2) < 0.01; })) << sut.err();
  for (const char* leaving : {"control", "backup"}) {
    ::kill(pid_of(leaving), SIGKILL);
    if (leaving == std::string("control")) {
      const auto before = number<double>("backup", "cell::encoder");
      EXPECT_TRUE(wait_until([&] { return number<double>("backup", "cell::encoder") > before + 1; }))
          << "the table turns on";
      EXPECT_TRUE(wait_until([&] {
        return indurop({"get", "cell::torque", "--node", board("sensor")})
                   .finish()
                   .err.find("its standby " + board("backup") + " leads") != std::string::npos;
      }));
      EXPECT_THAT(indurop({"get", "cell::torque", "--node", board("sensor")}).finish().err, Not(HasSubstr("fallback")))
          << "the value is the standby's";
      EXPECT_THAT(indurop({"status", "--node", board("sensor")}).finish().out,
                  HasSubstr("leads 2 variables with a standby"));
      // Right after the change it may push the other way for a moment.
      EXPECT_TRUE(wait_until([&] { return torque("sensor") > 0 && torque("sensor") < 1; })) << torque("sensor");
    } else {
      EXPECT_TRUE(wait_until([&] { return torque("sensor") == 0; })) << "no board is left";
    }
  }
}

TEST_F(Local, Errors_of_the_plant_are_said_once_and_nothing_runs) {
  Program& sut = run(write(element("sensor", "table") + element("control", "no_such_module")));
  EXPECT_EQ(sut.wait(), 4);
  const std::string said = sut.err();
  const auto first = said.find("no_such_module.so");
  ASSERT_NE(first, std::string::npos) << said;
  EXPECT_EQ(pid_of("sensor"), 0);
}

TEST_F(Local, Without_saying_how_a_plant_is_not_run) {
  Program& sut = indurop({"run", two_boards()});
  EXPECT_EQ(sut.wait(), 2);
  EXPECT_THAT(sut.err(), HasSubstr("--local"));
  EXPECT_THAT(sut.err(), HasSubstr("--board NAME"));
}

TEST_F(Local, Options_that_would_do_nothing_are_refused) {
  const std::string plant = two_boards();
  const std::string script = path("script.txt");
  std::ofstream(script) << "1s kill " << board("sensor") << "\n";
  const std::vector<std::pair<std::vector<std::string>, const char*>> wrong{
      {{"--local", "--node", "x"}, "leave out --node"},
      {{"--sim", "--board", board("sensor"), "--network", "delay=1ms"}, "for --sim of all boards"},
      {{"--sim", "--board", board("sensor"), "--script", script}, "for --sim of all boards"},
      {{"--sim", "--require-rt"}, "virtual time needs no privileges"},
      {{"--sim", "--replay-board", "x"}, "--replay-board is for --replay"},
      {{"--sim", "--with", "x.so"}, "--with is for --replay"},
      {{"--replay", "x.mcap", "--board", board("sensor"), "--until", "1s"}, "a replay ends with its recording"},
  };
  for (const auto& [more, why] : wrong) {
    std::vector<std::string> words{"run", plant};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome sut = indurop(words).finish();
    EXPECT_EQ(sut.code, 2) << why << sut.err;
    EXPECT_THAT(sut.err, HasSubstr(why));
  }
}

TEST_F(Local, A_board_the_plant_does_not_have_is_named_with_those_it_has) {
  Program& sut = indurop({"run", two_boards(), "--board", "missing"});
  EXPECT_EQ(sut.wait(), 2);
  EXPECT_THAT(sut.err(), HasSubstr("has no board missing; it has " + board("sensor") + ", " + board("control")));
}

TEST_F(Local, Status_tells_of_the_other_board) {
  run(two_boards());
  ASSERT_TRUE(wait_until([&] { return controlled(); }));
  Program& sut = indurop({"status", "--node", board("sensor"), "-o", "json"});
  EXPECT_EQ(sut.wait(), 0);
  EXPECT_THAT(sut.out(), HasSubstr("\"board\":\"" + board("control") + "\",\"state\":\"alive\""));
  EXPECT_THAT(sut.out(), HasSubstr("\"name\":\"cell::torque\",\"owner\":\"" + board("control") + "\""));
}

}  // namespace
}  // namespace indurop::test
