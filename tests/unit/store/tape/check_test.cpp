// SPDX-License-Identifier: Apache-2.0
// A tape is shared memory: whatever stands there, readers neither crash nor read outside of it.

#include "store/tape/check.h"

#include <gmock/gmock.h>

#include <random>

#include "store/vars/shm_file.h"
#include "tape_fixture.h"

namespace indurop::tape {
namespace {

using test::Plant;

TEST(Check, Refuses_what_is_no_tape) {
  Plant plant("refuses", {{"ab", "bc"}});
  auto file = vars::ShmFile::open(vars::tape_file(plant.node()), vars::Mode::ReadWrite);
  ASSERT_TRUE(file.ok());
  auto& header = *reinterpret_cast<TapeHeader*>(file->data());
  EXPECT_TRUE(index_tape({file->data(), file->size()}).ok());
  EXPECT_EQ(index_tape({file->data(), 16}).error().code, Errc::Corrupt);
  EXPECT_EQ(index_tape({file->data(), file->size() - 4096}).error().code, Errc::Corrupt);
  header.abi = 99;
  EXPECT_EQ(Follower::open(plant.node(), true).error().code, Errc::VersionMismatch);
  EXPECT_EQ(Follower::open("missing-node", true).error().code, Errc::NotFound);
}

TEST(Check, Damaged_tapes_are_read_without_harm) {
  std::mt19937 engine(3);
  const auto random = [&engine] { return static_cast<std::uint32_t>(engine()); };
  for (int round = 0; round < 400; ++round) {
    Plant plant("damaged", {{"ab", "bcd"}, {"d", "e"}}, 3000);
    for (std::uint64_t tick = 0; tick < 300; ++tick) {
      plant.put<std::uint32_t>("b", static_cast<std::uint32_t>(tick));
      plant.track(static_cast<std::uint32_t>(tick % 2)).begin();
      plant.put<double>("d", static_cast<double>(tick));
      plant.track(static_cast<std::uint32_t>(tick % 2)).end(Plant::at(tick), 0);
    }
    auto file = vars::ShmFile::open(vars::tape_file(plant.node()), vars::Mode::ReadWrite);
    ASSERT_TRUE(file.ok());
    // Half of the rounds hit the header and the tracks, whose bytes matter most.
    const std::size_t reach = round % 2 == 0 ? 1024 : file->size();
    for (unsigned hits = random() % 8 + 1; hits > 0; --hits) {
      file->data()[random() % reach] = static_cast<std::byte>(random());
    }
    auto reader = Follower::open(plant.node(), true);
    if (!reader) {
      continue;
    }
    tape::Run run;
    for (std::size_t track = 0; track < reader->tracks(); ++track) {
      for (int reads = 0; reads < 1000 && reader->next(track, run); ++reads) {
      }
    }
  }
}

}  // namespace
}  // namespace indurop::tape
