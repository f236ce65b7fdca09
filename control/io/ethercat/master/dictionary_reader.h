// SPDX-License-Identifier: Apache-2.0
// Reads which objects a slave has, with their types and names, as it describes them itself: takes it to PREOP, asks
// through its mailbox, and leaves it in INIT. For a bus that has no master; waits: not for the tick.

#pragma once

#include <indurop/result.h>

#include <string>
#include <vector>

#include "control/io/ethercat/master/mailbox_session.h"
#include "control/io/ethercat/sdo_information.h"

namespace indurop::io::ethercat {

struct DescribedObject {
  ObjectDescription object;
  std::vector<EntryDescription> entries;  // by subindex; those that it does not describe are left out
};

class DictionaryReader {
 public:
  // The slave at this position, as a scan has found it; borrowed.
  DictionaryReader(Link& link, Requester::Wait wait, std::size_t place, const FoundSlave& slave);

  // Errors: it has no SDO information, a master runs it, it refuses a state or a request, or it does not answer.
  Result<std::vector<DescribedObject>, std::string> run();

 private:
  using Message = std::vector<std::uint8_t>;

  Result<Message, std::string> ask(InformationCode code, Bytes data, InformationCode wanted);
  Result<std::vector<DescribedObject>, std::string> read_all();
  Result<DescribedObject, std::string> read_one(std::uint16_t index);

  MailboxSession session_;
  const FoundSlave& slave_;
};

}  // namespace indurop::io::ethercat
