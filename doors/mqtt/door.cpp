// SPDX-License-Identifier: Apache-2.0
#include "doors/mqtt/door.h"

#include <fmt/format.h>
#include <poll.h>

#include <array>
#include <utility>

#include "core/rt/clock.h"
#include "doors/mqtt/plain/topics.h"

namespace indurop::mqtt {
namespace {

constexpr std::chrono::milliseconds kTurn{100};

BrokerSettings with_id(BrokerSettings settings, const char* what) {
  settings.client_id += what;
  return settings;
}

}  // namespace

Door::PlainSide::PlainSide(Door& door, const BrokerSettings& to)
    : broker(
          with_id(to, "-plain"),
          [topic = door.settings_.plain.prefix + "/online"] {
            return Will{topic, "false", true, 1, 0};
          },
          [&door, this] {
            BrokerEvents events = door.events_of("plain topics");
            events.connected = [&door, this](std::uint64_t /*will*/) {
              door.log_.info("plain topics are published at {}", door.settings_.broker.address.host_and_port());
              std::vector<const Board*> all;
              for (const auto& [name, board] : door.boards_) {
                all.push_back(board.get());
              }
              plain.connected(all);
            };
            events.message = [this](const std::string& topic, const std::string& payload, bool retained) {
              plain.receive(topic, payload, retained);
            };
            return events;
          }(),
          door.mailbox_),
      plain(door.settings_.plain, broker, [&door](Command command) { door.commands_.add(std::move(command)); }) {}

Door::SparkplugSide::SparkplugSide(Door& door, const BrokerSettings& to, std::optional<Backlog> kept)
    : births(door.settings_.state / "bdseq"),
      backlog(std::move(kept)),
      broker(
          with_id(to, "-sparkplug"),
          [&door, this] {
            Will will = EdgeNode::will_of(door.settings_.sparkplug, births.next(), rt::wall_ns());
            if (!births.problem().empty()) {
              door.log_.error("{}", births.problem());
            }
            return will;
          },
          [&door, this] {
            BrokerEvents events = door.events_of("Sparkplug");
            events.connected = [&door, this](std::uint64_t birth) {
              door.log_.info("Sparkplug: edge node {} of group {} is at {}", door.settings_.sparkplug.node,
                             door.settings_.sparkplug.group, door.settings_.broker.address.host_and_port());
              node.connected(birth);
            };
            events.lost = [this] { node.lost(); };
            events.confirmed = [this](int receipt) { node.confirmed(receipt); };
            events.message = [this](const std::string& topic, const std::string& payload, bool /*retained*/) {
              node.receive(topic, payload);
            };
            return events;
          }(),
          door.mailbox_),
      node(
          door.settings_.sparkplug, broker, backlog ? &*backlog : nullptr,
          [&door](Command command) { door.commands_.add(std::move(command)); }, door.log_) {}

Door::Door(Settings settings)
    : settings_(std::move(settings)),
      log_("indurop-mqtt", settings_.broker.client_id, settings_.quiet),
      commands_(settings_.stream.access, mailbox_),
      stream_(settings_.stream, stream_events()) {}

BrokerEvents Door::events_of(const char* what) const {
  BrokerEvents events;
  events.connected = [](std::uint64_t /*will*/) {};
  events.lost = [] {};
  events.message = [](const std::string& /*topic*/, const std::string& /*payload*/, bool /*retained*/) {};
  events.confirmed = [](int /*receipt*/) {};
  events.trouble = [this, what](const std::string& text) { log_.warning("{}: {}", what, text); };
  return events;
}

StreamEvents Door::stream_events() {
  StreamEvents events;
  events.opened = [this] {
    log_.info("the boards of {} are published", settings_.stream.access.address.host_and_port());
  };
  events.lost = [this](const std::string& why) {
    log_.warning("{}", why);
    while (!boards_.empty()) {
      const std::string name = boards_.begin()->first;
      remove_board(name);
      if (plain_ != nullptr) {
        plain_->plain.publish_state(name, false);
      }
    }
  };
  events.state = [this](const std::string& board, bool alive) {
    if (plain_ != nullptr && is_level(board)) {
      plain_->plain.publish_state(board, alive);
    }
  };
  events.gone = [this](const std::string& board) {
    if (const auto found = boards_.find(board); found != boards_.end() && plain_ != nullptr) {
      plain_->plain.forget(*found->second);
    }
    remove_board(board);
  };
  events.described = [this](const base::Json& subscribed) { add_board(subscribed); };
  events.frame = [this](const Frame& frame) { take_frame(frame); };
  events.trouble = [this](const std::string& text) { log_.warning("{}", text); };
  return events;
}

void Door::add_board(const base::Json& subscribed) {
  auto board = Board::from(subscribed, settings_.deadbands);
  if (!board) {
    log_.error("{}", board.error().text);
    return;
  }
  if (!is_level(board->name())) {
    log_.error("board {} cannot be shown: its name cannot be a level of a topic", board->name());
    return;
  }
  for (const base::Json& missing : subscribed["missing"].values()) {
    log_.warning("board {}: {}", board->name(), missing["message"].text().value_or(""));
  }
  const std::string name = board->name();
  const auto& kept = boards_[name] = std::make_unique<Board>(std::move(*board));
  for (const Variable& variable : kept->variables()) {
    if (sparkplug_ != nullptr && variable.leaves.empty()) {
      log_.warning("{} of board {} has more than {} numbers: it is no metric", variable.name, name, Board::kMostLeaves);
    }
  }
  if (sparkplug_ != nullptr) {
    sparkplug_->node.board_is_there(*kept);
  }
}

void Door::remove_board(const std::string& name) {
  const auto found = boards_.find(name);
  if (found == boards_.end()) {
    return;
  }
  if (sparkplug_ != nullptr) {
    sparkplug_->node.board_is_gone(name);
  }
  boards_.erase(found);
}

void Door::take_frame(const Frame& frame) {
  for (const auto& [name, board] : boards_) {
    if (board->stream() != frame.stream) {
      continue;
    }
    const std::vector<Change> changes = board->update(frame);
    if (plain_ != nullptr) {
      plain_->plain.publish(*board, changes);
    }
    if (sparkplug_ != nullptr) {
      sparkplug_->node.changed(*board, changes);
    }
  }
}

Result<void, base::Problem> Door::begin() {
  if (settings_.has_sparkplug) {
    std::error_code error;
    std::filesystem::create_directories(settings_.state, error);
    std::optional<Backlog> backlog;
    if (settings_.store_bytes > 0) {
      auto opened = Backlog::open(settings_.state / "store", settings_.store_bytes);
      if (!opened) {
        return std::move(opened).error();
      }
      backlog = std::move(*opened);
    }
    sparkplug_ = std::make_unique<SparkplugSide>(*this, settings_.broker, std::move(backlog));
    sparkplug_->broker.start();
  }
  if (settings_.has_plain) {
    plain_ = std::make_unique<PlainSide>(*this, settings_.broker);
    plain_->broker.start();
  }
  return {};
}

void Door::wait(std::chrono::milliseconds most) {
  std::array<pollfd, 2> all{pollfd{mailbox_.descriptor(), POLLIN, 0}, pollfd{stream_.descriptor(), POLLIN, 0}};
  ::poll(all.data(), all.size(), static_cast<int>(most.count()));
  mailbox_.run();
}

// What was sent last is waited for, so that it is not sent again at the next start.
void Door::end() {
  constexpr int kMostTurns = 20;
  for (int i = 0; i < kMostTurns && sparkplug_ != nullptr && sparkplug_->node.waits_for_receipt(); ++i) {
    sparkplug_->node.tick(rt::now_ns());
    wait(kTurn);
  }
  if (sparkplug_ != nullptr) {
    sparkplug_->node.die();
  }
  if (plain_ != nullptr) {
    plain_->broker.publish(plain_->plain.status_topic(), "false", Retain::Yes);
  }
  plain_.reset();
  sparkplug_.reset();
}

Result<void, base::Problem> Door::run(base::StopSignal& stop) {
  if (auto begun = begin(); !begun) {
    return begun;
  }
  while (stop.wait(std::chrono::nanoseconds(0)) == 0) {
    stream_.run(rt::now_ns());
    wait(kTurn);
    if (sparkplug_ != nullptr) {
      sparkplug_->node.tick(rt::now_ns());
    }
  }
  end();
  return {};
}

}  // namespace indurop::mqtt
