// SPDX-License-Identifier: Apache-2.0
// SR, RS, SEMA and edges: tables of inputs and expected outputs, call by call.

#include <gtest/gtest.h>
#include <indurop/plc/bistables.h>

namespace indurop::iec {
namespace {

constexpr Scan kScan{};

TEST(PlcSr, Set_dominates) {
  struct Row {
    bool s1, r, q1;
  };
  Sr sut;
  for (const auto& [s1, r, q1] : {Row{false, false, false}, Row{true, false, true}, Row{false, false, true},
                                  Row{false, true, false}, Row{true, true, true}, Row{false, true, false}}) {
    sut.s1 = s1;
    sut.r = r;
    sut(kScan);
    EXPECT_EQ(sut.q1, q1) << s1 << r;
  }
}

TEST(PlcRs, Reset_dominates) {
  struct Row {
    bool s, r1, q1;
  };
  Rs sut;
  for (const auto& [s, r1, q1] : {Row{false, false, false}, Row{true, false, true}, Row{false, false, true},
                                  Row{true, true, false}, Row{false, false, false}, Row{true, false, true}}) {
    sut.s = s;
    sut.r1 = r1;
    sut(kScan);
    EXPECT_EQ(sut.q1, q1) << s << r1;
  }
}

TEST(PlcSema, Only_the_first_claim_finds_it_free) {
  struct Row {
    bool claim, release, busy;
  };
  Sema sut;
  for (const auto& [claim, release, busy] :
       {Row{false, false, false}, Row{true, false, false}, Row{true, false, true}, Row{false, false, true},
        Row{false, true, false}, Row{false, false, false}, Row{true, true, false}, Row{false, false, true}}) {
    sut.claim = claim;
    sut.release = release;
    sut(kScan);
    EXPECT_EQ(sut.busy, busy) << claim << release;
  }
}

struct EdgeRow {
  bool clk, q;
};

template <class Block>
void check(std::initializer_list<EdgeRow> rows) {
  Block sut;
  int call = 0;
  for (const auto& [clk, q] : rows) {
    sut.clk = clk;
    sut(kScan);
    EXPECT_EQ(sut.q, q) << "call " << ++call;
  }
}

TEST(PlcRTrig, Shows_the_rising_edge_for_one_call) {
  check<RTrig>({{false, false}, {true, true}, {true, false}, {false, false}, {true, true}, {false, false}});
}

TEST(PlcRTrig, An_input_that_is_true_from_the_start_is_an_edge) {
  check<RTrig>({{true, true}, {true, false}, {false, false}});
}

TEST(PlcFTrig, Shows_the_falling_edge_for_one_call) {
  check<FTrig>({{true, false}, {false, true}, {false, false}, {true, false}, {true, false}, {false, true}});
}

TEST(PlcFTrig, An_input_that_is_false_from_the_start_is_an_edge) {
  check<FTrig>({{false, true}, {false, false}, {true, false}});
}

}  // namespace
}  // namespace indurop::iec
