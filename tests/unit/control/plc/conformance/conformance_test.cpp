// SPDX-License-Identifier: Apache-2.0
// Programs in Structured Text that test the language and its library themselves: each is compiled to a module as a
// user's would be, loaded, and run scan by scan in a time made here; then the expectations it has counted are looked
// at.

#include <gtest/gtest.h>
#include <indurop/generated.h>
#include <indurop/indurop.h>

#include <chrono>
#include <string>

#include "tests/unit/control/plc/program/module.h"

namespace {

using indurop::testing::PlcModule;

// One of the programs, in a time that begins somewhere and goes on from scan to scan.
class Program {
 public:
  explicit Program(const std::string& name) : module_(name) {
    conformance::checks = 0;
    conformance::failed = 0;
    conformance::first_failed = "";
    conformance::scans = 0;
    conformance::finished = false;
  }
  void scan() {
    module_.scan(now_);
    now_ += std::chrono::milliseconds(10);
  }
  [[nodiscard]] std::string fault() const { return module_.fault(); }

 private:
  PlcModule module_;
  std::chrono::nanoseconds now_{987'654'321'000};
};

class PlcConformance : public testing::TestWithParam<const char*> {};

TEST_P(PlcConformance, Every_expectation_of_the_program_is_met) {
  Program sut(GetParam());
  constexpr int kMostScans = 20;
  while (!HasFailure() && !conformance::finished && conformance::scans < kMostScans) {
    sut.scan();
  }
  EXPECT_TRUE(conformance::finished);
  EXPECT_GT(conformance::checks, 0);
  EXPECT_EQ(conformance::failed, 0) << "first: " << conformance::first_failed.get().c_str();
}

INSTANTIATE_TEST_SUITE_P(Programs, PlcConformance, testing::Values(PLC_PROGRAMS),
                         [](const auto& program) { return std::string(program.param); });

std::string fault_of(int which) {
  const Program sut("faults");
  conformance::which = which;
  const std::string fault = sut.fault();
  return fault.empty() ? "no fault" : fault;
}

TEST(PlcFaults, Name_their_place) {
  struct Row {
    int which;
    const char* text;
  };
  for (const auto& [which, text] :
       {Row{0, "no fault"},
        Row{1, "faults.st:41:21: division by zero in Main"},
        Row{2, "faults.st:42:21: MOD by zero in Main"},
        Row{3, "faults.st:43:17: division by zero in Main"},
        Row{4, "faults.st:44:23: division by zero in Main"},
        Row{5, "faults.st:9:17: division by zero in Quotient"},
        Row{6, "faults.st:46:13: index 5 is outside of 1..2 in Main"},
        Row{7, "faults.st:47:29: index 0 is outside of 1..3 in Main"},
        Row{8, "faults.st:16:18: index 5 is outside of -2..2 in Picker"},
        Row{9, "faults.st:49:22: value 105 is outside of 0..100 in Main"},
        Row{10, "faults.st:55:17: selector K of MUX 5 is outside of 0..2 in Main"},
        Row{11, "faults.st:54:9: value 101 is outside of 0..100 in Main"},
        Row{12, "faults.st:56:9: a pointer that is NULL is used in Main"},
        Row{13, "faults.st:59:9: the byte a pointer leads to 12 is outside of 0..10 in Main"},
        Row{14, "faults.st:63:17: the byte a pointer leads to 12 is outside of 0..10 in Main"},
        Row{15, "faults.st:66:9: a pointer leads to a place where no value of its type can lie in Main"},
        Row{16, "faults.st:67:9: a pointer that is NULL is used in Main"},
        Row{17, "faults.st:68:18: a pointer that is NULL is used in Main"},
        Row{18, "faults.st:69:9: a method of an interface variable that is NULL is called in Main"},
        Row{19, "faults.st:86:8: more than 100 calls of methods inside each other (recursion) in Ring.Step"},
        Row{20, "faults.st:94:14: index 4 is outside of 1..3 in Element"},
        Row{21, "faults.st:118:24: a pointer to a variable of a call that has ended is used in Keeper.Use"},
        Row{22, "faults.st:119:29: a pointer to a variable of a call that has ended is used in Keeper.Use"},
        Row{23, "faults.st:75:59: a pointer to a variable of a call that has ended is used in Main"},
        Row{24, "faults.st:100:28: a pointer to a variable of a call that has ended is used in Keeper"}}) {
    EXPECT_EQ(fault_of(which), text) << which;
  }
}

TEST(PlcFaults, A_scan_that_faults_writes_nothing) {
  Program sut("faults");
  conformance::which = 0;
  sut.scan();
  conformance::which = 1;
  EXPECT_ANY_THROW(sut.scan());
  EXPECT_EQ(conformance::scans, 1);
}

}  // namespace
