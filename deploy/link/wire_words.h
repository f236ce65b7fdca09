// SPDX-License-Identifier: Apache-2.0
// The messages of deployment (deploy/words/) as samples of their IDL types: one list for each message maps its fields
// to those of the sample, and both directions use it. A field that is missing in list, message or IDL does not compile.

#pragma once

#include <indurop/idl/deploy.h>

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <list>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

#include "deploy/words/command_words.h"
#include "deploy/words/deployment_words.h"
#include "network/dds/lent.h"

namespace indurop::deploy::wire {

template <class Word, class WordField, class Sample, class SampleField>
struct Pair {
  WordField Word::*word;
  SampleField Sample::*sample;
};
template <class Word, class WordField, class Sample, class SampleField>
Pair(WordField Word::*, SampleField Sample::*) -> Pair<Word, WordField, Sample, SampleField>;

// The wire form of a message: `Sample`, and `kFields` as pairs.
template <class Word>
struct Wire;

template <>
struct Wire<BoardReport> {
  using Sample = indurop_deploy_BoardReport;
  static constexpr std::tuple kFields{
      Pair{&BoardReport::board, &Sample::board},
      Pair{&BoardReport::agent, &Sample::agent},
      Pair{&BoardReport::host, &Sample::host},
      Pair{&BoardReport::release, &Sample::release},
      Pair{&BoardReport::generation, &Sample::generation},
      Pair{&BoardReport::plant, &Sample::plant},
      Pair{&BoardReport::current, &Sample::current},
      Pair{&BoardReport::current_size, &Sample::current_size},
      Pair{&BoardReport::comment, &Sample::comment},
      Pair{&BoardReport::previous, &Sample::previous},
      Pair{&BoardReport::members, &Sample::members},
      Pair{&BoardReport::deployer, &Sample::deployer},
      Pair{&BoardReport::deployer_host, &Sample::deployer_host},
      Pair{&BoardReport::proposed, &Sample::proposed},
      Pair{&BoardReport::phase, &Sample::phase},
      Pair{&BoardReport::stage, &Sample::stage},
      Pair{&BoardReport::files, &Sample::files},
      Pair{&BoardReport::files_done, &Sample::files_done},
      Pair{&BoardReport::bytes, &Sample::bytes},
      Pair{&BoardReport::bytes_done, &Sample::bytes_done},
      Pair{&BoardReport::message, &Sample::message},
      Pair{&BoardReport::grant, &Sample::grant},
      Pair{&BoardReport::refused, &Sample::refused},
      Pair{&BoardReport::refusal, &Sample::refusal},
      Pair{&BoardReport::node, &Sample::node},
      Pair{&BoardReport::tick, &Sample::tick},
      Pair{&BoardReport::lost_ticks, &Sample::lost_ticks},
      Pair{&BoardReport::overruns, &Sample::overruns},
      Pair{&BoardReport::faults, &Sample::faults},
      Pair{&BoardReport::clock_offset_ns, &Sample::clock_offset_ns},
      Pair{&BoardReport::way, &Sample::way},
      Pair{&BoardReport::grid_ns, &Sample::grid_ns},
      Pair{&BoardReport::plan, &Sample::plan},
  };
};

template <>
struct Wire<Order> {
  using Sample = indurop_deploy_Order;
  static constexpr std::tuple kFields{
      Pair{&Order::deployer, &Sample::deployer},
      Pair{&Order::host, &Sample::host},
      Pair{&Order::plant, &Sample::plant},
      Pair{&Order::deployment, &Sample::deployment},
      Pair{&Order::size, &Sample::size},
      Pair{&Order::generation, &Sample::generation},
      Pair{&Order::boards, &Sample::boards},
      Pair{&Order::step, &Sample::step},
      Pair{&Order::said_at_ns, &Sample::said_at_ns},
      Pair{&Order::switch_at_ns, &Sample::switch_at_ns},
      Pair{&Order::health_ns, &Sample::health_ns},
      Pair{&Order::way, &Sample::way},
      Pair{&Order::grant, &Sample::grant},
      Pair{&Order::signature, &Sample::signature},
  };
};

template <>
struct Wire<BlobRequest> {
  using Sample = indurop_deploy_Request;
  static constexpr std::tuple kFields{
      Pair{&BlobRequest::requester, &Sample::requester}, Pair{&BlobRequest::source, &Sample::source},
      Pair{&BlobRequest::blob, &Sample::blob},           Pair{&BlobRequest::offset, &Sample::offset},
      Pair{&BlobRequest::length, &Sample::length},       Pair{&BlobRequest::restart, &Sample::restart},
  };
};

template <>
struct Wire<BlobChunk> {
  using Sample = indurop_deploy_Chunk;
  static constexpr std::tuple kFields{
      Pair{&BlobChunk::source, &Sample::source}, Pair{&BlobChunk::blob, &Sample::blob},
      Pair{&BlobChunk::offset, &Sample::offset}, Pair{&BlobChunk::missing, &Sample::missing},
      Pair{&BlobChunk::data, &Sample::data},
  };
};

template <>
struct Wire<Command> {
  using Sample = indurop_deploy_Command;
  static constexpr std::tuple kFields{
      Pair{&Command::commander, &Sample::commander}, Pair{&Command::host, &Sample::host},
      Pair{&Command::board, &Sample::board},         Pair{&Command::agent, &Sample::agent},
      Pair{&Command::plant, &Sample::plant},         Pair{&Command::action, &Sample::action},
      Pair{&Command::target, &Sample::target},       Pair{&Command::nonce, &Sample::nonce},
      Pair{&Command::signature, &Sample::signature},
  };
};

template <>
struct Wire<CommandReply> {
  using Sample = indurop_deploy_Reply;
  static constexpr std::tuple kFields{
      Pair{&CommandReply::commander, &Sample::commander}, Pair{&CommandReply::board, &Sample::board},
      Pair{&CommandReply::agent, &Sample::agent},         Pair{&CommandReply::nonce, &Sample::nonce},
      Pair{&CommandReply::outcome, &Sample::outcome},     Pair{&CommandReply::text, &Sample::text},
  };
};

// Converts to anything: the number of these that an aggregate accepts is its number of fields.
struct Anything {
  template <class T>
  operator T() const noexcept;  // NOLINT(google-explicit-constructor): what it is for
};
template <class Aggregate, class... Fields>
consteval std::size_t count_fields() {
  if constexpr (requires { Aggregate{Fields{}..., Anything{}}; }) {
    return count_fields<Aggregate, Fields..., Anything>();
  } else {
    return sizeof...(Fields);
  }
}
// `Parts`: base classes of the message, each of which counts as one field.
template <class Word, class... Parts>
consteval bool all_fields_travel() {
  constexpr std::size_t kListed = std::tuple_size_v<decltype(Wire<Word>::kFields)>;
  constexpr std::size_t kOfParts = (count_fields<Parts>() + ... + 0);
  return kListed == count_fields<typename Wire<Word>::Sample>() &&
         kListed == count_fields<Word>() - sizeof...(Parts) + kOfParts;
}
static_assert(all_fields_travel<BoardReport, CommittedDeployment, FetchProgress, NodeFigures>());
static_assert(all_fields_travel<Order>());
static_assert(all_fields_travel<BlobRequest>());
static_assert(all_fields_travel<BlobChunk>());
static_assert(all_fields_travel<Command>());
static_assert(all_fields_travel<CommandReply>());

// The message as DDS writes it. Borrows the message's memory, so the message must outlive it unchanged.
template <class Word>
class Lent {
 public:
  explicit Lent(const Word& word) {
    std::apply([&](const auto&... pair) { (put(word.*pair.word, sample_.*pair.sample), ...); }, Wire<Word>::kFields);
  }
  Lent(const Lent&) = delete;
  Lent& operator=(const Lent&) = delete;
  ~Lent() = default;
  [[nodiscard]] const typename Wire<Word>::Sample& sample() const noexcept { return sample_; }

 private:
  void put(const std::string& from, char*& to) { to = dds::lent(from); }
  template <std::integral Number>
  void put(Number from, Number& to) {
    to = from;
  }
  template <class Enum>
  requires std::is_enum_v<Enum>
  void put(Enum from, std::uint8_t& to) { to = static_cast<std::uint8_t>(from); }
  template <class Sequence>
  void put(const std::vector<std::uint8_t>& from, Sequence& to) {
    fill(to, dds::lent(from.data()), from.size());
  }
  template <class Sequence>
  void put(const std::vector<std::string>& from, Sequence& to) {
    std::vector<char*>& pointers = names_.emplace_back();
    for (const std::string& name : from) {
      pointers.push_back(dds::lent(name));
    }
    fill(to, pointers.data(), pointers.size());
  }
  template <class Sequence, class Item>
  static void fill(Sequence& to, Item* items, std::size_t count) {
    to._buffer = items;
    to._length = to._maximum = static_cast<std::uint32_t>(count);
    to._release = false;
  }

  typename Wire<Word>::Sample sample_{};
  std::list<std::vector<char*>> names_;
};

// Unknown numbers are mapped to the last enumerator, which is the most cautious assumption.
constexpr Phase last_of(Phase /*any*/) noexcept {
  return Phase::Failed;
}
constexpr Step last_of(Step /*any*/) noexcept {
  return Step::Abort;
}
constexpr Way last_of(Way /*any*/) noexcept {
  return Way::Compare;
}
constexpr NodeCondition last_of(NodeCondition /*any*/) noexcept {
  return NodeCondition::Stopped;
}
constexpr Action last_of(Action /*any*/) noexcept {
  return Action::SetTrust;
}
constexpr Outcome last_of(Outcome /*any*/) noexcept {
  return Outcome::Refused;
}
template <class Enum>
constexpr bool known(std::uint8_t number) noexcept {
  return number <= static_cast<std::uint8_t>(last_of(Enum{}));
}

inline void take(const char* from, std::string& to) {
  to = from;
}
template <std::integral Number>
void take(Number from, Number& to) {
  to = from;
}
template <class Enum>
requires std::is_enum_v<Enum>
void take(std::uint8_t from, Enum& to) {
  to = known<Enum>(from) ? static_cast<Enum>(from) : last_of(Enum{});
}
template <class Sequence, class Item>
void take(const Sequence& from, std::vector<Item>& to) {
  to.assign(from._buffer, from._buffer + from._length);
}

// Returns a copy of a received sample with all its fields.
template <class Word>
Word word_of(const typename Wire<Word>::Sample& sample) {
  Word word;
  std::apply([&](const auto&... pair) { (take(sample.*pair.sample, word.*pair.word), ...); }, Wire<Word>::kFields);
  return word;
}

}  // namespace indurop::deploy::wire
