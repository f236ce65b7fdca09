// SPDX-License-Identifier: Apache-2.0
// Function block diagrams, run: data flow, feedback, order of execution, connectors.

#include <indurop/indurop.h>

#include <gtest/gtest.h>
#include <plc_test_beremiz_mixed.glb.h>

#include "tests/unit/control/plc/program/module.h"

namespace indurop {
namespace {

using std::chrono_literals::operator""ms;  // NOLINT(misc-unused-using-decls): clang-tidy does not see its use
using testing::PlcModule;
namespace mixed = plc_test_beremiz_mixed;

TEST(PlcDiagram, Feedback_brings_the_value_of_the_last_scan) {
  const PlcModule sut("plc_test_beremiz_mixed_fast");
  // 200 ms until the lamp goes on. Off sees that On is off a scan later, and On that Off is off a scan after that.
  int changes = 0;
  bool before = false;
  for (auto at = 0ms; at <= 2000ms; at += 10ms) {
    sut.scan(at);
    changes += mixed::loop0_Flash.get() != before ? 1 : 0;
    before = mixed::loop0_Flash.get();
    EXPECT_EQ(mixed::loop0_Flash.get(), at >= 200ms && (at - 200ms).count() % 420 < 210) << at.count();
    EXPECT_EQ(mixed::loop0_A.get(), !mixed::loop0_Flash.get()) << "through the connector, negated";
  }
  EXPECT_EQ(changes, 9);
}

TEST(PlcDiagram, A_variable_in_the_middle_of_a_network_is_written_before_it_is_read) {
  const PlcModule sut("plc_test_beremiz_mixed_slow");
  mixed::Go = false;  // reset: the counter stands at First
  sut.scan();
  mixed::Go = true;
  for (int i = 0; i < 97; ++i) {
    sut.scan();
  }
  EXPECT_EQ(mixed::main0_Sum.get(), 0) << "the counter is at 100";
  sut.scan();
  EXPECT_EQ(mixed::main0_Sum.get(), 1);
}

}  // namespace
}  // namespace indurop
