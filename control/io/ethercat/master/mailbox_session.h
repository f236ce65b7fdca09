// SPDX-License-Identifier: Apache-2.0
// Messages through the mailbox of one slave of a bus that has no master: takes the slave to a state with a mailbox, and
// leaves it in INIT. Waits: not for the tick.

#pragma once

#include <indurop/result.h>

#include <functional>
#include <string>
#include <vector>

#include "control/io/ethercat/coe.h"
#include "control/io/ethercat/master/requester.h"
#include "control/io/ethercat/master/scan.h"

namespace indurop::io::ethercat {

class MailboxSession {
 public:
  // The slave at this position, as a scan has found it; borrowed, as the link.
  MailboxSession(Link& link, Requester::Wait wait, std::size_t place, const FoundSlave& slave);
  MailboxSession(const MailboxSession&) = delete;
  MailboxSession& operator=(const MailboxSession&) = delete;
  ~MailboxSession();

  // To PREOP, or to BOOT, which has a mailbox of its own. Returns what is wrong, empty: nothing; as send().
  std::string open(AlState state, std::uint16_t protocol);
  // What follows the header of a message.
  std::string send(MailboxType type, Bytes message);
  // The next message that is wanted; others are dropped. Errors: none comes within a second (`patience`).
  Result<std::vector<std::uint8_t>, std::string> receive(const std::function<bool(const Mailbox&)>& is_wanted,
                                                         Clock patience = std::chrono::seconds(1));
  // Bytes of a message to the slave, and of an answer, without the header of the mailbox.
  [[nodiscard]] std::size_t room() const noexcept { return area_.receive_size - kMailboxHeader; }
  [[nodiscard]] std::size_t answer_room() const noexcept { return area_.send_size - kMailboxHeader; }

 private:
  std::string take_to(AlState state);

  Requester requester_;
  std::size_t place_;
  const FoundSlave& slave_;
  MailboxArea area_;
  std::uint8_t counter_ = 0;
  bool is_open_ = false;
};

}  // namespace indurop::io::ethercat
