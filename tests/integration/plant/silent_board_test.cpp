// SPDX-License-Identifier: Apache-2.0
// What tools elsewhere say of a variable whose board is down, and how soon those of the other boards are there.

#include <fstream>

#include "tests/support/plant_fixture.h"

namespace indurop::test {
namespace {

using testing::HasSubstr;

class SilentBoard : public PlantTest {
 protected:
  [[nodiscard]] std::string plant() const {
    std::string file = path("plant.xml");
    std::ofstream out(file);
    out << "<plant name=\"pt\"><domain>" << domain() << "</domain><external>" << dds_domain(1)
        << "</external><types>" SOAK_MODULES "/libsoak_glb_types.so</types>";
    for (const char* name : {"left", "middle"}) {
      out << "<board name=\"" << board(name) << "\"><module><filename>" SOAK_MODULES "/soak_" << name
          << ".so</filename><moduletype>thread</moduletype><operationtype>periodic</operationtype><period>2ms</period>"
             "<priority>1</priority></module></board>";
    }
    out << "</plant>";
    return file;
  }
  Outcome remote(std::vector<std::string> words, const std::string& wait = "20s") {
    words.insert(words.begin(), INDUROP_PROGRAM);
    words.insert(words.end(), {"--one-host", "--domain", std::to_string(dds_domain(1)), "--wait", wait});
    return start(words).finish();
  }
};

TEST_F(SilentBoard, Is_named_and_the_others_are_not_waited_for) {
  start({INDUROP_PROGRAM, "run", plant(), "--local", "-q"});
  ASSERT_TRUE(wait_until([&] { return remote({"get", "left.number", "middle.number"}).code == 0; }));
  kill_node(board("middle"));
  Outcome sut;
  ASSERT_TRUE(wait_until([&] {
    sut = remote({"get", "middle.number"});
    return sut.code == 6;
  }));
  EXPECT_THAT(sut.err, HasSubstr("'middle.number' is of board " + board("middle") + ", which is silent"));
  EXPECT_EQ(remote({"get", "middle@" + board("middle")}).code, 6);
  EXPECT_EQ(remote({"set", "soak::middle.number=1"}).code, 6);
  const auto begin = std::chrono::steady_clock::now();
  const Outcome there = remote({"get", "left.number"});
  EXPECT_EQ(there.code, 0) << there.err;
  EXPECT_THAT(there.err, HasSubstr("silent: " + board("middle")));
  // Of the 20 s that it would wait for the silent board.
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(10));
}

TEST_F(SilentBoard, Of_which_nothing_is_known_is_named_with_what_was_asked_for) {
  // A board that runs alone: the other one never did, so no peer has announced what it shows.
  start({INDUROP_PROGRAM, "run", plant(), "--board", board("left"), "--one-host", "-q"});
  ASSERT_TRUE(wait_until([&] { return remote({"get", "left.number"}).code == 0; }));
  for (const std::string& name : {std::string("elsewhere"), "elsewhere@" + board("middle"), std::string("else*")}) {
    const Outcome sut = remote({"get", name}, "1s");
    EXPECT_EQ(sut.code, 6) << name;
    EXPECT_THAT(sut.err, HasSubstr("it may be of a board that is not heard: " + board("middle"))) << name;
  }
  EXPECT_THAT(remote({"get", "left@" + board("middle")}, "1s").err, HasSubstr(board("middle")));
}

TEST_F(SilentBoard, Peers_that_are_no_machines_are_reported_at_once) {
  const Outcome sut = remote({"get", "left.number", "--peer", "no such machine"});
  EXPECT_EQ(sut.code, 2);
  EXPECT_THAT(sut.err, HasSubstr("--peer no such machine: "));
}

TEST_F(SilentBoard, Peers_with_names_that_cannot_be_resolved_delay_no_longer_than_the_boards) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "the library that takes name servers away cannot be loaded before that of the sanitizer";
#endif
  const Outcome sut = start({INDUROP_PROGRAM, "get", "left.number", "--remote", "--one-host", "--peer", "nohost:7410",
                             "--wait", "100ms"},
                            {.variables = {"LD_PRELOAD=" STUCK_RESOLVER}})
                          .finish();
  EXPECT_EQ(sut.code, 6);
  EXPECT_THAT(sut.err, HasSubstr("--peer nohost:7410: no name server has answered yet"));
}

}  // namespace
}  // namespace indurop::test
