// SPDX-License-Identifier: Apache-2.0
#include "network/mirror/frames/receiver.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace indurop::mirror {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// Notes which streams are read.
class NotingPlane final : public Plane {
 public:
  Opened offer_frames(Stream /*stream*/) override { return {}; }
  Opened offer_catalogue() override { return {}; }
  Opened exchange_beacons(BeaconListener& /*listener*/) override { return {}; }
  Result<std::unique_ptr<Subscription>, base::Problem> subscribe(const std::string& /*board*/, Stream stream,
                                                                 FrameListener& /*listener*/) override {
    heard.push_back(stream);
    return std::make_unique<Subscription>();
  }
  void close() noexcept override {}
  bool send(const indurop_wire_Frame& /*frame*/, Stream /*stream*/) noexcept override { return true; }
  bool send(const indurop_wire_Catalogue& /*catalogue*/) noexcept override { return true; }
  bool send(const indurop_wire_Beacon& /*beacon*/) noexcept override { return true; }

  std::vector<Stream> heard;
};

class ReceiverOf : public ::testing::Test {
 protected:
  ReceiverOf() : node_("receiver" + std::to_string(::getpid())) {
    schema::Schema schema;
    for (const char* name : {"a", "b"}) {
      schema::Variable v;
      v.name = name;
      v.type.base = schema::Base::Int32;
      v.type.element_size = v.type.align = 4;
      v.kind = abi::Kind::Scalar;
      v.type_hash = schema::hash_of(v.type);
      schema.variables.push_back(v);
    }
    auto made = vars::Store::create(node_, schema);
    EXPECT_TRUE(made.ok());
    store_ = std::make_unique<vars::Store>(std::move(made).value());
    std::vector<Landing*> all;
    for (const auto& entry : store_->directory()) {
      landings_.push_back(std::make_unique<Landing>(*store_, entry, 0));
      all.push_back(landings_.back().get());
    }
    sut_ = std::make_unique<Receiver>("other", *store_, all, mutex_, *record_);
  }
  ~ReceiverOf() override {
    sut_.reset();
    landings_.clear();
    store_.reset();
    (void)vars::remove_node(node_);
  }

  // The other board announces its variables, a third one ("c") is not read here.
  void announce(std::uint64_t session, std::uint8_t a, std::uint8_t b, std::uint8_t c) {
    std::string names[] = {"a", "b", "c"};
    const std::uint8_t streams[] = {a, b, c};
    std::vector<indurop_wire_CatalogueEntry> entries;
    for (std::uint32_t i = 0; i < 3; ++i) {
      entries.push_back(
          {names[i].data(), store_->schema().variables.front().type_hash, i, 0, sizeof(std::int32_t), streams[i]});
    }
    std::string board = "other";
    std::string none;
    indurop_wire_Catalogue catalogue{};
    catalogue.board = board.data();
    catalogue.release = catalogue.schema = none.data();
    catalogue.session = session;
    catalogue.layout = 1;
    catalogue.entries._length = catalogue.entries._maximum = 3;
    catalogue.entries._buffer = entries.data();
    sut_->announced(catalogue, plane_);
  }
  PeerState state() { return record_->state.load(); }

  std::string node_;
  std::unique_ptr<vars::Store> store_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<Landing>> landings_;
  std::unique_ptr<PeerRecord> record_ = std::make_unique<PeerRecord>();
  std::unique_ptr<Receiver> sut_;
  NotingPlane plane_;
};

constexpr std::uint8_t kPrompt = 0;
constexpr std::uint8_t kLoose = 1;
constexpr std::uint8_t kBulk = 2;

TEST_F(ReceiverOf, Reads_only_streams_that_carry_what_this_board_reads) {
  announce(1, kPrompt, kPrompt, kBulk);
  EXPECT_THAT(plane_.heard, ElementsAre(Stream::Prompt));
  plane_.heard.clear();
  announce(2, kBulk, kLoose, kPrompt);
  EXPECT_THAT(plane_.heard, ElementsAre(Stream::Bulk, Stream::BestEffort));
}

TEST_F(ReceiverOf, A_catalogue_with_an_unknown_stream_is_refused) {
  announce(1, kPrompt, 3, kPrompt);
  EXPECT_EQ(state(), PeerState::Mismatched);
  EXPECT_THAT(record_->problem.get(), HasSubstr("damaged"));
  EXPECT_THAT(plane_.heard, IsEmpty());
}

TEST_F(ReceiverOf, A_board_that_seemed_silent_is_alive_again_without_a_new_catalogue) {
  announce(5, kPrompt, kPrompt, kPrompt);
  ASSERT_EQ(state(), PeerState::Alive);
  sut_->silent();
  ASSERT_EQ(state(), PeerState::Silent);
  sut_->alive(4);
  EXPECT_EQ(state(), PeerState::Silent) << "another run of the board, whose variables are not known";
  sut_->alive(5);
  EXPECT_EQ(state(), PeerState::Alive);
  EXPECT_EQ(record_->losses.load(), 1U);
}

TEST_F(ReceiverOf, A_board_whose_variables_differ_is_not_alive_after_silence_either) {
  announce(5, 3, kPrompt, kPrompt);
  sut_->silent();
  sut_->alive(5);
  EXPECT_EQ(state(), PeerState::Mismatched);
}

TEST_F(ReceiverOf, A_board_that_did_not_announce_itself_stays_absent) {
  sut_->alive(0);
  EXPECT_EQ(state(), PeerState::Absent);
}

}  // namespace
}  // namespace indurop::mirror
