// SPDX-License-Identifier: Apache-2.0
// CTU, CTD, CTUD: tables of inputs and expected outputs, and the ends of the counted types.

#include <gtest/gtest.h>
#include <indurop/plc/counters.h>

#include <array>
#include <cstring>
#include <initializer_list>

namespace indurop::iec {
namespace {

constexpr Scan kCountingScan{};
using Int = std::int16_t;

TEST(PlcCtu, Counts_rising_edges_up_to_the_preset_and_on) {
  struct Row {
    bool cu, r, q;
    Int cv;
  };
  Ctu<Int> sut;
  sut.pv = 2;
  int call = 0;
  for (const auto& [cu, r, q, cv] : {Row{false, false, false, 0}, Row{true, false, false, 1},
                                     Row{true, false, false, 1}, Row{false, false, false, 1}, Row{true, false, true, 2},
                                     Row{false, false, true, 2}, Row{true, false, true, 3}, Row{false, true, false, 0},
                                     // An edge while reset is lost.
                                     Row{true, true, false, 0}, Row{true, false, false, 0}, Row{false, false, false, 0},
                                     Row{true, false, false, 1}}) {
    sut.cu = cu;
    sut.r = r;
    sut(kCountingScan);
    EXPECT_EQ(sut.q, q) << "call " << ++call;
    EXPECT_EQ(sut.cv, cv) << "call " << call;
  }
}

TEST(PlcCtu, An_input_that_is_true_from_the_start_counts) {
  Ctu<Int> sut;
  sut.cu = true;
  sut.pv = 1;
  sut(kCountingScan);
  EXPECT_EQ(sut.cv, 1);
  EXPECT_TRUE(sut.q);
}

TEST(PlcCtu, Without_a_preset_it_is_always_there) {
  Ctu<Int> sut;
  sut(kCountingScan);
  EXPECT_TRUE(sut.q);
}

template <class T>
class PlcCounter : public testing::Test {};
using Counted = testing::Types<std::int16_t, std::int32_t, std::int64_t, std::uint16_t, std::uint32_t, std::uint64_t>;
TYPED_TEST_SUITE(PlcCounter, Counted);

TYPED_TEST(PlcCounter, Stops_at_the_ends_of_its_type) {
  using Limits = std::numeric_limits<TypeParam>;
  Ctu<TypeParam> up;
  up.cv = Limits::max() - 1;
  up.pv = Limits::max();
  Ctd<TypeParam> down;
  down.cv = Limits::min() + 1;
  Ctud<TypeParam> both;
  both.cv = Limits::max();
  for (const bool level : {true, false, true, false, true}) {
    up.cu = down.cd = both.cu = level;
    up(kCountingScan);
    down(kCountingScan);
    both(kCountingScan);
  }
  EXPECT_EQ(up.cv, Limits::max());
  EXPECT_TRUE(up.q);
  EXPECT_EQ(down.cv, Limits::min());
  EXPECT_TRUE(down.q);
  EXPECT_EQ(both.cv, Limits::max());
}

TEST(PlcCtd, Counts_down_from_what_was_loaded) {
  struct Row {
    bool cd, ld, q;
    Int cv;
  };
  Ctd<Int> sut;
  sut.pv = 2;
  int call = 0;
  for (const auto& [cd, ld, q, cv] :
       {Row{false, false, true, 0}, Row{false, true, false, 2}, Row{true, false, false, 1}, Row{false, false, false, 1},
        Row{true, false, true, 0}, Row{false, false, true, 0}, Row{true, false, true, -1},
        // Loading goes first, and its call takes the edge.
        Row{false, false, true, -1}, Row{true, true, false, 2}, Row{true, false, false, 2}}) {
    sut.cd = cd;
    sut.ld = ld;
    sut(kCountingScan);
    EXPECT_EQ(sut.q, q) << "call " << ++call;
    EXPECT_EQ(sut.cv, cv) << "call " << call;
  }
}

TEST(PlcCtud, Counts_both_ways_reset_before_load_before_counting) {
  struct Row {
    bool cu, cd, r, ld, qu, qd;
    Int cv;
  };
  Ctud<Int> sut;
  sut.pv = 2;
  int call = 0;
  for (const auto& [cu, cd, r, ld, qu, qd, cv] :
       {Row{false, false, false, false, false, true, 0}, Row{true, false, false, false, false, false, 1},
        Row{false, false, false, false, false, false, 1}, Row{true, false, false, false, true, false, 2},
        Row{false, true, false, false, false, false, 1},
        // Both edges at once cancel each other.
        Row{false, false, false, false, false, false, 1}, Row{true, true, false, false, false, false, 1},
        Row{false, false, false, true, true, false, 2}, Row{false, false, true, true, false, true, 0},
        Row{false, true, false, false, false, true, -1}}) {
    sut.cu = cu;
    sut.cd = cd;
    sut.r = r;
    sut.ld = ld;
    sut(kCountingScan);
    ++call;
    EXPECT_EQ(sut.qu, qu) << "call " << call;
    EXPECT_EQ(sut.qd, qd) << "call " << call;
    EXPECT_EQ(sut.cv, cv) << "call " << call;
  }
}

TEST(PlcBlocks, Restored_from_bytes_they_count_on_without_a_new_edge) {
  Ctu<Int> before;
  before.pv = 2;
  before.cu = true;
  before(kCountingScan);
  std::array<unsigned char, sizeof before> bytes{};
  std::memcpy(bytes.data(), &before, sizeof before);
  Ctu<Int> sut;
  std::memcpy(&sut, bytes.data(), sizeof sut);
  sut(kCountingScan);  // the input is still on: no edge
  EXPECT_EQ(sut.cv, 1);
  sut.cu = false;
  sut(kCountingScan);
  sut.cu = true;
  sut(kCountingScan);
  EXPECT_EQ(sut.cv, 2);
  EXPECT_TRUE(sut.q);
}

}  // namespace
}  // namespace indurop::iec
