// SPDX-License-Identifier: Apache-2.0
// Reads and writes files of a slave (FoE): parameters, logs, firmware. Waits: not for the tick.

#pragma once

#include <indurop/result.h>

#include <functional>
#include <string>
#include <vector>

#include "control/io/ethercat/foe.h"
#include "control/io/ethercat/master/mailbox_session.h"

namespace indurop::io::ethercat {

class FoeClient {
 public:
  // The session is open. `progress` is called with the bytes that have been transferred.
  FoeClient(MailboxSession& session, std::uint32_t password, std::function<void(std::size_t)> progress = {})
      : session_(session), password_(password), progress_(std::move(progress)) {}

  // Errors: what the slave says, a packet that is missing, or no answer.
  Result<std::vector<std::uint8_t>, std::string> read(const std::string& name);
  // Returns what is wrong; empty: nothing.
  std::string write(const std::string& name, Bytes content);

 private:
  Result<std::vector<std::uint8_t>, std::string> ask(Bytes message);
  void report(std::size_t bytes) const;

  MailboxSession& session_;
  std::uint32_t password_;
  std::function<void(std::size_t)> progress_;
};

}  // namespace indurop::io::ethercat
