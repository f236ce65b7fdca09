// SPDX-License-Identifier: Apache-2.0
// What the master asks a slave that is in OP, by turns: whether it still is, its clock, its ports, and through its
// mailbox. Real-time safe.

#pragma once

#include <optional>

#include "control/io/ethercat/master/events.h"
#include "control/io/ethercat/master/port_watch.h"
#include "control/io/ethercat/master/sdo_client.h"
#include "control/io/ethercat/master/sync_setup.h"

namespace indurop::io::ethercat {

class OperationWatch {
 public:
  // Borrows all but the numbers.
  OperationWatch(std::uint16_t place, std::uint16_t station, SdoClient& mailbox, SyncSetup& sync, Events& events)
      : place_(place), station_(station), mailbox_(mailbox), sync_(sync), events_(events) {}

  // The slave has reached OP.
  void begin(Clock now) noexcept;
  std::optional<Query> query(Clock now) noexcept;
  // Why it has left OP; None: it has not.
  struct Verdict {
    Problem problem = Problem::None;
    std::uint32_t detail = 0;
  };
  Verdict answer(Bytes data, bool is_answered, Clock now) noexcept;
  // The last query was one of the mailbox.
  [[nodiscard]] bool asks_mailbox() const noexcept { return asks_ == Asks::Mailbox; }
  // Its process data came back with another working counter than expected.
  void suspect(std::uint16_t wkc, Clock now) noexcept;
  [[nodiscard]] std::uint64_t port_errors() const noexcept { return ports_.errors(); }

 private:
  enum class Asks { Mailbox, State, Pulse, Ports };

  void take_ports(Bytes data, Clock now) noexcept;

  std::uint16_t place_;
  std::uint16_t station_;
  SdoClient& mailbox_;
  SyncSetup& sync_;
  Events& events_;
  PortWatch ports_;
  Asks asks_ = Asks::Mailbox;  // the query on its way
  bool is_suspect_ = false;
  bool missed_state_ = false;  // the last query of the state was not answered
  Clock check_at_{0};
};

}  // namespace indurop::io::ethercat
