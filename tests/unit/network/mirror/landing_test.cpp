// SPDX-License-Identifier: Apache-2.0
#include "network/mirror/frames/landing.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstring>
#include <limits>
#include <memory>

namespace indurop::mirror {
namespace {

constexpr std::int64_t kLandingMs = 1'000'000;
constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max();

class LandingOf : public ::testing::Test {
 protected:
  LandingOf() : node_("landing" + std::to_string(::getpid())) {}
  ~LandingOf() override {
    store_.reset();
    (void)vars::remove_node(node_);
  }
  Landing& make(std::int64_t maxage_ns, bool fallback, int sources) {
    schema::Variable v;
    v.name = "v";
    v.type.base = schema::Base::Int32;
    v.type.element_size = v.type.align = 4;
    v.kind = abi::Kind::Scalar;
    v.type_hash = schema::hash_of(v.type);
    v.maxage_ns = maxage_ns;
    if (fallback) {
      v.fallback = {9, 0, 0, 0};
    }
    schema::Schema schema;
    schema.variables.push_back(v);
    auto made = vars::Store::create(node_, schema);
    EXPECT_TRUE(made.ok());
    store_ = std::make_unique<vars::Store>(std::move(made).value());
    sut_ = std::make_unique<Landing>(*store_, store_->directory().front(), 100 * kLandingMs);
    for (int i = 0; i < sources; ++i) {
      sut_->add_source();
    }
    return *sut_;
  }
  void deliver(std::size_t source, std::uint64_t session, std::int32_t value, std::int64_t now) {
    std::uint8_t bytes[4];
    std::memcpy(bytes, &value, 4);
    sut_->deliver({source, session, nullptr, now}, bytes, *record_);
  }
  std::int32_t value() {
    std::uint8_t bytes[4];
    EXPECT_TRUE(store_->read(store_->directory().front(), 0, bytes).ok());
    std::int32_t out = 0;
    std::memcpy(&out, bytes, 4);
    return out;
  }
  std::int64_t confirmed() {
    return abi::confirmed_of(store_->entry(store_->directory().front().name_hash, 0), abi::Kind::Scalar).load();
  }

  std::string node_;
  std::unique_ptr<vars::Store> store_;
  std::unique_ptr<Landing> sut_;
  std::unique_ptr<PeerRecord> record_ = std::make_unique<PeerRecord>();
};

TEST_F(LandingOf, A_value_is_written_and_confirmed) {
  make(0, false, 1);
  EXPECT_EQ(confirmed(), abi::kNeverConfirmed);
  deliver(0, 1, 5, 10 * kLandingMs);
  EXPECT_EQ(value(), 5);
  EXPECT_EQ(confirmed(), 10 * kLandingMs);
  deliver(0, 1, 5, 20 * kLandingMs);
  EXPECT_EQ(confirmed(), 20 * kLandingMs);
  EXPECT_EQ(record_->values.load(), 1U) << "written once, it did not change";
}

TEST_F(LandingOf, After_its_maxage_it_falls_back_and_comes_again) {
  Landing& sut = make(30 * kLandingMs, true, 1);
  deliver(0, 1, 5, 10 * kLandingMs);
  EXPECT_EQ(sut.expire(20 * kLandingMs), 40 * kLandingMs);
  EXPECT_EQ(value(), 5);
  EXPECT_EQ(sut.expire(40 * kLandingMs), kNever);
  EXPECT_EQ(value(), 9);
  deliver(0, 1, 5, 50 * kLandingMs);
  EXPECT_EQ(value(), 5);
}

TEST_F(LandingOf, Without_a_maxage_it_falls_back_when_its_board_is_silent) {
  Landing& sut = make(0, true, 1);
  deliver(0, 1, 5, 10 * kLandingMs);
  EXPECT_EQ(sut.expire(10'000 * kLandingMs), kNever);
  EXPECT_EQ(value(), 5);
  sut.silent(0, 10'000 * kLandingMs, *record_);
  EXPECT_LT(confirmed(), 0);
  sut.expire(10'000 * kLandingMs);
  EXPECT_EQ(value(), 9);
}

TEST_F(LandingOf, Never_heard_it_falls_back_when_patience_ends) {
  Landing& sut = make(0, true, 1);
  EXPECT_EQ(sut.expire(99 * kLandingMs), 100 * kLandingMs);
  EXPECT_EQ(value(), 0);
  sut.expire(100 * kLandingMs);
  EXPECT_EQ(value(), 9);
}

TEST_F(LandingOf, The_source_longest_in_service_leads) {
  make(0, false, 2);
  deliver(1, 20, 2, 1 * kLandingMs);
  EXPECT_EQ(value(), 2) << "the only one heard";
  deliver(0, 10, 1, 2 * kLandingMs);
  EXPECT_EQ(value(), 1);
  deliver(1, 20, 3, 3 * kLandingMs);
  EXPECT_EQ(value(), 1);
  EXPECT_EQ(confirmed(), 2 * kLandingMs);
}

TEST_F(LandingOf, When_the_leader_is_silent_the_others_last_value_counts_at_once) {
  Landing& sut = make(50 * kLandingMs, true, 2);
  deliver(0, 10, 1, 1 * kLandingMs);
  deliver(1, 20, 2, 2 * kLandingMs);
  sut.silent(0, 5 * kLandingMs, *record_);
  EXPECT_EQ(value(), 2);
  EXPECT_EQ(confirmed(), 5 * kLandingMs) << "valid all the time";
  deliver(0, 30, 7, 6 * kLandingMs);
  EXPECT_EQ(value(), 2) << "a restarted board does not take the lead back";
  sut.silent(1, 7 * kLandingMs, *record_);
  EXPECT_EQ(value(), 7);
  sut.silent(0, 8 * kLandingMs, *record_);
  EXPECT_LT(confirmed(), 0);
}

TEST_F(LandingOf, Equal_service_is_decided_by_the_manifests_order) {
  make(0, false, 2);
  deliver(1, 10, 2, 1 * kLandingMs);
  deliver(0, 10, 1, 2 * kLandingMs);
  EXPECT_EQ(value(), 1);
}

}  // namespace
}  // namespace indurop::mirror
