// SPDX-License-Identifier: Apache-2.0
#include "network/mirror/simulated/network.h"

#include <algorithm>
#include <cmath>

namespace indurop::mirror {
namespace {

using Kind = Message::Kind;

// The generator of Steele, Lea and Flood: every seed gives a long sequence, and adjacent seeds differ at once.
std::uint64_t next_chance(std::uint64_t& state) noexcept {
  state += 0x9e3779b97f4a7c15ULL;
  std::uint64_t mixed = state;
  mixed = (mixed ^ (mixed >> 30U)) * 0xbf58476d1ce4e5b9ULL;
  mixed = (mixed ^ (mixed >> 27U)) * 0x94d049bb133111ebULL;
  return mixed ^ (mixed >> 31U);
}

// Returns whether messages of this kind are repeated until they arrive.
bool is_reliable(Kind kind) noexcept {
  return kind == Kind::Prompt || kind == Kind::Bulk || kind == Kind::Catalogue;
}

bool is_before(std::int64_t time, std::uint32_t board, std::uint64_t number, const Message& other,
               std::uint64_t other_number) noexcept {
  if (time != other.time_ns) {
    return time < other.time_ns;
  }
  return board != other.board ? board < other.board : number < other_number;
}

}  // namespace

SimulatedNetwork::SimulatedNetwork(const NetworkModel& model, std::size_t boards)
    : model_(model), boards_(boards), links_(boards, std::vector<Link>(boards)) {
  for (std::size_t from = 0; from < boards; ++from) {
    for (std::size_t to = 0; to < boards; ++to) {
      std::uint64_t mixed = model.seed;
      mixed = next_chance(mixed) + from;
      mixed = next_chance(mixed) + to;
      links_[from][to].chance = mixed;
    }
  }
}

// Returns a random number from 0 to less than 1.
double SimulatedNetwork::draw(Link& link) const noexcept {
  constexpr unsigned kBits = 53;  // that fit into a double
  return std::ldexp(static_cast<double>(next_chance(link.chance) >> (64U - kBits)), -static_cast<int>(kBits));
}

bool SimulatedNetwork::linked(std::size_t from, std::size_t to) const noexcept {
  const auto there = [](const Board& board) { return board.runs && board.connected; };
  return from != to && there(boards_[from]) && there(boards_[to]);
}

void SimulatedNetwork::put(std::size_t to, Pending pending) {
  pending.number = ++number_;
  std::vector<Pending>& inbox = boards_[to].inbox;
  const auto place = std::find_if(inbox.begin(), inbox.end(), [&](const Pending& other) {
    return is_before(pending.message.time_ns, pending.message.board, pending.number, other.message, other.number);
  });
  inbox.insert(place, std::move(pending));
}

void SimulatedNetwork::carry(const Message& message, std::size_t to, std::int64_t earliest_ns, bool may_be_lost) {
  Link& link = links_[message.board][to];
  // Always both, so that changing one setting does not change the random numbers of the other.
  const double luck = draw(link);
  const double late = draw(link);
  const bool reliable = is_reliable(message.kind);
  bool lost = may_be_lost && luck < model_.loss;
  if (lost && !reliable) {
    return;
  }
  Pending pending{message, 0, lost};
  std::int64_t& arrival = pending.message.time_ns;
  arrival += model_.delay.count() + static_cast<std::int64_t>(late * static_cast<double>(model_.jitter.count()));
  for (; lost; lost = draw(link) < model_.loss) {
    arrival += model_.repeat.count();
  }
  arrival = std::max(arrival, earliest_ns);
  std::vector<Pending>& inbox = boards_[to].inbox;
  if (reliable) {
    // A message that has not arrived and is superseded is no longer repeated. Other messages delay those that follow
    // them.
    std::erase_if(inbox, [&](const Pending& other) {
      return other.repeated && other.message.board == message.board && other.message.kind == message.kind &&
             other.message.part == message.part && message.is_frame();
    });
    for (const Pending& other : inbox) {
      if (other.message.board == message.board && other.message.kind == message.kind) {
        arrival = std::max(arrival, other.message.time_ns);
      }
    }
  }
  put(to, std::move(pending));
}

void SimulatedNetwork::want(std::size_t from, std::size_t to, Kind stream, std::int64_t now_ns) {
  std::vector<Kind>& wanted = links_[from][to].wanted;
  if (std::find(wanted.begin(), wanted.end(), stream) == wanted.end()) {
    wanted.push_back(stream);
  }
  if (!linked(from, to)) {
    return;
  }
  for (const auto& [key, message] : boards_[from].last) {
    if (key.first == stream) {
      Message again = message;
      again.time_ns = now_ns;
      carry(again, to, 0, false);
    }
  }
}

void SimulatedNetwork::send(Message message, std::int64_t earliest_ns) {
  Board& sender = boards_[message.board];
  if (message.kind == Kind::Subscribe) {
    const auto from = static_cast<std::size_t>(message.part / kStreams);
    if (from < boards_.size()) {
      want(from, message.board, static_cast<Kind>(message.part % kStreams), std::max(message.time_ns, earliest_ns));
    }
    return;
  }
  for (std::size_t to = 0; to < boards_.size(); ++to) {
    const std::vector<Kind>& wanted = links_[message.board][to].wanted;
    const bool is_subscribed =
        !message.is_frame() || std::find(wanted.begin(), wanted.end(), message.kind) != wanted.end();
    if (is_subscribed && linked(message.board, to)) {
      carry(message, to, earliest_ns, true);
    }
  }
  if (message.kind == Kind::Catalogue) {
    sender.catalogue = std::move(message);
  } else if (message.is_frame()) {
    const auto key = std::pair(message.kind, message.part);
    sender.last[key] = std::move(message);
  }
}

std::vector<Message> SimulatedNetwork::take(std::size_t board, std::int64_t until_ns) {
  std::vector<Pending>& inbox = boards_[board].inbox;
  const auto end = std::find_if(inbox.begin(), inbox.end(),
                                [&](const Pending& pending) { return pending.message.time_ns > until_ns; });
  std::vector<Message> out;
  for (auto pending = inbox.begin(); pending != end; ++pending) {
    out.push_back(std::move(pending->message));
  }
  inbox.erase(inbox.begin(), end);
  return out;
}

std::int64_t SimulatedNetwork::next_question(std::size_t board) const noexcept {
  for (const Pending& pending : boards_[board].inbox) {
    if (!pending.message.is_frame()) {
      return pending.message.time_ns;
    }
  }
  return INT64_MAX;
}

std::int64_t SimulatedNetwork::next_arrival(std::size_t board) const noexcept {
  const std::vector<Pending>& inbox = boards_[board].inbox;
  return inbox.empty() ? INT64_MAX : inbox.front().message.time_ns;
}

// Reports to all boards that received `board` that it is gone.
void SimulatedNetwork::report_gone(std::size_t board, std::int64_t when_ns) {
  for (std::size_t to = 0; to < boards_.size(); ++to) {
    if (to != board && boards_[to].runs) {
      put(to, {{Kind::Gone, static_cast<std::uint32_t>(board), 0, when_ns, {}}, 0, false});
    }
  }
}

void SimulatedNetwork::forget_gone(std::size_t board) {
  for (std::size_t to = 0; to < boards_.size(); ++to) {
    std::erase_if(boards_[to].inbox, [&](const Pending& pending) {
      return pending.message.kind == Kind::Gone && (pending.message.board == board || to == board);
    });
  }
}

// Messages under way from and to this board are lost.
void SimulatedNetwork::drop_between(std::size_t board) {
  boards_[board].inbox.clear();
  for (Board& other : boards_) {
    std::erase_if(other.inbox, [&](const Pending& pending) {
      return pending.message.board == board && pending.message.kind != Kind::Gone;
    });
  }
}

// `to` receives what it missed.
void SimulatedNetwork::introduce(std::size_t from, std::size_t to, std::int64_t now_ns) {
  if (!linked(from, to) || !boards_[from].catalogue) {
    return;
  }
  Message catalogue = *boards_[from].catalogue;
  catalogue.time_ns = now_ns;
  carry(catalogue, to, 0, false);
  const std::vector<Kind> wanted = links_[from][to].wanted;
  for (const Kind stream : wanted) {
    want(from, to, stream, now_ns);
  }
}

void SimulatedNetwork::cut(std::size_t board, std::int64_t now_ns) {
  if (!boards_[board].connected) {
    return;
  }
  boards_[board].connected = false;
  drop_between(board);
  const std::int64_t when = now_ns + model_.lease.count();
  report_gone(board, when);
  for (std::uint32_t other = 0; other < boards_.size() && boards_[board].runs; ++other) {
    if (other != board) {
      put(board, {{Kind::Gone, other, 0, when, {}}, 0, false});
    }
  }
}

void SimulatedNetwork::join(std::size_t board, std::int64_t now_ns) {
  if (boards_[board].connected) {
    return;
  }
  boards_[board].connected = true;
  forget_gone(board);
  for (std::size_t other = 0; other < boards_.size(); ++other) {
    introduce(board, other, now_ns);
    introduce(other, board, now_ns);
  }
}

void SimulatedNetwork::kill(std::size_t board, std::int64_t now_ns) {
  if (!boards_[board].runs) {
    return;
  }
  leave(board, now_ns + model_.lease.count() - model_.delay.count());
}

void SimulatedNetwork::leave(std::size_t board, std::int64_t now_ns) {
  boards_[board].runs = false;
  boards_[board].catalogue.reset();
  boards_[board].last.clear();
  drop_between(board);
  for (std::vector<Link>& from : links_) {
    from[board].wanted.clear();
  }
  report_gone(board, now_ns + model_.delay.count());
}

void SimulatedNetwork::start(std::size_t board, std::int64_t now_ns) {
  boards_[board].runs = true;
  for (std::size_t other = 0; other < boards_.size(); ++other) {
    introduce(other, board, now_ns);
  }
}

}  // namespace indurop::mirror
