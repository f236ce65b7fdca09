// SPDX-License-Identifier: Apache-2.0
// indurop age, compared with values that say themselves how old they are.

#include <algorithm>
#include <cstring>
#include <fstream>
#include <limits>

#include "core/base/json.h"
#include "history/recording/mcap_reader.h"
#include "tests/support/plant_fixture.h"

namespace indurop::test {
namespace {

struct Truth {
  std::int64_t least = std::numeric_limits<std::int64_t>::max();
  std::int64_t most = 0;
};

class AgeTest : public PlantTest {
 protected:
  Outcome indurop(std::vector<std::string> words) {
    words.insert(words.begin(), INDUROP_PROGRAM);
    return start(words).finish();
  }
  static std::string module(int stage, const std::string& period, int priority, const std::string& wcet = "") {
    return "<module><filename>" AGE_MODULES "/age_" + std::to_string(stage) + ".so</filename><name>stage" +
           std::to_string(stage) + "</name><moduletype>thread</moduletype><operationtype>periodic</operationtype>" +
           "<period>" + period + "</period><priority>" + std::to_string(priority) + "</priority>" +
           (wcet.empty() ? "" : "<wcet>" + wcet + "</wcet>") + "</module>";
  }
  std::string write(const std::string& name, const std::string& text) {
    std::ofstream(path(name)) << text;
    return path(name);
  }
  base::Json ask(std::vector<std::string> more, int code) {
    more.insert(more.begin(), {"age", "ag::a", "ag::c", "-o", "json"});
    const Outcome sut = indurop(std::move(more));
    EXPECT_EQ(sut.code, code) << sut.err << sut.out;
    auto json = base::Json::parse(sut.out);
    EXPECT_TRUE(json && (*json)["chains"].values().size() == 1) << sut.out;
    return json ? (*json)["chains"].values()[0] : base::Json();
  }
  // All runs of the last module.
  static std::int64_t counted(const base::Json& chain) {
    std::int64_t sum = 0;
    for (const char* part : {"runs", "unclear", "disturbed", "unread"}) {
      sum += chain[part].integer().value_or(-1);
    }
    return sum;
  }
  // What the last module said in a recording.
  static Truth truth(const std::string& file) {
    Truth found;
    auto reader = recording::McapReader::open(file);
    EXPECT_TRUE(reader.ok());
    for (auto next = reader->next(); next && *next; next = reader->next()) {
      const recording::McapMessage& message = **next;
      if (reader->contents().channels.at(message.channel).topic != "ag::truth") {
        continue;
      }
      std::int64_t said = 0;  // behind the header of CDR
      EXPECT_EQ(message.data.view.size(), 4 + sizeof said);
      std::memcpy(&said, message.data.view.data() + 4, sizeof said);
      const std::int64_t age = said - 1;
      if (age >= 0) {
        found.least = std::min(found.least, age);
        found.most = std::max(found.most, age);
      }
    }
    return found;
  }
};

TEST_F(AgeTest, Of_one_board_is_what_the_values_say_and_reaches_what_is_predicted) {
  // The last one runs before the others.
  const std::string config =
      write("module.xml", "<root>" + module(1, "2ms", 2, "300us") + module(2, "5ms", 3, "400us") +
                              module(3, "1ms", 1, "100us") + "</root>");
  ASSERT_EQ(
      indurop({"run", config, "--sim", "--until", "2s", "-q", "--record", path("r.mcap"), "--node", board("one")}).code,
      0);
  const base::Json sut = ask({"--from", path("r.mcap")}, 0);
  const Truth right = truth(path("r.mcap"));
  EXPECT_EQ(sut["least_ns"].integer(), right.least);
  EXPECT_EQ(sut["most_ns"].integer(), right.most);
  EXPECT_EQ(sut["worst_ns"].integer(), right.most);
  EXPECT_LE(sut["best_ns"].integer(), right.least);
  EXPECT_GT(sut["runs"].integer(), 1980);
  EXPECT_EQ(sut["unclear"].integer(), 0);
  EXPECT_EQ(counted(sut), 2000);
}

TEST_F(AgeTest, Over_boards_is_what_the_values_say_and_within_what_is_predicted) {
  const std::string left =
      "<board name=\"" + board("left") + "\">" + module(1, "1ms", 1) + module(3, "2ms", 2) + "</board>";
  const std::string right = "<board name=\"" + board("right") + "\">" + module(2, "1ms", 1) + "</board>";
  const std::string plant = write("plant.xml", "<plant name=\"ag\"><domain>" + std::to_string(domain()) +
                                                   "</domain><external>off</external>" + left + right + "</plant>");
  ASSERT_EQ(indurop({"run", plant, "--sim", "--until", "5s", "-q", "--record", path("r.mcap"), "--network",
                     "delay=200us,jitter=900us,seed=3"})
                .code,
            0);
  const std::string first = path("r." + board("left") + ".mcap");
  const std::string second = path("r." + board("right") + ".mcap");
  const base::Json sut = ask({"--from", first, "--from", second, "--network", "1100us"}, 0);
  const Truth said = truth(first);
  EXPECT_EQ(sut["least_ns"].integer(), said.least);
  EXPECT_EQ(sut["most_ns"].integer(), said.most);
  EXPECT_LE(said.most, sut["worst_ns"].integer());
  EXPECT_GE(said.least, sut["best_ns"].integer());
  EXPECT_GT(sut["runs"].integer(), 2400);
  EXPECT_LE(sut["unclear"].integer(), 2) << "at the begin";
  EXPECT_EQ(counted(sut), 2500);

  ASSERT_EQ(indurop({"recording", "join", first, second, "-o", path("both.mcap"), "-q"}).code, 0);
  const base::Json joined = ask({"--from", path("both.mcap"), "--network", "1100us"}, 0);
  EXPECT_EQ(joined["most_ns"].integer(), said.most);
  EXPECT_EQ(joined["runs"].integer(), sut["runs"].integer());

  (void)ask({"--from", first, "--from", second, "--network", "10us"}, 4);
  const Outcome one = indurop({"age", "ag::a", "ag::c", "--from", first});
  EXPECT_EQ(one.code, 4);
  EXPECT_THAT(one.err, ::testing::HasSubstr("a recording of one of its boards is missing"));
}

TEST_F(AgeTest, Of_a_live_node_lies_within_what_its_values_said) {
  const std::string config =
      write("module.xml", "<root>" + module(1, "5ms", 1) + module(2, "5ms", 2) + module(3, "10ms", 3) + "</root>");
  Program& node = start({INDUROP_PROGRAM, "run", config, "-q", "--record", path("r.mcap"), "--node", board("live")});
  ASSERT_TRUE(wait_until([&] {
    const auto store = vars::Store::attach(board("live"), vars::Mode::ReadOnly);
    const auto* entry = store ? store->find(abi::fnv1a64("ag::truth", 9)) : nullptr;
    std::int64_t age = 0;
    return entry != nullptr && store->read(*entry, 0, {reinterpret_cast<std::uint8_t*>(&age), sizeof age}) && age > 0;
  })) << node.err();
  const Outcome asked = indurop({"age", "ag::a", "ag::c", "-o", "json", "--node", board("live"), "--duration", "1s"});
  node.signal(SIGINT);
  EXPECT_EQ(node.wait(), 130) << node.err();
  const auto json = base::Json::parse(asked.out);
  ASSERT_TRUE(json) << asked.err;
  const base::Json& sut = (*json)["chains"].values()[0];
  const Truth right = truth(path("r.mcap"));
  ASSERT_GT(sut["runs"].integer().value_or(0) + sut["disturbed"].integer().value_or(0), 0);
  if (sut["runs"].integer() > 0) {
    EXPECT_EQ(asked.code, 0) << asked.out;
    EXPECT_GE(sut["least_ns"].integer(), right.least);
    EXPECT_LE(sut["most_ns"].integer(), right.most);
  }
}

TEST_F(AgeTest, Says_what_it_cannot_do) {
  const std::string config =
      write("module.xml", "<root>" + module(1, "5ms", 1) + module(2, "5ms", 2) + module(3, "10ms", 3) + "</root>");
  ASSERT_EQ(
      indurop({"run", config, "--sim", "--until", "1s", "-q", "--record", path("r.mcap"), "--node", board("one")}).code,
      0);
  const Outcome unknown = indurop({"age", "ag::aa", "ag::c", "--from", path("r.mcap")});
  EXPECT_EQ(unknown.code, 1);
  EXPECT_THAT(unknown.err, ::testing::HasSubstr("no module reads or writes 'ag::aa'. Did you mean"));
  const Outcome backwards = indurop({"age", "ag::c", "ag::a", "--from", path("r.mcap")});
  EXPECT_EQ(backwards.code, 1);
  EXPECT_THAT(backwards.err, ::testing::HasSubstr("nothing leads from ag::c to ag::a"));
  const Outcome none = indurop({"age", "ag::a", "ag::c", "--from", config});
  EXPECT_EQ(none.code, 1);
  EXPECT_THAT(none.err, ::testing::HasSubstr("module.xml"));
}

}  // namespace
}  // namespace indurop::test
