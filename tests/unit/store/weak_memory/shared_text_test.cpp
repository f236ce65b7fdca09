// SPDX-License-Identifier: Apache-2.0
// A line of text that one thread changes while another one reads it, in every execution that C++ allows.
#include <gmock/gmock.h>

#include "tests/support/weak_memory/substitute.h"

#include "core/base/shared_text.h"

namespace indurop {
namespace {

using test::weak::explore;
using test::weak::Outcome;
using test::weak::Program;
using test::weak::Weakening;

// Returns what is wrong with a text that is changed twice while another thread reads it.
Outcome read_while_it_changes(const Weakening& without = {}) {
  alignas(base::SharedText) static std::byte memory[sizeof(base::SharedText)];
  static std::string seen;
  static bool whole;
  return explore(
      [] {
        std::fill(std::begin(memory), std::end(memory), std::byte{0});
        auto* const text = ::new (memory) base::SharedText;
        return Program{
            {[=] {
               text->set("ab");
               text->set("cd");
             },
             [=] { whole = text->try_get(seen); }},
            [] { return !whole || seen.empty() || seen == "ab" || seen == "cd" ? std::string() : "torn: " + seen; }};
      },
      without);
}

TEST(WeakText, No_text_is_torn) {
  const Outcome outcome = read_while_it_changes();
  EXPECT_EQ(outcome.wrong, "");
  EXPECT_TRUE(outcome.complete);
}

TEST(WeakText, Each_barrier_is_needed) {
  EXPECT_NE(read_while_it_changes({.no_acquire_fences = true}).wrong, "");
  EXPECT_NE(read_while_it_changes({.no_release_fences = true}).wrong, "");
  EXPECT_NE(read_while_it_changes({.no_acquire_loads = true}).wrong, "");
  EXPECT_NE(read_while_it_changes({.no_release_stores = true}).wrong, "");
}

}  // namespace
}  // namespace indurop
