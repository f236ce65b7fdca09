// SPDX-License-Identifier: Apache-2.0
#include "network/dds/joining.h"

#include <unistd.h>

#include "board_schema.h"
#include "boards.h"
#include "core/rt/clock.h"
#include "network/dds/endpoint.h"
#include "network/mirror/frames/dds_plane.h"
#include "network/mirror/frames/sender.h"

namespace indurop::test {
namespace {

using namespace mirror;

Settings on_loopback() {
  Settings settings;
  settings.plant = "joining";
  settings.network.board = "a";
  settings.network.domain = Boards::domain();
  settings.network.one_host = true;
  return settings;
}

int entities_of(dds::Handle participant) {
  return dds_get_children(participant, nullptr, 0);
}

class JoiningTest : public ::testing::Test {
 protected:
  JoiningTest() { wake_.init(false); }
  std::atomic<bool> stop_{false};
  rt::SignalWord wake_{};
  base::SharedText problem_{};
};

TEST_F(JoiningTest, What_went_half_way_is_torn_down_before_the_next_try) {
  int opened = 0;
  int closed = 0;
  dds::Endpoint catalogue;
  dds::Joining sut(
      on_loopback().network,
      [&](dds::Handle participant) -> Result<void, base::Problem> {
        EXPECT_EQ(closed, opened);
        EXPECT_EQ(entities_of(participant), 0);
        catalogue = dds::make_writer(participant, indurop_wire_Catalogue_desc, "t", dds::make_qos({}));
        EXPECT_TRUE(catalogue.ok()) << catalogue.why();
        wake_.wake();  // no need to wait for the next try
        if (++opened < 3) {
          return base::Problem{"not yet"};
        }
        return {};
      },
      [&] {
        ++closed;
        catalogue.reset();
      });
  ASSERT_TRUE(sut.join(stop_, wake_, problem_));
  EXPECT_EQ(opened, 3);
  EXPECT_EQ(closed, 2);
  EXPECT_TRUE(catalogue.ok());
  sut.leave();
  EXPECT_EQ(closed, 3);
  sut.leave();
  EXPECT_EQ(closed, 3) << "it has left already";
}

TEST_F(JoiningTest, Ends_on_request_and_reports_why_it_waits) {
  Settings settings = on_loopback();
  settings.network.one_host = false;
  settings.network.interface_name = "nosuch0";
  dds::Joining sut(
      settings.network, [](dds::Handle) { return Result<void, base::Problem>{}; },
      [] { ADD_FAILURE() << "nothing was opened"; });
  std::thread other([&] {
    EXPECT_TRUE(wait_until([&] { return problem_.get().find("nosuch0") != std::string::npos; }));
    stop_ = true;
    wake_.wake();
  });
  EXPECT_FALSE(sut.join(stop_, wake_, problem_));
  other.join();
}

TEST_F(JoiningTest, An_endpoint_takes_its_topic_along) {
  const auto here = dds::join_network(on_loopback().network);
  ASSERT_TRUE(here.ok()) << here.error().text;
  const dds::Handle participant = here->participant.get();
  for (int i = 0; i < 3; ++i) {
    const dds::Endpoint writer = dds::make_writer(participant, indurop_wire_Frame_desc, "t/frame", dds::make_qos({}));
    const dds::Endpoint reader = dds::make_reader(participant, indurop_wire_Frame_desc, "t/frame", dds::make_qos({}));
    EXPECT_TRUE(writer.ok() && reader.ok());
    EXPECT_GT(entities_of(participant), 2);
  }
  EXPECT_EQ(entities_of(participant), 0);
}

// The values of the second participant must be those of writers of the second participant.
TEST_F(JoiningTest, A_sender_that_was_closed_sends_in_the_next_network) {
  const std::string node = "joining" + std::to_string(::getpid());
  auto store = vars::Store::create(node, make_schema("plain"));
  ASSERT_TRUE(store.ok());
  const auto block = std::make_unique<MirrorBlock>();
  Settings settings = on_loopback();
  settings.routes.outgoing = {{"t::count"}, {"t::large"}};
  Sender sut(store.value(), settings, 1, *block);
  DdsPlane plane(settings);
  for (int i = 0; i < 2; ++i) {
    const auto here = dds::join_network(settings.network);
    ASSERT_TRUE(here.ok()) << here.error().text;
    plane.enter(here->participant.get());
    const auto opened = sut.open(plane);
    ASSERT_TRUE(opened.ok()) << opened.error().text;
    const std::uint64_t sent = block->frames.load();
    sut.cycle(rt::now_ns(), 0, false);
    EXPECT_GT(block->frames.load(), sent);
    EXPECT_EQ(block->send_errors.load(), 0U);
    plane.close();
    EXPECT_EQ(entities_of(here->participant.get()), 0);
  }
  (void)vars::remove_node(node);
}

}  // namespace
}  // namespace indurop::test
