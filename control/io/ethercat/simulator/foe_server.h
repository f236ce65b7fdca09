// SPDX-License-Identifier: Apache-2.0
// The files of a simulated slave, and the answers to requests for them.

#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "control/io/ethercat/foe.h"

namespace indurop::io::ethercat {

class FoeServer {
 public:
  using Content = std::vector<std::uint8_t>;
  // By name. A file whose name begins with "firmware" can be written in BOOT only, as real slaves have it.
  std::map<std::string, Content>& files() noexcept { return files_; }
  void set_password(std::uint32_t password) noexcept { password_ = password; }
  // Answers the next requests that it is busy.
  void set_busy(unsigned times) noexcept { busy_ = times; }
  void reset() noexcept { transfer_.reset(); }

  // Bytes of a message without the header of the mailbox, from the master and to it.
  struct Room {
    std::size_t in = 0;
    std::size_t out = 0;
  };
  // The answer; empty: none.
  std::vector<std::uint8_t> answer(Bytes message, bool in_boot, Room room);

 private:
  struct Transfer {
    std::string name;
    Content content;
    std::size_t done = 0;  // of a file that is read: bytes sent
    std::uint32_t packet = 0;
    bool reads = false;
  };

  std::vector<std::uint8_t> begin(const Foe& request, bool in_boot, Room room);
  std::vector<std::uint8_t> take(const Foe& packet, std::size_t room);
  std::vector<std::uint8_t> give(std::size_t room);

  std::map<std::string, Content> files_;
  std::uint32_t password_ = 0;
  unsigned busy_ = 0;
  std::optional<Transfer> transfer_;
};

}  // namespace indurop::io::ethercat
