// SPDX-License-Identifier: Apache-2.0
// Chunks in parts that are lost, repeated, in any order and mixed: what is published is compared byte by byte with what
// session and number determine, and which chunks that are, with a model that knows sets of parts only.

#include "doors/pools/assembler.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <random>
#include <set>
#include <utility>
#include <vector>

namespace indurop::pool_door {
namespace {

using std::chrono::milliseconds;

constexpr std::uint64_t kBytes = 3 * kPartBytes + 1234;  // four parts, the last one short

// Each byte of a chunk depends on session, number and place.
std::vector<std::byte> content(std::uint64_t session, std::uint64_t number, std::uint64_t size = kBytes) {
  std::vector<std::byte> bytes(size);
  std::uint64_t state = session * 0x9E3779B97F4A7C15ULL + number;
  for (std::size_t i = 0; i < size; i += sizeof state) {
    state = state * 6364136223846793005ULL + 1442695040888963407ULL;
    std::memcpy(bytes.data() + i, &state, std::min(sizeof state, size - i));
  }
  return bytes;
}

// The time of publishing says which chunk it is.
std::int64_t mark(std::uint64_t session, std::uint64_t number) {
  return static_cast<std::int64_t>(session * 1'000'000 + number);
}

// A pool with `size` chunks and no reader.
class Places final : public ChunkPlaces {
 public:
  explicit Places(std::size_t size) : memory_(size), taken_(size) {}
  std::optional<Place> take() override {
    const auto free = std::ranges::find(taken_, false);
    if (free == taken_.end()) {
      return std::nullopt;
    }
    *free = true;
    const auto index = static_cast<std::size_t>(free - taken_.begin());
    memory_[index].assign(kBytes, std::byte{0xEE});
    return Place{static_cast<std::uint32_t>(index), memory_[index].data()};
  }
  void publish(const Place& place, std::int64_t published_ns) override {
    published.emplace_back(published_ns, memory_.at(place.chunk));
    give_back(place);
  }
  void discard(const Place& place) override { give_back(place); }
  [[nodiscard]] std::size_t taken() const { return static_cast<std::size_t>(std::ranges::count(taken_, true)); }

  std::vector<std::pair<std::int64_t, std::vector<std::byte>>> published;

 private:
  void give_back(const Place& place) {
    EXPECT_TRUE(taken_.at(place.chunk)) << "a chunk is given back twice";
    taken_.at(place.chunk) = false;
  }
  std::vector<std::vector<std::byte>> memory_;
  std::vector<bool> taken_;
};

Part part_of(const std::vector<std::byte>& whole, std::uint64_t session, std::uint64_t number, std::uint64_t index) {
  const std::uint64_t offset = index * kPartBytes;
  return {session,      number, mark(session, number),
          whole.size(), offset, std::span(whole).subspan(offset, part_bytes(whole.size(), offset))};
}

// What should happen, by sets of parts.
class Model {
 public:
  explicit Model(std::size_t places) : places_(places) {}
  void add(std::uint64_t session, std::uint64_t number, std::uint64_t index, Assembler::Time now) {
    auto& [newest, parts, open, heard] = senders_[session];
    heard = now;
    if (number > newest) {
      incomplete += open ? 1 : 0;
      open = false;
      newest = number;
      parts.clear();
      open = filling() < places_;
      no_place += open ? 0 : 1;
    }
    if (number == newest && open) {
      parts.insert(index);
      if (parts.size() == parts_of(kBytes)) {
        published.push_back(mark(session, number));
        open = false;
      }
    }
  }
  void silence(Assembler::Time now) {
    for (auto& [session, sender] : senders_) {
      if (sender.open && now - sender.heard >= Assembler::kPatience) {
        sender.open = false;
        ++incomplete;
      }
    }
  }
  [[nodiscard]] std::size_t filling() const {
    return static_cast<std::size_t>(std::ranges::count_if(senders_, [](const auto& one) { return one.second.open; }));
  }

  std::vector<std::int64_t> published;
  std::uint64_t incomplete = 0;
  std::uint64_t no_place = 0;

 private:
  struct One {
    std::uint64_t newest = 0;
    std::set<std::uint64_t> parts{};
    bool open = false;
    Assembler::Time heard{};
  };
  std::size_t places_;
  std::map<std::uint64_t, One> senders_;
};

void expect_whole(const Places& places) {
  for (const auto& [which, bytes] : places.published) {
    const auto session = static_cast<std::uint64_t>(which) / 1'000'000;
    const auto number = static_cast<std::uint64_t>(which) % 1'000'000;
    ASSERT_EQ(bytes, content(session, number)) << "chunk " << number << " of sender " << session;
  }
}

struct Sent {
  std::uint64_t session = 0;
  std::uint64_t number = 0;
  std::uint64_t index = 0;
};

// A number below `end`.
unsigned below(std::mt19937& random, unsigned end) {
  return static_cast<unsigned>(random() % end);
}

// What senders send, each in its order, mixed with that of the others; some of it twice, and moved by up to `disorder`.
std::vector<Sent> traffic(std::mt19937& random, unsigned sessions, unsigned repetition_percent, unsigned disorder) {
  std::vector<Sent> network;
  std::map<std::uint64_t, Sent> next;
  for (unsigned i = 0; i < 400; ++i) {
    const std::uint64_t session = 1 + below(random, sessions);
    Sent& sent = next.try_emplace(session, Sent{session, 1, 0}).first->second;
    network.insert(network.end(), below(random, 100) < repetition_percent ? 2 : 1, sent);
    sent.index = (sent.index + 1) % parts_of(kBytes);
    sent.number += sent.index == 0 ? 1 + below(random, 3) : 0;
  }
  for (std::size_t i = 0; disorder > 0 && i < network.size(); ++i) {
    std::swap(network[i], network[std::min(network.size() - 1, i + below(random, disorder))]);
  }
  return network;
}

// Random networks: some lose much, some repeat, some change the order of parts over more than a chunk.
TEST(Assembler, Publishes_whole_chunks_as_the_model_does) {
  std::uint64_t all = 0;
  std::uint64_t lost = 0;
  for (unsigned seed = 1; seed <= 30; ++seed) {
    std::mt19937 random(seed);
    const std::size_t room = 1 + below(random, 4);
    const unsigned loss = below(random, 30);  // percent
    const std::vector<Sent> network = traffic(random, 1 + below(random, 5), below(random, 30), below(random, 7));
    Places places(room);
    Model model(room);
    Assembler assembler(places, kBytes);
    std::map<std::pair<std::uint64_t, std::uint64_t>, std::vector<std::byte>> made;
    Assembler::Time now{};
    for (const Sent& sent : network) {
      now += below(random, 50) == 0 ? Assembler::kPatience : milliseconds(1);
      assembler.give_up_silent(now);
      model.silence(now);
      if (below(random, 100) >= loss) {
        auto& whole = made[{sent.session, sent.number}];
        if (whole.empty()) {
          whole = content(sent.session, sent.number);
        }
        assembler.add(part_of(whole, sent.session, sent.number, sent.index), now);
        model.add(sent.session, sent.number, sent.index, now);
      }
      ASSERT_EQ(places.taken(), model.filling());
    }
    std::vector<std::int64_t> published;
    for (const auto& one : places.published) {
      published.push_back(one.first);
    }
    ASSERT_EQ(published, model.published) << "seed " << seed;
    ASSERT_EQ(assembler.counts().complete, model.published.size());
    ASSERT_EQ(assembler.counts().incomplete, model.incomplete);
    ASSERT_EQ(assembler.counts().no_place, model.no_place);
    all += model.published.size();
    lost += model.incomplete;
    assembler.give_up_all();
    ASSERT_EQ(places.taken(), 0U) << "the end gives everything up";
    expect_whole(places);
  }
  EXPECT_GT(all, 250U);
  EXPECT_GT(lost, 250U);
}

TEST(Assembler, Publishes_a_chunk_of_one_part_at_once) {
  Places places(1);
  Assembler assembler(places, 10);
  const auto whole = content(7, 1, 10);
  assembler.add(part_of(whole, 7, 1, 0), {});
  ASSERT_EQ(places.published.size(), 1U);
  EXPECT_TRUE(std::equal(whole.begin(), whole.end(), places.published[0].second.begin()));
  assembler.add(part_of(whole, 7, 1, 0), {});
  EXPECT_EQ(places.published.size(), 1U) << "a chunk that is repeated is not published again";
  EXPECT_EQ(assembler.counts().repeated, 1U);
}

TEST(Assembler, Refuses_parts_that_cannot_belong_to_a_chunk) {
  Places places(1);
  Assembler assembler(places, kBytes);
  const auto whole = content(1, 1);
  const Part good = part_of(whole, 1, 1, 1);
  std::vector<Part> bad(7, good);
  bad[0].offset += 1;
  bad[1].size += 1;
  bad[2].offset = 4 * kPartBytes;
  bad[3].data = bad[3].data.first(10);
  bad[4].offset = 3 * kPartBytes;  // the last part is shorter
  bad[5].number = 0;
  bad[6].offset = ~std::uint64_t{0} / kPartBytes * kPartBytes;
  for (const Part& part : bad) {
    assembler.add(part, {});
  }
  EXPECT_EQ(assembler.counts().malformed, bad.size());
  EXPECT_EQ(places.taken(), 0U);
}

TEST(Assembler, Drops_the_sender_that_was_silent_for_longest_if_there_are_too_many) {
  Places places(64);
  Assembler assembler(places, kBytes);
  const auto whole = content(1, 1);
  for (std::uint64_t session = 1; session <= Assembler::kMostSenders + 1; ++session) {
    assembler.add(part_of(whole, session, 1, 0), milliseconds(session));
  }
  EXPECT_EQ(places.taken(), Assembler::kMostSenders);
  EXPECT_EQ(assembler.counts().incomplete, 1U);
  for (std::uint64_t index = 1; index < parts_of(kBytes); ++index) {
    assembler.add(part_of(whole, 2, 1, index), milliseconds(100));
  }
  EXPECT_EQ(places.published.size(), 1U) << "the others are not affected";
}

}  // namespace
}  // namespace indurop::pool_door
