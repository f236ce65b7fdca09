// SPDX-License-Identifier: Apache-2.0
#include "tools/serve/stream/foxglove.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/base/web_socket_frames.h"
#include "core/rt/clock.h"
#include "history/recording/cdr.h"
#include "tools/serve/stream/foxglove_words.h"

namespace indurop::serve {
namespace {

constexpr std::size_t kMostSubscriptions = 5000;
constexpr std::int64_t kTellEveryNs = 1'000'000'000;

// Returns the requested items of a board, or all it has; no item twice.
std::vector<tools::Item> items_of(const Board& board, const std::vector<std::string>& names) {
  std::vector<tools::Item> all;
  std::vector<std::string> ignored;  // another board may have it
  for (const std::string& name : names.empty() ? std::vector<std::string>{"*"} : names) {
    for (tools::Item& item : items_named(*board.store(), board.name(), {name}, ignored)) {
      const auto same = [&item](const tools::Item& other) { return other.name == item.name; };
      if (names.size() < 2 || std::none_of(all.begin(), all.end(), same)) {
        all.push_back(std::move(item));
      }
    }
  }
  return all;
}

}  // namespace

FoxgloveClient::FoxgloveClient(Hub& hub, Line& line, std::uint64_t id, std::string address,
                               const FoxgloveSettings& settings)
    : hub_(&hub), settings_(&settings), outbox_(line, id, std::move(address)) {
  send(foxglove::server_info(hub.version(), rt::now_ns()));
  boards_updated();
}

FoxgloveClient::~FoxgloveClient() {
  hub_->leave(*this);
}

void FoxgloveClient::send(const std::string& text) {
  outbox_.add(text);
}

void FoxgloveClient::boards_updated() {
  const std::vector<std::string> names = hub_->boards().names();
  for (auto at = offered_.begin(); at != offered_.end();) {
    const bool there = std::find(names.begin(), names.end(), at->first) != names.end();
    if (!there) {
      withdraw(at->second);
    }
    at = there ? std::next(at) : offered_.erase(at);
  }
  for (const std::string& name : names) {
    const Board* const board = hub_->boards().find(name);
    if (board == nullptr || board->store() == nullptr) {
      continue;
    }
    const auto known = offered_.find(name);
    if (known == offered_.end()) {
      offer(*board);
    } else if (known->second.layout != board->layout()) {
      withdraw(known->second);
      offer(*board);
    }
  }
}

void FoxgloveClient::offer(const Board& board) {
  Offered offered{board.layout(), {}};
  base::Json channels = base::Json::array();
  for (const tools::Item& item : items_of(board, settings_->names)) {
    const std::uint32_t channel = ++last_channel_;
    const std::string topic = (hub_->boards().only().empty() ? board.name() + "/" : "") + item.name;
    channels.push_back(foxglove::channel(channel, topic, item.place.type));
    channels_[channel] = {board.name(), item.name};
    offered.channels.push_back(channel);
  }
  send(foxglove::advertise(std::move(channels)));
  offered_[board.name()] = std::move(offered);
}

void FoxgloveClient::withdraw(const Offered& offered) {
  for (const std::uint32_t channel : offered.channels) {
    channels_.erase(channel);
  }
  std::vector<std::uint32_t> gone;
  for (const auto& [id, subscription] : subscriptions_) {
    if (!channels_.contains(subscription.channel)) {
      gone.push_back(id);
    }
  }
  for (const std::uint32_t id : gone) {
    unsubscribe(id);
  }
  if (!offered.channels.empty()) {
    send(foxglove::unadvertise(offered.channels));
  }
}

int FoxgloveClient::receive(std::string_view text) {
  if (outbox_.is_full()) {
    return Outbox::kTooManyAnswers;
  }
  const auto word = read_foxglove_word(text);
  if (!word) {
    return base::close_code::kBadText;
  }
  if (word->op != "subscribe" && word->op != "unsubscribe") {
    send(foxglove::warning(fmt::format("'{}' is not served: variables can only be followed", word->op)));
  }
  for (const auto& [id, channel] : word->subscribe) {
    subscribe(id, channel);
  }
  for (const std::uint32_t id : word->unsubscribe) {
    unsubscribe(id);
  }
  return 0;
}

void FoxgloveClient::subscribe(std::uint32_t id, std::uint32_t channel) {
  const auto wanted = channels_.find(channel);
  if (wanted == channels_.end()) {
    return;  // it was withdrawn just before
  }
  if (subscriptions_.contains(id) || subscriptions_.size() >= kMostSubscriptions) {
    send(foxglove::warning(fmt::format("subscription {} is refused: {}", id,
                                       subscriptions_.contains(id)
                                           ? std::string("there is one of this id")
                                           : fmt::format("a client has at most {}", kMostSubscriptions))));
    return;
  }
  ClientWord word;
  word.board = wanted->second.board;
  word.names = {wanted->second.name};
  word.rate_hz = settings_->rate_hz;
  auto feed = hub_->feed_for(word);
  if (!feed || (*feed)->size() != 1) {
    send(foxglove::warning(fmt::format("{}: {}", wanted->second.name, feed ? "it has gone" : feed.error().message)));
    return;
  }
  if (!of_feed_.emplace(feed->get(), id).second) {
    send(foxglove::warning(fmt::format("subscription {} is refused: channel {} has one", id, channel)));
    return;
  }
  subscriptions_[id] = {channel, *feed, (*feed)->readable(0)};
  outbox_.wake();
}

void FoxgloveClient::unsubscribe(std::uint32_t id) {
  if (const auto found = subscriptions_.find(id); found != subscriptions_.end()) {
    of_feed_.erase(found->second.feed.get());
    subscriptions_.erase(found);
  }
}

void FoxgloveClient::sampled(const Feed& feed) {
  const auto found = of_feed_.find(&feed);
  if (found == of_feed_.end() || !feed.readable(0)) {
    return;
  }
  Subscription& subscription = subscriptions_.at(found->second);
  if (subscription.waiting) {
    outbox_.count_dropped();
    ++dropped_;
  }
  subscription.waiting = true;
  outbox_.wake();
}

void FoxgloveClient::ended(const Feed& feed, const Board* /*board*/) {
  if (const auto found = of_feed_.find(&feed); found != of_feed_.end()) {
    unsubscribe(found->second);
    boards_updated();
  }
}

SharedMessage FoxgloveClient::message_of(std::uint32_t id, Subscription& subscription) {
  subscription.waiting = false;
  const Feed& feed = *subscription.feed;
  if (!recording::to_cdr(feed.item(0).place.type, feed.value(0), cdr_).ok()) {
    return nullptr;
  }
  outbox_.count_sent();
  return std::make_shared<Message>(foxglove::message(id, feed.wall_ns(), cdr_), true);
}

SharedMessage FoxgloveClient::next() {
  if (const std::int64_t now = rt::now_ns(); dropped_ > 0 && now - warned_ns_ > kTellEveryNs) {
    send(foxglove::warning(fmt::format("{} messages were left out: they came faster than they were taken", dropped_)));
    dropped_ = 0;
    warned_ns_ = now;
  }
  return outbox_.next(subscriptions_, [this](auto& entry) {
    return entry.second.waiting ? message_of(entry.first, entry.second) : nullptr;
  });
}

ClientFigures FoxgloveClient::figures() const {
  return outbox_.figures(subscriptions_.size());
}

}  // namespace indurop::serve
