// SPDX-License-Identifier: Apache-2.0
// Requests as the Modbus specification has them, and answers that are none.
#include "control/io/modbus_frame.h"

#include <gmock/gmock.h>

#include <vector>

namespace indurop::io {
namespace {

using config::IoTable;
using testing::ElementsAre;
using testing::ElementsAreArray;
using Bytes = std::vector<std::uint8_t>;
using Fit = ModbusFrame::Fit;

ModbusRequest request(IoTable table, std::uint16_t first, std::uint16_t count, int unit = 17) {
  return {unit, table, first, count, {}};
}

TEST(ModbusFrame, Reads_are_as_in_the_specification) {
  EXPECT_THAT(ModbusFrame::reading(request(IoTable::Holding, 107, 3)).bytes(), ElementsAre(17, 3, 0, 107, 0, 3));
  EXPECT_EQ(ModbusFrame::reading(request(IoTable::Coil, 0, 1)).bytes()[1], 1);
  EXPECT_EQ(ModbusFrame::reading(request(IoTable::Discrete, 0, 1)).bytes()[1], 2);
  EXPECT_EQ(ModbusFrame::reading(request(IoTable::Input, 0, 1)).bytes()[1], 4);
}

TEST(ModbusFrame, Writes_are_as_in_the_specification) {
  const std::uint16_t registers[] = {0x000A, 0x0102};
  const std::uint8_t bits[] = {1, 0, 1, 1, 0, 0, 1, 1, 1, 0};
  EXPECT_THAT(ModbusFrame::writing(request(IoTable::Holding, 1, 2), {}, registers).bytes(),
              ElementsAre(17, 16, 0, 1, 0, 2, 4, 0, 0x0A, 1, 2));
  EXPECT_THAT(ModbusFrame::writing(request(IoTable::Holding, 1, 1), {}, registers).bytes(),
              ElementsAre(17, 6, 0, 1, 0, 0x0A));
  EXPECT_THAT(ModbusFrame::writing(request(IoTable::Coil, 19, 10), bits, {}).bytes(),
              ElementsAre(17, 15, 0, 19, 0, 10, 2, 0xCD, 0x01));
  EXPECT_THAT(ModbusFrame::writing(request(IoTable::Coil, 172, 1), bits, {}).bytes(),
              ElementsAre(17, 5, 0, 172, 0xFF, 0));
}

TEST(ModbusFrame, The_longest_request_fits) {
  const std::vector<std::uint16_t> registers(kMaxWrittenRegisters, 7);
  const std::vector<std::uint8_t> bits(kMaxWrittenBits, 1);
  EXPECT_EQ(ModbusFrame::writing(request(IoTable::Holding, 0, kMaxWrittenRegisters), {}, registers).bytes().size(),
            7 + 2 * kMaxWrittenRegisters);
  EXPECT_EQ(ModbusFrame::writing(request(IoTable::Coil, 0, kMaxWrittenBits), bits, {}).bytes().size(),
            7 + kMaxWrittenBits / 8);
}

TEST(ModbusFrame, Values_are_taken_from_the_answer) {
  std::uint8_t bits[10] = {};
  std::uint16_t registers[2] = {};
  const auto words = ModbusFrame::reading(request(IoTable::Input, 0, 2));
  const Bytes two{17, 4, 4, 0x12, 0x34, 0xAB, 0xCD};
  ASSERT_EQ(words.judge(two), Fit::Answer);
  words.take(two, bits, registers);
  EXPECT_THAT(registers, ElementsAre(0x1234, 0xABCD));
  const auto coils = ModbusFrame::reading(request(IoTable::Coil, 0, 10));
  const Bytes ten{17, 1, 2, 0xCD, 0x01};
  ASSERT_EQ(coils.judge(ten), Fit::Answer);
  coils.take(ten, bits, registers);
  EXPECT_THAT(bits, ElementsAreArray({1, 0, 1, 1, 0, 0, 1, 1, 1, 0}));
}

TEST(ModbusFrame, An_answer_of_another_unit_is_refused) {
  const auto sut = ModbusFrame::reading(request(IoTable::Holding, 0, 1));
  Bytes answer{17, 3, 2, 0, 1};
  EXPECT_EQ(sut.judge(answer), Fit::Answer);
  answer[0] = 18;
  EXPECT_EQ(sut.judge(answer), Fit::Stranger);
  answer[1] = 0x83;
  EXPECT_EQ(sut.judge(answer), Fit::Stranger);
}

TEST(ModbusFrame, What_is_no_answer_is_garbage) {
  const auto sut = ModbusFrame::reading(request(IoTable::Holding, 0, 1));
  const Bytes right{17, 3, 2, 0, 1};
  for (const std::size_t place : {1U, 2U}) {
    Bytes wrong = right;
    wrong[place] ^= 0x10;
    EXPECT_EQ(sut.judge(wrong), Fit::Garbage) << place;
  }
  for (std::size_t size = 0; size < right.size(); ++size) {
    EXPECT_EQ(sut.judge(std::span(right).first(size)), Fit::Garbage) << size;
  }
}

TEST(ModbusFrame, Exceptions_and_echoes) {
  const std::uint16_t registers[] = {7, 8};
  const auto sut = ModbusFrame::writing(request(IoTable::Holding, 3, 2), {}, registers);
  const Bytes refused{17, 0x90, 2};
  EXPECT_EQ(sut.judge(refused), Fit::Exception);
  EXPECT_EQ(ModbusFrame::exception(refused), 2);
  EXPECT_EQ(sut.judge(Bytes{17, 16, 0, 3, 0, 2}), Fit::Answer);
  EXPECT_EQ(sut.judge(Bytes{17, 16, 0, 4, 0, 2}), Fit::Garbage);
  EXPECT_EQ(sut.judge(Bytes{17, 16, 0, 3, 0, 1}), Fit::Garbage);
}

// The examples of "MODBUS application protocol" 6.16 and 6.17.
TEST(ModbusFrame, Single_bits_and_both_at_once_are_as_in_the_specification) {
  const auto masked = ModbusFrame::masking(request(IoTable::Holding, 4, 1), 0x0F0D, 0x0025);
  EXPECT_THAT(masked.bytes(), ElementsAre(17, 22, 0, 4, 0xF0, 0xF2, 0, 0x05));
  EXPECT_EQ(masked.judge(Bytes{17, 22, 0, 4, 0xF0, 0xF2, 0, 0x05}), Fit::Answer);
  EXPECT_EQ(masked.judge(Bytes{17, 22, 0, 4, 0xF0, 0xF2, 0, 0x04}), Fit::Garbage);
  const std::uint16_t registers[] = {0xFF, 0xFF, 0xFF};
  const auto both =
      ModbusFrame::exchanging(request(IoTable::Holding, 14, 3), request(IoTable::Holding, 3, 6), registers);
  EXPECT_THAT(both.bytes(), ElementsAre(17, 23, 0, 3, 0, 6, 0, 14, 0, 3, 6, 0, 0xFF, 0, 0xFF, 0, 0xFF));
  Bytes answer{17, 23, 12, 0, 0xFE, 0x0A, 0xCD, 0, 1, 0, 3, 0, 0x0D, 0, 0xFF};
  ASSERT_EQ(both.judge(answer), Fit::Answer);
  std::uint16_t read[6] = {};
  both.take(answer, {}, read);
  EXPECT_THAT(read, ElementsAre(0x00FE, 0x0ACD, 1, 3, 0x0D, 0xFF));
}

}  // namespace
}  // namespace indurop::io
