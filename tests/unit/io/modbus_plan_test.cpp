// SPDX-License-Identifier: Apache-2.0
// Neighbours share requests, as many as the protocol allows.
#include "io/modbus_plan.h"

#include <gmock/gmock.h>

namespace indurop::io {
namespace {

using config::IoPoint;
using config::IoTable;
using config::WireType;
using testing::ElementsAre;

IoPoint point(IoTable table, std::uint16_t number, WireType type = WireType::UInt16, int unit = 1) {
  IoPoint p;
  p.address = {table, number, -1};
  p.type = type;
  p.unit = unit;
  return p;
}

std::vector<IoPoint> row(IoTable table, int count, WireType type = WireType::UInt16) {
  std::vector<IoPoint> points;
  for (int i = 0; i < count; ++i) {
    points.push_back(point(table, static_cast<std::uint16_t>(i * static_cast<int>(config::registers_of(type))), type));
  }
  return points;
}

TEST(ModbusPlan, Neighbours_in_any_order_are_one_request) {
  const std::vector<IoPoint> points{point(IoTable::Holding, 12), point(IoTable::Holding, 10, WireType::Float32),
                                    point(IoTable::Holding, 13, WireType::Int32)};
  const auto sut = plan_reads(points, 0);
  ASSERT_EQ(sut.size(), 1U);
  EXPECT_EQ(sut[0].first, 10);
  EXPECT_EQ(sut[0].count, 5);
  EXPECT_THAT(sut[0].points, ElementsAre(1, 0, 2));
}

TEST(ModbusPlan, Gaps_are_read_along_only_if_asked_for_and_never_written) {
  const std::vector<IoPoint> points{point(IoTable::Holding, 0), point(IoTable::Holding, 4)};
  EXPECT_EQ(plan_reads(points, 0).size(), 2U);
  EXPECT_EQ(plan_reads(points, 2).size(), 2U);
  EXPECT_EQ(plan_reads(points, 3).size(), 1U);
  EXPECT_EQ(plan_writes(points).size(), 2U);
}

TEST(ModbusPlan, Tables_and_units_do_not_mix) {
  const std::vector<IoPoint> points{point(IoTable::Holding, 0), point(IoTable::Input, 1),
                                    point(IoTable::Holding, 1, WireType::UInt16, 2)};
  EXPECT_EQ(plan_reads(points, 10).size(), 3U);
}

TEST(ModbusPlan, Keeps_to_the_limits_of_the_protocol) {
  auto sut = plan_reads(row(IoTable::Input, 300), 0);
  ASSERT_EQ(sut.size(), 3U);
  EXPECT_EQ(sut[0].count, 125);
  EXPECT_EQ(sut[2].count, 50);
  sut = plan_writes(row(IoTable::Holding, 124));
  ASSERT_EQ(sut.size(), 2U);
  EXPECT_EQ(sut[0].count, 123);
  sut = plan_reads(row(IoTable::Coil, 2001, WireType::Bool), 0);
  ASSERT_EQ(sut.size(), 2U);
  EXPECT_EQ(sut[0].count, 2000);
  sut = plan_writes(row(IoTable::Coil, 1969, WireType::Bool));
  ASSERT_EQ(sut.size(), 2U);
  EXPECT_EQ(sut[0].count, 1968);
}

TEST(ModbusPlan, A_number_never_falls_apart) {
  const auto sut = plan_reads(row(IoTable::Input, 40, WireType::Float64), 0);  // 31 numbers in 124 registers
  ASSERT_EQ(sut.size(), 2U);
  EXPECT_EQ(sut[0].count, 124);
  EXPECT_EQ(sut[1].first, 124);
}

TEST(ModbusPlan, Points_of_the_same_place_share_it) {
  const std::vector<IoPoint> points{point(IoTable::Holding, 5, WireType::Float32), point(IoTable::Holding, 5),
                                    point(IoTable::Holding, 6)};
  const auto sut = plan_reads(points, 0);
  ASSERT_EQ(sut.size(), 1U);
  EXPECT_EQ(sut[0].count, 2);
}

}  // namespace
}  // namespace indurop::io
