// SPDX-License-Identifier: Apache-2.0
// Neighbours share requests, as many as the protocol allows.
#include "control/io/modbus_plan.h"

#include <gmock/gmock.h>

#include <algorithm>

namespace indurop::io {
namespace {

using config::IoPoint;
using config::IoTable;
using config::WireType;
using testing::ElementsAre;

IoPoint planned_point(IoTable table, std::uint16_t number, WireType type = WireType::UInt16, int unit = 1) {
  IoPoint p;
  p.address = {table, number, -1};
  p.type = type;
  p.unit = unit;
  return p;
}

std::vector<IoPoint> row(IoTable table, int count, WireType type = WireType::UInt16) {
  std::vector<IoPoint> points;
  for (int i = 0; i < count; ++i) {
    points.push_back(
        planned_point(table, static_cast<std::uint16_t>(i * static_cast<int>(config::registers_of(type))), type));
  }
  return points;
}

TEST(ModbusPlan, Neighbours_in_any_order_are_one_request) {
  const std::vector<IoPoint> points{planned_point(IoTable::Holding, 12),
                                    planned_point(IoTable::Holding, 10, WireType::Float32),
                                    planned_point(IoTable::Holding, 13, WireType::Int32)};
  const auto sut = plan_reads(points, 0);
  ASSERT_EQ(sut.size(), 1U);
  EXPECT_EQ(sut[0].first, 10);
  EXPECT_EQ(sut[0].count, 5);
  EXPECT_THAT(sut[0].points, ElementsAre(1, 0, 2));
}

TEST(ModbusPlan, Gaps_are_read_along_only_if_asked_for_and_never_written) {
  const std::vector<IoPoint> points{planned_point(IoTable::Holding, 0), planned_point(IoTable::Holding, 4)};
  EXPECT_EQ(plan_reads(points, 0).size(), 2U);
  EXPECT_EQ(plan_reads(points, 2).size(), 2U);
  EXPECT_EQ(plan_reads(points, 3).size(), 1U);
  EXPECT_EQ(plan_writes(points).size(), 2U);
}

TEST(ModbusPlan, Tables_and_units_do_not_mix) {
  const std::vector<IoPoint> points{planned_point(IoTable::Holding, 0), planned_point(IoTable::Input, 1),
                                    planned_point(IoTable::Holding, 1, WireType::UInt16, 2)};
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
  const std::vector<IoPoint> points{planned_point(IoTable::Holding, 5, WireType::Float32),
                                    planned_point(IoTable::Holding, 5), planned_point(IoTable::Holding, 6)};
  const auto sut = plan_reads(points, 0);
  ASSERT_EQ(sut.size(), 1U);
  EXPECT_EQ(sut[0].count, 2);
}

TEST(ModbusPlan, Bits_of_one_register_are_written_together_and_apart_from_whole_ones) {
  std::vector<IoPoint> points{planned_point(IoTable::Holding, 5, WireType::Bool), planned_point(IoTable::Holding, 6),
                              planned_point(IoTable::Holding, 5, WireType::Bool),
                              planned_point(IoTable::Holding, 6, WireType::Bool)};
  points[0].address.bit = 3;
  points[2].address.bit = 9;
  points[3].address.bit = 0;
  const auto sut = plan_writes(points);
  ASSERT_EQ(sut.size(), 3U);
  EXPECT_THAT(sut[0].points, ElementsAre(1));
  EXPECT_FALSE(sut[0].masked);
  EXPECT_THAT(sut[1].points, ElementsAre(0, 2));
  EXPECT_TRUE(sut[1].masked);
  EXPECT_THAT(sut[2].points, ElementsAre(3));
}

TEST(ModbusPlan, Points_of_another_cycle_travel_apart) {
  std::vector<IoPoint> points = row(IoTable::Input, 3);
  points[1].every = 10;
  const auto sut = plan_reads(points, 5);
  ASSERT_EQ(sut.size(), 2U);
  EXPECT_EQ(sut[0].every, 1);
  EXPECT_THAT(sut[1].points, ElementsAre(1));
  EXPECT_EQ(sut[1].every, 10);
}

TEST(ModbusPlan, Together_a_writing_takes_a_reading_of_the_same_unit_along) {
  const std::vector<IoPoint> written{planned_point(IoTable::Holding, 0),
                                     planned_point(IoTable::Coil, 0, WireType::Bool)};
  const std::vector<IoPoint> read{planned_point(IoTable::Holding, 9, WireType::UInt16, 2),
                                  planned_point(IoTable::Input, 9), planned_point(IoTable::Holding, 9)};
  EXPECT_EQ(plan_steps(plan_writes(written), plan_reads(read, 0), false).size(), 5U);
  const auto sut = plan_steps(plan_writes(written), plan_reads(read, 0), true);
  ASSERT_EQ(sut.size(), 4U);
  const auto both = std::find_if(sut.begin(), sut.end(),
                                 [](const ModbusStep& step) { return step.write.count > 0 && step.read.count > 0; });
  ASSERT_NE(both, sut.end());
  EXPECT_THAT(both->read.points, ElementsAre(2));
  EXPECT_THAT(both->write.points, ElementsAre(0));
}

}  // namespace
}  // namespace indurop::io
