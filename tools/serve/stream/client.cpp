// SPDX-License-Identifier: Apache-2.0
#include "tools/serve/stream/client.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <utility>

#include "core/base/web_socket_frames.h"

namespace indurop::serve {

StreamClient::StreamClient(Hub& hub, Line& line, std::uint64_t id, std::string address)
    : hub_(&hub), outbox_(line, id, std::move(address)) {
  send_word(hub.hello());
  send_word(hub.boards_word());
}

StreamClient::~StreamClient() {
  hub_->leave(*this);
}

void StreamClient::send_word(std::string_view word) {
  outbox_.add(word);
}

int StreamClient::receive(std::string_view text) {
  if (outbox_.is_full()) {
    return Outbox::kTooManyAnswers;
  }
  const auto word = read_word(text);
  if (!word) {
    if (word.error().garbage) {
      return base::close_code::kBadText;
    }
    send_word(error_word(word.error().id, "bad_request", word.error().message).dump());
    return 0;
  }
  if (word->kind == ClientWord::Kind::Unsubscribe) {
    subscriptions_.erase(word->id);
    send_word(fmt::format(R"({{"type":"unsubscribed","id":{}}})", word->id));
    return 0;
  }
  subscribe(*word);
  return 0;
}

void StreamClient::subscribe(const ClientWord& word) {
  subscriptions_.erase(word.id);
  if (subscriptions_.size() >= kMostStreams) {
    send_word(
        error_word(word.id, "too_many", fmt::format("a client has at most {} subscriptions", kMostStreams)).dump());
    return;
  }
  auto feed = hub_->feed_for(word);
  if (!feed) {
    send_word(error_word(word.id, feed.error().error, feed.error().message).dump());
    return;
  }
  std::size_t variables = (*feed)->size();
  for (const auto& [id, other] : subscriptions_) {
    variables += other.feed->size();
  }
  if (variables > kMostVariables) {
    send_word(
        error_word(word.id, "too_many", fmt::format("a client follows at most {} variables", kMostVariables)).dump());
    return;
  }
  send_word((*feed)->subscribed(word.id, word.binary).dump());
  Subscription& mine = subscriptions_[word.id];
  mine.feed = *feed;
  mine.binary = word.binary;
  mine.waiting = true;
}

void StreamClient::sampled(const Feed& feed) {
  for (auto& [id, subscription] : subscriptions_) {
    if (subscription.feed.get() != &feed) {
      continue;
    }
    // Before the first frame after subscribing was sent, replaced samples are not counted.
    if (subscription.waiting && subscription.sent_seq != 0) {
      ++subscription.untold;
      ++subscription.dropped;
      outbox_.count_dropped();
    }
    subscription.waiting = true;
    outbox_.wake();
  }
}

void StreamClient::ended(const Feed& feed, const Board* board) {
  std::vector<std::uint32_t> ids;
  for (auto at = subscriptions_.begin(); at != subscriptions_.end();) {
    if (at->second.feed.get() == &feed) {
      ids.push_back(at->first);
      at = subscriptions_.erase(at);
    } else {
      ++at;
    }
  }
  if (!ids.empty()) {
    send_word(fmt::format(R"({{"type":"layout_changed","board":{},"layout":"{}","ids":[{}]}})",
                          base::Json(feed.board()).dump(), board != nullptr ? board->layout() : "",
                          fmt::join(ids, ",")));
  }
}

SharedMessage StreamClient::frame_of(Subscription& subscription) {
  Feed& feed = *subscription.feed;
  if (subscription.untold > 0) {
    auto notice = std::make_shared<Message>(fmt::format(R"({{"type":"dropped","stream":{},"frames":{},"total":{}}})",
                                                        feed.number(), subscription.untold, subscription.dropped));
    subscription.untold = 0;
    return notice;
  }
  const bool next = subscription.sent_seq != 0 && subscription.sent_seq + 1 == feed.seq();
  subscription.waiting = false;
  subscription.sent_seq = feed.seq();
  outbox_.count_sent();
  return subscription.binary ? feed.binary() : next ? feed.changes() : feed.everything();
}

SharedMessage StreamClient::next() {
  return outbox_.next(subscriptions_,
                      [this](auto& entry) { return entry.second.waiting ? frame_of(entry.second) : nullptr; });
}

ClientFigures StreamClient::figures() const {
  return outbox_.figures(subscriptions_.size());
}

}  // namespace indurop::serve
