// SPDX-License-Identifier: Apache-2.0
#include "store/vars/together.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <thread>

#include "store/vars/store.h"
#include "store/vars/tear_free_ring.h"
#include "test_schema.h"

namespace indurop::vars {
namespace {

using test::array_type;
using test::bytes_of;
using test::hash;
using test::scalar_type;
using test::TestNode;
using test::variable;

using Pair = std::array<std::uint64_t, 2>;

class Together : public ::testing::Test {
 protected:
  Together() : node_("together") {
    schema::Schema schema;
    schema.variables.push_back(variable("a", array_type(schema::Base::UInt64, 2)));
    schema.variables.push_back(variable("b", array_type(schema::Base::UInt64, 2)));
    schema.variables.push_back(variable("n", scalar_type(schema::Base::UInt64)));
    store_ = std::make_unique<Store>(std::move(Store::create(node_.name(), schema)).value());
  }
  template <class T>
  void put(const std::string& name, T value) {
    ASSERT_TRUE(store_->write(*store_->find(hash(name)), 0, bytes_of(value)).ok());
  }
  void* entry(const std::string& name) { return store_->entry(hash(name), 0); }
  bool read() {
    std::array<abi::Piece, 3> pieces{abi::Piece{entry("a"), &a_, abi::Kind::Ring, sizeof a_, 0, 0, 0},
                                     abi::Piece{entry("b"), &b_, abi::Kind::Ring, sizeof b_, 0, 0, 0},
                                     abi::Piece{entry("n"), &n_, abi::Kind::Scalar, sizeof n_, 0, 0, 0}};
    return read_together(pieces);
  }
  // As a mirror does: all three come from another board, the word lies with `a`.
  std::atomic<std::uint64_t>& mirrored() {
    auto& word = abi::update_word_of(entry("a"), abi::Kind::Ring);
    for (const char* name : {"a", "b", "n"}) {
      const auto kind = std::string(name) == "n" ? abi::Kind::Scalar : abi::Kind::Ring;
      abi::update_offset_of(entry(name), kind).store(reinterpret_cast<char*>(&word) - static_cast<char*>(entry(name)));
    }
    return word;
  }

  TestNode node_;
  std::unique_ptr<Store> store_;
  Pair a_{};
  Pair b_{};
  std::uint64_t n_ = 0;
};

TEST_F(Together, Own_variables_are_copied_whole) {
  put("a", Pair{1, 2});
  put("b", Pair{3, 4});
  put("n", std::uint64_t{5});
  EXPECT_TRUE(read());
  EXPECT_EQ(a_, (Pair{1, 2}));
  EXPECT_EQ(b_, (Pair{3, 4}));
  EXPECT_EQ(n_, 5U);
}

// a is written before b, so at every moment a is b or one ahead of it.
TEST_F(Together, Own_variables_are_as_of_one_moment) {
  std::atomic<bool> stop{false};
  std::thread writer([&] {
    for (std::uint64_t i = 1; !stop; ++i) {
      put("a", Pair{i, i});
      put("b", Pair{i, i});
    }
  });
  int together = 0;
  for (int i = 0; i < 100'000; ++i) {
    if (read()) {
      ++together;
      EXPECT_TRUE(a_[0] == b_[0] || a_[0] == b_[0] + 1) << a_[0] << " and " << b_[0];
    }
    EXPECT_EQ(a_[0], a_[1]) << "each value is whole in any case";
    EXPECT_EQ(b_[0], b_[1]);
  }
  stop = true;
  writer.join();
  EXPECT_GT(together, 0);
}

TEST_F(Together, An_update_that_is_being_taken_over_is_waited_for_but_not_for_ever) {
  auto& word = mirrored();
  put("a", Pair{1, 1});
  word.store(abi::kUpdating);
  EXPECT_FALSE(read());
  EXPECT_EQ(a_, (Pair{1, 1})) << "what is there is given";
  word.store(abi::kUpdateStep);
  EXPECT_TRUE(read());
}

TEST_F(Together, Values_of_different_updates_are_not_coherent) {
  mirrored().store(abi::kPartial);
  put("n", std::uint64_t{7});
  EXPECT_FALSE(read());
  EXPECT_EQ(n_, 7U);
}

TEST_F(Together, A_variable_that_is_sent_alone_belongs_to_no_others) {
  mirrored().store(0);
  abi::update_offset_of(entry("b"), abi::Kind::Ring).store(abi::kAlone);
  EXPECT_FALSE(read());
  std::array<abi::Piece, 1> alone{abi::Piece{entry("b"), &b_, abi::Kind::Ring, sizeof b_, 0, 0, 0}};
  EXPECT_TRUE(read_together(alone)) << "but it is what it is";
}

TEST_F(Together, Mirrored_values_are_never_of_two_updates) {
  auto& word = mirrored();
  std::atomic<bool> stop{false};
  std::thread mirror([&] {
    for (std::uint64_t i = 1; !stop; ++i) {
      word.store(word.load() | abi::kUpdating, std::memory_order_relaxed);
      std::atomic_thread_fence(std::memory_order_release);
      put("b", Pair{i, i});
      put("n", i);
      put("a", Pair{i, i});
      word.store((i + 1) * abi::kUpdateStep, std::memory_order_release);
      for (int k = 0; k < 200; ++k) {
        (void)word.load();
      }
    }
  });
  int together = 0;
  for (int i = 0; i < 100'000; ++i) {
    if (read()) {
      ++together;
      EXPECT_TRUE(a_[0] == b_[0] && b_[0] == n_) << a_[0] << ", " << b_[0] << ", " << n_;
    }
  }
  stop = true;
  mirror.join();
  EXPECT_GT(together, 0);
}

TEST_F(Together, A_new_run_owns_everything_again) {
  mirrored().store(abi::kPartial);
  schema::Schema same = store_->schema();
  store_.reset();
  store_ = std::make_unique<Store>(std::move(Store::create(node_.name(), same)).value());
  ASSERT_EQ(store_->origin(), Origin::Adopted);
  EXPECT_TRUE(read());
}

}  // namespace
}  // namespace indurop::vars
