// SPDX-License-Identifier: Apache-2.0
// Messages of two threads in one ring in every execution that C++ allows: none arrives mixed, twice, or before an
// earlier one of its thread.
#include <gmock/gmock.h>

#include "tests/support/weak_memory/substitute.h"

// NOLINTBEGIN(bugprone-suspicious-include): compiled here with the atomics of the model
#include "store/runtime/message_ring.cpp"
// NOLINTEND(bugprone-suspicious-include)

namespace indurop::runtime {
namespace {

using test::weak::explore;
using test::weak::Outcome;
using test::weak::Program;
using test::weak::Weakening;

constexpr std::uint32_t kCapacity = 2;

struct Block {
  scheduler::RunBlock run;
  scheduler::ModuleRecord module;
  std::array<scheduler::MessageRing, 2> rings;
  std::array<scheduler::MessageEntry, kCapacity> entries;
};

alignas(Block) std::array<std::byte, sizeof(Block)> memory{};

scheduler::RunBlock& new_block() {
  memory.fill(std::byte{0});
  auto& block = *reinterpret_cast<Block*>(memory.data());
  block.run.module_count = 1;
  block.run.modules_offset = offsetof(Block, module);
  block.run.rings_offset = offsetof(Block, rings);
  block.rings[0].capacity = kCapacity;
  block.rings[0].entries_offset = offsetof(Block, entries);
  return block.run;
}

// What is wrong with messages that were read, of a thread that pushes a1 and then a2, or of one that pushes b1.
std::string wrong_in(const std::vector<std::string>& read) {
  std::string all;
  for (const std::string& text : read) {
    if (text != "a1" && text != "a2" && text != "b1") {
      return "mixed: " + text;
    }
    if (std::count(read.begin(), read.end(), text) > 1) {
      return "twice: " + text;
    }
    all += text;
  }
  return all.find("a2") < all.find("a1") && all.find("a1") != std::string::npos ? "in another order: " + all : "";
}

// Each thread pushes its messages while another one tries to read two.
Outcome push_while_reading(const std::vector<std::vector<std::string>>& threads, const Weakening& without = {}) {
  static std::vector<std::string> read;
  return explore(
      [&] {
        scheduler::RunBlock& run = new_block();
        read.clear();
        Program program;
        for (const std::vector<std::string>& texts : threads) {
          program.threads.emplace_back([&] {
            for (const std::string& text : texts) {
              push_message(run, 0, text, rt::MonoTime{});
            }
          });
        }
        program.threads.emplace_back([&run] {
          MessageReader reader(run);
          Message message;
          for (int i = 0; i < 2; ++i) {
            if (reader.next(message, rt::MonoTime{})) {
              read.emplace_back(message.text);
            }
          }
        });
        program.check = [] { return wrong_in(read); };
        return program;
      },
      without);
}

TEST(WeakMessages, Of_two_threads_are_not_mixed) {
  const Outcome outcome = push_while_reading({{"a1"}, {"b1"}});
  EXPECT_EQ(outcome.wrong, "");
  EXPECT_TRUE(outcome.complete);
}

TEST(WeakMessages, Of_one_thread_arrive_once_and_in_order) {
  const Outcome outcome = push_while_reading({{"a1", "a2"}});
  EXPECT_EQ(outcome.wrong, "");
  EXPECT_TRUE(outcome.complete);
}

TEST(WeakMessages, Both_barriers_of_the_sequence_are_needed) {
  EXPECT_NE(push_while_reading({{"a1", "a2"}}, {.no_acquire_loads = true}).wrong, "");
  EXPECT_NE(push_while_reading({{"a1", "a2"}}, {.no_release_stores = true}).wrong, "");
}

}  // namespace
}  // namespace indurop::runtime
