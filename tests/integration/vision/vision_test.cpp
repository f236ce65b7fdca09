// SPDX-License-Identifier: Apache-2.0
// examples/vision with a real node: images in a pool, from a thread module to a process module, and deaths of both.

#include <csignal>
#include <nlohmann/json.hpp>

#include "node_fixture.h"
#include "store/pools/pool.h"
#include "store/vars/store.h"
#include "tests/support/wait_until.h"

namespace indurop::test {
namespace {

// cell::Vision::part
struct Part {
  std::uint64_t image;
  bool found;
  double x;
  double y;
  double error;
};

class Vision : public NodeTest {
 protected:
  Program& start_vision() {
    Program& program = start_file(VISION_DIR "/module.xml");
    EXPECT_TRUE(wait_until_running(program));
    return program;
  }
  [[nodiscard]] Part part() const { return value<Part>("cell::Vision::part"); }
  [[nodiscard]] bool reaches(std::uint64_t image) const {
    return wait_until([&] { return part().image >= image; });
  }
  [[nodiscard]] pools::Usage usage() const {
    const auto store = vars::Store::attach(node(), vars::Mode::ReadOnly);
    const schema::Pool& pool = store->schema().pools.at(0);
    return pools::Pool::open(node(), pool.name, pool.type_hash, vars::Mode::ReadOnly)->usage();
  }
};

TEST_F(Vision, Finds_the_part_where_it_is) {
  start_vision();
  ASSERT_TRUE(reaches(30));
  EXPECT_TRUE(part().found);
  EXPECT_LT(part().error, 1e-6);
}

TEST_F(Vision, Is_shown_with_chunks_drops_and_users) {
  start_vision();
  ASSERT_TRUE(reaches(30));
  const auto shown = nlohmann::json::parse(indurop({"get", "--node", node(), "camera", "-o", "json"}).out);
  const auto& camera = shown["pools"][0];
  EXPECT_EQ(camera["name"], "cell::Vision::camera");
  EXPECT_EQ(camera["chunks"], 4);
  EXPECT_GE(camera["published"], 30);
  ASSERT_EQ(camera["users"].size(), 2U);
  EXPECT_EQ(camera["users"][0]["name"], "camera");
  EXPECT_EQ(camera["users"][1]["name"], "finder");
  const Outcome status = indurop({"status", "--node", node()});
  EXPECT_CONTAINS(status.out, "pool      cell::Vision::camera: 4 chunks of ");
  EXPECT_CONTAINS(status.out, "finder (pid ");
}

TEST_F(Vision, Loses_only_what_a_killed_finder_had_in_its_hand) {
  start_vision();
  for (int kills = 0; kills < 3; ++kills) {
    ASSERT_TRUE(reaches(part().image + 3));
    ::kill(module("finder").pid.load(), SIGKILL);
  }
  ASSERT_TRUE(reaches(part().image + 10));
  EXPECT_TRUE(wait_until([&] { return usage().users.size() == 2; })) << "the dead have no seats";
  EXPECT_GE(usage().free, 1U);
  EXPECT_EQ(usage().without_a_chunk, 0U);
}

TEST_F(Vision, Keeps_its_images_when_the_node_is_killed) {
  Program& first = start_vision();
  ASSERT_TRUE(reaches(10));
  first.signal(SIGKILL);
  (void)first.finish();
  const std::uint64_t published = usage().numbers;
  EXPECT_GE(published, 10U);
  Program& second = start_vision();
  ASSERT_TRUE(reaches(published + 5)) << "numbers go on";
  second.signal(SIGTERM);
  (void)second.finish();
  EXPECT_TRUE(vars::pool_files(node()).empty()) << "an orderly end removes the pools";
}

}  // namespace
}  // namespace indurop::test
