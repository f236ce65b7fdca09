// SPDX-License-Identifier: Apache-2.0
// Births, deaths, data and commands of an edge node, against the rules of the Sparkplug specification 3.0.

#include "doors/mqtt/sparkplug/edge_node.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <memory>
#include <set>
#include <utility>

#include "core/rt/clock.h"
#include "described_board.h"
#include "doors/mqtt/sparkplug/birth_count.h"
#include "listed_outlet.h"

namespace indurop::mqtt {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;

constexpr std::int64_t kSecond = 1'000'000'000;

class EdgeNodeTest : public testing::Test {
 protected:
  EdgeNodeTest()
      : folder_(fs::path(testing::TempDir()) / ("edge_node_" + std::to_string(::getpid()))),
        backlog_(std::move(Backlog::open(folder_, 1U << 24U)).value()) {}
  ~EdgeNodeTest() override { fs::remove_all(folder_); }

  void make(const std::string& primary_host = {}) {
    sut_ = std::make_unique<EdgeNode>(
        SparkplugSettings{"g", "n", primary_host, {"host", "token-of-host"}}, outlet_, &backlog_,
        [this](Command command) { commands_.push_back(std::move(command)); }, base::Log("test", "t", true));
  }
  // A node with a board that has sent its first frame, connected.
  void make_born() {
    make();
    (void)board_.update(FrameBytes().frame());
    sut_->board_is_there(board_);
    sut_->connected(9);
  }
  void change(const FrameBytes& bytes) { sut_->changed(board_, board_.update(bytes.frame())); }
  // Everything that was sent, and that the sequence numbers are right.
  std::vector<std::pair<std::string, Payload>> take() {
    std::vector<std::pair<std::string, Payload>> all;
    for (const auto& message : outlet_.take()) {
      EXPECT_FALSE(message.retain) << message.topic;
      Payload payload = *decode(message.payload);
      if (message.topic.find("/NDEATH/") != std::string::npos) {
        EXPECT_FALSE(payload.seq);
      } else {
        seq_ = message.topic.find("/NBIRTH/") != std::string::npos ? 0 : (seq_ + 1) % 256;
        EXPECT_EQ(payload.seq, seq_) << message.topic;
      }
      all.emplace_back(message.topic.substr(8), std::move(payload));
    }
    return all;
  }
  std::vector<std::string> take_topics() {
    std::vector<std::string> all;
    for (const auto& [topic, payload] : take()) {
      all.push_back(topic);
    }
    return all;
  }
  static Payload command(Metric metric) {
    Payload payload;
    payload.metrics.push_back(std::move(metric));
    return payload;
  }
  static Metric named(std::string name, WireValue value) {
    Metric metric;
    metric.name = std::move(name);
    metric.value = std::move(value);
    return metric;
  }

  fs::path folder_;
  ListedOutlet outlet_;
  Backlog backlog_;
  std::vector<Command> commands_;
  Board board_ = make_board();
  std::unique_ptr<EdgeNode> sut_;
  std::uint64_t seq_ = 255;
};

TEST_F(EdgeNodeTest, Is_born_with_the_number_of_its_will) {
  const Will will = EdgeNode::will_of({"g", "n", "", {}}, 9, 5'000'000);
  EXPECT_EQ(will.topic, "spBv1.0/g/NDEATH/n");
  EXPECT_EQ(will.quality_of_service, 1);
  EXPECT_FALSE(will.retain);
  const auto death = decode(will.payload);
  ASSERT_EQ(death->metrics.size(), 1U);
  EXPECT_FALSE(death->seq);
  make_born();
  EXPECT_THAT(outlet_.filters, ElementsAre("spBv1.0/g/NCMD/n", "spBv1.0/g/DCMD/n/#"));
  const auto sent = take();
  ASSERT_EQ(sent.size(), 2U);
  EXPECT_EQ(sent[0].first, "g/NBIRTH/n");
  EXPECT_EQ(sent[0].second.metrics[0].name, "bdSeq");
  EXPECT_EQ(sent[0].second.metrics[0].value, death->metrics[0].value);
  EXPECT_EQ(sent[0].second.metrics[0].datatype, static_cast<std::uint32_t>(DataType::Int64));
  EXPECT_EQ(sent[0].second.metrics[1].name, "Node Control/Rebirth");
  EXPECT_EQ(sent[0].second.metrics[1].value, WireValue(false));
  EXPECT_EQ(sent[1].first, "g/DBIRTH/n/cell");
  std::set<std::uint64_t> aliases;
  for (const Metric& metric : sent[1].second.metrics) {
    EXPECT_TRUE(!metric.name.empty() && metric.datatype && metric.timestamp_ms && metric.alias) << metric.name;
    aliases.insert(*metric.alias);
  }
  EXPECT_EQ(aliases.size(), 8U);
}

TEST_F(EdgeNodeTest, Sends_data_by_alias) {
  make_born();
  const auto births = take();
  change(FrameBytes().gain(2.5).wall(1'700'000'000'456'000'000));
  const auto sent = take();
  ASSERT_EQ(sent.size(), 1U);
  EXPECT_EQ(sent[0].first, "g/DDATA/n/cell");
  ASSERT_EQ(sent[0].second.metrics.size(), 1U);
  const Metric& metric = sent[0].second.metrics[0];
  EXPECT_EQ(metric.alias, births[1].second.metrics[0].alias);
  EXPECT_EQ(metric.timestamp_ms, 1'700'000'000'456U);
  EXPECT_EQ(metric.value, WireValue(2.5));
  EXPECT_TRUE(metric.name.empty() && !metric.datatype && !metric.is_historical);
}

TEST_F(EdgeNodeTest, Sequence_numbers_wrap_after_255) {
  make_born();
  for (int i = 1; i < 600; ++i) {
    change(FrameBytes().gain(i));
  }
  EXPECT_EQ(take().size(), 601U);  // take() compares each number
}

TEST_F(EdgeNodeTest, Boards_die_and_are_born_again) {
  make_born();
  take();
  change(FrameBytes().alive(false));
  change(FrameBytes().alive(false).gain(3));
  EXPECT_THAT(take_topics(), ElementsAre("g/DDEATH/n/cell"));
  change(FrameBytes().gain(4));
  EXPECT_THAT(take_topics(), ElementsAre("g/DBIRTH/n/cell"));
  sut_->board_is_gone("cell");
  EXPECT_THAT(take_topics(), ElementsAre("g/DDEATH/n/cell"));
  change(FrameBytes().gain(5));
  EXPECT_TRUE(take().empty());
}

TEST_F(EdgeNodeTest, Another_layout_has_other_aliases) {
  make_born();
  const auto before = take()[1].second.metrics;
  Board other = make_board();
  (void)other.update(FrameBytes().frame());
  sut_->board_is_there(other);
  const auto after = take();
  ASSERT_EQ(after.size(), 1U);
  EXPECT_GT(after[0].second.metrics.front().alias, before.back().alias);
}

TEST_F(EdgeNodeTest, A_rebirth_begins_the_sequence_again_with_the_same_number) {
  make_born();
  const auto first = take();
  // A second one within a second of the birth would only repeat it.
  sut_->receive("spBv1.0/g/NCMD/n", encode(command(named("Node Control/Rebirth", true))));
  EXPECT_TRUE(take().empty());
  const std::int64_t end = rt::now_ns() + 60 * kSecond;
  std::vector<std::pair<std::string, Payload>> again;
  while (again.empty() && rt::now_ns() < end) {
    sut_->receive("spBv1.0/g/NCMD/n", encode(command(named("Node Control/Rebirth", true))));
    again = take();
  }
  ASSERT_EQ(again.size(), 2U);
  EXPECT_EQ(again[0].first, "g/NBIRTH/n");
  EXPECT_EQ(again[0].second.metrics[0].value, first[0].second.metrics[0].value);
  EXPECT_EQ(again[1].second.metrics[0].alias, first[1].second.metrics[0].alias);
  sut_->receive("spBv1.0/g/NCMD/n", encode(command(named("Node Control/Rebirth", false))));
  sut_->receive("spBv1.0/g/NCMD/n", "nonsense");
  EXPECT_TRUE(take().empty());
}

TEST_F(EdgeNodeTest, Data_without_a_connection_are_sent_later_as_historical) {
  make();
  sut_->board_is_there(board_);
  for (int i = 0; i < 3; ++i) {
    change(FrameBytes().gain(i).wall(i * kSecond));
  }
  EXPECT_TRUE(take().empty());
  sut_->connected(1);
  sut_->tick(rt::now_ns());
  const auto sent = take();
  ASSERT_EQ(sent.size(), 5U);
  EXPECT_EQ(sent[1].first, "g/DBIRTH/n/cell");
  for (std::size_t i = 0; i < 3; ++i) {
    const Payload& data = sent[2 + i].second;
    EXPECT_EQ(sent[2 + i].first, "g/DDATA/n/cell");
    EXPECT_EQ(data.metrics[0].name, "knu/gain");
    EXPECT_EQ(data.metrics[0].value, WireValue(static_cast<double>(i)));
    EXPECT_EQ(data.metrics[0].timestamp_ms, i * 1000);
    for (const Metric& metric : data.metrics) {
      EXPECT_TRUE(metric.is_historical);
    }
  }
  EXPECT_FALSE(backlog_.is_empty()) << "not confirmed yet";
  sut_->confirmed(1);
  EXPECT_TRUE(backlog_.is_empty());
}

TEST_F(EdgeNodeTest, What_was_not_confirmed_is_sent_again) {
  make_born();
  sut_->tick(rt::now_ns());
  change(FrameBytes().gain(1));
  sut_->tick(rt::now_ns());
  sut_->confirmed(outlet_.receipts);
  change(FrameBytes().gain(2));  // the broker may not have received this
  sut_->lost();
  change(FrameBytes().gain(3));
  take();
  sut_->connected(2);
  sut_->tick(rt::now_ns());
  std::vector<WireValue> kept;
  for (const auto& [topic, payload] : take()) {
    if (topic == "g/DDATA/n/cell") {
      kept.push_back(payload.metrics.at(0).value);
    }
  }
  EXPECT_THAT(kept, ElementsAre(WireValue(2.0), WireValue(3.0)));
  sut_->lost();  // before the receipt
  sut_->connected(3);
  take();
  sut_->tick(rt::now_ns());
  EXPECT_EQ(take().size(), 2U) << "both again";
}

TEST_F(EdgeNodeTest, Kept_data_wait_for_their_board) {
  make();
  sut_->board_is_there(board_);
  change(FrameBytes().gain(1));
  sut_->board_is_gone("cell");
  sut_->connected(1);
  sut_->tick(rt::now_ns());
  EXPECT_THAT(take_topics(), ElementsAre("g/NBIRTH/n"));
  sut_->board_is_there(board_);
  sut_->tick(rt::now_ns());
  EXPECT_THAT(take_topics(), ElementsAre("g/DBIRTH/n/cell", "g/DDATA/n/cell"));
  sut_->confirmed(outlet_.receipts);
  EXPECT_TRUE(backlog_.is_empty());
}

TEST_F(EdgeNodeTest, Kept_data_of_a_board_that_stays_away_are_given_up) {
  make();
  sut_->board_is_there(board_);
  change(FrameBytes().gain(1));
  sut_->board_is_gone("cell");
  sut_->connected(1);
  sut_->tick(rt::now_ns() + 61 * kSecond);
  sut_->confirmed(outlet_.receipts);
  EXPECT_TRUE(backlog_.is_empty());
}

TEST_F(EdgeNodeTest, Waits_for_its_primary_host) {
  make("scada");
  (void)board_.update(FrameBytes().frame());
  sut_->board_is_there(board_);
  sut_->connected(4);
  EXPECT_THAT(outlet_.filters, testing::Contains("spBv1.0/STATE/scada"));
  change(FrameBytes().gain(1));
  EXPECT_TRUE(take().empty());
  EXPECT_FALSE(backlog_.is_empty());
  sut_->receive("spBv1.0/STATE/scada", R"({"online":true,"timestamp":1000})");
  EXPECT_THAT(take_topics(), ElementsAre("g/NBIRTH/n", "g/DBIRTH/n/cell"));
  sut_->receive("spBv1.0/STATE/scada", R"({"online":false,"timestamp":999})");
  EXPECT_TRUE(take().empty()) << "the will of an earlier session";
  sut_->receive("spBv1.0/STATE/scada", R"({"online":false,"timestamp":1000})");
  EXPECT_THAT(take_topics(), ElementsAre("g/NDEATH/n"));
  EXPECT_EQ(outlet_.reconnects, 1);
}

TEST_F(EdgeNodeTest, Commands_are_requests_in_the_name_of_the_commander) {
  make_born();
  const auto births = take();
  Metric by_alias = named("", 7.5);
  by_alias.alias = births[1].second.metrics[0].alias;
  Payload both = command(by_alias);
  both.metrics.push_back(named("knu/joints[1]/on", true));
  sut_->receive("spBv1.0/g/DCMD/n/cell", encode(both));
  ASSERT_EQ(commands_.size(), 1U);
  EXPECT_EQ(commands_[0].board, "cell");
  EXPECT_EQ(commands_[0].token, "token-of-host");
  EXPECT_EQ(commands_[0].values.dump(), R"({"knu::gain":7.5,"knu::joints[1].on":true})");
  commands_[0].then({true, {}});
  EXPECT_TRUE(take().empty()) << "the change itself will be sent";
  commands_[0].then({false, base::Json{{"message", "no"}}});
  const auto sent = take();
  ASSERT_EQ(sent.size(), 1U);
  EXPECT_EQ(sent[0].second.metrics.size(), 2U) << "the values that were not changed";
}

TEST_F(EdgeNodeTest, Commands_that_do_not_fit_change_nothing) {
  make_born();
  for (const auto& metric : {named("knu/nothing", 1.0), named("knu/gain", std::string("1")), named("", 1.0)}) {
    Payload both = command(named("knu/gain", 1.0));
    both.metrics.push_back(metric);
    sut_->receive("spBv1.0/g/DCMD/n/cell", encode(both));
  }
  sut_->receive("spBv1.0/g/DCMD/n/other", encode(command(named("knu/gain", 1.0))));
  sut_->receive("spBv1.0/g/DCMD/n/cell", encode(Payload{}));
  EXPECT_TRUE(commands_.empty());
}

TEST(BirthCount, Goes_on_after_a_restart_and_wraps) {
  const fs::path file = fs::path(testing::TempDir()) / ("bdseq_" + std::to_string(::getpid()));
  for (std::uint64_t i = 0; i < 260; ++i) {
    BirthCount sut(file);
    EXPECT_EQ(sut.next(), i % 256);
    EXPECT_EQ(sut.problem(), "");
  }
  fs::remove(file);
  BirthCount nowhere(fs::path(testing::TempDir()) / "there_is_no_such_folder" / "bdseq");
  EXPECT_EQ(nowhere.next(), 0U);
  EXPECT_NE(nowhere.problem(), "");
}

}  // namespace
}  // namespace indurop::mqtt
