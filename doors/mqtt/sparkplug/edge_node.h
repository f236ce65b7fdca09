// SPDX-License-Identifier: Apache-2.0
// An edge node of Sparkplug B, whose devices are the boards: births and deaths, data by alias, commands, and data that
// were kept while no broker or no primary host was there.

#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/log.h"
#include "doors/mqtt/broker/broker.h"
#include "doors/mqtt/broker/outlet.h"
#include "doors/mqtt/model/board.h"
#include "doors/mqtt/serve/commands.h"
#include "doors/mqtt/sparkplug/backlog.h"
#include "doors/mqtt/sparkplug/metrics.h"

namespace indurop::mqtt {

struct SparkplugSettings {
  std::string group;
  std::string node;
  std::string primary_host;  // data are kept while it is offline; empty: none is waited for
  UserToken commander;       // in whose name commands of hosts are executed; without a token they are refused
};

// Used by the thread of the main loop.
class EdgeNode {
 public:
  // `backlog`: null: data are lost while there is no connection. `submit` executes a command.
  EdgeNode(SparkplugSettings settings, Outlet& outlet, Backlog* backlog, std::function<void(Command)> submit,
           const base::Log& log);

  // The death that the broker publishes for a connection with this number of birth.
  static Will will_of(const SparkplugSettings& settings, std::uint64_t birth, std::int64_t now_ns);

  void connected(std::uint64_t birth);
  void lost();
  void confirmed(int receipt);
  void receive(const std::string& topic, const std::string& payload);
  // A board has (other) variables. It must outlive its next call or board_is_gone().
  void board_is_there(const Board& board);
  void board_is_gone(const std::string& board);
  // A frame of the board was taken over.
  void changed(const Board& board, const std::vector<Change>& changes);
  // To be called some times a second: sends what was kept and asks for receipts.
  void tick(std::int64_t now_ns);
  // Returns true while data that were sent last are not confirmed.
  [[nodiscard]] bool waits_for_receipt() const noexcept { return state_ == State::Born && !sent_.empty(); }
  // Publishes the death of the node; the connection has to end after it.
  void die();

 private:
  enum class State { Offline, Waiting, Born };
  struct Device {
    const Board* board = nullptr;
    AliasTable aliases;
    bool born = false;
  };
  struct Sent {
    std::string board;
    Payload payload;
  };
  // What a receipt confirms.
  struct Receipt {
    int id = 0;
    std::size_t sent = 0;
    std::optional<Backlog::Position> stored;
  };

  [[nodiscard]] std::string topic(const char* kind, const std::string& device = {}) const;
  void be_born();
  void publish_birth(Device& device);
  void publish_death(const std::string& board);
  [[nodiscard]] Metric metric_of(const Device& device, std::size_t variable, std::size_t leaf, bool is_birth) const;
  bool send(const char* kind, const std::string& device, Payload payload);
  void keep(const std::string& board, const Payload& payload);
  void note_lost();
  // Returns true if something was published.
  bool send_kept(std::int64_t now_ns);
  [[nodiscard]] bool can_send(const Backlog::Stored& stored) const;
  void receive_state(const std::string& payload);
  void command_node(const Payload& payload);
  void command_device(const std::string& board, const Payload& payload);
  void publish_again(const std::string& board, const std::vector<AliasTable::Place>& places);

  SparkplugSettings settings_;
  Outlet* outlet_;
  Backlog* backlog_;
  std::function<void(Command)> submit_;
  base::Log log_;
  State state_ = State::Offline;
  std::uint64_t birth_ = 0;
  std::uint8_t seq_ = 0;
  std::uint64_t next_alias_ = 1;
  std::map<std::string, Device, std::less<>> devices_;
  std::deque<Sent> sent_;  // not confirmed yet
  std::size_t sent_metrics_ = 0;
  Receipt receipt_;
  std::int64_t born_ns_ = 0;
  std::int64_t synced_ns_ = 0;
  std::int64_t host_time_ = 0;  // timestamp of the primary host's last state
  std::uint64_t noted_lost_ = 0;
  std::string noted_problem_;
  std::string noted_missing_;  // board whose kept data were given up
};

}  // namespace indurop::mqtt
