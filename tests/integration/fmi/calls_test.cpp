// SPDX-License-Identifier: Apache-2.0
// What a master may do wrong, or what goes wrong below it: an error with a text, never a crash.

#include <gmock/gmock.h>
#include <unistd.h>

#include <csignal>
#include <limits>
#include <random>

#include "store/vars/node_lock.h"
#include "store/vars/store.h"
#include "tests/integration/fmi/running2.h"
#include "tests/support/forked.h"
#include "tests/support/wait_until.h"

namespace indurop::fmi {
namespace {

using ::testing::HasSubstr;

const std::string kTypes = TYPES;

TEST(FmuCalls, Null_pointers_and_unknown_references_are_errors) {
  const Fmu about(kTypes, "types.xml", 2);
  Running2 fmu(about);
  ASSERT_NO_FATAL_FAILURE(fmu.initialize());
  const Master2& m = fmu.master;
  double value = 0;
  unsigned int reference = 0;
  EXPECT_EQ(m.step(nullptr, 0, 1, fmi2True), fmi2Error);
  EXPECT_EQ(m.get_real(nullptr, &reference, 1, &value), fmi2Error);
  EXPECT_EQ(m.terminate(nullptr), fmi2Error);
  m.free_instance(nullptr);
  EXPECT_EQ(m.get_real(fmu.instance, nullptr, 1, &value), fmi2Error);
  EXPECT_EQ(m.get_real(fmu.instance, &reference, 1, nullptr), fmi2Error);
  EXPECT_EQ(m.get_real(fmu.instance, nullptr, 0, nullptr), fmi2OK);
  for (const unsigned int unknown : {0U, 100'000U, 0xffffffffU}) {
    EXPECT_EQ(m.get_real(fmu.instance, &unknown, 1, &value), fmi2Error);
    EXPECT_EQ(m.set_real(fmu.instance, &unknown, 1, &value), fmi2Error);
    EXPECT_THAT(fmu.log, HasSubstr("there is no variable with value reference " + std::to_string(unknown)));
  }
  reference = about.reference("kinds::in.i8");
  EXPECT_EQ(m.get_real(fmu.instance, &reference, 1, &value), fmi2Error);
  EXPECT_THAT(fmu.log, HasSubstr("test 3 logStatusError: fmi2GetReal: kinds::in.i8 (value reference"));
  reference = about.reference("kinds::in.text");
  const char* text = nullptr;
  EXPECT_EQ(m.set_string(fmu.instance, &reference, 1, &text), fmi2Error);
  EXPECT_EQ(m.get_real_status(fmu.instance, fmi2LastSuccessfulTime, nullptr), fmi2Discard);
  EXPECT_EQ(m.get_state(fmu.instance, nullptr), fmi2Error);
  EXPECT_THAT(fmu.log, HasSubstr("canGetAndSetFMUstate is false"));
  EXPECT_EQ(m.cancel_step(fmu.instance), fmi2Error);
  EXPECT_EQ(m.set_time(fmu.instance, 0), fmi2Error);
  EXPECT_EQ(fmu.step(0, 1e-3), fmi2OK) << "none of that ended it";
}

TEST(FmuCalls, The_order_of_states_is_kept) {
  const Fmu about(kTypes, "types.xml", 2);
  Running2 fmu(about);
  ASSERT_NE(fmu.instance, nullptr) << fmu.log;
  const Master2& m = fmu.master;
  double value = 1;
  const unsigned int input = about.reference("kinds::in.f64");
  EXPECT_EQ(fmu.step(0, 1e-3), fmi2Error);
  EXPECT_EQ(m.exit_initialization(fmu.instance), fmi2Error);
  EXPECT_EQ(m.terminate(fmu.instance), fmi2Error);
  EXPECT_EQ(m.get_real(fmu.instance, &input, 1, &value), fmi2Error);
  EXPECT_EQ(m.set_real(fmu.instance, &input, 1, &value), fmi2OK) << fmu.log;
  EXPECT_EQ(m.set_up(fmu.instance, fmi2False, 0, 1, fmi2True, 0.5), fmi2Error);
  EXPECT_EQ(m.set_up(fmu.instance, fmi2True, 1e-6, 1, fmi2True, 1.01), fmi2OK);
  EXPECT_EQ(m.enter_initialization(fmu.instance), fmi2OK);
  EXPECT_EQ(m.enter_initialization(fmu.instance), fmi2Error);
  EXPECT_EQ(fmu.step(1, 1e-3), fmi2Error);
  EXPECT_EQ(fmu.get("kinds::in.f64"), 1);
  EXPECT_EQ(m.exit_initialization(fmu.instance), fmi2OK);
  EXPECT_EQ(m.set_up(fmu.instance, fmi2False, 0, 0, fmi2False, 0), fmi2Error);
  EXPECT_EQ(fmu.step(1, 0), fmi2Error);
  EXPECT_EQ(fmu.step(1, -1e-3), fmi2Error);
  EXPECT_EQ(fmu.step(1, std::numeric_limits<double>::quiet_NaN()), fmi2Error);
  EXPECT_EQ(fmu.step(0.5, 1e-3), fmi2Error);
  EXPECT_THAT(fmu.log, HasSubstr("time neither jumps nor goes back"));
  EXPECT_EQ(fmu.step(1, 1), fmi2Error);
  EXPECT_THAT(fmu.log, HasSubstr("beyond the stop time of 1.01 s"));
  EXPECT_EQ(fmu.step(1, 1e-2), fmi2OK) << fmu.log;
  EXPECT_EQ(fmu.get("kinds::runs"), 10);
  EXPECT_EQ(fmu.set_real("kinds::out.f64", 1), fmi2Error);
  EXPECT_THAT(fmu.log, HasSubstr("kinds::out.f64 (value reference"));
}

// The yardstick is the table of states of the standard (FMI 2.0, section 4.2.4).
TEST(FmuCalls, Any_order_of_calls_is_answered_as_the_standard_says) {
  enum class State { Instantiated, Initialization, Step, Terminated };
  const Fmu about(kTypes, "types.xml", 2);
  Running2 fmu(about);
  ASSERT_NE(fmu.instance, nullptr) << fmu.log;
  const Master2& m = fmu.master;
  const unsigned int reference = about.reference("kinds::in.f64");
  std::mt19937 random(11);
  State state = State::Instantiated;
  double now = 0;
  double value = 0;
  const auto move = [&state](fmi2Status status, State from, State to) {
    ASSERT_EQ(status == fmi2OK, state == from);
    state = status == fmi2OK ? to : state;
  };
  for (int call = 0; call < 2000; ++call) {
    fmu.log.clear();
    switch (random() % 16) {
      case 0:
        move(m.enter_initialization(fmu.instance), State::Instantiated, State::Initialization);
        break;
      case 1:
        move(m.exit_initialization(fmu.instance), State::Initialization, State::Step);
        break;
      case 2:
        if (random() % 8 == 0) {
          move(m.terminate(fmu.instance), State::Step, State::Terminated);
        }
        break;
      case 3:
        if (random() % 4 == 0) {
          ASSERT_EQ(m.reset(fmu.instance), fmi2OK) << fmu.log;
          state = State::Instantiated;
          now = 0;
        }
        break;
      case 4:
        ASSERT_EQ(m.set_up(fmu.instance, fmi2False, 0, 0, fmi2False, 0) == fmi2OK, state == State::Instantiated);
        break;
      case 5:
      case 6:
      case 7:
        ASSERT_EQ(m.set_real(fmu.instance, &reference, 1, &value) == fmi2OK, state != State::Terminated);
        break;
      case 8:
      case 9:
      case 10:
        ASSERT_EQ(m.get_real(fmu.instance, &reference, 1, &value) == fmi2OK, state != State::Instantiated);
        break;
      default:
        ASSERT_EQ(fmu.step(now, 1e-3) == fmi2OK, state == State::Step) << fmu.log;
        now += state == State::Step ? 1e-3 : 0;
    }
    ASSERT_FALSE(::testing::Test::HasFatalFailure()) << "call " << call << ": " << fmu.log;
  }
}

TEST(FmuCalls, What_a_variable_does_not_take_is_discarded) {
  const Fmu about(kTypes, "types.xml", 2);
  Running2 fmu(about);
  ASSERT_NO_FATAL_FAILURE(fmu.initialize());
  EXPECT_EQ(fmu.set_real("kinds::limited", 4.5), fmi2Discard);
  EXPECT_THAT(fmu.log, HasSubstr("4.5 is outside -1.5..4"));
  EXPECT_EQ(fmu.get("kinds::limited"), 2.5);
  EXPECT_EQ(fmu.set_real("kinds::in.u64", -1), fmi2Discard);
  EXPECT_EQ(fmu.set_real("kinds::in.u64", 1.5), fmi2Discard);
  EXPECT_EQ(fmu.set_real("kinds::in.i64", 9223372036854775808.0), fmi2Discard);
  EXPECT_EQ(fmu.set_real("kinds::in.f32", 1e300), fmi2Discard);
  const auto set_integer = [&](const std::string& name, int value) {
    const unsigned int reference = about.reference(name);
    return fmu.master.set_integer(fmu.instance, &reference, 1, &value);
  };
  EXPECT_EQ(set_integer("kinds::in.i8", 128), fmi2Discard);
  EXPECT_EQ(set_integer("kinds::in.i8", -128), fmi2OK);
  EXPECT_EQ(set_integer("kinds::in.mode", 3), fmi2Discard);
  EXPECT_THAT(fmu.log, HasSubstr("kinds::in.mode has no item 3"));
  EXPECT_EQ(set_integer("kinds::in.mode", 2), fmi2OK);
  const unsigned int text = about.reference("kinds::in.text");
  const char* words = "0123456789abcdef";
  EXPECT_EQ(fmu.master.set_string(fmu.instance, &text, 1, &words), fmi2Discard);
  EXPECT_THAT(fmu.log, HasSubstr("holds 15 bytes of text, not 16"));
}

TEST(FmuCalls, Files_of_another_FMU_are_refused) {
  const Fmu about(kTypes, "types.xml", 2);
  Running2 other(about, "{0}");
  EXPECT_EQ(other.instance, nullptr);
  EXPECT_THAT(other.log, HasSubstr("its files are not those of one FMU"));
  Running2 elsewhere(about, {}, "file:///nowhere");
  EXPECT_NE(elsewhere.instance, nullptr) << "the resources next to the library are taken: " << elsewhere.log;
}

TEST(FmuCalls, A_module_that_faults_is_a_warning) {
  const Fmu about(kTypes, "types.xml", 2);
  Running2 fmu(about);
  ASSERT_NO_FATAL_FAILURE(fmu.initialize());
  EXPECT_EQ(fmu.set_real("kinds::faulty", 3), fmi2OK);
  EXPECT_EQ(fmu.step(0, 2e-3), fmi2OK) << fmu.log;
  EXPECT_EQ(fmu.step(2e-3, 2e-3), fmi2Warning);
  EXPECT_THAT(fmu.log, HasSubstr("module types_copy faulted: "));
  EXPECT_THAT(fmu.log, HasSubstr("as requested"));
  EXPECT_EQ(fmu.step(4e-3, 2e-3), fmi2OK) << "the others go on";
}

// The node of the only instance of an FMU in a process.
std::string only_node(pid_t master = ::getpid()) {
  for (const std::string& node : vars::list_nodes()) {
    if (node.starts_with("fmu-" + std::to_string(master) + "-")) {
      return node;
    }
  }
  return {};
}

TEST(FmuCalls, A_node_that_is_killed_is_an_error_until_the_reset) {
  const Fmu about(kTypes, "types.xml", 2);
  Running2 fmu(about);
  ASSERT_NO_FATAL_FAILURE(fmu.initialize());
  EXPECT_EQ(fmu.step(0, 1e-3), fmi2OK);
  const pid_t node = vars::running_node(only_node());
  ASSERT_GT(node, 0);
  ASSERT_EQ(::kill(node, SIGKILL), 0);
  EXPECT_EQ(fmu.step(1e-3, 1e-3), fmi2Error);
  EXPECT_THAT(fmu.log, HasSubstr("the node ended before tick 2"));
  double value = 0;
  const unsigned int reference = about.reference("kinds::in.f64");
  EXPECT_EQ(fmu.master.get_real(fmu.instance, &reference, 1, &value), fmi2Error);
  EXPECT_THAT(fmu.log, HasSubstr("the simulation has ended, reset or free the instance"));
  fmi2Boolean ended = fmi2False;
  EXPECT_EQ(fmu.master.get_boolean_status(fmu.instance, fmi2Terminated, &ended), fmi2OK);
  EXPECT_EQ(ended, fmi2True);
  ASSERT_EQ(fmu.master.reset(fmu.instance), fmi2OK) << fmu.log;
  ASSERT_NO_FATAL_FAILURE(fmu.initialize());
  EXPECT_EQ(fmu.step(0, 1e-3), fmi2OK) << fmu.log;
  EXPECT_EQ(fmu.get("kinds::runs"), 1);
}

TEST(FmuCalls, A_master_that_is_killed_leaves_no_node) {
  const Fmu about(kTypes, "types.xml", 2);
  test::Forked master([&about] {
    const Running2 fmu(about);
    for (;;) {
      ::pause();
    }
    return 0;
  });
  const pid_t pid = master.pid();
  ASSERT_TRUE(test::wait_until([pid] { return vars::running_node(only_node(pid)) != 0; }));
  const std::string node = only_node(pid);
  master.kill_and_wait();
  EXPECT_TRUE(test::wait_until([&node] { return vars::running_node(node) == 0; }));
  const Running2 next(about);
  // The next one removes its memory, unless one of another test is just doing that.
  EXPECT_TRUE(test::wait_until([pid] { return only_node(pid).empty(); }));
}

TEST(FmuCalls, A_master_may_ignore_what_becomes_of_its_children) {
  const Fmu about(kTypes, "types.xml", 2);
  const auto before = std::signal(SIGCHLD, SIG_IGN);
  {
    Running2 fmu(about);
    ASSERT_NO_FATAL_FAILURE(fmu.initialize());
    EXPECT_EQ(fmu.step(0, 1e-3), fmi2OK) << fmu.log;
  }
  (void)std::signal(SIGCHLD, before);
  EXPECT_EQ(only_node(), "");
}

TEST(FmuCalls, Nothing_is_left_behind) {
  const Fmu about(kTypes, "types.xml", 2);
  {
    Running2 fmu(about);
    ASSERT_NO_FATAL_FAILURE(fmu.initialize());
    EXPECT_NE(only_node(), "");
  }
  EXPECT_EQ(only_node(), "");
}

TEST(FmuCalls, Node_and_modules_are_heard_if_the_master_wants_it) {
  const Fmu about(kTypes, "types.xml", 2);
  Running2 fmu(about);
  ASSERT_NO_FATAL_FAILURE(fmu.initialize());
  const char* category = "node";
  EXPECT_EQ(fmu.master.set_logging(fmu.instance, fmi2True, 1, &category), fmi2OK);
  EXPECT_EQ(fmu.step(0, 1e-3), fmi2OK);
  EXPECT_THAT(fmu.log, HasSubstr("test 0 node: "));
  category = "nodes";
  EXPECT_EQ(fmu.master.set_logging(fmu.instance, fmi2True, 1, &category), fmi2Error);
}

}  // namespace
}  // namespace indurop::fmi
