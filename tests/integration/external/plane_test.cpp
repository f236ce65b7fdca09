// SPDX-License-Identifier: Apache-2.0
// The external plane of one store, seen by a Cyclone DDS program that knows only the IDL.

#include <gmock/gmock.h>

#include <limits>
#include <string>
#include <vector>

#include "kinds_msgs.h"
#include "network/dds/entity.h"
#include "plane_fixture.h"
#include "store/vars/custody.h"
#include "tests/support/program.h"

namespace indurop::test {
namespace {

::kinds::All something() {
  ::kinds::All all{};
  all.yes = true;
  all.letter = 'x';
  all.i8 = -8;
  all.u8 = 200;
  all.i16 = -16000;
  all.u16 = 60000;
  all.i32 = -2'000'000'000;
  all.u32 = 4'000'000'000;
  all.i64 = std::numeric_limits<std::int64_t>::min();
  all.u64 = std::numeric_limits<std::uint64_t>::max();
  all.f = 1.5F;
  all.d = -0.1;
  all.colour = ::kinds::BLUE;
  all.text = "1234567";
  all.inner = {7, 0.25};
  all.list = {{{8, -0.5}, {9, 0.75}}};
  all.grid = {{{1, 2, 3}, {4, 5, 6}}};
  all.names[0] = "abc";
  all.names[1] = "";
  return all;
}

void expect_something(const kinds_All& all) {
  EXPECT_TRUE(all.yes);
  EXPECT_EQ(all.letter, 'x');
  EXPECT_EQ(all.i8, -8);
  EXPECT_EQ(all.u8, 200);
  EXPECT_EQ(all.i16, -16000);
  EXPECT_EQ(all.u16, 60000);
  EXPECT_EQ(all.i32, -2'000'000'000);
  EXPECT_EQ(all.u32, 4'000'000'000U);
  EXPECT_EQ(all.i64, std::numeric_limits<std::int64_t>::min());
  EXPECT_EQ(all.u64, std::numeric_limits<std::uint64_t>::max());
  EXPECT_EQ(all.f, 1.5F);
  EXPECT_EQ(all.d, -0.1);
  EXPECT_EQ(all.colour, kinds_BLUE);
  EXPECT_STREQ(all.text, "1234567");
  EXPECT_EQ(all.inner.small, 7);
  EXPECT_EQ(all.inner.wide, 0.25);
  EXPECT_EQ(all.list[0].wide, -0.5);
  EXPECT_EQ(all.list[1].small, 9);
  EXPECT_EQ(all.grid[1][2], 6);
  EXPECT_STREQ(all.names[0], "abc");
  EXPECT_STREQ(all.names[1], "");
}

TEST_F(Plane, Values_of_every_kind_arrive_as_they_are) {
  start();
  EXPECT_EQ(block().topics, 9U);
  EXPECT_EQ(block().writable, 2U);
  const dds_entity_t all = reader(kinds_All_desc, "kinds/all");
  const dds_entity_t word = reader(kinds_word__desc, "kinds/word");
  const dds_entity_t pair = reader(kinds_pair__desc, "kinds/pair");
  const dds_entity_t colour = reader(kinds_colour__desc, "kinds/colour");
  put("kinds::all", something());
  put("kinds::pair", std::array<std::int16_t, 2>{-3, 4});
  put("kinds::colour", std::int32_t{1});
  EXPECT_TRUE(receives<kinds_All>(all, [](const kinds_All& value) {
    if (value.u8 == 200) {
      expect_something(value);
    }
    return value.u8 == 200;
  }));
  EXPECT_TRUE(receives<kinds_word_>(word, [](const auto& value) { return std::string(value.value) == "abc"; }));
  EXPECT_TRUE(
      receives<kinds_pair_>(pair, [](const auto& value) { return value.value[0] == -3 && value.value[1] == 4; }));
  EXPECT_TRUE(receives<kinds_colour_>(colour, [](const auto& value) { return value.value == kinds_GREEN; }));
  EXPECT_TRUE(wait_until([&] { return block().read.load() == 4; }));
}

TEST_F(Plane, A_late_joiner_gets_the_last_value) {
  start();
  put("kinds::all", something());
  const dds_entity_t first = reader(kinds_All_desc, "kinds/all");
  ASSERT_TRUE(receives<kinds_All>(first, [](const kinds_All& value) { return value.u8 == 200; }));
  const dds_entity_t second = reader(kinds_All_desc, "kinds/all");
  EXPECT_TRUE(receives<kinds_All>(second, [](const kinds_All& value) { return value.u8 == 200; }));
  // Not even asking for it: the value is sent again to a participant that has joined.
  const dds_entity_t third = reader(kinds_All_desc, "kinds/all", false);
  EXPECT_TRUE(receives<kinds_All>(third, [](const kinds_All& value) { return value.u8 == 200; }));
}

TEST_F(Plane, What_does_not_change_is_not_repeated) {
  start();
  const dds_entity_t word = reader(kinds_word__desc, "kinds/word");
  const dds_entity_t tick = reader(kinds_tick__desc, "kinds/tick");
  int words = 0;
  for (std::uint32_t i = 1; i <= 200; ++i) {
    put("kinds::tick", i);
    put("kinds::word", std::array<char, 6>{'a', 'b', 'c'});  // the same again
    ASSERT_TRUE(receives<kinds_tick_>(tick, [&](const auto& value) { return value.value == i; }));
    words += take<kinds_word_>(word) ? 1 : 0;
  }
  EXPECT_GE(words, 1);
  EXPECT_LE(words, 3) << "when it was discovered, and again";
}

TEST_F(Plane, Texts_without_an_end_get_one) {
  start();
  const dds_entity_t word = reader(kinds_word__desc, "kinds/word");
  put("kinds::word", std::array<char, 6>{'1', '2', '3', '4', '5', '6'});
  EXPECT_TRUE(receives<kinds_word_>(word, [](const auto& value) { return std::string(value.value) == "12345"; }));
}

TEST_F(Plane, A_value_its_type_does_not_know_is_counted_and_named_and_the_others_go_on) {
  start();
  const dds_entity_t colour = reader(kinds_colour__desc, "kinds/colour");
  const dds_entity_t tick = reader(kinds_tick__desc, "kinds/tick");
  put("kinds::colour", std::int32_t{77});
  ASSERT_TRUE(wait_until([&] { return block().refused_by_dds.load() > 0; }));
  EXPECT_TRUE(wait_until([&] { return block().problem.get().find("kinds::colour") != std::string::npos; }));
  put("kinds::tick", std::uint32_t{5});
  EXPECT_TRUE(receives<kinds_tick_>(tick, [](const auto& value) { return value.value == 5; }));
  put("kinds::colour", std::int32_t{2});
  EXPECT_TRUE(receives<kinds_colour_>(colour, [](const auto& value) { return value.value == kinds_BLUE; }));
}

TEST_F(Plane, A_variable_marked_so_is_set_from_outside) {
  start();
  const dds_entity_t out = writer(kinds_wanted__desc, "kinds/wanted");
  ASSERT_TRUE(wait_until([&] { return matched(out); }));
  const kinds_wanted_ value{7.5};
  ASSERT_EQ(dds_write(out, &value), 0);
  EXPECT_TRUE(wait_until([&] { return get<double>("kinds::wanted") == 7.5; }));
  EXPECT_EQ(block().received.load(), 1U);
}

// The lock is against slips of people with tools: a program that sets variables is part of the plant.
TEST_F(Plane, A_program_sets_a_variable_of_a_locked_node_too) {
  start();
  auto custody = vars::Custody::create(node());
  ASSERT_TRUE(custody.ok());
  vars::LockNote locked;
  locked.lock = vars::WriteLock::All;
  ASSERT_TRUE(custody->set_lock(locked).ok());
  const dds_entity_t out = writer(kinds_wanted__desc, "kinds/wanted");
  ASSERT_TRUE(wait_until([&] { return matched(out); }));
  const kinds_wanted_ value{6.25};
  ASSERT_EQ(dds_write(out, &value), 0);
  EXPECT_TRUE(wait_until([&] { return get<double>("kinds::wanted") == 6.25; }));
  EXPECT_EQ(vars::lock_of(node()).lock, vars::WriteLock::All);
}

TEST_F(Plane, What_is_out_of_range_is_refused_and_the_truth_is_said_again) {
  start();
  const dds_entity_t in = reader(kinds_wanted__desc, "kinds/wanted");
  const dds_entity_t out = writer(kinds_wanted__desc, "kinds/wanted");
  ASSERT_TRUE(wait_until([&] { return matched(out) && block().read.load() > 0; }));
  for (const double bad : {99.0, std::numeric_limits<double>::quiet_NaN(), -11.0}) {
    const std::uint64_t before = block().refused.load();
    const kinds_wanted_ value{bad};
    ASSERT_EQ(dds_write(out, &value), 0);
    ASSERT_TRUE(wait_until([&] { return block().refused.load() == before + 1; }));
    EXPECT_TRUE(receives<kinds_wanted_>(in, [](const auto& seen) { return seen.value == 1; }));
  }
  EXPECT_EQ(get<double>("kinds::wanted"), 1);
  EXPECT_EQ(block().received.load(), 0U);
  EXPECT_TRUE(wait_until([&] {
    return block().problem.get() == "a value for kinds::wanted from outside is rejected: -11 is outside -10..10";
  })) << block().problem.get();
}

TEST_F(Plane, Ranges_of_fields_hold_too) {
  start();
  const dds_entity_t out = writer(kinds_Inner_desc, "kinds/wanted_inner");
  ASSERT_TRUE(wait_until([&] { return matched(out); }));
  const kinds_Inner bad{1, 2.0};
  ASSERT_EQ(dds_write(out, &bad), 0);
  ASSERT_TRUE(wait_until([&] { return block().refused.load() == 1; }));
  const kinds_Inner good{1, 0.5};
  ASSERT_EQ(dds_write(out, &good), 0);
  EXPECT_TRUE(wait_until([&] { return get<::kinds::Inner>("kinds::wanted_inner").wide == 0.5; }));
}

TEST_F(Plane, What_is_not_marked_cannot_be_set) {
  start();
  const dds_entity_t marked = writer(kinds_wanted__desc, "kinds/wanted");
  const dds_entity_t out = writer(kinds_rigid__desc, "kinds/rigid");
  ASSERT_TRUE(wait_until([&] { return matched(marked); }));
  const kinds_rigid_ value{8};
  ASSERT_EQ(dds_write(out, &value), 0);
  const kinds_wanted_ last{2};
  ASSERT_EQ(dds_write(marked, &last), 0);
  ASSERT_TRUE(wait_until([&] { return get<double>("kinds::wanted") == 2; }));
  EXPECT_FALSE(matched(out));
  EXPECT_EQ(get<double>("kinds::rigid"), 3);
}

TEST_F(Plane, Topics_of_very_many_variables_are_created_on_request) {
  start(600);
  EXPECT_EQ(block().topics, 609U);
  const dds_entity_t listing = dds_create_reader(participant_, DDS_BUILTIN_TOPIC_DCPSPUBLICATION, nullptr, nullptr);
  dds::take_all<dds_builtintopic_endpoint_t>(listing, [](const auto& endpoint, const dds::SampleInfo& /*info*/) {
    EXPECT_EQ(std::string(endpoint.topic_name).rfind("indurop/", 0), 0U) << "no variable is announced yet";
  });
  put("kinds::more417", ::kinds::Inner{3, 0.5});
  const dds_entity_t in = reader(kinds_Inner_desc, "kinds/more417");
  EXPECT_TRUE(receives<kinds_Inner>(in, [](const auto& value) { return value.small == 3; }));
  const dds_entity_t out = writer(kinds_wanted__desc, "kinds/wanted");
  ASSERT_TRUE(wait_until([&] { return matched(out); }));
}

class PlaneNames : public Plane, public ::testing::WithParamInterface<bool> {};

TEST_P(PlaneNames, Of_very_many_variables_indurop_gets_those_it_asks_for_without_their_types) {
  start(600, GetParam());
  put("kinds::all", something());
  put("kinds::more417", ::kinds::Inner{3, 0.5});
  const auto remote = [](std::vector<std::string> words) {
    words.insert(words.begin(), INDUROP_PROGRAM);
    words.insert(words.end(), {"--one-host", "--domain", std::to_string(domain())});
    Program program(words, Environment{});
    const int code = program.wait();
    return Outcome{code, program.out(), program.err()};
  };
  EXPECT_EQ(remote({"get", "kinds::more417.small"}).out, "3\n");
  const Outcome all = remote({"get", "kinds::all", "kinds::pair", "kinds::word", "-o", "csv"});
  EXPECT_EQ(all.code, 0) << all.err;
  for (const char* part :
       {"4000000000", "-9223372036854775808", "18446744073709551615", "BLUE", "1234567", "0.25", "abc", "0.75"}) {
    EXPECT_THAT(all.out, ::testing::HasSubstr(part));
  }
  const Outcome many = remote({"get", "kinds::*", "-o", "csv"});
  EXPECT_EQ(many.code, 0) << many.err;
  EXPECT_GE(std::count(many.out.begin(), many.out.end(), '\n'), 609);
  EXPECT_THAT(many.err, ::testing::Not(::testing::HasSubstr("no value")));
  const Outcome set = remote({"set", "kinds::wanted", "-7.5"});
  EXPECT_EQ(set.code, 0) << set.err;
  EXPECT_EQ(get<double>("kinds::wanted"), -7.5);
}

INSTANTIATE_TEST_SUITE_P(Ros2, PlaneNames, ::testing::Bool());

TEST_F(Plane, A_participant_that_requests_a_qos_that_is_not_offered_is_named) {
  start();
  const std::unique_ptr<dds_qos_t, decltype(&dds_delete_qos)> qos(dds_create_qos(), &dds_delete_qos);
  dds_qset_durability(qos.get(), DDS_DURABILITY_PERSISTENT);
  const dds_entity_t topic = dds_create_topic(participant_, &kinds_tick__desc, "kinds/tick", nullptr, nullptr);
  const dds_entity_t in = dds_create_reader(participant_, topic, qos.get(), nullptr);
  ASSERT_GT(in, 0);
  EXPECT_TRUE(wait_until([&] { return block().mismatched.load() > 0; }));
  EXPECT_TRUE(wait_until([&] { return block().problem.get().find("kinds/tick") != std::string::npos; }));
}

// kinds_msgs.idl is what ROS 2 makes of the messages; ROS 2 itself is not needed to compare bytes.
TEST_F(Plane, A_program_of_ROS_2_reads_and_sets_variables) {
  start(0, true);
  const ::kinds::All sent = something();
  put("kinds::all", sent);
  const dds_entity_t all = reader(kinds_msgs_msg_dds__All__desc, "rt/kinds/all", false);
  EXPECT_TRUE(receives<kinds_msgs_msg_dds__All_>(all, [&](const auto& got) {
    return got.yes_ == sent.yes && got.i64_ == sent.i64 && got.d_ == sent.d &&
           got.colour_ == static_cast<std::int32_t>(sent.colour) && sent.text == std::string_view(got.text_) &&
           got.inner_.wide_ == sent.inner.wide && got.list_[1].small_ == sent.list[1].small &&
           got.grid_[5] == sent.grid[1][2] && sent.names[1] == std::string_view(got.names_[1]);
  })) << block().problem.get();
  const dds_entity_t wanted = writer(kinds_msgs_msg_dds__Wanted__desc, "rt/kinds/wanted");
  ASSERT_TRUE(wait_until([&] { return matched(wanted); })) << block().problem.get();
  const kinds_msgs_msg_dds__Wanted_ value{-7.5};
  ASSERT_EQ(dds_write(wanted, &value), DDS_RETCODE_OK);
  EXPECT_TRUE(wait_until([&] { return get<double>("kinds::wanted") == -7.5; }));
}

}  // namespace
}  // namespace indurop::test
