// SPDX-License-Identifier: Apache-2.0
// The writer of retained values is killed at random instants: what is loaded next is always one complete save, and
// never an older one than was loaded before.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "fault.h"
#include "store/vars/retain.h"

namespace indurop::vars {
namespace {

using indurop::test::Forked;
using test::array_type;
using test::hash;
using test::TestNode;
using test::variable;

constexpr std::uint32_t kWords = 5000;

schema::Schema retained() {
  schema::Schema schema;
  schema.variables.push_back(variable("values", array_type(schema::Base::UInt64, kWords), true));
  return schema;
}

int save_for_ever(const std::string& node, const std::filesystem::path& directory) {
  auto store = Store::attach(node, Mode::ReadWrite);
  RetainFile file(directory);
  if (!store.ok() || !file.load(*store).ok()) {
    return 1;
  }
  std::vector<std::uint64_t> words(kWords);
  auto* const bytes = reinterpret_cast<std::uint8_t*>(words.data());
  const DirectoryEntry& entry = *store->find(hash("values"));
  while (store->read(entry, 0, {bytes, words.size() * 8}).ok()) {
    std::fill(words.begin(), words.end(), words[0] + 1);
    if (!store->write(entry, 0, {bytes, words.size() * 8}).ok() || !file.save(*store).ok()) {
      return 2;
    }
  }
  return 3;
}

TEST(KilledRetain, Newest_complete_save_is_always_there) {
  const TestNode node("killed-retain");
  const std::filesystem::path directory = std::string(kShmDirectory) + "/t-killed-retain-" + std::to_string(::getpid());
  auto store = Store::create(node.name(), retained());
  ASSERT_TRUE(store.ok());
  std::mt19937 random(5);
  std::uint64_t last = 0;
  int longest_us = 5000;
  for (const test::Duration duration; !duration.over();) {
    Forked saving([&] { return save_for_ever(node.name(), directory); });
    test::wait_a_random_moment(random, longest_us);
    saving.kill_and_wait();
    store->reset(false);
    const auto report = RetainFile(directory).load(*store);
    ASSERT_TRUE(report.ok());
    EXPECT_TRUE(report->notes.empty()) << report->notes[0];
    std::vector<std::uint64_t> words(kWords);
    ASSERT_TRUE(
        store->read(*store->find(hash("values")), 0, {reinterpret_cast<std::uint8_t*>(words.data()), kWords * 8}).ok());
    EXPECT_EQ(words, std::vector<std::uint64_t>(kWords, words[0]));
    EXPECT_GE(words[0], last);
    last = words[0];
    longest_us += last == 0 ? longest_us / 4 : 0;  // until the machine is quick enough for a first save
  }
  EXPECT_GT(last, 0U);
  std::filesystem::remove_all(directory);
}

}  // namespace
}  // namespace indurop::vars
