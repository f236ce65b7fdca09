// SPDX-License-Identifier: Apache-2.0
// What ends a compiled program, and what it says: faults.st.

#include <indurop/indurop.h>

#include <gtest/gtest.h>
#include <plc_test_faults.glb.h>

#include "module.h"

namespace v = plc_test_faults;

TEST(PlcFault, Names_place_reason_and_pou) {
  const indurop::testing::PlcModule sut("plc_test_faults");
  const auto fault_of = [&](std::int16_t number) {
    v::which = number;
    return sut.fault();
  };
  EXPECT_EQ(fault_of(0), "");
  EXPECT_EQ(fault_of(1), "faults.st:26:15: division by zero in main");
  EXPECT_EQ(fault_of(2), "faults.st:27:15: MOD by zero in main");
  EXPECT_EQ(fault_of(3), "faults.st:28:13: index 11 is outside of 1..10 in main");
  EXPECT_EQ(fault_of(4), "faults.st:29:25: value 110 is outside of 0..100 in main");
  EXPECT_EQ(fault_of(5), "faults.st:13:15: division by zero in Inner");
  EXPECT_EQ(fault_of(6), "faults.st:31:17: division by zero in main");
}

TEST(PlcFault, A_scan_that_faults_publishes_nothing) {
  const indurop::testing::PlcModule sut("plc_test_faults");
  v::which = 0;
  sut.scan();
  v::which = 1;
  EXPECT_NE(sut.fault(), "");
  EXPECT_EQ(v::written.get(), 0);
}
