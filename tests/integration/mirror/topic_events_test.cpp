// SPDX-License-Identifier: Apache-2.0
// Participants of one process: what one does has reached the other when the call returns.

#include "network/mirror/external/topic_events.h"

#include <memory>

#include "boards.h"
#include "network/dds/endpoint.h"
#include "network/dds/setup.h"
#include "network/mirror/frames/dds_plane.h"

namespace indurop::test {
namespace {

class TopicEventsTest : public ::testing::Test {
 protected:
  void SetUp() override {
    wake_.init(false);
    dds::NetworkSettings network;
    network.domain = Boards::domain();
    network.one_host = true;
    auto joined = dds::join_network(network);
    ASSERT_TRUE(joined) << joined.error().text;
    own_ = std::move(joined->participant);
    other_ = dds::Entity(dds_create_participant(static_cast<dds_domainid_t>(network.domain), nullptr, nullptr));
    ASSERT_TRUE(other_.ok()) << other_.why();
  }
  [[nodiscard]] dds::Endpoint reader(dds::Handle of, const dds::QosChoice& qos, const dds::Listener& listener = {}) {
    return dds::make_reader(of, indurop_wire_Frame_desc, "events", dds::make_qos(qos), listener);
  }
  [[nodiscard]] dds::Endpoint writer(dds::Handle of, const dds::QosChoice& qos, const dds::Listener& listener = {}) {
    return dds::make_writer(of, indurop_wire_Frame_desc, "events", dds::make_qos(qos), listener);
  }
  static void write(const dds::Endpoint& by) {
    const indurop_wire_Frame frame{};
    EXPECT_TRUE(dds::write(by.get(), frame).ok());
  }

  rt::SignalWord wake_{};
  mirror::TopicEvents sut_{wake_};
  dds::Participant own_;
  dds::Entity other_;
};

TEST_F(TopicEventsTest, Readers_are_counted_as_they_come_and_go) {
  const auto own = writer(own_.get(), {}, sut_.listener());
  EXPECT_EQ(sut_.readers(), 0);
  auto first = reader(other_.get(), {});
  const auto second = reader(other_.get(), {});
  EXPECT_EQ(sut_.readers(), 2);
  first.reset();
  EXPECT_EQ(sut_.readers(), 1);
  EXPECT_EQ(sut_.take_disagreements(), 0U);
}

TEST_F(TopicEventsTest, An_arrival_wakes_once_until_it_is_taken) {
  const auto own = reader(own_.get(), {}, sut_.listener());
  const auto other = writer(other_.get(), {});
  EXPECT_FALSE(sut_.take_arrival());
  write(other);
  write(other);
  EXPECT_TRUE(wake_.try_wait());
  EXPECT_FALSE(wake_.try_wait());
  EXPECT_TRUE(sut_.take_arrival());
  EXPECT_FALSE(sut_.take_arrival());
  write(other);
  EXPECT_TRUE(wake_.try_wait());
  EXPECT_TRUE(sut_.take_arrival());
}

TEST_F(TopicEventsTest, Disagreements_are_reported_once) {
  const auto own = reader(own_.get(), {.reliable = true}, sut_.listener());
  const auto first = writer(other_.get(), {.reliable = false});
  const auto second = writer(other_.get(), {.reliable = false});
  EXPECT_EQ(sut_.take_disagreements(), 2U);
  EXPECT_EQ(sut_.take_disagreements(), 0U);
  const auto offered = writer(own_.get(), {.reliable = false}, sut_.listener());
  const auto wanted = reader(other_.get(), {.reliable = true});
  EXPECT_EQ(sut_.take_disagreements(), 1U);
}

}  // namespace
}  // namespace indurop::test
