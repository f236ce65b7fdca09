// SPDX-License-Identifier: Apache-2.0
#include "network/mirror/frames/frame_layout.h"

#include <gmock/gmock.h>

#include <numeric>

namespace indurop::mirror {
namespace {

std::vector<Parcel> of_sizes(const std::vector<std::uint32_t>& sizes) {
  std::vector<Parcel> parcels;
  for (const std::uint32_t size : sizes) {
    parcels.push_back({size, 0, 0, false});
  }
  return parcels;
}

TEST(Pack, Nothing_gives_no_parts) {
  EXPECT_TRUE(pack({}).empty());
}

TEST(Pack, Every_parcel_is_in_exactly_one_part_and_none_overlap) {
  std::vector<std::uint32_t> sizes;
  for (std::uint32_t i = 1; i <= 500; ++i) {
    sizes.push_back(i * 7 % 1300 + 1);
  }
  const auto parcels = of_sizes(sizes);
  const auto sut = pack(parcels);
  std::vector<int> seen(parcels.size(), 0);
  for (const Part& part : sut) {
    std::uint32_t end = 0;
    for (const Placed& placed : part.content) {
      ++seen[placed.parcel];
      EXPECT_EQ(placed.offset, end);
      end += parcels[placed.parcel].size;
    }
    EXPECT_EQ(part.size, end);
    EXPECT_LE(part.size, kPartBytes);
  }
  EXPECT_THAT(seen, ::testing::Each(1));
}

TEST(Pack, Small_ones_share_a_packet) {
  const auto sut = pack(of_sizes(std::vector<std::uint32_t>(500, 16)));
  EXPECT_EQ(sut.size(), (500U * 16 + kPartBytes - 1) / kPartBytes);
}

TEST(Pack, One_too_large_for_a_packet_travels_alone_and_in_bulk) {
  const auto sut = pack(of_sizes({8, 10'000'000, kPartBytes, kPartBytes + 1}));
  ASSERT_EQ(sut.size(), 4U);
  EXPECT_EQ(sut[0].stream, Stream::Prompt);
  EXPECT_EQ(sut[1].stream, Stream::Bulk);
  EXPECT_EQ(sut[1].size, 10'000'000U);
  EXPECT_EQ(sut[2].stream, Stream::Prompt);
  EXPECT_EQ(sut[3].stream, Stream::Bulk);
}

TEST(Pack, Rates_and_reliability_are_kept_apart) {
  const std::vector<Parcel> parcels{{8, 0, 0, false}, {8, 10'000'000, 0, false}, {8, 0, 0, true}, {8, 0, 0, false}};
  const auto sut = pack(parcels);
  ASSERT_EQ(sut.size(), 3U);
  EXPECT_EQ(sut[0].content.size(), 2U);
  EXPECT_EQ(sut[1].every_ns, 10'000'000);
  EXPECT_EQ(sut[2].stream, Stream::BestEffort);
}

TEST(Pack, A_value_with_a_maxage_is_confirmed_three_times_within_it) {
  const std::vector<Parcel> parcels{{8, 0, 30'000'000, false}, {8, 0, 0, false}, {8, 50'000'000, 30'000'000, false}};
  const auto sut = pack(parcels);
  ASSERT_EQ(sut.size(), 2U);
  EXPECT_EQ(sut[0].keepalive_ns, 10'000'000) << "the most demanding one decides";
  EXPECT_EQ(sut[1].keepalive_ns, 50'000'000) << "never more often than asked for";
  EXPECT_EQ(pack(of_sizes({8}))[0].keepalive_ns, kKeepAliveNs);
}

}  // namespace
}  // namespace indurop::mirror
