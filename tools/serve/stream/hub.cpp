// SPDX-License-Identifier: Apache-2.0
#include "tools/serve/stream/hub.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/base/text.h"
#include "core/rt/clock.h"
#include "tools/serve/stream/client.h"
#include "tools/serve/stream/foxglove.h"

namespace indurop::serve {
std::unique_ptr<Visitor> Hub::receive(const Request& request, Line& line) {
  if (boards_word_.empty()) {
    update_boards();
  }
  std::unique_ptr<Follower> client;
  if (is_foxglove(request.subprotocol)) {
    client = std::make_unique<FoxgloveClient>(*this, line, ++last_client_, request.from, foxglove_);
  } else {
    client = std::make_unique<StreamClient>(*this, line, ++last_client_, request.from);
  }
  clients_.push_back(client.get());
  return client;
}

void Hub::leave(Follower& client) {
  std::erase(clients_, &client);
}

std::string Hub::hello() const {
  base::Json out = base::Json::object();
  out["type"] = "hello";
  out["api"] = kApiVersion;
  out["version"] = version_;
  out["max_rate_hz"] = kHighestRateHz;
  out["max_variables"] = kMostVariables;
  out["max_streams"] = kMostStreams;
  return out.dump();
}

Result<std::shared_ptr<Feed>, Refusal> Hub::feed_for(const ClientWord& word) {
  const Board* const board = boards_->find(word.board);
  if (board == nullptr) {
    const auto names = boards_->names();
    return Refusal{"not_found", word.board.empty() ? fmt::format("name the board: there are {}", names.size())
                                                   : fmt::format("there is no board '{}'{}", word.board,
                                                                 base::suggestion(word.board, names))};
  }
  board->want();
  if (board->store() == nullptr) {
    return Refusal{"unavailable", fmt::format("the variables of board {} cannot be read", board->name())};
  }
  const std::string key =
      fmt::format("{} {} {} {}", board->name(), board->layout(), word.rate_hz, fmt::join(word.names, " "));
  std::erase_if(feeds_, [](const auto& entry) { return entry.second.expired(); });
  if (const auto known = feeds_.find(key); known != feeds_.end()) {
    return known->second.lock();
  }
  auto feed = std::make_shared<Feed>(++last_feed_, board->name(), word.names, word.rate_hz);
  feed->attach(*board);
  feed->sample(board, rt::now_ns());
  feeds_[key] = feed;
  wake();
  return feed;
}

void Hub::run(std::int64_t now_ns) {
  std::vector<std::shared_ptr<Feed>> all;
  for (const auto& [key, weak] : feeds_) {
    if (auto feed = weak.lock(); feed && feed->due(now_ns)) {
      all.push_back(std::move(feed));
    }
  }
  std::map<std::string, const Board*, std::less<>> boards;
  for (const auto& feed : all) {
    auto [board, fresh] = boards.try_emplace(feed->board(), nullptr);
    if (fresh) {
      board->second = boards_->find(feed->board());
    }
    if (!feed->sample(board->second, now_ns)) {
      end(*feed);
      continue;
    }
    for (Follower* const client : clients_) {
      client->sampled(*feed);
    }
  }
  wake();
}

void Hub::end(const Feed& feed) {
  const Board* const board = boards_->find(feed.board());
  for (Follower* const client : clients_) {
    client->ended(feed, board);
  }
}

void Hub::wake() {
  std::erase_if(feeds_, [](const auto& entry) { return entry.second.expired(); });
  std::int64_t next = INT64_MAX;
  for (const auto& [key, weak] : feeds_) {
    next = std::min(next, weak.lock()->due_ns());
  }
  if (next != INT64_MAX) {
    wake_at_(std::max<std::int64_t>(next - rt::now_ns(), 1));
  }
}

void Hub::update_boards() {
  base::Json list = base::Json::array();
  for (const std::string& name : boards_->names()) {
    const Board* const board = boards_->find(name);
    if (board == nullptr) {
      continue;
    }
    base::Json one = base::Json::object();
    one["board"] = name;
    one["alive"] = board->alive();
    one["state"] = board->steady_state();
    one["layout"] = board->layout();
    list.push_back(std::move(one));
  }
  base::Json word = base::Json::object();
  word["type"] = "boards";
  word["boards"] = std::move(list);
  for (Follower* const client : clients_) {
    client->boards_updated();
  }
  std::string text = word.dump();
  if (text == boards_word_) {
    return;
  }
  boards_word_ = std::move(text);
  send_to_all(boards_word_);
}

void Hub::send_to_all(const std::string& word) {
  for (Follower* const client : clients_) {
    client->send_word(word);
  }
}

std::vector<ClientFigures> Hub::clients() const {
  std::vector<ClientFigures> all;
  for (const Follower* const client : clients_) {
    all.push_back(client->figures());
  }
  return all;
}

}  // namespace indurop::serve
