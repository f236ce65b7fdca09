// SPDX-License-Identifier: Apache-2.0

#include "history/recorder/run_words.h"

#include <gmock/gmock.h>

#include <algorithm>

namespace indurop::recorder {
namespace {

TEST(RunWords, Come_back_as_they_were) {
  std::vector<std::uint8_t> cdr;
  to_cdr(RunWords{{1, 2, 3, -4, 5, 6}, 77, true, true, true}, cdr);
  const auto run = run_from_cdr(cdr);
  ASSERT_TRUE(run.ok());
  EXPECT_EQ(run->tail.number, 1U);
  EXPECT_EQ(run->tail.release_ns, -4);
  EXPECT_EQ(run->tail.end_ns, 6);
  EXPECT_EQ(run->module, 77U);
  EXPECT_TRUE(run->faulted);
  EXPECT_TRUE(run->anew);
  EXPECT_TRUE(run->exchanged);
  cdr.pop_back();
  const auto older = run_from_cdr(cdr);
  ASSERT_TRUE(older.ok()) << "of a recording that did not tell that";
  EXPECT_FALSE(older->exchanged);
  cdr.pop_back();
  const auto old = run_from_cdr(cdr);
  ASSERT_TRUE(old.ok()) << "of a recording that did not tell that either";
  EXPECT_TRUE(old->faulted);
  EXPECT_FALSE(old->anew);
  to_cdr(std::int64_t{-12}, cdr);
  EXPECT_EQ(clock_from_cdr(cdr).value(), -12);
  EXPECT_FALSE(run_from_cdr(cdr).ok());
  cdr.pop_back();
  EXPECT_FALSE(clock_from_cdr(cdr).ok());
  const std::vector<std::uint8_t> bytes{1, 2, 3};
  to_cdr(AnswerRecord{-7, bytes}, cdr);
  const auto answer = answer_from_cdr(cdr);
  ASSERT_TRUE(answer.ok());
  EXPECT_EQ(answer->code, -7);
  EXPECT_TRUE(std::equal(answer->bytes.begin(), answer->bytes.end(), bytes.begin(), bytes.end()));
  cdr.pop_back();
  EXPECT_FALSE(answer_from_cdr(cdr).ok());
}

TEST(RunWords, A_sequence_number_says_whose_value_it_is_and_as_what) {
  for (const std::uint32_t module : {0U, 5U, kOthers}) {
    for (const tape::EntryKind kind :
         {tape::EntryKind::Before, tape::EntryKind::Again, tape::EntryKind::Clock, tape::EntryKind::Answer}) {
      const ValueWords back = from_sequence(to_sequence({module, kind}));
      EXPECT_EQ(back.module, module);
      EXPECT_EQ(back.kind, kind);
    }
  }
}

}  // namespace
}  // namespace indurop::recorder
