// SPDX-License-Identifier: Apache-2.0
// What a client of our server may do: exception codes as the Modbus specification has them, and no value by halves.
#include "control/io/modbus_places.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <vector>

#include <modbus/modbus.h>

namespace indurop::io {
namespace {

using config::IoPoint;
using config::IoTable;
using config::WireType;
using testing::ElementsAre;
using testing::IsEmpty;
using Bytes = std::vector<std::uint8_t>;

constexpr int kBadFunction = 1;
constexpr int kBadAddress = 2;
constexpr int kBadValue = 3;
constexpr int kFailure = 4;

IoPoint point(IoTable table, std::uint16_t number, WireType type = WireType::UInt16, int bit = -1) {
  IoPoint p;
  p.address = {table, number, bit};
  p.type = type;
  return p;
}

class Places : public testing::Test {
 protected:
  const std::vector<IoPoint> outputs_{point(IoTable::Discrete, 2, WireType::Bool),
                                      point(IoTable::Input, 10, WireType::Float32), point(IoTable::Holding, 30),
                                      point(IoTable::Input, 12, WireType::Bool, 7)};
  const std::vector<IoPoint> inputs_{point(IoTable::Coil, 5, WireType::Bool), point(IoTable::Holding, 20),
                                     point(IoTable::Holding, 21, WireType::Int32),
                                     point(IoTable::Holding, 23, WireType::Bool, 4),
                                     point(IoTable::Holding, 23, WireType::Bool, 5)};
  ModbusPlaces sut_{outputs_, inputs_};
  std::vector<Sample> values_{{1, Quality::Good}, {1.5L, Quality::Good}, {77, Quality::Good}, {1, Quality::Good}};
  std::vector<Sample> written_{5};
};

TEST_F(Places, What_outputs_hold_may_be_read) {
  sut_.offer(values_);
  EXPECT_EQ(sut_.refusal(Bytes{2, 0, 2, 0, 1}), 0);
  EXPECT_EQ(sut_.refusal(Bytes{4, 0, 10, 0, 3}), 0);
  EXPECT_EQ(sut_.refusal(Bytes{3, 0, 30, 0, 1}), 0);
  EXPECT_EQ(sut_.table().tab_input_bits[0], 1);
  EXPECT_EQ(sut_.table().tab_input_registers[0], 0x3FC0) << "1.5 as IEEE 754";
  EXPECT_EQ(sut_.table().tab_input_registers[2], 0x80);
}

TEST_F(Places, What_inputs_have_may_be_read_as_well_with_what_lies_between) {
  sut_.offer(values_);
  EXPECT_EQ(sut_.refusal(Bytes{3, 0, 20, 0, 11}), 0);
  EXPECT_EQ(sut_.refusal(Bytes{1, 0, 5, 0, 1}), 0);
}

TEST_F(Places, Values_that_are_not_refreshed_are_refused) {
  EXPECT_EQ(sut_.refusal(Bytes{3, 0, 30, 0, 1}), kFailure) << "before the first run";
  sut_.offer(values_);
  values_[2].quality = Quality::NotRefreshed;
  sut_.offer(values_);
  EXPECT_EQ(sut_.refusal(Bytes{3, 0, 30, 0, 1}), kFailure);
  EXPECT_EQ(sut_.refusal(Bytes{4, 0, 10, 0, 2}), 0) << "another";
}

TEST_F(Places, Addresses_of_no_point) {
  sut_.offer(values_);
  EXPECT_EQ(sut_.refusal(Bytes{3, 0, 19, 0, 1}), kBadAddress);
  EXPECT_EQ(sut_.refusal(Bytes{3, 0, 30, 0, 2}), kBadAddress);
  EXPECT_EQ(sut_.refusal(Bytes{1, 0, 4, 0, 1}), kBadAddress);
  EXPECT_EQ(sut_.refusal(Bytes{4, 0xFF, 0xFF, 0, 1}), kBadAddress);
  EXPECT_EQ(sut_.refusal(Bytes{6, 0, 24, 0, 1}), kBadAddress);
}

TEST_F(Places, Outputs_are_not_written) {
  EXPECT_EQ(sut_.refusal(Bytes{6, 0, 30, 0, 1}), kBadAddress);
  EXPECT_EQ(sut_.refusal(Bytes{16, 0, 23, 0, 8, 16, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1}), kBadAddress);
}

TEST_F(Places, Half_a_number_is_not_written) {
  EXPECT_EQ(sut_.refusal(Bytes{6, 0, 21, 0, 1}), kBadAddress);
  EXPECT_EQ(sut_.refusal(Bytes{16, 0, 20, 0, 2, 4, 0, 1, 0, 1}), kBadAddress);
  EXPECT_EQ(sut_.refusal(Bytes{22, 0, 21, 0, 0, 0, 1}), kBadAddress);
  EXPECT_EQ(sut_.refusal(Bytes{16, 0, 20, 0, 3, 6, 0, 1, 0, 1, 0, 1}), 0);
}

TEST_F(Places, Written_inputs_have_their_values) {
  const Bytes all{16, 0, 20, 0, 4, 8, 0, 9, 0xFF, 0xFF, 0xFF, 0xFE, 0, 0x20};
  ASSERT_EQ(sut_.refusal(all), 0);
  const std::uint16_t registers[] = {9, 0xFFFF, 0xFFFE, 0x20};
  std::copy(std::begin(registers), std::end(registers), sut_.table().tab_registers);
  EXPECT_THAT(sut_.take(all, written_), ElementsAre(1, 2, 3, 4));
  EXPECT_EQ(written_[1].value, 9);
  EXPECT_EQ(written_[2].value, -2);
  EXPECT_EQ(written_[3].value, 0);
  EXPECT_EQ(written_[4].value, 1);
  EXPECT_THAT(sut_.take(Bytes{3, 0, 20, 0, 1}, written_), IsEmpty()) << "a reading";
}

TEST_F(Places, Requests_that_are_none) {
  EXPECT_EQ(sut_.refusal(Bytes{}), kBadFunction);
  EXPECT_EQ(sut_.refusal(Bytes{8, 0, 0, 0, 0}), kBadFunction);
  EXPECT_EQ(sut_.refusal(Bytes{3, 0, 20}), kBadValue);
  EXPECT_EQ(sut_.refusal(Bytes{3, 0, 20, 0, 0}), kBadValue);
  EXPECT_EQ(sut_.refusal(Bytes{3, 0, 20, 0, 126}), kBadValue);
  EXPECT_EQ(sut_.refusal(Bytes{5, 0, 5, 0x12, 0x34}), kBadValue);
  EXPECT_EQ(sut_.refusal(Bytes{16, 0, 20, 0, 1, 4, 0, 1, 0, 1}), kBadValue);
  EXPECT_EQ(sut_.refusal(Bytes{23, 0, 20, 0, 1, 0, 20, 0, 1, 2, 0}), kBadValue);
  EXPECT_EQ(sut_.refusal(Bytes{23, 0, 20, 0, 1, 0, 20, 0, 1, 2, 0, 1}), 0);
}

// Whatever comes, what it may touch lies in the table: the answer is made without another look.
TEST_F(Places, Random_requests_never_reach_outside) {
  sut_.offer(values_);
  std::uint32_t seed = 1;
  const auto random = [&seed] { return static_cast<std::uint8_t>((seed = seed * 1664525U + 1013904223U) >> 24U); };
  for (int i = 0; i < 200'000; ++i) {
    Bytes request(random() % 20U);
    for (std::uint8_t& byte : request) {
      byte = random() % 4U == 0 ? random() : static_cast<std::uint8_t>(random() % 32U);
    }
    const auto taken = sut_.take(request, written_);
    if (sut_.refusal(request) == 0) {
      ASSERT_LT(taken.size(), 6U);
    }
  }
}

}  // namespace
}  // namespace indurop::io
