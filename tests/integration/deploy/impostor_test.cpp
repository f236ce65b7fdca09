// SPDX-License-Identifier: Apache-2.0
// A board that was taken over, and with its own keys reports as another one, answers its commands and sends its files.

#include <atomic>
#include <memory>
#include <set>
#include <string>
#include <thread>

#include "agents_fixture.h"
#include "core/keys/participant_keys.h"
#include "core/rt/clock.h"
#include "core/schema/topic_name.h"
#include "deploy/link/command_link.h"
#include "deploy/link/deploy_link.h"
#include "deploy/link/link_keys.h"
#include "deploy/link/reply_inbox.h"
#include "deploy/link/report_inbox.h"
#include "deploy/link/wire_words.h"
#include "network/dds/endpoint.h"
#include "network/dds/setup.h"

namespace indurop::test {
namespace {

using testing::HasSubstr;

// Says what it can in the name of a board, all the time.
class Rogue {
 public:
  Rogue(const std::string& keys, std::string claimed, int domain) : claimed_(std::move(claimed)) {
    settings_.network.domain = domain;
    settings_.network.one_host = true;
    settings_.network.security = deploy::security_of(keys::ParticipantKeys(keys));
    settings_.self = deploy::new_session();
    thread_ = std::thread([this] { run(); });
  }
  ~Rogue() {
    stop_ = true;
    thread_.join();
  }
  Rogue(const Rogue&) = delete;
  Rogue& operator=(const Rogue&) = delete;
  // How often it has lied about an agent that it has heard.
  [[nodiscard]] int lies() const { return lies_; }

 private:
  void run() {
    auto opened = deploy::DeployLink::open(settings_);
    ASSERT_TRUE(opened) << opened.error().text;
    auto commands = deploy::CommandLink::open(*opened->link, deploy::CommandSide::Agent);
    ASSERT_TRUE(commands);
    deploy::BoardReport lie;
    lie.board = claimed_;
    lie.host = "rogue";
    lie.plant = "rogue";
    lie.phase = deploy::Phase::Failed;
    while (!stop_) {
      opened->link->wait(rt::MonoClock::now() + std::chrono::milliseconds(10));
      lie.agent = settings_.self;
      opened->link->publish(lie);
      for (const auto& news : opened->link->take_boards()) {
        if (news.report.board == claimed_ && news.report.agent != settings_.self) {
          victim_ = news.report.agent;
        }
      }
      if (victim_ != 0) {
        lie.agent = victim_;
        opened->link->publish(lie);
        ++lies_;
      }
      for (const deploy::Command& command : (*commands)->take_commands()) {
        (*commands)->send(deploy::CommandReply{command.commander, command.board, command.agent, command.nonce,
                                               command.nonce == 0 ? deploy::Outcome::Nonce : deploy::Outcome::Done,
                                               "rogue"});
      }
      for (const deploy::BlobRequest& request : opened->link->take_requests()) {
        (void)opened->link->send(request.requester, {victim_, request.blob, 0, true, {}});
      }
    }
  }

  deploy::LinkSettings settings_;
  std::string claimed_;
  std::uint64_t victim_ = 0;
  std::atomic<int> lies_{0};
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

// Participants of one process, so that every sample has arrived when its write returns.
TEST(ReportInbox, Keeps_the_report_of_each_writer_however_often_another_one_writes_under_its_name) {
  dds::NetworkSettings network;
  network.domain = dds_domain(1);
  network.one_host = true;
  const auto joined = dds::join_network(network);
  ASSERT_TRUE(joined) << joined.error().text;
  const auto domain = static_cast<dds_domainid_t>(network.domain);
  const auto participant = [&] { return dds::Entity(dds_create_participant(domain, nullptr, nullptr)); };
  const dds::Entity board = participant();
  const dds::Entity rogue = participant();
  ASSERT_TRUE(board.ok() && rogue.ok()) << board.why() << rogue.why();
  const dds::Qos qos = dds::make_qos({.depth = 8});
  const std::string topic = "boards";
  rt::SignalWord wake{};
  wake.init(false);
  deploy::ReportInbox sut(wake);
  const auto reader =
      dds::make_reader(joined->participant.get(), indurop_deploy_BoardReport_desc, topic, qos, sut.listener());
  const auto truth = dds::make_writer(board.get(), indurop_deploy_BoardReport_desc, topic, qos);
  auto lies = dds::make_writer(rogue.get(), indurop_deploy_BoardReport_desc, topic, qos);
  ASSERT_TRUE(reader.ok() && truth.ok() && lies.ok());
  const auto write = [](const dds::Endpoint& by, std::uint64_t tick) {
    deploy::BoardReport report;
    report.board = "a";
    report.agent = 1;
    report.tick = tick;
    const deploy::wire::Lent lent(report);
    EXPECT_TRUE(dds::write(by.get(), lent.sample()).ok());
  };

  write(truth, 7);
  for (std::uint64_t lie = 0; lie < 100; ++lie) {
    write(lies, 1000 + lie);
  }
  const auto both = sut.take();
  ASSERT_EQ(both.size(), 2U);
  EXPECT_EQ(both[0].report.value_or(deploy::BoardReport{}).tick, 7U);
  EXPECT_EQ(both[1].report.value_or(deploy::BoardReport{}).tick, 1099U);
  EXPECT_EQ(both[1].reports, 100U);
  EXPECT_NE(both[0].publication, both[1].publication);
  EXPECT_TRUE(wake.try_wait());
  EXPECT_TRUE(sut.take().empty());

  lies.reset();
  write(truth, 8);
  const auto again = sut.take();
  ASSERT_EQ(again.size(), 1U) << "the board still writes it";
  EXPECT_EQ(again[0].report.value_or(deploy::BoardReport{}).tick, 8U);
  EXPECT_FALSE(again[0].gone);
}

TEST(CommandLink, Takes_the_answer_of_each_writer_however_often_another_one_answers) {
  deploy::LinkSettings settings;
  settings.network.domain = dds_domain(1);
  settings.network.one_host = true;
  settings.self = 5;
  const auto opened = deploy::DeployLink::open(settings);
  ASSERT_TRUE(opened) << opened.error().text;
  const auto sut = deploy::CommandLink::open(*opened->link, deploy::CommandSide::Commander);
  ASSERT_TRUE(sut) << sut.error().text;
  const auto domain = static_cast<dds_domainid_t>(settings.network.domain);
  const auto participant = [&] { return dds::Entity(dds_create_participant(domain, nullptr, nullptr)); };
  const dds::Entity board = participant();
  const dds::Entity rogue = participant();
  const dds::Qos qos = dds::make_qos({.for_late_ones = false, .depth = 16});
  const std::string topic = schema::deploy_topics() + "reply";
  const auto truth = dds::make_writer(board.get(), indurop_deploy_Reply_desc, topic, qos);
  const auto lies = dds::make_writer(rogue.get(), indurop_deploy_Reply_desc, topic, qos);
  ASSERT_TRUE(truth.ok() && lies.ok()) << truth.why() << lies.why();
  const auto write = [&](const dds::Endpoint& by, std::uint64_t nonce) {
    const deploy::CommandReply reply{settings.self, "a", 1, nonce, deploy::Outcome::Done, ""};
    const deploy::wire::Lent lent(reply);
    EXPECT_TRUE(dds::write(by.get(), lent.sample()).ok());
  };
  const auto taken = [&] {
    std::multiset<std::uint64_t> nonces;
    for (const deploy::CommandReply& reply : (*sut)->take_replies()) {
      nonces.insert(reply.nonce);
    }
    return nonces;
  };

  write(truth, 7);
  write(truth, 8);
  for (std::uint64_t lie = 0; lie < 100; ++lie) {
    write(lies, 1000 + lie);
  }
  std::multiset<std::uint64_t> expected{7, 8};
  for (std::uint64_t lie = 100 - deploy::ReplyInbox::kMaxOfWriter; lie < 100; ++lie) {
    expected.insert(1000 + lie);
  }
  EXPECT_EQ(taken(), expected);
  EXPECT_THAT(taken(), testing::IsEmpty());
}

class Impostors : public AgentsTest {
 protected:
  std::string module_state(const std::string& name) {
    const Json all = indurop_here({"status", "--node", board(name), "-o", "json"}).json();
    return all.is_object() && !all["modules"].empty() ? all["modules"][0]["state"].get<std::string>() : "none";
  }
};

TEST_F(Impostors, Are_named_and_neither_believed_nor_obeyed) {
  const std::string file = manifest("v1.xml", {{"a", "steady"}, {"b", "steady"}});
  bring_keys(file, {"a", "b"});
  start_agent("a");
  start_agent("b");
  speak_with_keys(path("keys"));
  ASSERT_TRUE(wait_until([&] { return report("a").is_object() && report("b").is_object(); }));
  const Rogue rogue(path("keys/boards/" + board("b")), board("a"), link_domain());
  ASSERT_TRUE(wait_until([&] { return rogue.lies() > 50; }));

  const Outcome done = deploy(file);
  ASSERT_EQ(done.code, 0) << done.err;
  const std::string first = done.json()["deployment"];
  EXPECT_TRUE(runs("a", first) && runs("b", first));
  const Outcome boards = indurop({"boards", "-o", "json"});
  const std::string named = "board " + board("b") + " reports in the name of board " + board("a");
  EXPECT_THAT(boards.err, HasSubstr(named));
  EXPECT_EQ(boards.json()["boards"].size(), 2U);
  const Json impostors = boards.json()["impostors"];
  ASSERT_EQ(impostors.size(), 1U) << boards.out;
  EXPECT_EQ(impostors[0]["claimed"], board("a"));
  EXPECT_EQ(impostors[0]["board"], board("b"));
  EXPECT_GT(impostors[0]["reports"], 0);
  EXPECT_THAT(agent("b").err(), HasSubstr(named)) << "the other agents say it, too";

  const Outcome stopped = indurop({"stop", "steady@" + board("a")});
  EXPECT_EQ(stopped.code, 0) << stopped.err;
  EXPECT_EQ(module_state("a"), "stopped") << "the answer was that of the board";
  EXPECT_EQ(deploy(manifest("v2.xml", {{"a", "other"}, {"b", "steady"}})).code, 0);
  const Outcome back = indurop({"rollback", "--health", "500ms"});
  EXPECT_EQ(back.code, 0) << back.err;
  EXPECT_TRUE(runs("a", first));
  EXPECT_EQ(indurop({"history", "-o", "json"}).json()["deployments"].size(), 3U);
}

}  // namespace
}  // namespace indurop::test
