// SPDX-License-Identifier: Apache-2.0
// An instruction list, run: the accumulator, brackets, set and reset, conditional calls and returns.

#include <indurop/indurop.h>

#include <gtest/gtest.h>
#include <plc_test_instruction_list.glb.h>

#include "tests/unit/control/plc/program/module.h"

namespace indurop {
namespace {

using std::chrono_literals::operator""ms;  // NOLINT(misc-unused-using-decls): clang-tidy does not see its use
using testing::PlcModule;
namespace list = plc_test_instruction_list;

TEST(PlcList, Operators_work_from_left_to_right) {
  const PlcModule sut("plc_test_instruction_list");
  for (unsigned bits = 0; bits < 8; ++bits) {
    const bool a = (bits & 1U) != 0;
    const bool b = (bits & 2U) != 0;
    const bool c = (bits & 4U) != 0;
    list::Logic_a = a;
    list::Logic_b = b;
    list::Logic_c = c;
    list::Logic_x = -20;
    list::Logic_y = 0;
    sut.scan();
    const bool new_c = (a || b) && c;
    const bool new_a = !new_c;
    const bool set_b = (new_a && !(b || new_c)) != !new_a;
    EXPECT_EQ(list::Logic_c.get(), new_c) << bits;
    EXPECT_EQ(list::Logic_a.get(), new_a) << bits << " (-20 + 1) * 2 is not above 10";
    EXPECT_EQ(list::Logic_b.get(), b || set_b) << bits;
  }
}

TEST(PlcList, What_was_stored_stays_in_the_accumulator) {
  const PlcModule sut("plc_test_instruction_list");
  list::Logic_a = false;
  list::Logic_b = false;
  list::Logic_c = false;
  list::Logic_x = 4;
  list::Logic_y = 1;
  sut.scan();
  // x := (4 + 1) * (1 + 2), above 10: a is reset. y := LIMIT(15, 0, 10); x := ABS(MAX(15, 3) - y).
  EXPECT_FALSE(list::Logic_a.get());
  EXPECT_EQ(list::Logic_y.get(), 10);
  EXPECT_EQ(list::Logic_x.get(), 5);
}

}  // namespace
}  // namespace indurop
