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
  auto file = vars::ShmFile::create(vars::mirror_file(node),
                                    mirror_block_size(settings.boards.size(), settings.incoming.size()));
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
                                  [entry](const auto& landing) { return &landing->entry() == entry; });
  if (found != landings_.end()) {
    return found->get();
  }
  landings_.push_back(std::make_unique<Landing>(store_, *entry, board_ns(store_) + settings_.network.lease_ns));
  return landings_.back().get();
}

// Creates one receiver per board, with the variables read from it.
void Exchange::make_receivers() {
  for (std::size_t i = 0; i < settings_.boards.size(); ++i) {
    std::vector<Landing*> from_it;
    for (const Incoming& in : settings_.incoming) {
      if (in.owner != settings_.boards[i]) {
        continue;
      }
      if (Landing* landing = landing_of(in.variable); landing != nullptr) {
        from_it.push_back(landing);
        block_.variables()[block_.incoming++] = {abi::fnv1a64(in.variable.data(), in.variable.size()),
                                                 static_cast<std::uint32_t>(i), 0};
      }
    }
    receivers_.push_back(
        std::make_unique<Receiver>(settings_.boards[i], store_, from_it, landings_mutex_, block_.peers()[i]));
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
