// SPDX-License-Identifier: Apache-2.0
// irp::printf, irp::property and what a thread module may ask about its schedule.

#include <gtest/gtest.h>
#include <indurop/indurop.h>

#include <thread>

#include <indurop/generated.h>
#include "hosted.h"

namespace {

using namespace knu::Robot;
using indurop::testing::Hosted;
using indurop::testing::printed;
using indurop::testing::TestNode;

TEST(Printf, Goes_through_the_ring_of_the_calling_module) {
  TestNode node;
  const Hosted hosted(node);
  joints[0] = {1, 2, 3};
  label = "arm";
  EXPECT_EQ(irp::printf("%u %s %lf\n", tick, label, joints[0].y), 15);
  EXPECT_EQ(printed(node), "7 arm 2.000000\n");
}

TEST(Printf, Writes_to_stdout_outside_a_node) {
  ::testing::internal::CaptureStdout();
  EXPECT_EQ(irp::printf("%d %s\n", 5, std::string(1000, 'x')), 1003);
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "5 " + std::string(1000, 'x') + "\n");
}

TEST(Printf, Tells_that_the_ring_is_full) {
  TestNode node;
  const Hosted hosted(node);
  int printed_lines = 0;
  while (irp::printf("line\n") > 0) {
    ++printed_lines;
  }
  EXPECT_EQ(printed_lines, 8);
  EXPECT_EQ(node.module(0).lost_messages, 1U);
}

TEST(Property, Converts_to_the_type_asked_for) {
  TestNode node({{"m",
                  {},
                  0,
                  {{"intialize value", "5"},
                   {"hex", " 0x1F "},
                   {"gain", "2.5"},
                   {"on", "true"},
                   {"off", "off"},
                   {"config", "/etc/io.xml"},
                   {"minus", "-128"},
                   {"empty", ""}},
                  ""}});
  const Hosted hosted(node);
  EXPECT_EQ(irp::property<int>("intialize value", 0), 5);
  EXPECT_EQ(irp::property("hex", 0U), 31U);
  EXPECT_DOUBLE_EQ(irp::property("gain", 0.0), 2.5);
  EXPECT_FLOAT_EQ(irp::property("gain", 0.0F), 2.5F);
  EXPECT_DOUBLE_EQ(irp::property("intialize value", 0.0), 5.0);
  EXPECT_TRUE(irp::property("on", false));
  EXPECT_FALSE(irp::property("off", true));
  EXPECT_EQ(irp::property("config", "none"), "/etc/io.xml");
  EXPECT_EQ(irp::property<std::string>("empty", "none"), "");
  EXPECT_EQ(irp::property<indurop::string<32>>("config", "none"), "/etc/io.xml");
  EXPECT_EQ(irp::property<std::int8_t>("minus", 0), -128);
  EXPECT_EQ(indurop::property("absent", 17), 17);
  EXPECT_EQ(irp::property("absent", "none"), "none");
  EXPECT_EQ(printed(node), "");
}

TEST(Property, Of_wrong_form_gives_the_default_and_one_message) {
  TestNode node(
      {{"m", {}, 0, {{"counter", "5x"}, {"big", "300"}, {"minus", "-129"}, {"flag", "maybe"}, {"sign", "-1"}}, ""}});
  const Hosted hosted(node);
  EXPECT_EQ(irp::property("counter", 3), 3);
  EXPECT_EQ(irp::property("counter", 3), 3);
  EXPECT_EQ(printed(node),
            "module m: property 'counter' is \"5x\", expected a whole number from -2147483648 to 2147483647: using the "
            "default\n");
  EXPECT_EQ(irp::property<std::uint8_t>("big", 1), 1);
  EXPECT_EQ(irp::property<std::int8_t>("minus", 1), 1);
  EXPECT_EQ(irp::property("sign", 2U), 2U);
  EXPECT_DOUBLE_EQ(irp::property("counter", 0.5), 0.5);
  EXPECT_TRUE(irp::property("flag", true));
  EXPECT_NE(printed(node).find("property 'flag' is \"maybe\", expected true or false"), std::string::npos);
}

TEST(Property, Outside_a_node_is_the_default) {
  EXPECT_EQ(irp::property("counter", 3), 3);
}

TEST(Schedule, Of_a_thread_module_is_that_of_its_run_however_late) {
  TestNode node({{"m", {}, 5'000'000, {}, ""}, {"event", {}, 0, {}, ""}});
  const Hosted hosted(node);
  node.run().epoch_ns = 1000;
  node.run().tick = 14;  // tick 13 was begun last
  indurop::runtime::set_current_run(0, {12, 1000 + 12'000'000});
  EXPECT_EQ(irp::period(), std::chrono::milliseconds(5));
  EXPECT_EQ(irp::tick(), 12U);
  EXPECT_EQ(irp::release_ns(), 1000 + 12'000'000);
  indurop::runtime::set_current_module(1);
  EXPECT_EQ(irp::period(), std::chrono::nanoseconds(0));
  EXPECT_EQ(irp::tick(), 13U) << "on no run";
  EXPECT_EQ(irp::release_ns(), 1000 + 13'000'000);
  EXPECT_FALSE(irp::stop_requested());
  node.run().state = indurop::scheduler::NodeState::Stopping;
  EXPECT_TRUE(irp::stop_requested());
}

TEST(Schedule, Is_moved_by_a_hundredth_of_the_period_at_most) {
  using std::chrono::nanoseconds;
  TestNode node;
  const Hosted hosted(node);
  auto& run = node.run();
  const std::int64_t before = run.epoch_ns;
  irp::shift_ticks(nanoseconds(3));
  irp::shift_ticks(nanoseconds(-13));
  EXPECT_EQ(run.epoch_ns, before - 10);
  irp::shift_ticks(nanoseconds(run.basic_period_ns));
  EXPECT_EQ(run.epoch_ns, before - 10 + run.basic_period_ns / 100);
  indurop::runtime::set_current_module(indurop::runtime::kNoModule);
  irp::shift_ticks(nanoseconds(1));
  EXPECT_EQ(run.epoch_ns, before - 10 + run.basic_period_ns / 100);
}

TEST(Schedule, Shows_the_pulses_of_devices) {
  using std::chrono::nanoseconds;
  TestNode node;
  const Hosted hosted(node);
  irp::report_pulse(nanoseconds(250'100), nanoseconds(250'000));
  EXPECT_EQ(node.run().pulse_after_ns, 250'100);
  EXPECT_EQ(node.run().pulse_wanted_ns, 250'000);
  indurop::runtime::set_current_module(indurop::runtime::kNoModule);
  irp::report_pulse(nanoseconds(1), nanoseconds(1));
  EXPECT_EQ(node.run().pulse_after_ns, 250'100);
}

TEST(Schedule, Outside_a_node_is_empty) {
  irp::shift_ticks(std::chrono::nanoseconds(1));
  irp::report_pulse(std::chrono::nanoseconds(1), std::chrono::nanoseconds(1));
  EXPECT_EQ(irp::period(), std::chrono::nanoseconds(0));
  EXPECT_EQ(irp::tick(), 0U);
  EXPECT_EQ(irp::release_ns(), 0);
  EXPECT_FALSE(irp::stop_requested());
  EXPECT_GT(irp::now_ns(), 0);
}

}  // namespace
