// SPDX-License-Identifier: Apache-2.0
#include "core/rt/shared_mutex.h"

#include <gtest/gtest.h>
#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <unistd.h>

#include <atomic>
#include <cstring>
#include <new>
#include <random>
#include <thread>

#include "core/rt/clock.h"
#include "tests/support/forked.h"
#include "tests/support/wait_until.h"

namespace indurop::rt {
namespace {

using indurop::test::Forked;
using indurop::test::wait_until;
using std::chrono::milliseconds;

struct Board {
  SharedMutex lock;
  std::atomic<bool> there;
  std::atomic<bool> go;
  std::atomic<bool> inside;  // set by the process that has the lock
  std::atomic<std::uint64_t> entered;
  std::atomic<std::uint64_t> met;  // processes found inside that were not killed there
};

class SharedLock : public testing::Test {
 protected:
  SharedLock()
      : board_(*new (::mmap(nullptr, sizeof(Board), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0))
                   Board{}) {
    EXPECT_TRUE(init_shared_mutex(board_.lock));
  }
  ~SharedLock() override { ::munmap(&board_, sizeof(Board)); }

  // In a process of its own: takes the lock and stays.
  int hold() {
    if (lock_within(board_.lock) != LockResult::Locked) {
      return 1;
    }
    board_.there = true;
    while (true) {
      ::pause();
    }
  }
  void wait_for_holder() {
    EXPECT_TRUE(wait_until([this] { return board_.there.load(); }));
  }

  Board& board_;
};

TEST_F(SharedLock, Is_taken_once_and_released_by_its_holder_only) {
  EXPECT_FALSE(unlock(board_.lock));
  EXPECT_EQ(lock_within(board_.lock), LockResult::Locked);
  EXPECT_EQ(lock_within(board_.lock), LockResult::HeldByCaller);
  EXPECT_EQ(try_lock(board_.lock), LockResult::HeldByCaller);
  EXPECT_TRUE(held_by(board_.lock, this_thread()));
  std::thread([this] {
    EXPECT_FALSE(held_by(board_.lock, this_thread()));
    EXPECT_FALSE(unlock(board_.lock));
    EXPECT_EQ(try_lock(board_.lock), LockResult::Timeout);
    EXPECT_EQ(lock_within(board_.lock), LockResult::Timeout);
  }).join();
  EXPECT_TRUE(unlock(board_.lock));
  EXPECT_FALSE(held_by(board_.lock, this_thread()));
  EXPECT_FALSE(unlock(board_.lock));
  std::thread([this] {
    EXPECT_EQ(try_lock(board_.lock), LockResult::Locked);
    EXPECT_TRUE(unlock(board_.lock));
  }).join();
}

TEST_F(SharedLock, Passes_to_the_next_when_its_holder_is_killed) {
  Forked process([this] { return hold(); });
  wait_for_holder();
  EXPECT_EQ(lock_within(board_.lock), LockResult::Timeout);
  process.kill_and_wait();
  EXPECT_EQ(try_lock(board_.lock), LockResult::OwnerDied);
  EXPECT_TRUE(unlock(board_.lock));
  EXPECT_EQ(lock_within(board_.lock), LockResult::Locked);
  EXPECT_TRUE(unlock(board_.lock));
}

TEST_F(SharedLock, Passes_to_who_waits_when_its_holder_is_killed) {
  Forked process([this] { return hold(); });
  wait_for_holder();
  std::atomic<LockResult> result{LockResult::Broken};
  std::thread waiting([&] {
    board_.go = true;
    result = lock_within(board_.lock, std::chrono::seconds(60));
    unlock(board_.lock);
  });
  EXPECT_TRUE(wait_until([this] { return board_.go.load(); }));
  process.kill_and_wait();
  waiting.join();
  EXPECT_EQ(result, LockResult::OwnerDied);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(lock_within(board_.lock), LockResult::Locked);
    EXPECT_TRUE(unlock(board_.lock));
  }
}

TEST_F(SharedLock, Passes_to_the_next_when_its_thread_ends) {
  std::thread([this] { EXPECT_EQ(lock_within(board_.lock), LockResult::Locked); }).join();
  EXPECT_EQ(try_lock(board_.lock), LockResult::OwnerDied);
  EXPECT_TRUE(unlock(board_.lock));
  EXPECT_EQ(lock_within(board_.lock), LockResult::Locked);
  EXPECT_TRUE(unlock(board_.lock));
}

TEST_F(SharedLock, What_a_parent_holds_is_not_its_childs) {
  ASSERT_EQ(lock_within(board_.lock), LockResult::Locked);
  Forked child([this] {
    const bool own = held_by(board_.lock, this_thread()) || unlock(board_.lock);
    return own || try_lock(board_.lock) != LockResult::Timeout ? 1 : 0;
  });
  EXPECT_EQ(child.wait(), 0);
  EXPECT_TRUE(unlock(board_.lock));
}

TEST_F(SharedLock, Memory_that_was_overwritten_is_no_lock) {
  const std::uint32_t no_thread = 0x3FFFFFF0;  // beyond the largest thread id
  std::memcpy(board_.lock.bytes, &no_thread, sizeof no_thread);
  EXPECT_EQ(lock_within(board_.lock), LockResult::Broken);
  EXPECT_FALSE(unlock(board_.lock));
}

// Several processes and threads, and some are killed anywhere.
TEST_F(SharedLock, No_two_processes_are_inside) {
  const auto work = [this] {
    while (!board_.go) {
      const LockResult result = lock_within(board_.lock);
      if (is_locked(result)) {
        const bool met = board_.inside.exchange(true) && result != LockResult::OwnerDied;
        board_.met.fetch_add(met ? 1 : 0);
        board_.entered.fetch_add(1);
        board_.inside = false;
        unlock(board_.lock);
      }
    }
    return 0;
  };
  Forked steady(work);
  std::thread thread(work);
  std::mt19937 random(3);
  for (int i = 0; i < 200; ++i) {
    Forked killed(work);
    std::this_thread::sleep_for(std::chrono::microseconds(random() % 2000));
    killed.kill_and_wait();
  }
  board_.go = true;
  thread.join();
  EXPECT_EQ(steady.wait(), 0);
  EXPECT_EQ(board_.met, 0U);
  EXPECT_GT(board_.entered, 1000U);
}

// On one core: a low one has the lock, a middle one never sleeps, the high one wants the lock.
TEST_F(SharedLock, A_holder_inherits_the_priority_of_who_waits) {
  cpu_set_t one;
  CPU_ZERO(&one);
  CPU_SET(static_cast<std::size_t>(::sched_getcpu()), &one);
  const auto become = [&one](int priority) {
    const sched_param parameter{priority};
    return ::sched_setaffinity(0, sizeof one, &one) == 0 &&
           ::pthread_setschedparam(::pthread_self(), SCHED_FIFO, &parameter) == 0;
  };
  bool may = false;
  std::thread([&] { may = become(1); }).join();
  if (!may) {
    GTEST_SKIP() << "needs the right to real-time priorities";
  }
  std::atomic<bool> end{false};
  std::atomic<int> started{0};
  std::atomic<LockResult> result{LockResult::Broken};
  std::thread low([&] {
    become(10);
    lock_within(board_.lock);
    board_.there = true;
    while (started < 2) {  // who starts the others may have this core only
      sleep_until(now_ns() + 100'000);
    }
    // Now the high one waits and the middle one is ready: without inheritance the rest is never run.
    const std::int64_t until = now_ns() + 20'000'000;
    while (now_ns() < until) {
    }
    unlock(board_.lock);
  });
  EXPECT_TRUE(wait_until([this] { return board_.there.load(); }));
  std::thread middle([&] {
    become(20);
    while (!board_.go && !end) {
      sleep_until(now_ns() + 100'000);
    }
    const std::int64_t until = now_ns() + 400'000'000;  // less than what real-time throttling allows
    while (!end && now_ns() < until) {
    }
  });
  std::thread high([&] {
    become(30);
    started = 2;
    board_.go = true;
    result = lock_within(board_.lock, milliseconds(300));
    unlock(board_.lock);
    end = true;
  });
  high.join();
  middle.join();
  low.join();
  EXPECT_EQ(result, LockResult::Locked);
}

}  // namespace
}  // namespace indurop::rt
