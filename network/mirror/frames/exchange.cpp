// SPDX-License-Identifier: Apache-2.0
#include "network/mirror/frames/exchange.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "core/rt/copy_text.h"
#include "network/mirror/frames/board_time.h"

namespace indurop::mirror {
namespace {

constexpr std::int64_t kUnnotifiedPollNs = 10'000'000;  // without a notification: another process may have written
constexpr std::int64_t kBulkLookNs = 20'000'000;
constexpr std::int64_t kPollAgainNs = 100'000;  // for the end of a run that is not notified

}  // namespace

Exchange::Exchange(Settings settings, vars::Store& store, const std::atomic<std::uint64_t>& tick, vars::ShmFile&& file)
    : settings_(std::move(settings)),
      store_(store),
      tick_(tick),
      file_(std::move(file)),
      block_(*reinterpret_cast<MirrorBlock*>(file_.data())),
      session_(static_cast<std::uint64_t>(board_wall_ns(store))) {
  fill_block();
  sender_ = std::make_unique<Sender>(store_, settings_, session_, block_);
  beacons_ = std::make_unique<Beacons>(store_, settings_, session_, block_);
  make_receivers();
  block_.magic.store(kMirrorMagic, std::memory_order_release);
}

Result<std::unique_ptr<Exchange>> Exchange::make(Settings settings, const std::string& node, vars::Store& store,
                                                 const std::atomic<std::uint64_t>& tick) {
  auto file =
      vars::ShmFile::create(vars::mirror_file(node),
                            mirror_block_size(settings.boards.size(), settings.routes.incoming.size() + kMoreIncoming));
  if (!file) {
    return file.error();
  }
  auto made = std::make_unique<Exchange>(std::move(settings), store, tick, std::move(file).value());
  if (Status published = made->file_.publish(); !published) {
    return published.error();
  }
  return made;
}

void Exchange::fill_block() {
  block_.abi = kMirrorAbi;
  block_.peer_count = static_cast<std::uint32_t>(settings_.boards.size());
  rt::copy_text(block_.plant, settings_.plant);
  rt::copy_text(block_.board, settings_.network.board);
  block_.domain = settings_.network.domain;
  block_.session.store(session_, std::memory_order_relaxed);
  for (std::size_t i = 0; i < settings_.boards.size(); ++i) {
    rt::copy_text(block_.peers()[i].name, settings_.boards[i]);
  }
}

// Returns null if the store does not hold the variable.
Landing* Exchange::landing_of(const std::string& variable) {
  const auto* entry = store_.find(abi::fnv1a64(variable.data(), variable.size()));
  if (entry == nullptr) {
    return nullptr;
  }
  const auto found = std::find_if(landings_.begin(), landings_.end(),
                                  [entry](const auto& one) { return one->entry().name_hash == entry->name_hash; });
  if (found != landings_.end()) {
    return found->get();
  }
  landings_.push_back(std::make_unique<Landing>(store_, *entry, board_ns(store_) + settings_.network.lease_ns));
  return landings_.back().get();
}

std::vector<Landing*> Exchange::landings_from(const std::string& board, const std::vector<Incoming>& incoming) {
  std::vector<Landing*> from_it;
  for (const Incoming& in : incoming) {
    if (Landing* landing = in.owner == board ? landing_of(in.variable) : nullptr; landing != nullptr) {
      from_it.push_back(landing);
    }
  }
  return from_it;
}

// Creates one receiver per board, with the variables read from it.
void Exchange::make_receivers() {
  for (std::size_t i = 0; i < settings_.boards.size(); ++i) {
    receivers_.push_back(std::make_unique<Receiver>(settings_.boards[i], store_,
                                                    landings_from(settings_.boards[i], settings_.routes.incoming),
                                                    landings_mutex_, block_.peers()[i]));
  }
  list_incoming(settings_.routes.incoming);
}

// A record stays where it is as long as it counts, so that tools never read half of a list.
void Exchange::list_incoming(const std::vector<Incoming>& incoming) {
  const std::uint32_t room =
      static_cast<std::uint32_t>((file_.size() - mirror_block_size(block_.peer_count, 0)) / sizeof(IncomingRecord));
  std::vector<std::pair<std::uint64_t, std::uint32_t>> all;
  for (const Incoming& in : incoming) {
    const std::uint64_t hash = abi::fnv1a64(in.variable.data(), in.variable.size());
    const auto board = std::find(settings_.boards.begin(), settings_.boards.end(), in.owner);
    if (board != settings_.boards.end() && store_.find(hash) != nullptr) {
      all.emplace_back(hash, static_cast<std::uint32_t>(board - settings_.boards.begin()));
    }
  }
  IncomingRecord* const records = block_.variables();
  const std::uint32_t before = block_.incoming;
  for (std::uint32_t i = 0; i < before; ++i) {
    const auto found =
        std::find(all.begin(), all.end(), std::pair(records[i].name_hash.load(), records[i].peer.load()));
    if (found != all.end()) {
      all.erase(found);
    } else {
      records[i].name_hash = 0;
    }
  }
  std::uint32_t next = 0;
  for (const auto& [hash, peer] : all) {
    while (next < block_.incoming && records[next].name_hash != 0) {
      ++next;
    }
    if (next == room) {
      break;  // only tools do not list it
    }
    records[next].peer = peer;
    records[next].name_hash = hash;
    block_.incoming = std::max(block_.incoming.load(), next + 1);
  }
}

void Exchange::follow(const Routes& routes) {
  for (std::size_t i = settings_.routes.writers.size(); i < routes.writers.size(); ++i) {
    settings_.routes.writers.push_back(routes.writers[i]);
  }
  for (std::size_t i = 0; i < settings_.boards.size(); ++i) {
    std::vector<Landing*> from_it;
    {
      const std::lock_guard<std::mutex> guard(landings_mutex_);
      from_it = landings_from(settings_.boards[i], routes.incoming);
    }
    receivers_[i]->follow(from_it, settings_.network.lease_ns, plane_);
  }
  list_incoming(routes.incoming);
  if (const auto added = sender_->add(routes.outgoing, settings_.routes.writers, board_ns(store_)); !added) {
    block_.problem.set(added.error().text);
  }
}

Plane::Opened Exchange::open(Plane& plane) {
  plane_ = &plane;
  if (auto opened = sender_->open(plane); !opened) {
    return opened;
  }
  return beacons_->open(plane, [this](const std::string& board, std::optional<std::uint64_t> session) {
    Receiver* const receiver = receiver_of(board);
    if (receiver == nullptr || plane_->beat().count() == 0) {
      return;
    }
    if (session) {
      receiver->alive(*session);
    } else {
      receiver->silent();
    }
  });
}

void Exchange::close() noexcept {
  for (const auto& receiver : receivers_) {
    receiver->close();
  }
  if (plane_ != nullptr) {
    plane_->close();
  }
}

Receiver* Exchange::receiver_of(const std::string& board) const noexcept {
  const auto found = std::find_if(receivers_.begin(), receivers_.end(),
                                  [&](const auto& receiver) { return receiver->board() == board; });
  return found == receivers_.end() ? nullptr : found->get();
}

bool Exchange::knows(const std::string& board) const noexcept {
  return receiver_of(board) != nullptr;
}

void Exchange::announced(const indurop_wire_Catalogue& catalogue) {
  if (Receiver* receiver = receiver_of(catalogue.board); receiver != nullptr) {
    receiver->announced(catalogue, *plane_);
  }
}

void Exchange::gone(const std::string& board) noexcept {
  if (Receiver* receiver = receiver_of(board); receiver != nullptr) {
    receiver->silent();
  }
}

std::int64_t Exchange::poll(std::int64_t now_ns, const Schedule& schedule) noexcept {
  std::int64_t next = rt::to_ns(beacons_->cycle(rt::mono_time(now_ns), schedule));
  const std::lock_guard<std::mutex> guard(landings_mutex_);
  for (const auto& landing : landings_) {
    next = std::min(next, landing->expire(now_ns));
  }
  return next;
}

std::int64_t Exchange::send(std::int64_t now_ns, bool bulk) noexcept {
  const std::uint64_t begun = tick_.load(std::memory_order_acquire);
  if (sender_->cycle(now_ns, begun > 0 ? begun - 1 : 0, bulk)) {
    return now_ns + kPollAgainNs;
  }
  return now_ns + (bulk ? kBulkLookNs : kUnnotifiedPollNs);
}

void Exchange::send_last(bool bulk) noexcept {
  (void)sender_->cycle(board_ns(store_), tick_.load(std::memory_order_acquire), bulk);
}

}  // namespace indurop::mirror
