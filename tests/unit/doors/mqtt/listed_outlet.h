// SPDX-License-Identifier: Apache-2.0
// A connection to a broker as a list of messages, for tests.

#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "doors/mqtt/broker/outlet.h"

namespace indurop::mqtt {

struct ListedMessage {
  std::string topic;
  std::string payload;
  bool retain = false;
};

class ListedOutlet final : public Outlet {
 public:
  bool publish(const std::string& topic, std::string_view payload, Retain retain) override {
    if (!up) {
      return false;
    }
    sent.push_back({topic, std::string(payload), retain == Retain::Yes});
    return true;
  }
  void subscribe(const std::string& filter) override { filters.push_back(filter); }
  int request_receipt() override { return up ? ++receipts : 0; }
  void reconnect() override { ++reconnects; }

  // Returns what was sent since the last call.
  std::vector<ListedMessage> take() { return std::exchange(sent, {}); }

  bool up = true;
  int receipts = 0;
  int reconnects = 0;
  std::vector<ListedMessage> sent;
  std::vector<std::string> filters;
};

}  // namespace indurop::mqtt
