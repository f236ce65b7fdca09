// SPDX-License-Identifier: Apache-2.0
// INDUROP_MODULE, with names that collide with the fields'.

#include <gtest/gtest.h>
#include <indurop/indurop.h>

namespace {

int g_runs = 0;
[[maybe_unused]] int name = 0;

void start() {
  g_runs += 100;
}
void onRun() {
  ++g_runs;
}
bool event() {
  return true;
}

}  // namespace

INDUROP_MODULE(
    run = &::onRun, license = "Apache-2.0", start = &::start, condition = &::event, name = "gripper",
    stop = [] { g_runs = -1; }, description = "opens", author = "me")

TEST(ModuleDescriptor, Carries_all_fields_in_any_order) {
  indurop::ModuleDescriptor sut;
  indurop_module_describe(&sut);
  EXPECT_EQ(sut.size, sizeof sut);
  EXPECT_EQ(sut.abi, indurop::abi::kVersion);
  EXPECT_STREQ(sut.name, "gripper");
  EXPECT_STREQ(sut.description, "opens");
  EXPECT_STREQ(sut.author, "me");
  EXPECT_STREQ(sut.license, "Apache-2.0");
  ASSERT_TRUE(sut.condition);
  EXPECT_TRUE(sut.condition());
  sut.start();
  sut.run();
  EXPECT_EQ(g_runs, 101);
  sut.stop();
  EXPECT_EQ(g_runs, -1);
}

TEST(ModuleDescriptor, Of_an_older_node_is_not_written_beyond_its_size) {
  struct {
    indurop::ModuleDescriptor old{};
    unsigned char behind[8]{};
  } memory{};
  constexpr std::size_t kOldSize = offsetof(indurop::ModuleDescriptor, description);
  memory.old.size = kOldSize;
  memory.old.description = "untouched";
  indurop_module_describe(&memory.old);
  EXPECT_STREQ(memory.old.name, "gripper");
  EXPECT_STREQ(memory.old.description, "untouched");
}

TEST(Condition, Takes_int_and_bool_functions) {
  indurop::Condition sut;
  EXPECT_FALSE(sut);
  sut = +[]() -> int { return 2; };
  EXPECT_TRUE(sut());
  sut = +[]() -> bool { return false; };
  EXPECT_FALSE(sut());
}
