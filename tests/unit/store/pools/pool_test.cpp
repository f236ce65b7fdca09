// SPDX-License-Identifier: Apache-2.0
// Files and seats of pools: made, adopted, replaced, damaged, left by dead processes.

#include "store/pools/pool.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <cstddef>
#include <cstring>
#include <string>

#include "pool_node.h"
#include "tests/support/forked.h"

namespace indurop::pools {
namespace {

using indurop::test::Forked;
using test::kShape;
using test::PoolNode;
using vars::Mode;

TEST(Pool, A_chunk_goes_from_one_mapping_to_the_other) {
  const PoolNode node("map");
  auto made = Pool::create(node.name(), kShape);
  ASSERT_TRUE(made.ok());
  auto opened = Pool::open(node.name(), kShape.name, kShape.type_hash, Mode::ReadWrite);
  ASSERT_TRUE(opened.ok());
  const auto writer = made->take_seat("writer");
  const auto reader = opened->take_seat("reader");
  ASSERT_TRUE(writer.ok() && reader.ok());
  const auto chunk = made->chunks().take(*writer);
  ASSERT_TRUE(chunk);
  std::memset(made->data(*chunk), 0x5A, kShape.chunk_bytes);
  EXPECT_EQ(made->chunks().publish(*writer, *chunk, rt::mono_time(7)), 1U);
  const auto held = opened->chunks().latest(*reader);
  ASSERT_TRUE(held);
  EXPECT_EQ(std::to_integer<int>(opened->data(held->chunk)[kShape.chunk_bytes - 1]), 0x5A);
  const Usage usage = opened->usage();
  EXPECT_EQ(usage.numbers, 1U);
  EXPECT_EQ(usage.free, kShape.chunks - 1);
  EXPECT_EQ(usage.newest_ns, 7);
  ASSERT_EQ(usage.users.size(), 2U);
  EXPECT_EQ(usage.users[1].name, "reader");
  EXPECT_EQ(usage.users[1].holds, 1U);
  EXPECT_EQ(usage.users[1].seen, 1U);
}

TEST(Pool, Chunks_do_not_overlap) {
  const PoolNode node("apart");
  auto sut = Pool::create(node.name(), kShape);
  ASSERT_TRUE(sut.ok());
  for (std::uint32_t i = 0; i + 1 < kShape.chunks; ++i) {
    EXPECT_GE(sut->data(i + 1) - sut->data(i), static_cast<std::ptrdiff_t>(kShape.chunk_bytes));
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(sut->data(i)) % 64, 0U);
  }
}

TEST(Pool, A_new_run_of_the_same_shape_keeps_what_was_published) {
  const PoolNode node("adopt");
  {
    auto before = Pool::create(node.name(), kShape);
    ASSERT_TRUE(before.ok());
    const auto seat = before->take_seat("writer");
    const auto chunk = before->chunks().take(*seat);
    EXPECT_EQ(before->chunks().publish(*seat, *chunk, rt::mono_time(1)), 1U);
  }
  auto sut = Pool::create(node.name(), kShape);
  ASSERT_TRUE(sut.ok());
  EXPECT_TRUE(sut->chunks().latest(*sut->take_seat("reader")));
}

TEST(Pool, Another_shape_retires_the_file_that_others_use) {
  const PoolNode node("shape");
  auto before = Pool::create(node.name(), kShape);
  ASSERT_TRUE(before.ok());
  Shape larger = kShape;
  ++larger.chunks;
  auto sut = Pool::create(node.name(), larger);
  ASSERT_TRUE(sut.ok());
  EXPECT_TRUE(before->retired());
  EXPECT_FALSE(sut->retired());
  EXPECT_EQ(Pool::open(node.name(), kShape.name, kShape.type_hash, Mode::ReadWrite)->shape().chunks, larger.chunks);
}

TEST(Pool, A_removed_pool_is_retired_and_not_found) {
  const PoolNode node("gone");
  auto sut = Pool::create(node.name(), kShape);
  ASSERT_TRUE(sut.ok());
  const auto opened = Pool::open(node.name(), kShape.name, kShape.type_hash, Mode::ReadOnly);
  ASSERT_TRUE(opened.ok());
  sut->remove();
  EXPECT_TRUE(opened->retired());
  EXPECT_EQ(Pool::open(node.name(), kShape.name, kShape.type_hash, Mode::ReadOnly).error().code, Errc::NotFound);
  EXPECT_TRUE(vars::pool_files(node.name()).empty());
}

TEST(Pool, Shapes_that_cannot_be_are_refused) {
  const PoolNode node("bad");
  for (const Shape& shape : {Shape{"", 1, 64, 4}, Shape{"a", 1, 0, 4}, Shape{"a", 1, 64, 1}, Shape{"a", 1, 64, 65},
                             Shape{"a", 1, kMaxChunkBytes + 1, 2}, Shape{std::string(kMaxPoolName, 'x'), 1, 64, 2}}) {
    EXPECT_EQ(Pool::create(node.name(), shape).error().code, Errc::InvalidArgument) << shape.name;
  }
  EXPECT_EQ(Pool::create("a/b", kShape).error().code, Errc::InvalidArgument);
}

TEST(Pool, Another_type_is_refused) {
  const PoolNode node("type");
  ASSERT_TRUE(Pool::create(node.name(), kShape).ok());
  EXPECT_EQ(Pool::open(node.name(), kShape.name, kShape.type_hash + 1, Mode::ReadOnly).error().code,
            Errc::TypeMismatch);
}

struct Damage {
  std::size_t offset;
  std::uint64_t value;
};
class DamagedPool : public testing::TestWithParam<Damage> {};
INSTANTIATE_TEST_SUITE_P(
    Words, DamagedPool,
    testing::Values(Damage{offsetof(PoolHeader, magic), 5}, Damage{offsetof(PoolHeader, abi), 0xFFFFFFFFFFULL},
                    Damage{offsetof(PoolHeader, abi), kPoolAbi | std::uint64_t{65} << 32U},
                    Damage{offsetof(PoolHeader, chunk_bytes), std::uint64_t{1} << 40U},
                    Damage{offsetof(PoolHeader, stride), std::uint64_t{1} << 40U},
                    Damage{offsetof(PoolHeader, stride), 0xFFFFFFFFFFFFFFC0ULL},
                    Damage{offsetof(PoolHeader, data_offset), 0}, Damage{offsetof(PoolHeader, data_offset), 1U << 30U},
                    Damage{offsetof(PoolHeader, states), published_as(17)},
                    Damage{offsetof(PoolHeader, states), filled_by(200)}, Damage{offsetof(PoolHeader, states), 3}));

TEST_P(DamagedPool, Is_replaced_by_the_next_run) {
  const PoolNode node("damaged");
  ASSERT_TRUE(Pool::create(node.name(), kShape).ok());
  const int file = ::open(node.path().c_str(), O_WRONLY | O_CLOEXEC);
  ASSERT_EQ(::pwrite(file, &GetParam().value, sizeof(std::uint64_t), static_cast<off_t>(GetParam().offset)), 8);
  ::close(file);
  auto sut = Pool::create(node.name(), kShape);
  ASSERT_TRUE(sut.ok());
  EXPECT_EQ(sut->chunks().free(), kShape.chunks);
}

TEST(Pool, A_truncated_file_is_corrupt) {
  const PoolNode node("short");
  ASSERT_TRUE(Pool::create(node.name(), kShape).ok());
  ASSERT_EQ(::truncate(node.path().c_str(), sizeof(PoolHeader) / 2), 0);
  EXPECT_EQ(Pool::open(node.name(), kShape.name, kShape.type_hash, Mode::ReadOnly).error().code, Errc::Corrupt);
  EXPECT_TRUE(Pool::create(node.name(), kShape).ok());
}

TEST(Pool, Seats_are_limited_and_free_again_when_their_processes_end) {
  const PoolNode node("seats");
  auto sut = Pool::create(node.name(), kShape);
  ASSERT_TRUE(sut.ok());
  Forked child([&] {
    for (std::uint32_t i = 0; i < kSeats; ++i) {
      if (!sut->take_seat("child").ok()) {
        return 1;
      }
    }
    (void)sut->chunks().take(3);
    return sut->take_seat("one more").error().code == Errc::NoSpace ? 0 : 2;
  });
  EXPECT_EQ(child.wait(), 0);
  EXPECT_EQ(sut->sweep(), 1U);
  EXPECT_EQ(sut->usage().recovered, 1U);
  EXPECT_EQ(sut->usage().users.size(), 0U);
  EXPECT_TRUE(sut->take_seat("parent").ok());
}

TEST(Pool, A_stopped_process_keeps_what_it_holds) {
  const PoolNode node("stopped");
  auto sut = Pool::create(node.name(), kShape);
  ASSERT_TRUE(sut.ok());
  Forked child([&] {
    const auto seat = sut->take_seat("child");
    (void)sut->chunks().take(*seat);
    ::raise(SIGSTOP);
    return 0;
  });
  int status = 0;
  ASSERT_EQ(::waitpid(child.pid(), &status, WUNTRACED), child.pid());
  EXPECT_EQ(sut->sweep(), 0U);
  EXPECT_EQ(sut->usage().users.at(0).fills, 1U);
  child.kill_and_wait();
  EXPECT_EQ(sut->sweep(), 1U);
}

}  // namespace
}  // namespace indurop::pools
