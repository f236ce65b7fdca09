// SPDX-License-Identifier: Apache-2.0
// Objects in the process data of a slave: where they are, and numbers of every width and place.
#include "control/io/ethercat_field.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <random>

#include "control/io/ethercat/master/plan.h"

namespace indurop::io {
namespace {

using ethercat::Pdo;
using Kind = EthercatField::Kind;

TEST(EthercatField, Is_found_where_the_plan_of_the_slave_puts_it) {
  // Two SyncManagers, PDOs in another order than they are mapped, a gap, and one that is not assigned.
  const std::vector<Pdo> pdos = {{0x1A02, 3, 0, "", {{0x6020, 1, 16, 3, ""}}},
                                 {0x1A01, 0xFF, 0, "", {{0x6010, 1, 16, 6, ""}}},
                                 {0x1A00, 2, 0, "", {{0x6000, 1, 1, 1, ""}, {0, 0, 5, 0, ""}, {0x6000, 2, 2, 5, ""}}},
                                 {0x1A03, 3, 0, "", {{0x6020, 2, 32, 8, ""}}}};
  const auto at = [&](std::uint16_t index, std::uint8_t subindex) { return find_field(pdos, {index, subindex}); };
  EXPECT_EQ(at(0x6000, 1)->bit, 0U);
  EXPECT_EQ(at(0x6000, 2)->bit, 6U);
  EXPECT_EQ(at(0x6000, 2)->bits, 2U);
  EXPECT_EQ(at(0x6020, 1)->bit, 8U) << "the next SyncManager begins with a byte";
  EXPECT_EQ(at(0x6020, 1)->kind, Kind::Signed);
  EXPECT_EQ(at(0x6020, 2)->bit, 24U);
  EXPECT_EQ(at(0x6020, 2)->kind, Kind::Real);
  EXPECT_FALSE(at(0x6010, 1));
  EXPECT_FALSE(at(0x6020, 3));
}

TEST(EthercatField, Numbers_come_back_and_change_no_other_bit) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 20'000; ++i) {
    EthercatField field{random() % 40, 1 + random() % 64, random() % 2 == 0 ? Kind::Unsigned : Kind::Signed};
    std::array<std::uint8_t, 16> before{};
    for (auto& byte : before) {
      byte = static_cast<std::uint8_t>(random());
    }
    const std::uint64_t bits = random() >> (64 - field.bits);
    const bool is_negative = field.kind == Kind::Signed && (bits >> (field.bits - 1)) != 0;
    const Number number = is_negative ? static_cast<Number>(bits) - std::ldexp(Number{1}, static_cast<int>(field.bits))
                                      : static_cast<Number>(bits);
    auto after = before;
    ASSERT_TRUE(write_field(field, number, after));
    ASSERT_EQ(read_field(field, after), number) << field.bits << " bits at " << field.bit;
    for (std::size_t bit = 0; bit < 8 * after.size(); ++bit) {
      if (bit < field.bit || bit >= field.bit + field.bits) {
        ASSERT_EQ(after[bit / 8] >> (bit % 8) & 1, before[bit / 8] >> (bit % 8) & 1) << bit;
      }
    }
  }
}

TEST(EthercatField, What_does_not_fit_becomes_the_nearest_number) {
  std::array<std::uint8_t, 8> bytes{};
  const auto limited = [&](std::size_t bits, Kind kind, Number number) {
    EXPECT_FALSE(write_field({0, bits, kind}, number, bytes));
    return static_cast<double>(read_field({0, bits, kind}, bytes));
  };
  EXPECT_EQ(limited(16, Kind::Signed, 40'000), 32'767);
  EXPECT_EQ(limited(16, Kind::Signed, -40'000), -32'768);
  EXPECT_EQ(limited(1, Kind::Unsigned, 2), 1);
  EXPECT_EQ(limited(8, Kind::Unsigned, -1), 0);
  EXPECT_EQ(limited(64, Kind::Signed, 1e30L), static_cast<double>(std::numeric_limits<std::int64_t>::max()));
  EXPECT_EQ(limited(32, Kind::Real, 1e300L), static_cast<double>(std::numeric_limits<float>::max()));
  EXPECT_TRUE(write_field({0, 32, Kind::Real}, 1.5L, bytes));
  EXPECT_EQ(read_field({0, 32, Kind::Real}, bytes), 1.5L);
  EXPECT_TRUE(write_field({0, 64, Kind::Real}, -0.1, bytes));
  EXPECT_EQ(static_cast<double>(read_field({0, 64, Kind::Real}, bytes)), -0.1);
}

}  // namespace
}  // namespace indurop::io
