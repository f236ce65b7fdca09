// SPDX-License-Identifier: Apache-2.0
// The model of weak memory against the litmus tests of the literature (names as in Alglave et al., "Herding cats",
// 2014; results for C++ as in Lahav et al., "Repairing sequential consistency in C/C++11", 2017): what may happen does,
// in at least one execution, and what must not does not.
#include <gmock/gmock.h>

#include <functional>
#include <vector>

#include "tests/support/weak_memory/substitute.h"

namespace indurop::test::weak {
namespace {

constexpr auto kRelaxed = std::memory_order_relaxed;
constexpr auto kAcquire = std::memory_order_acquire;
constexpr auto kRelease = std::memory_order_release;
constexpr auto kSequential = std::memory_order_seq_cst;

class Litmus : public testing::Test {
 protected:
  // True if there is an execution after which `happened`.
  bool may_happen(const std::vector<std::function<void()>>& threads, const std::function<bool()>& happened,
                  const Weakening& without = {}) {
    const Outcome outcome = explore(
        [&] {
          x.store(0);
          y.store(0);
          a = b = c = d = -1;
          return Program{threads, [&] { return happened() ? std::string("it happened") : std::string(); }};
        },
        without);
    EXPECT_TRUE(outcome.complete || !outcome.wrong.empty());
    return !outcome.wrong.empty();
  }

  std::atomic<int> x;
  std::atomic<int> y;
  int a = -1;
  int b = -1;
  int c = -1;
  int d = -1;
};

TEST_F(Litmus, MP_a_message_is_passed_by_release_and_acquire_only) {
  const auto passes = [this](std::memory_order written, std::memory_order read) {
    return !may_happen({[=, this] {
                          x.store(1, kRelaxed);
                          y.store(1, written);
                        },
                        [=, this] {
                          a = y.load(read);
                          b = x.load(kRelaxed);
                        }},
                       [this] { return a == 1 && b == 0; });
  };
  EXPECT_TRUE(passes(kRelease, kAcquire));
  EXPECT_FALSE(passes(kRelaxed, kAcquire));
  EXPECT_FALSE(passes(kRelease, kRelaxed));
  EXPECT_FALSE(passes(kRelaxed, kRelaxed));
}

TEST_F(Litmus, MP_fences_pass_a_message_too) {
  const auto passes = [this](const Weakening& without) {
    return !may_happen(
        {[this] {
           x.store(1, kRelaxed);
           std::atomic_thread_fence(kRelease);
           y.store(1, kRelaxed);
         },
         [this] {
           a = y.load(kRelaxed);
           std::atomic_thread_fence(kAcquire);
           b = x.load(kRelaxed);
         }},
        [this] { return a == 1 && b == 0; }, without);
  };
  EXPECT_TRUE(passes({}));
  EXPECT_FALSE(passes({.no_acquire_fences = true}));
  EXPECT_FALSE(passes({.no_release_fences = true}));
}

TEST_F(Litmus, SB_two_that_write_first_and_read_then_may_both_miss_it) {
  const auto both_miss = [this](bool fences) {
    const auto thread = [this, fences](std::atomic<int>& to, std::atomic<int>& from, int& read) {
      to.store(1, kRelease);
      if (fences) {
        std::atomic_thread_fence(kSequential);
      }
      read = from.load(kAcquire);
    };
    return may_happen({[=, this] { thread(x, y, a); }, [=, this] { thread(y, x, b); }},
                      [this] { return a == 0 && b == 0; });
  };
  EXPECT_TRUE(both_miss(false));
  EXPECT_FALSE(both_miss(true));
}

TEST_F(Litmus, SB_sequential_accesses_do_not_both_miss_it_and_one_that_is_weaker_may) {
  const auto both_miss = [this](std::memory_order read) {
    const auto thread = [read](std::atomic<int>& to, std::atomic<int>& from, int& found) {
      to.store(1, kSequential);
      found = from.load(read);
    };
    return may_happen({[=, this] { thread(x, y, a); }, [=, this] { thread(y, x, b); }},
                      [this] { return a == 0 && b == 0; });
  };
  EXPECT_FALSE(both_miss(kSequential));
  EXPECT_TRUE(both_miss(kAcquire));
}

TEST_F(Litmus, IRIW_sequential_accesses_have_one_order) {
  const auto reads = [](std::atomic<int>& from, std::atomic<int>& then, int& first, int& second) {
    first = from.load(kSequential);
    second = then.load(kSequential);
  };
  EXPECT_FALSE(may_happen({[this] { x.store(1, kSequential); }, [this] { y.store(1, kSequential); },
                           [=, this] { reads(x, y, a, b); }, [=, this] { reads(y, x, c, d); }},
                          [this] { return a == 1 && b == 0 && c == 1 && d == 0; }));
}

TEST_F(Litmus, SB_a_fence_on_one_side_and_sequential_accesses_on_the_other) {
  EXPECT_FALSE(may_happen({[this] {
                             x.store(1, kRelaxed);
                             std::atomic_thread_fence(kSequential);
                             a = y.load(kRelaxed);
                           },
                           [this] {
                             y.store(1, kSequential);
                             b = x.load(kSequential);
                           }},
                          [this] { return a == 0 && b == 0; }));
}

TEST_F(Litmus, CoRR_a_thread_does_not_read_backwards) {
  EXPECT_FALSE(may_happen({[this] {
                             x.store(1, kRelaxed);
                             x.store(2, kRelaxed);
                           },
                           [this] {
                             a = x.load(kRelaxed);
                             b = x.load(kRelaxed);
                           }},
                          [this] { return a > b; }));
}

TEST_F(Litmus, CoRR2_all_threads_see_the_writes_of_a_place_in_one_order) {
  const auto reads = [this](int& first, int& second) {
    first = x.load(kRelaxed);
    second = x.load(kRelaxed);
  };
  const std::vector<std::function<void()>> threads = {[this] { x.store(1, kRelaxed); },
                                                      [this] { x.store(2, kRelaxed); }, [=, this] { reads(a, b); },
                                                      [=, this] { reads(c, d); }};
  EXPECT_FALSE(may_happen(threads, [this] { return a == 1 && b == 2 && c == 2 && d == 1; }));
  EXPECT_TRUE(may_happen(threads, [this] { return a == 2 && b == 1; })) << "but in any order";
}

TEST_F(Litmus, IRIW_writes_to_two_places_have_no_order_without_sequential_fences) {
  const auto differ = [this](bool fences) {
    const auto reads = [fences](std::atomic<int>& from, std::atomic<int>& then, int& first, int& second) {
      first = from.load(kAcquire);
      if (fences) {
        std::atomic_thread_fence(kSequential);
      }
      second = then.load(kAcquire);
    };
    return may_happen({[this] { x.store(1, kRelease); }, [this] { y.store(1, kRelease); },
                       [=, this] { reads(x, y, a, b); }, [=, this] { reads(y, x, c, d); }},
                      [this] { return a == 1 && b == 0 && c == 1 && d == 0; });
  };
  EXPECT_TRUE(differ(false));
  EXPECT_FALSE(differ(true));
}

TEST_F(Litmus, WRC_what_was_acquired_is_released_with_the_rest) {
  const auto lost = [this](std::memory_order between) {
    return may_happen({[this] { x.store(1, kRelaxed); },
                       [=, this] {
                         a = x.load(kRelaxed);
                         y.store(1, between);
                       },
                       [this] {
                         b = y.load(kAcquire);
                         c = x.load(kRelaxed);
                       }},
                      [this] { return a == 1 && b == 1 && c == 0; });
  };
  EXPECT_TRUE(lost(kRelaxed));
  EXPECT_FALSE(lost(kRelease));
}

TEST_F(Litmus, S_a_write_after_an_acquired_one_stands_behind_it) {
  const auto is_first = [this](std::memory_order read) {
    return may_happen({[this] {
                         x.store(2, kRelaxed);
                         y.store(1, kRelease);
                       },
                       [=, this] {
                         a = y.load(read);
                         x.store(1, kRelaxed);
                       }},
                      [this] { return a == 1 && x.load() == 2; });
  };
  EXPECT_TRUE(is_first(kRelaxed));
  EXPECT_FALSE(is_first(kAcquire));
}

TEST_F(Litmus, W2_writes_of_two_threads_may_stand_in_the_opposite_order) {
  EXPECT_TRUE(may_happen({[this] {
                            x.store(1, kRelease);
                            y.store(2, kRelease);
                          },
                          [this] {
                            y.store(1, kRelease);
                            x.store(2, kRelease);
                          }},
                         [this] { return x.load() == 1 && y.load() == 1; }));
}

TEST_F(Litmus, A_release_sequence_goes_through_a_relaxed_modification) {
  EXPECT_FALSE(may_happen({[this] {
                             x.store(1, kRelaxed);
                             y.store(1, kRelease);
                           },
                           [this] { y.fetch_add(1, kRelaxed); },
                           [this] {
                             a = y.load(kAcquire);
                             b = x.load(kRelaxed);
                           }},
                          [this] { return a == 2 && b == 0; }));
}

TEST_F(Litmus, Modifications_lose_nothing_and_stores_between_them_do) {
  EXPECT_FALSE(may_happen({[this] { x.fetch_add(1, kRelaxed); }, [this] { x.fetch_add(1, kRelaxed); }},
                          [this] { return x.load() != 2; }));
  const auto add = [this] { x.store(x.load(kSequential) + 1, kSequential); };
  EXPECT_TRUE(may_happen({add, add}, [this] { return x.load() != 2; }));
}

TEST_F(Litmus, One_of_two_comparisons_succeeds) {
  const auto swap = [this](int& won) {
    int expected = 0;
    won = x.compare_exchange_strong(expected, 1, kRelaxed) ? 1 : 0;
  };
  EXPECT_FALSE(may_happen({[=, this] { swap(a); }, [=, this] { swap(b); }}, [this] { return a + b != 1; }));
}

TEST_F(Litmus, A_mutex_orders_plain_accesses) {
  const auto add = [this] {
    lock(&y);
    x.store(x.load(kRelaxed) + 1, kRelaxed);
    unlock(&y);
  };
  EXPECT_FALSE(may_happen({add, add, add}, [this] { return x.load() != 3; }));
}

TEST_F(Litmus, Threads_that_wait_for_each_other_are_found) {
  const Outcome outcome = explore([this] {
    x.store(0);
    y.store(0);
    return Program{{[this] {
                      lock(&x);
                      lock(&y);
                      unlock(&y);
                      unlock(&x);
                    },
                    [this] {
                      lock(&y);
                      lock(&x);
                      unlock(&x);
                      unlock(&y);
                    }},
                   [] { return std::string(); }};
  });
  EXPECT_EQ(outcome.wrong, "threads wait for each other");
}

}  // namespace
}  // namespace indurop::test::weak
