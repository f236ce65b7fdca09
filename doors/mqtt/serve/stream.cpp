// SPDX-License-Identifier: Apache-2.0
#include "doors/mqtt/serve/stream.h"

#include <fmt/format.h>

#include <algorithm>

namespace indurop::mqtt {
namespace {

constexpr std::int64_t kRetryStreamNs = 1'000'000'000;
constexpr std::int64_t kSilenceNs = 60'000'000'000;  // the server sends something in shorter intervals
constexpr std::size_t kMostBoards = 32;              // subscriptions of one client

}  // namespace

void Stream::run(std::int64_t now_ns) {
  if (!socket_) {
    if (now_ns >= next_try_ns_) {
      connect(now_ns);
    }
    return;
  }
  const auto messages = socket_->receive(std::chrono::milliseconds(0));
  if (!messages) {
    lose(messages.error().text, now_ns);
    return;
  }
  if (!messages->empty()) {
    heard_ns_ = now_ns;
  }
  for (const WebSocketMessage& message : *messages) {
    receive(message);
  }
  if (now_ns - heard_ns_ > kSilenceNs) {
    lose("the server sends nothing any more", now_ns);
  } else if (!without_.empty() && now_ns >= retry_ns_) {
    retry_ns_ = now_ns + kRetryStreamNs;
    without_.clear();
    subscribe();
  }
}

void Stream::connect(std::int64_t now_ns) {
  auto socket = WebSocket::open(settings_.access, "/api/v1/stream", "indurop.v1", settings_.token);
  if (!socket) {
    lose(socket.error().text, now_ns);
    return;
  }
  socket_.emplace(std::move(*socket));
  heard_ns_ = now_ns;
  last_why_.clear();
  events_.opened();
}

void Stream::lose(const std::string& why, std::int64_t now_ns) {
  socket_.reset();
  next_try_ns_ = now_ns + kRetryStreamNs;
  boards_.clear();
  requested_.clear();
  without_.clear();
  if (why != last_why_) {
    last_why_ = why;
    events_.lost(why);
  }
}

void Stream::receive(const WebSocketMessage& message) {
  if (message.binary) {
    if (const auto frame = read_frame(message.bytes)) {
      events_.frame(*frame);
    }
    return;
  }
  const auto json = base::Json::parse(message.bytes);
  const std::string type = json ? (*json)["type"].text().value_or("") : std::string();
  if (type == "boards") {
    receive_boards(*json);
  } else if (type == "subscribed") {
    events_.described(*json);
  } else if (type == "layout_changed") {
    for (const base::Json& id : (*json)["ids"].values()) {
      end(id.natural().value_or(0));
    }
    subscribe();
  } else if (type == "error") {
    const auto requested = requested_.find((*json)["id"].natural().value_or(0));
    if (requested != requested_.end()) {
      without_.insert(requested->second);
      requested_.erase(requested);
    }
    const std::string text = (*json)["message"].text().value_or("");
    if ((*json)["error"].text() != "unavailable" && text != last_trouble_) {  // that is a node that is just starting
      last_trouble_ = text;
      events_.trouble(text);
    }
  }
}

void Stream::end(std::uint64_t id) {
  const auto requested = requested_.find(id);
  if (requested != requested_.end()) {
    events_.gone(requested->second);
    requested_.erase(requested);
  }
}

void Stream::receive_boards(const base::Json& message) {
  std::map<std::string, bool> now;
  for (const base::Json& one : message["boards"].values()) {
    now[one["board"].text().value_or("")] = one["alive"].boolean().value_or(false);
  }
  for (const auto& [board, alive] : now) {
    const auto before = boards_.find(board);
    if (before == boards_.end() || before->second != alive) {
      events_.state(board, alive);
    }
  }
  for (const auto& [board, alive] : boards_) {
    if (!now.contains(board) && alive) {
      events_.state(board, false);
    }
  }
  boards_ = std::move(now);
  subscribe();
}

void Stream::subscribe() {
  for (const auto& [board, alive] : boards_) {
    const bool known = std::any_of(requested_.begin(), requested_.end(),
                                   [&board = board](const auto& one) { return one.second == board; });
    if (known || without_.contains(board)) {
      continue;
    }
    if (requested_.size() >= kMostBoards) {
      events_.trouble(fmt::format("board {} is left out: there are more than {}", board, kMostBoards));
      return;
    }
    requested_[++last_id_] = board;
    const base::Json word{
        {"type", "subscribe"},          {"id", last_id_}, {"board", board}, {"names", settings_.names},
        {"rate_hz", settings_.rate_hz}, {"binary", true}};
    (void)socket_->send(word.dump());  // a lost connection shows when it is read
  }
}

}  // namespace indurop::mqtt
