// SPDX-License-Identifier: Apache-2.0
// indurop-mqtt as a whole: the stream of `indurop serve`, and what is published of it.

#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>

#include "core/base/log.h"
#include "core/base/stop_signal.h"
#include "doors/mqtt/broker/broker.h"
#include "doors/mqtt/mailbox.h"
#include "doors/mqtt/model/board.h"
#include "doors/mqtt/options.h"
#include "doors/mqtt/plain/plain.h"
#include "doors/mqtt/serve/commands.h"
#include "doors/mqtt/serve/stream.h"
#include "doors/mqtt/sparkplug/backlog.h"
#include "doors/mqtt/sparkplug/birth_count.h"
#include "doors/mqtt/sparkplug/edge_node.h"

namespace indurop::mqtt {

class Door {
 public:
  explicit Door(Settings settings);

  // Publishes until a signal ends it. Returns why it cannot begin.
  Result<void, base::Problem> run(base::StopSignal& stop);

 private:
  // A connection has one will, so plain topics and Sparkplug have a connection each.
  struct PlainSide {
    PlainSide(Door& door, const BrokerSettings& to);
    Broker broker;
    Plain plain;
  };
  struct SparkplugSide {
    SparkplugSide(Door& door, const BrokerSettings& to, std::optional<Backlog> kept);
    BirthCount births;
    std::optional<Backlog> backlog;
    Broker broker;
    EdgeNode node;
  };

  Result<void, base::Problem> begin();
  void end();
  [[nodiscard]] BrokerEvents events_of(const char* what) const;
  [[nodiscard]] StreamEvents stream_events();
  void wait(std::chrono::milliseconds most);
  void add_board(const base::Json& subscribed);
  void remove_board(const std::string& name);
  void take_frame(const Frame& frame);

  Settings settings_;
  base::Log log_;
  Mailbox mailbox_;
  std::map<std::string, std::unique_ptr<Board>> boards_;
  Commands commands_;
  Stream stream_;
  std::unique_ptr<PlainSide> plain_;          // null: no plain topics
  std::unique_ptr<SparkplugSide> sparkplug_;  // null: no Sparkplug
};

}  // namespace indurop::mqtt
