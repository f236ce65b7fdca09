// SPDX-License-Identifier: Apache-2.0
// The deployment topics of an agent, as other participants see them.

#include "deploy/link/deploy_link.h"

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "agents_fixture.h"
#include "core/base/log.h"
#include "core/rt/clock.h"
#include "deploy/agent/lists_from_others.h"

namespace indurop::test {
namespace {

class DeployLinks : public AgentsTest {
 protected:
  struct Tool {
    std::uint64_t self = 0;
    std::unique_ptr<deploy::DeployLink> link;
  };
  static Tool open() {
    deploy::LinkSettings settings;
    settings.network.domain = link_domain();
    settings.network.one_host = true;
    settings.self = deploy::new_session();
    auto opened = deploy::DeployLink::open(settings);
    EXPECT_TRUE(opened);
    return {settings.self, std::move(opened->link)};
  }
};

// The agent has a writer for each tool that fetches from it, and deletes it when the tool no longer does.
TEST_F(DeployLinks, An_agent_stays_when_it_no_longer_sends_files_to_tools) {
  start_agent("a");
  std::vector<Tool> tools;
  for (int i = 0; i < 4; ++i) {
    tools.push_back(open());
  }
  std::uint64_t agent = 0;
  const auto reports_of = [&agent](const Tool& tool) {
    int reports = 0;
    for (const auto& news : tool.link->take_boards()) {
      EXPECT_FALSE(news.gone);
      agent = news.report.agent;
      ++reports;
    }
    return reports;
  };
  ASSERT_TRUE(wait_until([&] { return reports_of(tools[0]) > 0; }));
  for (const Tool& tool : tools) {
    EXPECT_TRUE(wait_until([&] {
      tool.link->request({tool.self, agent, "none of this name", 0, 1});
      return !tool.link->take_chunks().empty();
    }));
  }
  // It reports twice a second, and forgets a tool after 5 s.
  for (int reports = 0; reports < 16 && !HasFailure();) {
    tools[0].link->wait(rt::MonoClock::now() + std::chrono::seconds(1));
    reports += reports_of(tools[0]);
  }
}

// An agent that does not know the board yet when it asks does not get its first request.
TEST_F(DeployLinks, A_request_for_a_list_that_gets_no_answer_is_sent_again) {
  const Tool board = open();
  const Tool other = open();
  std::string taken;
  const deploy::PassedList list = {"a list", "list/", [](const std::string&) { return std::string("1"); },
                                   [&taken](const std::string&, const std::string& text) {
                                     taken = text;
                                     return std::string("taken");
                                   }};
  const base::Log log("test", "board", true);
  deploy::ListsFromOthers lists(board.self, {list}, log);
  const auto is_asked_for = [&other](const std::string& blob) {
    for (const deploy::BlobRequest& request : other.link->take_requests()) {
      if (request.blob == blob) {
        return true;
      }
    }
    return false;
  };
  ASSERT_TRUE(wait_until([&] {
    board.link->request({board.self, other.self, "none of this name", 0, 1});
    return is_asked_for("none of this name");
  }));
  const std::vector<std::uint64_t> agents = {other.self};
  const rt::MonoTime begin = rt::MonoClock::now();
  lists.step(*board.link, agents, "plant", begin);
  ASSERT_TRUE(wait_until([&] { return is_asked_for("list/1"); }));
  EXPECT_FALSE(lists.has_asked(agents));
  const rt::MonoTime later = begin + std::chrono::milliseconds(1001);
  lists.step(*board.link, agents, "plant", later);
  ASSERT_TRUE(wait_until([&] { return is_asked_for("list/1"); }));
  const std::string text = "users";
  ASSERT_TRUE(wait_until([&] {
    return other.link->send(board.self, {other.self, "list/1", 0, false, {text.begin(), text.end()}}) ==
           deploy::DeployLink::Sent::Yes;
  }));
  ASSERT_TRUE(wait_until([&] {
    lists.step(*board.link, agents, "plant", later);
    return taken == text;
  }));
  EXPECT_TRUE(lists.has_asked(agents));
}

}  // namespace
}  // namespace indurop::test
