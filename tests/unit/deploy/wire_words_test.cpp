// SPDX-License-Identifier: Apache-2.0
// What is said arrives: every field of every word goes to its sample and comes back.

#include "deploy/link/wire_words.h"

#include <gtest/gtest.h>

namespace indurop::deploy {
namespace {

// Another value for each call, so that two fields that change places are seen.
class Different {
 public:
  void put(std::string& field) { field = "text " + std::to_string(++count_); }
  void put(std::vector<std::string>& field) { field = {std::to_string(++count_), "", std::to_string(++count_)}; }
  void put(std::vector<std::uint8_t>& field) { field = {static_cast<std::uint8_t>(++count_), 0, 255}; }
  void put(bool& field) { field = true; }
  template <std::integral Number>
  void put(Number& field) {
    field = static_cast<Number>(++count_);
  }
  template <class Enum>
  requires std::is_enum_v<Enum>
  void put(Enum& field) { field = wire::last_of(field); }

 private:
  unsigned count_ = 100;
};

template <class Word>
Word filled() {
  Word word;
  Different values;
  std::apply([&](const auto&... pair) { (values.put(word.*pair.word), ...); }, wire::Wire<Word>::kFields);
  return word;
}

template <class Word>
void expect_equal(const Word& sut, const Word& word) {
  const auto compare = [](const auto& a, const auto& b) { EXPECT_TRUE(a == b); };
  std::apply([&](const auto&... pair) { (compare(sut.*pair.word, word.*pair.word), ...); }, wire::Wire<Word>::kFields);
}

template <class Word>
class WireWords : public testing::Test {};
using Words = testing::Types<BoardReport, Order, BlobRequest, BlobChunk, Command, CommandReply>;
TYPED_TEST_SUITE(WireWords, Words);

TYPED_TEST(WireWords, Come_back_as_they_were) {
  const auto word = filled<TypeParam>();
  const wire::Lent lent(word);
  const auto sut = wire::word_of<TypeParam>(lent.sample());
  expect_equal(sut, word);
}

TYPED_TEST(WireWords, Come_back_when_they_are_empty) {
  const TypeParam word;
  const wire::Lent lent(word);
  const auto sut = wire::word_of<TypeParam>(lent.sample());
  expect_equal(sut, word);
}

TEST(WireNumbers, Beyond_those_known_here_stand_for_the_last) {
  BoardReport word;
  const wire::Lent lent(word);
  auto sample = lent.sample();
  sample.phase = 200;
  sample.node = 200;
  const auto sut = wire::word_of<BoardReport>(sample);
  EXPECT_EQ(sut.phase, Phase::Failed);
  EXPECT_EQ(sut.node, NodeCondition::Stopped);
  EXPECT_FALSE(wire::known<Action>(200));
  EXPECT_TRUE(wire::known<Action>(static_cast<std::uint8_t>(Action::UnshelveAlarms)));
}

}  // namespace
}  // namespace indurop::deploy
