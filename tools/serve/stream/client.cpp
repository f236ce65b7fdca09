// SPDX-License-Identifier: Apache-2.0
#include "tools/serve/stream/client.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/rt/clock.h"

namespace indurop::serve {
namespace {

// Maximum answers that wait for a client: one with more only sends and does not read.
constexpr std::size_t kMostAnswers = 256;
constexpr int kTooManyAnswers = 1008;

}  // namespace

StreamClient::StreamClient(Hub& hub, Line& line, std::uint64_t id, std::string address)
    : hub_(&hub), line_(&line), id_(id), address_(std::move(address)), since_ns_(rt::now_ns()) {
  tell(hub.hello());
  tell(hub.boards_word());
}

StreamClient::~StreamClient() {
  hub_->leave(*this);
}

void StreamClient::tell(std::string_view word) {
  control_.push_back(std::make_shared<Message>(word));
  line_->ask();
}

int StreamClient::heard(std::string_view text) {
  if (control_.size() > kMostAnswers) {
    return kTooManyAnswers;
  }
  const auto word = read_word(text);
  if (!word) {
    if (word.error().garbage) {
      return close_code::kBadText;
    }
    tell(error_word(word.error().id, "bad_request", word.error().message).dump());
    return 0;
  }
  if (word->kind == ClientWord::Kind::Unsubscribe) {
    subscriptions_.erase(word->id);
    tell(fmt::format(R"({{"type":"unsubscribed","id":{}}})", word->id));
    return 0;
  }
  subscribe(*word);
  return 0;
}

void StreamClient::subscribe(const ClientWord& word) {
  subscriptions_.erase(word.id);
  if (subscriptions_.size() >= kMostStreams) {
    tell(error_word(word.id, "too_many", fmt::format("a client has at most {} subscriptions", kMostStreams)).dump());
    return;
  }
  auto feed = hub_->feed_for(word);
  if (!feed) {
    tell(error_word(word.id, feed.error().error, feed.error().message).dump());
    return;
  }
  std::size_t variables = (*feed)->size();
  for (const auto& [id, other] : subscriptions_) {
    variables += other.feed->size();
  }
  if (variables > kMostVariables) {
    tell(error_word(word.id, "too_many", fmt::format("a client follows at most {} variables", kMostVariables)).dump());
    return;
  }
  tell((*feed)->told(word.id, word.binary).dump());
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
      ++dropped_;
    }
    subscription.waiting = true;
    line_->ask();
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
    tell(fmt::format(R"({{"type":"layout_changed","board":{},"layout":"{}","ids":[{}]}})",
                     base::Json(feed.board()).dump(), board != nullptr ? board->layout() : "", fmt::join(ids, ",")));
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
  ++sent_;
  return subscription.binary ? feed.binary() : next ? feed.changes() : feed.everything();
}

SharedMessage StreamClient::next() {
  SharedMessage message;
  if (!control_.empty()) {
    message = std::move(control_.front());
    control_.pop_front();
  } else {
    auto turn = subscriptions_.upper_bound(last_served_);
    for (std::size_t i = 0; i < subscriptions_.size() && !message; ++i) {
      turn = turn == subscriptions_.end() ? subscriptions_.begin() : turn;
      last_served_ = turn->first;
      message = turn->second.waiting ? frame_of(turn->second) : nullptr;
      ++turn;
    }
  }
  sent_bytes_ += message ? message->size() : 0;
  return message;
}

ClientFigures StreamClient::figures() const {
  return {id_, address_, since_ns_, subscriptions_.size(), sent_, dropped_, sent_bytes_};
}

}  // namespace indurop::serve
