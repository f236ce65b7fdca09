// SPDX-License-Identifier: Apache-2.0
// The reports of boards that have arrived and were not taken yet. DDS keeps the last samples of one name, of all
// writers together, so a participant that reports under another board's name would displace the reports of that board.
// Here each writer has a place of its own. Speakers decides which participant may report as which board.

#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "core/rt/signal_word.h"
#include "deploy/words/deployment_words.h"
#include "network/dds/endpoint.h"

namespace indurop::deploy {

class ReportInbox {
 public:
  // Signals `wake` when something has arrived; borrows it.
  explicit ReportInbox(rt::SignalWord& wake) : wake_(wake) {}

  // For the reader of reports, which must be deleted first.
  [[nodiscard]] dds::Listener listener();

  // What one writer said of one agent since the last call.
  struct Received {
    dds::InstanceHandle publication = 0;
    std::string board;
    std::uint64_t agent = 0;
    std::optional<BoardReport> report;  // its last one
    std::uint64_t reports = 0;          // how many it were
    bool gone = false;                  // after the report, if there is one: no participant writes them any more
  };
  [[nodiscard]] std::vector<Received> take();

 private:
  void receive(dds::Handle reader);  // called by threads of DDS
  Received& place(dds::InstanceHandle publication, const std::string& board, std::uint64_t agent);

  rt::SignalWord& wake_;
  std::mutex mutex_;  // of what follows
  std::vector<Received> received_;
  std::map<std::tuple<dds::InstanceHandle, std::string, std::uint64_t>, std::size_t> places_;  // in received_
};

}  // namespace indurop::deploy
