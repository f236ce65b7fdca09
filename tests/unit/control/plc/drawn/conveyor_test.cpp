// SPDX-License-Identifier: Apache-2.0
// The example of the documentation, and what a module built with --watch tells about its power.

#include <indurop/indurop.h>

#include <gtest/gtest.h>
#include <plc_test_conveyor.glb.h>

#include "control/plc/front/watch_plan.h"
#include "control/plc/print/live.h"
#include "tests/unit/control/plc/program/module.h"

namespace indurop {
namespace {

using std::chrono_literals::operator""ms;  // NOLINT(misc-unused-using-decls): clang-tidy does not see its use
using testing::PlcModule;
namespace belt = plc_test_conveyor;

class PlcConveyor : public ::testing::Test {
 protected:
  PlcConveyor() {
    belt::start = false;
    belt::stop = false;
    belt::box_sensor = false;
    belt::pallet_changed = true;
    belt::acknowledge = false;
    scan(1);
    belt::pallet_changed = false;
  }
  void scan(int count) {
    for (int i = 0; i < count; ++i) {
      sut_.scan(at_);
      at_ += 10ms;
    }
  }

  PlcModule sut_{"plc_test_conveyor"};
  std::chrono::milliseconds at_{0};
};

TEST_F(PlcConveyor, The_motor_follows_the_horn) {
  belt::start = true;
  scan(1);
  belt::start = false;
  EXPECT_TRUE(belt::horn.get());
  scan(199);
  EXPECT_FALSE(belt::motor.get());
  scan(1);
  EXPECT_TRUE(belt::motor.get()) << "2 s later";
  EXPECT_FALSE(belt::horn.get());
  belt::stop = true;
  scan(1);
  EXPECT_FALSE(belt::motor.get());
}

TEST_F(PlcConveyor, Twelve_boxes_are_a_pallet) {
  for (int i = 1; i <= 12; ++i) {
    belt::box_sensor = true;
    scan(3);
    belt::box_sensor = false;
    scan(3);
    EXPECT_EQ(belt::count.get(), i);
    EXPECT_EQ(belt::pallet_full.get(), i == 12);
  }
}

TEST_F(PlcConveyor, A_jam_stops_it_until_acknowledged) {
  belt::start = true;
  scan(202);
  belt::start = false;
  belt::box_sensor = true;
  scan(302);
  EXPECT_FALSE(belt::motor.get());
  belt::box_sensor = false;
  belt::start = true;
  scan(300);
  EXPECT_FALSE(belt::motor.get());
  belt::acknowledge = true;
  scan(1);
  scan(202);
  EXPECT_TRUE(belt::motor.get());
}

TEST_F(PlcConveyor, The_power_of_every_line_is_reported) {
  plc::CompileOptions options;
  options.files = {PLC_CONVEYOR};
  options.name = "belt";
  plc::WatchPlan plan = plc::watch_plan(options);
  ASSERT_TRUE(plan.ok);
  plc::Diagnostics diagnostics;
  const auto bodies = plc::live_bodies(plan.document, "", diagnostics);
  ASSERT_EQ(bodies.size(), 1U);
  const plc::LiveBody& program = bodies.front();
  const plc::WatchedVariable* flow = plan.layouts.front().find(plc::upper(program.flow_variable));
  ASSERT_NE(flow, nullptr);
  const auto bit = [&](std::size_t number) { return belt::instance_watch[flow->offset + number].get() != 0; };
  belt::start = true;
  scan(5);
  plc::LivePower live(program, bit, [](const std::string&) { return std::string(); });
  std::size_t contacts = 0;
  std::size_t coils = 0;
  for (const plc::network::Element* element : program.sheet->order.elements) {
    const bool coil = element->kind == plc::network::Element::Kind::Coil;
    if (element->kind != plc::network::Element::Kind::Contact && !coil) {
      continue;
    }
    const bool open = element->text == "box_sensor" || element->text == "pallet_changed" ||
                      element->text == "acknowledge" || (element->text == "motor" && !element->negated);
    const bool flows = element->text == "start" || element->text == "belt" || element->text == "stop" ||
                       (element->text == "fault" && element->negated) || element->text == "horn" ||
                       (element->text == "motor" && element->negated);
    EXPECT_TRUE(coil || live.closed(*element) == !open) << element->text << element->id;
    EXPECT_EQ(live.powered({element, nullptr}), flows) << element->text << element->id;
    ++(coil ? coils : contacts);
  }
  EXPECT_EQ(contacts, 12U);
  EXPECT_EQ(coils, 6U);
  EXPECT_LT(program.power.size(), contacts + coils) << "what a view derives is not reported";
}

}  // namespace
}  // namespace indurop
