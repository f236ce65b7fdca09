// SPDX-License-Identifier: Apache-2.0
// The agent's part of the host's audit log (store/operate/audit.h): each remote command, done or refused, with the name
// of the user and the reason. Not real-time safe.

#pragma once

#include <cstdint>
#include <string>

#include "deploy/transaction/user_list.h"
#include "deploy/words/command_words.h"

namespace indurop::deploy {

// Returns the command as logs name it.
const char* word_of(Action action) noexcept;
// Returns the command with this verified name in place of the one that it claims; empty: as it is.
Command signed_by(Command command, const std::string& user);
// Notes a command. `user`: the verified name; empty: the name in the command is that of a deployer's client, which says
// so. `outcome`: "begun", "done", else why not. Nothing is noted of recordings that are kept running. Returns why it
// could not be noted, else an empty text.
std::string note_command(const Command& command, const std::string& user, const std::string& outcome);
// Notes a list of users that another board had. `author`: the verified name of the one who sent it to the plant; empty:
// a deployer. Returns the same.
std::string log_users(const std::string& board, const UserList& list, const std::string& author);
// Notes a list of valid keys that is taken from a host or board. `outcome`: as above. Returns the same.
std::string log_trust(const std::string& board, const std::string& plant, const std::string& from, std::uint64_t serial,
                      const std::string& outcome);

}  // namespace indurop::deploy
