// SPDX-License-Identifier: Apache-2.0
// A board with an older release in the network, whose protocol is another one: it is named, and disturbs no board.

#include "agents_fixture.h"
#include "core/schema/topic_name.h"

namespace indurop::test {
namespace {

using testing::HasSubstr;

class Releases : public AgentsTest {
 protected:
  void SetUp() override { file_ = manifest("v1.xml", {{"a", "steady"}, {"b", "steady"}}); }
  // What board a's node says of board b.
  Json peer() {
    const Json all = indurop_here({"status", "--node", board("a"), "-o", "json"}).json();
    return all.is_object() && all["mirror"].is_object() ? all["mirror"]["boards"][0] : Json{};
  }
  bool peer_is(const std::string& state) {
    return wait_until([&] {
      const Json one = peer();
      return one.is_object() && one["state"] == state;
    });
  }
  std::string file_;
};

TEST_F(Releases, An_agent_of_another_one_is_named_and_nothing_is_deployed) {
  start_agent("a");
  use_program(OLDER_PROGRAM);
  start_agent("b");
  const std::string named = "the agent of board " + board("b");
  ASSERT_TRUE(wait_until([&] { return indurop({"boards"}).err.find(named) != std::string::npos; }));
  const Outcome refused = deploy(file_, {"--timeout", "1s"});
  EXPECT_EQ(refused.code, 6);
  EXPECT_THAT(refused.err, HasSubstr("missing: " + board("b")));
  EXPECT_THAT(refused.err,
              HasSubstr("uses protocol 1 of another release, this one uses " + std::to_string(schema::protocol())));
  const Json seen = indurop({"boards", "-o", "json"}).json();
  ASSERT_EQ(seen["other_releases"].size(), 1U);
  EXPECT_EQ(seen["other_releases"][0]["board"], board("b"));
  EXPECT_EQ(seen["other_releases"][0]["protocol"], 1);
  EXPECT_EQ(report("a")["state"], "empty");
  // The same release on both.
  stop_agent("b", SIGTERM);
  use_program(AGENT_PROGRAM);
  start_agent("b");
  const Outcome done = deploy(file_);
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_TRUE(runs("b", done.json()["deployment"]));
  EXPECT_TRUE(wait_until([&] { return indurop({"boards", "-o", "json"}).json()["other_releases"].empty(); }));
}

TEST_F(Releases, A_node_of_another_one_is_named_by_the_others) {
  start_agent("a");
  start_agent("b");
  const Outcome done = deploy(file_);
  ASSERT_EQ(done.code, 0) << done.err;
  ASSERT_TRUE(peer_is("alive"));
  stop_agent("b", SIGTERM);
  ASSERT_TRUE(peer_is("silent"));
  Program& older = start({OLDER_NODE, file_, "--board", board("b"), "--one-host", "--quiet"});
  ASSERT_TRUE(peer_is("mismatched")) << older.err();
  EXPECT_THAT(peer()["problem"].get<std::string>(),
              HasSubstr("uses protocol 1 of another release, this board uses " + std::to_string(schema::protocol())));
  EXPECT_TRUE(runs("a", done.json()["deployment"]));
  older.signal(SIGTERM);
  (void)older.finish();
  EXPECT_TRUE(peer_is("silent"));
  start_agent("b");
  EXPECT_TRUE(peer_is("alive"));
  EXPECT_EQ(peer()["problem"], "");
}

}  // namespace
}  // namespace indurop::test
