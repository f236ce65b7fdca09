// SPDX-License-Identifier: Apache-2.0
// Keyframes: readers see whole ones only, whatever happens to the writer.

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstring>
#include <random>

#include "store/tape/keyframes.h"
#include "store/vars/process.h"
#include "tape_fixture.h"

namespace indurop::tape::test {
namespace {

using vars::test::TestNode;

TapeHeader& tape_of(pid_t pid) {
  static TapeHeader header;
  header.node_pid = pid;
  header.node_start_time = vars::process_start_time(pid);
  return header;
}

// All bytes of a keyframe are the low byte of its number.
void write(KeyframeWriter& writer, std::size_t index, std::uint64_t number, std::uint64_t bytes) {
  std::memset(writer.room(index).data(), static_cast<int>(number & 0xff), bytes);
  writer.publish(index, {number, number + 100, static_cast<std::int64_t>(number), bytes});
}

bool is_whole(const Keyframe& keyframe) {
  return std::all_of(keyframe.bytes.begin(), keyframe.bytes.end(),
                     [&](std::uint8_t byte) { return byte == (keyframe.head.run & 0xff); });
}

class Keyframes : public ::testing::Test {
 protected:
  KeyframeWriter make() {
    const KeyframePlan plans[] = {{3, 100, "a\tint\t4\n"}, {5, 40'000, "b\tdouble\t8\n"}};
    return KeyframeWriter::create(node_.name(), plans).value();
  }
  [[nodiscard]] Result<KeyframeFollower> follow(pid_t pid = ::getpid()) const {
    return KeyframeFollower::open(node_.name(), tape_of(pid));
  }
  ~Keyframes() override { (void)vars::remove_shm_file(vars::keyframe_file(node_.name())); }
  TestNode node_{"keyframes"};
};

TEST_F(Keyframes, Are_read_once_each_with_their_form) {
  KeyframeWriter writer = make();
  KeyframeFollower sut = follow().value();
  ASSERT_EQ(sut.modules(), 2U);
  EXPECT_EQ(sut.module(0).module, 3U);
  EXPECT_EQ(sut.module(1).form, "b\tdouble\t8\n");
  Keyframe keyframe;
  EXPECT_FALSE(sut.next(0, keyframe));
  write(writer, 0, 10, 100);
  write(writer, 0, 11, 60);
  ASSERT_TRUE(sut.next(0, keyframe));
  EXPECT_EQ(keyframe.module, 3U);
  EXPECT_EQ(keyframe.head.run, 10U);
  EXPECT_EQ(keyframe.bytes.size(), 100U);
  ASSERT_TRUE(sut.next(0, keyframe));
  EXPECT_EQ(keyframe.head.tick, 111U);
  EXPECT_EQ(keyframe.bytes.size(), 60U);
  EXPECT_FALSE(sut.next(0, keyframe));
  EXPECT_FALSE(sut.next(1, keyframe));
}

TEST_F(Keyframes, Of_a_slow_reader_are_the_newest_ones) {
  KeyframeWriter writer = make();
  KeyframeFollower sut = follow().value();
  for (std::uint64_t number = 0; number < 20; ++number) {
    write(writer, 1, number, 40'000);
  }
  std::memset(writer.room(1).data(), 0xee, 40'000);  // the next one is being written
  Keyframe keyframe;
  for (std::uint64_t number = 20 - (kKeyframeSlots - 1); number < 20; ++number) {
    ASSERT_TRUE(sut.next(1, keyframe));
    EXPECT_EQ(keyframe.head.run, number);
    EXPECT_TRUE(is_whole(keyframe));
  }
  EXPECT_FALSE(sut.next(1, keyframe));
}

TEST_F(Keyframes, Of_another_run_or_damaged_are_refused) {
  EXPECT_EQ(follow().error().code, Errc::NotFound);
  KeyframeWriter writer = make();
  EXPECT_EQ(follow(1).error().code, Errc::NotFound);
  auto file = vars::ShmFile::open(vars::keyframe_file(node_.name()), vars::Mode::ReadWrite).value();
  auto& header = *reinterpret_cast<KeyframeHeader*>(file.data());
  header.module_count = 0xffffff;
  EXPECT_EQ(follow().error().code, Errc::Corrupt);
  header.module_count = 2;
  auto& module = *reinterpret_cast<KeyframeModule*>(file.data() + kLine);
  module.slots_offset += file.size();
  EXPECT_EQ(follow().error().code, Errc::Corrupt);
  header.abi = kKeyframeAbi + 1;
  EXPECT_EQ(follow().error().code, Errc::VersionMismatch);
}

// The node is killed at any moment: what it left is read as far as it was whole.
TEST_F(Keyframes, Of_a_killed_node_are_whole) {
  std::mt19937 random(1);  // NOLINT(cert-msc51-cpp): the same each time
  for (int round = 0; round < 40; ++round) {
    int ready[2];
    ASSERT_EQ(::pipe(ready), 0);
    const pid_t child = ::fork();
    if (child == 0) {
      KeyframeWriter writer = make();
      const char byte = 1;
      (void)!::write(ready[1], &byte, 1);
      for (std::uint64_t number = 0;; ++number) {
        write(writer, number % 2, number, number % 2 == 0 ? 100 : 40'000);
      }
    }
    char byte = 0;
    ASSERT_EQ(::read(ready[0], &byte, 1), 1);
    Result<KeyframeFollower> sut = follow(child);
    ASSERT_TRUE(sut.ok());
    Keyframe keyframe;
    const auto read_all = [&] {
      for (std::size_t i = 0; i < 2; ++i) {
        while (sut->next(i, keyframe)) {
          ASSERT_TRUE(is_whole(keyframe)) << keyframe.head.run;
        }
      }
    };
    for (std::size_t looks = random() % 300; looks > 0; --looks) {
      ASSERT_TRUE(sut->next(looks % 2, keyframe) ? is_whole(keyframe) : true);
    }
    (void)::kill(child, SIGKILL);
    (void)::waitpid(child, nullptr, 0);
    read_all();
    ::close(ready[0]);
    ::close(ready[1]);
  }
}

}  // namespace
}  // namespace indurop::tape::test
