// SPDX-License-Identifier: Apache-2.0
// The chapter's thread modules as files that are loaded like the node does it. All use one libindurop.so, so without a
// node they and this program share the private memory of their variables.

#include <dlfcn.h>
#include <gtest/gtest.h>
#include <indurop/generated.h>
#include <indurop/indurop.h>

#include <cstdlib>

namespace {

// A node named "local" may be running on this machine; a generated header looks for it at priority 101.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wprio-ctor-dtor"
[[gnu::constructor(100)]] void keep_away_from_others() {
  ::setenv("INDUROP_NODE", "rttest-none", 0);
}
#pragma GCC diagnostic pop

class Module {
 public:
  explicit Module(const char* file) : handle_(::dlopen(file, RTLD_NOW | RTLD_LOCAL)) {
    EXPECT_NE(handle_, nullptr) << ::dlerror();
    if (auto* describe = symbol<void (*)(indurop::ModuleDescriptor*)>("indurop_module_describe")) {
      describe(&descriptor);
    }
  }
  ~Module() { ::dlclose(handle_); }
  Module(const Module&) = delete;
  Module& operator=(const Module&) = delete;
  template <class Function>
  Function symbol(const char* name) {
    return reinterpret_cast<Function>(::dlsym(handle_, name));
  }

  indurop::ModuleDescriptor descriptor;

 private:
  void* handle_;
};

TEST(Figures4And5, Run_on_shared_variables) {
  Module modify(MODIFY_MODULE);
  Module output(OUTPUT_MODULE);
  ASSERT_NE(modify.descriptor.run, nullptr);
  ASSERT_NE(output.descriptor.run, nullptr);
  modify.descriptor.run();
  modify.descriptor.run();
  EXPECT_EQ(knu::Robot::tick, 20U);
  EXPECT_EQ(knu::Robot::joints[0].x, 30.0);
  ::testing::internal::CaptureStdout();
  output.descriptor.run();
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "joints[0] = {30.000000, 30.000000, 30.000000}\n");
}

TEST(Figure7, Decides_by_its_variable) {
  Module event(EVENT_MODULE);
  auto* condition = event.symbol<int (*)()>("condition");
  ASSERT_NE(condition, nullptr);
  joint[0].x = 179.5;
  EXPECT_EQ(condition(), 0);
  joint[0].x = 180;
  EXPECT_EQ(condition(), 1);
  EXPECT_NE(event.symbol<void (*)()>("run"), nullptr);
}

TEST(Figure13, Works_on_the_variables_of_figure_11) {
  Module robot(FIGURE13_MODULE);
  auto* start = robot.symbol<void (*)()>("start");
  auto* run = robot.symbol<void (*)()>("run");
  ASSERT_TRUE(start != nullptr && run != nullptr);
  start();
  EXPECT_EQ(PLC_ROBOT::ROBOT_MODULE_STATE.eState, 3);
  EXPECT_EQ(PLC_ROBOT::ROBOT_MODULE_SERVICE.eOpCode, 11);
  PLC_ROBOT::AXIS1_OUT.position = 1;
  PLC_ROBOT::ROBOT_MODULE_STATE.MotionDone = 1;
  run();
  EXPECT_EQ(PLC_ROBOT::ROBOT_MODULE_STATE.dCurJoint[5], 5U);
  EXPECT_EQ(PLC_ROBOT::AXIS1_OUT.position, 0);
  EXPECT_EQ(PLC_ROBOT::msgRobotServiceEditNum, 0);
}

}  // namespace
