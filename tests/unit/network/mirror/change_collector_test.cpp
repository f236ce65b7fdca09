// SPDX-License-Identifier: Apache-2.0
#include "network/mirror/frames/change_collector.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstring>
#include <memory>

namespace indurop::mirror {
namespace {

constexpr std::int64_t kCollectingMs = 1'000'000;

class CollectorOf : public ::testing::Test {
 protected:
  CollectorOf() : node_("collector" + std::to_string(::getpid())) {
    schema::Schema schema;
    for (const char* name : {"a", "b", "n"}) {
      schema::Variable v;
      v.name = name;
      v.type.base = schema::Base::UInt64;
      v.type.element_size = v.type.align = 8;
      if (v.name != "n") {
        v.type.dims = {1};
        v.kind = abi::Kind::Ring;
      }
      v.type_hash = schema::hash_of(v.type);
      schema.variables.push_back(v);
    }
    auto made = vars::Store::create(node_, schema);
    EXPECT_TRUE(made.ok());
    store_ = std::make_unique<vars::Store>(std::move(made).value());
    sut_ = std::make_unique<ChangeCollector>(*store_);
  }
  ~CollectorOf() override {
    store_.reset();
    (void)vars::remove_node(node_);
  }
  const vars::DirectoryEntry& entry(const std::string& name) {
    return *store_->find(abi::fnv1a64(name.data(), name.size()));
  }
  void put(const std::string& name, std::uint64_t value) {
    std::uint8_t bytes[8];
    std::memcpy(bytes, &value, 8);
    ASSERT_TRUE(store_->write(entry(name), 0, bytes).ok());
  }
  void add(const std::string& name, std::uint64_t& image, bool& changed, const Writers* writers) {
    sut_->add(entry(name), reinterpret_cast<std::uint8_t*>(&image), &changed, writers);
  }

  std::string node_;
  std::unique_ptr<vars::Store> store_;
  std::unique_ptr<ChangeCollector> sut_;
  std::uint64_t a_ = 0;
  std::uint64_t b_ = 0;
  bool changed_ = false;
};

TEST_F(CollectorOf, What_changed_is_copied_once) {
  add("a", a_, changed_, nullptr);
  add("n", b_, changed_, nullptr);
  put("a", 1);
  put("n", 2);
  EXPECT_FALSE(sut_->collect(kCollectingMs));
  EXPECT_TRUE(changed_);
  EXPECT_EQ(a_, 1U);
  EXPECT_EQ(b_, 2U);
  changed_ = false;
  EXPECT_FALSE(sut_->collect(2 * kCollectingMs));
  EXPECT_FALSE(changed_);
}

TEST_F(CollectorOf, Nothing_is_copied_while_its_writers_are_in_a_run) {
  std::uint64_t runs = 1;
  const Writers writers{[&] { return runs; }, true};
  add("a", a_, changed_, &writers);
  put("a", 1);
  EXPECT_FALSE(sut_->collect(kCollectingMs)) << "they tell when they are done";
  EXPECT_EQ(a_, 0U);
  runs = 2;
  (void)sut_->collect(2 * kCollectingMs);
  EXPECT_EQ(a_, 1U);
}

TEST_F(CollectorOf, A_board_that_does_not_announce_is_polled_again) {
  std::uint64_t runs = 1;
  const Writers writers{[&] { return runs; }, false};
  add("a", a_, changed_, &writers);
  put("a", 1);
  EXPECT_TRUE(sut_->collect(kCollectingMs));
  runs = 2;
  EXPECT_FALSE(sut_->collect(2 * kCollectingMs));
  EXPECT_EQ(a_, 1U);
}

TEST_F(CollectorOf, A_run_that_begins_during_the_copy_spoils_all_of_it) {
  std::uint64_t asked = 0;
  const Writers writers{[&]() -> std::uint64_t { return asked++ == 0 ? 0 : 3; }, true};
  add("a", a_, changed_, &writers);
  add("b", b_, changed_, &writers);
  put("a", 1);
  put("b", 1);
  (void)sut_->collect(kCollectingMs);
  EXPECT_EQ(a_, 0U);
  EXPECT_EQ(b_, 0U);
  EXPECT_FALSE(changed_);
}

TEST_F(CollectorOf, Others_are_copied_meanwhile) {
  const Writers busy{[] { return std::uint64_t{1}; }, true};
  add("a", a_, changed_, &busy);
  add("b", b_, changed_, nullptr);
  put("a", 1);
  put("b", 1);
  (void)sut_->collect(kCollectingMs);
  EXPECT_EQ(a_, 0U);
  EXPECT_EQ(b_, 1U);
}

TEST_F(CollectorOf, Patience_with_a_run_that_never_ends_does_end) {
  const Writers stuck{[] { return std::uint64_t{1}; }, true, 20 * kCollectingMs};
  add("a", a_, changed_, &stuck);
  put("a", 1);
  (void)sut_->collect(kCollectingMs);
  (void)sut_->collect(21 * kCollectingMs - 1);
  EXPECT_EQ(a_, 0U);
  (void)sut_->collect(21 * kCollectingMs);
  EXPECT_EQ(a_, 1U);
}

}  // namespace
}  // namespace indurop::mirror
