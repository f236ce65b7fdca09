// SPDX-License-Identifier: Apache-2.0
// vars, get, set, hz.
#include <unistd.h>

#include "fixture.h"

namespace indurop::test {
namespace {

TEST_F(WithNode, Get_prints_nothing_but_the_value_of_one_name) {
  EXPECT_EQ(indurop({"get", "knu::Robot::gain"}).out, "1\n");
  EXPECT_EQ(indurop({"get", "gain"}).out, "1\n");
  EXPECT_EQ(indurop({"get", "knu.Robot.mode"}).out, "OFF\n");
  EXPECT_EQ(indurop({"get", "starts"}).out, "5\n");
}

TEST_F(WithNode, Get_of_several_is_a_table_csv_or_json) {
  const auto text = indurop({"get", "gain", "joints[1].y"});
  EXPECT_EQ(text.out,
            "NAME                     VALUE  UNIT\n"
            "knu::Robot::gain             1  mm\n"
            "knu::Robot::joints[1].y      0  deg\n");
  EXPECT_EQ(indurop({"get", "gain", "starts", "-o", "csv"}).out,
            "name,value,unit\nknu::Robot::gain,1,mm\nstation::starts,5,\n");
  const auto json = indurop({"get", "joints[1]", "-o", "json"}).json();
  EXPECT_EQ(json["schema_version"], 1);
  EXPECT_EQ(json["node"], "local");
  EXPECT_EQ(json["values"][0]["name"], "knu::Robot::joints[1]");
  EXPECT_EQ(json["values"][0]["value"]["z"], 0.0);
}

TEST_F(WithNode, Globs_select_and_nothing_comes_twice) {
  const auto json = indurop({"get", "station::*", "starts", "-o", "json"}).json();
  EXPECT_EQ(json["values"].size(), 2U);
}

TEST_F(WithNode, Unknown_names_are_answered_with_the_nearest) {
  const auto sut = indurop({"get", "gian", "nothing*"});
  EXPECT_EQ(sut.code, 1);
  EXPECT_THAT(sut.err, HasSubstr("gain"));
  EXPECT_THAT(sut.err, HasSubstr("nothing*"));
  EXPECT_THAT(indurop({"get", "joints[10]"}).err, HasSubstr("10"));
  EXPECT_EQ(indurop({"get", "joints[10]"}).code, 1);
  EXPECT_EQ(indurop({"get", "joints[1].w"}).code, 1);
}

TEST_F(WithNode, Set_changes_a_variable_or_a_part_of_it) {
  EXPECT_EQ(indurop({"set", "gain", "2.5"}).code, 0);
  EXPECT_EQ(indurop({"get", "gain"}).out, "2.5\n");
  EXPECT_EQ(indurop({"set", "joints[1].y", "-12.5"}).code, 0);
  EXPECT_EQ(indurop({"get", "joints[1].y"}).out, "-12.5\n");
  EXPECT_EQ(indurop({"set", "joints[2]={x: 1, y: 2, z: 3}", "mode=AUTO", "station::name=\"cell 7\""}).code, 0);
  EXPECT_EQ(indurop({"get", "joints[2].z"}).out, "3\n");
  EXPECT_EQ(indurop({"get", "mode"}).out, "AUTO\n");
  EXPECT_EQ(indurop({"get", "station::name"}).out, "\"cell 7\"\n");
}

TEST_F(WithNode, Set_takes_arrays_and_negative_values_after_options) {
  EXPECT_EQ(indurop({"set", "starts", "-3", "--node", "local"}).code, 0);
  EXPECT_EQ(indurop({"get", "starts"}).out, "-3\n");
}

TEST_F(WithNode, Set_changes_nothing_if_one_value_is_bad) {
  const auto sut = indurop({"set", "gain=2", "mode=SIDEWAYS", "starts=abc"});
  EXPECT_EQ(sut.code, 1);
  EXPECT_THAT(sut.err, HasSubstr("SIDEWAYS"));
  EXPECT_THAT(sut.err, HasSubstr("abc"));
  EXPECT_THAT(sut.err, HasSubstr("nothing was changed"));
  EXPECT_EQ(indurop({"get", "gain"}).out, "1\n");
}

TEST_F(WithNode, Set_keeps_to_declared_ranges_of_variables_and_fields) {
  const auto above = indurop({"set", "gain", "11"});
  EXPECT_EQ(above.code, 1);
  EXPECT_THAT(above.err, HasSubstr("0..10"));
  EXPECT_EQ(indurop({"set", "gain", "nan"}).code, 1);
  EXPECT_EQ(indurop({"set", "joints[0].y", "181"}).code, 1);
  EXPECT_EQ(indurop({"set", "joints[0]", "{x: 0, y: -200, z: 0}"}).code, 1);
  EXPECT_EQ(indurop({"set", "starts", "99999999999"}).code, 1);
  EXPECT_EQ(indurop({"get", "gain"}).out, "1\n");
}

TEST_F(WithNode, Force_holds_what_the_node_writes_until_unforce) {
  ASSERT_EQ(indurop({"force", "tick=7", "joints[1].y", "-0.5"}).code, 2) << "two ways of writing assignments";
  ASSERT_EQ(indurop({"force", "tick=7", "joints[1].y=-0.5"}).code, 0);
  EXPECT_EQ(indurop({"get", "tick"}).out, "7\n");
  EXPECT_THAT(indurop({"forces", "-o", "csv"}).out,
              ContainsRegex("knu::Robot::tick,7,,[^\n]*\nknu::Robot::joints\\[1\\].y,-0.5,,"));
  EXPECT_EQ(indurop({"status", "-o", "json"}).json()["forces"][0]["name"], "knu::Robot::tick");
  EXPECT_THAT(indurop({"status"}).out,
              ContainsRegex("forced    knu::Robot::tick = 7.*, knu::Robot::joints\\[1\\].y = -0.5"));
  const auto set = indurop({"set", "joints[1]", "{x: 1}"});
  EXPECT_EQ(set.code, 1);
  EXPECT_THAT(set.err, HasSubstr("indurop unforce 'knu::Robot::joints[1]'"));
  EXPECT_EQ(indurop({"unforce", "joints"}).code, 0) << "all parts of it";
  EXPECT_EQ(indurop({"set", "joints[1].y", "2"}).code, 0);
  EXPECT_EQ(indurop({"get", "joints[1].y"}).out, "2\n");
  EXPECT_EQ(indurop({"unforce", "--all"}).code, 0);
  EXPECT_THAT(indurop({"forces"}).err, HasSubstr("nothing is forced"));
}

TEST_F(WithNode, Texts_and_values_as_PLC_programs_write_them_are_forced) {
  ASSERT_EQ(indurop({"force", "station::name='it$'s cell 7'", "starts=T#5ns", "mode=AUTO"}).code, 0);
  EXPECT_EQ(indurop({"get", "station::name"}).out, "\"it's cell 7\"\n");
  EXPECT_EQ(indurop({"get", "starts"}).out, "5\n");
  EXPECT_THAT(indurop({"forces", "-o", "csv"}).out, HasSubstr("station::name,it's cell 7,,"));
  ASSERT_EQ(indurop({"force", "station::name", "short"}).code, 0);
  EXPECT_EQ(indurop({"get", "station::name"}).out, "\"short\"\n");
  EXPECT_EQ(indurop({"set", "station::name", "other"}).code, 1) << "it is forced";
  EXPECT_EQ(indurop({"unforce", "station::name"}).code, 0);
  EXPECT_EQ(indurop({"set", "starts=16#FF"}).code, 1);
  EXPECT_EQ(indurop({"unforce", "--all"}).code, 0);
  EXPECT_EQ(indurop({"set", "starts=INT#16#7F"}).code, 0);
  EXPECT_EQ(indurop({"get", "starts"}).out, "127\n");
}

TEST_F(WithNode, Of_a_struct_is_held_what_was_said) {
  ASSERT_EQ(indurop({"force", "joints[1]={x: 1.5, z: 0}", "--reason", "gauge is broken"}).code, 0);
  ASSERT_EQ(indurop({"set", "joints[1].y", "4"}).code, 0) << "the rest goes on";
  EXPECT_EQ(indurop({"get", "joints[1]"}).out, "{x: 1.5, y: 4, z: 0}\n");
  const auto forces = indurop({"forces", "-o", "json"}).json()["forces"];
  ASSERT_EQ(forces.size(), 2U);
  for (const auto& one : forces) {
    EXPECT_EQ(one["reason"], "gauge is broken");
    EXPECT_NE(one["who"], "");
    EXPECT_EQ(one["lease"], false);
  }
  EXPECT_THAT(indurop({"status"}).out, HasSubstr("gauge is broken"));
  EXPECT_THAT(indurop({"audit"}).out, ContainsRegex("force.*gauge is broken"));
  EXPECT_EQ(indurop({"unforce", "joints[1]"}).code, 0);
  EXPECT_EQ(indurop({"force", "joints=" + indurop({"get", "joints"}).out, "station::name=123456789012345"}).code, 0);
  EXPECT_EQ(indurop({"forces", "-o", "json"}).json()["forces"].size(), 31U);
  EXPECT_EQ(indurop({"unforce", "--all"}).code, 0);
}

TEST_F(WithNode, A_lease_ends_with_its_client) {
  for (const int signal : {SIGINT, SIGKILL, SIGSTOP}) {
    Program sut(indurop_command({"force", "tick=7", "gain=3", "--lease", "--reason", "trial"}), background());
    ASSERT_TRUE(sut.prints("held while this command runs")) << sut.out();
    const auto begin = indurop({"get", "tick"});
    EXPECT_EQ(begin.out, "7\n");
    const auto left = [] {
      return indurop({"forces", "-o", "json"}).json()["forces"][0]["left_ns"].get<std::int64_t>();
    };
    std::int64_t before = left();
    EXPECT_TRUE(wait_until([&] { return std::exchange(before, left()) < before; })) << "it is renewed";
    EXPECT_EQ(indurop({"forces", "-o", "json"}).json()["forces"][0]["lease"], true);
    sut.signal(signal);
    EXPECT_TRUE(wait_until([] { return indurop({"get", "tick"}).out != "7\n"; })) << "signal " << signal;
    EXPECT_THAT(indurop({"forces"}).err, HasSubstr("nothing is forced"));
    sut.signal(SIGKILL);
    (void)sut.wait();
  }
}

TEST_F(WithNode, A_lease_leaves_forces_of_other_users_alone) {
  Program sut(indurop_command({"force", "tick=7", "gain=3", "--lease"}), background());
  ASSERT_TRUE(sut.prints("held while this command runs")) << sut.out();
  ASSERT_EQ(indurop({"force", "tick=9"}).code, 0);
  EXPECT_EQ(sut.wait(), 1) << "it has lost one, and says so";
  EXPECT_EQ(indurop({"get", "tick"}).out, "9\n") << "the other's force goes on";
  const auto forces = indurop({"forces", "-o", "json"}).json()["forces"];
  ASSERT_EQ(forces.size(), 1U) << "its others were released";
  EXPECT_EQ(forces[0]["left_ns"], nullptr);
  EXPECT_EQ(indurop({"force", "tick=1", "--lease", "--for", "2s"}).code, 2);
}

TEST_F(WithNode, A_locked_node_is_written_as_far_as_its_lock_goes) {
  EXPECT_EQ(indurop({"lock"}).out, "none\n");
  ASSERT_EQ(indurop({"force", "tick", "7"}).code, 0);
  ASSERT_EQ(indurop({"lock", "tune", "--reason", "production"}).code, 0);
  EXPECT_EQ(indurop({"set", "gain", "2"}).code, 0) << "a parameter";
  const std::vector<std::vector<std::string>> forbidden{{"set", "mode", "AUTO"},     {"set", "gain=3", "mode=AUTO"},
                                                        {"force", "gain", "4"},      {"unforce", "--all"},
                                                        {"stop", "output"},          {"restart", "show"},
                                                        {"reset", "--warm", "--yes"}};
  for (const auto& words : forbidden) {
    const auto sut = indurop(words);
    EXPECT_EQ(sut.code, 1) << words[0];
    EXPECT_THAT(sut.err, HasSubstr("its write lock is 'tune'")) << words[0];
    EXPECT_THAT(sut.err, HasSubstr("production")) << words[0];
  }
  EXPECT_EQ(indurop({"get", "gain"}).out, "2\n");
  EXPECT_EQ(indurop({"get", "tick"}).out, "7\n") << "what is forced stays forced";
  EXPECT_THAT(indurop({"status"}).out, ContainsRegex("locked    tune .*production"));
  EXPECT_EQ(indurop({"status", "-o", "json"}).json()["lock"]["lock"], "tune");
  ASSERT_EQ(indurop({"lock", "all"}).code, 0);
  EXPECT_EQ(indurop({"set", "gain", "2.5"}).code, 1);
  EXPECT_EQ(indurop({"lock", "some"}).code, 2);
  kill_node();
  node_ = std::make_unique<Program>(fake_node("local"), background());
  ASSERT_TRUE(node_->prints("ready")) << node_->out();
  EXPECT_EQ(indurop({"set", "gain", "2.5"}).code, 1) << "the lock outlives the node";
  ASSERT_EQ(indurop({"lock", "none"}).code, 0);
  EXPECT_EQ(indurop({"set", "gain", "2.5"}).code, 0);
  EXPECT_THAT(indurop({"audit"}).out, ContainsRegex("lock.*production"));
}

TEST_F(WithNode, Force_explains_what_cannot_be_forced) {
  const auto many =
      indurop({"force", "joints=[{x: 1, y: 1, z: 1}, {}, {}, {}, {}, {}, {}, {}, {}, {}]", "joints[1].w=2"});
  EXPECT_EQ(many.code, 1);
  EXPECT_THAT(indurop({"forces"}).err, HasSubstr("nothing is forced")) << "all or none";
  EXPECT_EQ(indurop({"force", "gain", "11"}).code, 1) << "outside of its declared range";
  EXPECT_EQ(indurop({"unforce"}).code, 2);
  EXPECT_EQ(indurop({"unforce", "nix"}).code, 1);
  kill_node();
  const auto dead = indurop({"force", "gain", "2"});
  EXPECT_EQ(dead.code, 6);
  EXPECT_THAT(dead.err, HasSubstr("forces are for a node that runs"));
}

TEST_F(WithNode, Set_explains_what_is_no_assignment) {
  EXPECT_EQ(indurop({"set", "gain"}).code, 2);
  EXPECT_EQ(indurop({"set", "gain=1", "mode"}).code, 2);
  EXPECT_EQ(indurop({"set", "=1"}).code, 2);
  EXPECT_EQ(indurop({"set", "*", "1"}).code, 1);
}

TEST_F(WithNode, Another_user_may_look_but_not_change) {
  if (geteuid() != 0) {
    GTEST_SKIP() << "needs root to become another user";
  }
  constexpr uid_t kUnprivileged = 65534;
  const auto get = indurop({"get", "gain"}, {.user = kUnprivileged});
  if (get.code == 127 || get.code == 126) {
    GTEST_SKIP() << "the build directory is closed to others";
  }
  EXPECT_EQ(get.out, "1\n") << get.err;
  const auto set = indurop({"set", "gain", "2"}, {.user = kUnprivileged});
  EXPECT_EQ(set.code, 1);
  EXPECT_THAT(set.err, HasSubstr("no permission to change values"));
  EXPECT_EQ(indurop({"get", "gain"}).out, "1\n");
}

TEST_F(WithNode, Vars_lists_types_units_and_values) {
  const auto text = indurop({"vars", "gain"});
  EXPECT_EQ(text.code, 0);
  EXPECT_THAT(text.out, HasSubstr("knu::Robot::gain  double      1  mm    0..10"));
  EXPECT_EQ(indurop({"vars", "--names", "-t", "double"}).out, "knu::Robot::gain\npress::oil\n");
  const auto json = indurop({"vars", "-o", "json"}).json();
  EXPECT_EQ(json["variables"].size(), 8U);
  EXPECT_EQ(json["variables"][0]["name"], "knu::Robot::gain");
  EXPECT_EQ(json["variables"][0]["range"], nlohmann::json::parse("[0.0,10.0]"));
  EXPECT_EQ(json["variables"][0]["description"], "amplitude");
}

TEST_F(WithNode, Values_outlive_the_node_and_can_be_changed_for_the_next) {
  kill_node();
  const auto get = indurop({"get", "gain"});
  EXPECT_EQ(get.code, 0);
  EXPECT_EQ(get.out, "1\n");
  EXPECT_THAT(get.err, HasSubstr("not running, last seen"));
  EXPECT_EQ(indurop({"set", "gain", "3"}).code, 0);
  EXPECT_EQ(indurop({"get", "-q", "gain"}).out, "3\n");
  EXPECT_THAT(indurop({"get", "-q", "gain"}).err, IsEmpty());
}

TEST_F(WithNode, Hz_counts_every_update_of_a_struct) {
  const auto sut = indurop({"hz", "joints", "--once", "-o", "json"});
  const auto json = sut.json();
  ASSERT_TRUE(json.is_object()) << sut.out << sut.err;
  EXPECT_TRUE(json["exact"]);
  EXPECT_GT(json["rate_hz"], 0.0);
  EXPECT_THAT(indurop({"hz", "tick", "--once"}).out, HasSubstr("average rate: "));
  EXPECT_EQ(indurop({"hz", "nothing"}).code, 1);
  EXPECT_EQ(indurop({"hz", "gain", "-n", "2"}).out, "no update yet\n");
}

}  // namespace
}  // namespace indurop::test
