// SPDX-License-Identifier: Apache-2.0
// Captures of real buses: the reader understands every frame, and the builder makes the same bytes.
#include <gmock/gmock.h>

#include <algorithm>

#include "capture.h"
#include "control/io/ethercat/frame.h"

namespace indurop::io::ethercat {
namespace {

// Builds the frame again from what was read of it.
std::vector<std::uint8_t> rebuilt(const std::vector<std::uint8_t>& packet) {
  Mac source{};
  std::copy_n(packet.begin() + 6, source.size(), source.begin());
  FrameBuilder builder(source);
  FrameReader reader(packet);
  Datagram datagram;
  while (reader.next(datagram)) {
    EXPECT_TRUE(builder.add(datagram.command, datagram.index, datagram.address, datagram.data(packet)));
  }
  const Bytes bytes = builder.finish();
  return {bytes.begin(), bytes.end()};
}

TEST(Captures, Every_frame_of_real_buses_is_read_and_built_again) {
  INDUROP_NEEDS_REAL_DATA();
  std::size_t files = 0;
  std::size_t frames = 0;
  std::size_t built = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(real_data())) {
    if (entry.path().extension() != ".pcapng") {
      continue;
    }
    ++files;
    for (const auto& [time, packet] : packets_of(entry.path())) {
      if (!is_ethercat(packet)) {
        continue;
      }
      ++frames;
      FrameReader reader(packet);
      ASSERT_EQ(reader.fault(), FrameFault::None) << entry.path() << ": " << to_string(reader.fault());
      Datagram datagram;
      bool is_sent = true;  // nothing that slaves change
      std::size_t end = 0;
      while (reader.next(datagram)) {
        is_sent &= datagram.wkc == 0 && datagram.interrupt == 0 && !datagram.circulating;
        end = datagram.wkc_at() + 2;
      }
      if (is_sent) {
        ++built;
        const auto again = rebuilt(packet);
        ASSERT_TRUE(std::equal(packet.begin() + kFrameHeader, packet.begin() + static_cast<std::ptrdiff_t>(end),
                               again.begin() + kFrameHeader))
            << entry.path();
      }
    }
  }
  EXPECT_GE(files, 20U);
  EXPECT_GE(frames, 40'000U);
  EXPECT_GE(built, 10'000U);
}

}  // namespace
}  // namespace indurop::io::ethercat
