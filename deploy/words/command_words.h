// SPDX-License-Identifier: Apache-2.0
// Commands to one board outside of deployments: stop, start or restart its node or one of its modules, force values of
// its variables, keep its black box or record its runs. The agent answers the first request with a number that is valid
// once, so that a captured command cannot be replayed. No network.

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace indurop::deploy {

enum class Action : std::uint8_t {
  StopModule,  // target of these six: transaction/write_words.h, or only the name of the module; empty: the node
  StartModule,
  RestartModule,
  StopNode,
  StartNode,
  RestartNode,
  Force,    // target: transaction/write_words.h
  Unforce,  // target: transaction/write_words.h
  KeepBox,  // target: the reason
  // Records what its runs read and write to a file on its disk. Target: the recording's name, "past" or "now" (where it
  // begins), then variables or globs, one per line, none: all. The command is repeated to keep the recording running;
  // one that is no longer requested ends automatically. The answer to the first request lists globs that match no
  // variable of the board, one per line; if none matches, nothing is recorded.
  Record,
  EndRecord,   // target: its name. Unchanged: it had ended earlier, the text says why
  DropRecord,  // target: its name; its file was fetched
  SetLock,     // target: transaction/write_words.h
  Set,         // target: transaction/write_words.h
  // Actions on alarms. Target: transaction/write_words.h with names of alarms as lines, none: all. The answer is a JSON
  // array of those that it was done to.
  AckAlarms,
  ShelveAlarms,  // for the given duration
  UnshelveAlarms,
  SetUsers,  // target: text of a UserList (transaction/user_list.h)
  // Exchanges the code of a module. Target: transaction/write_words.h with two lines, its name and the text of an
  // operate::RemoteReload; the file is fetched from the commander, a deployer. The answer is that of an
  // operate::RemoteReloadReply.
  ReloadModule,
  SetTrust,  // target: a list of valid keys (core/keys/trust_list.h), signed by the plant's authority
};

struct Command {
  std::uint64_t commander = 0;  // number of this run of the commanding client
  std::string host;             // its host, for people
  std::string board;
  std::uint64_t agent = 0;  // the addressed agent of the board
  std::string plant;        // what the board runs
  Action action = Action::StopModule;
  std::string target;       // see Action
  std::uint64_t nonce = 0;  // issued by the agent; 0: requests one
  // Of command_text(); empty: unsigned. With a deployer's key the signature alone, with that of another user
  // user_signature_text().
  std::string signature;
};

// A signature with the certificate (PEM) to whose key it belongs.
struct UserSignature {
  std::string signature;
  std::string certificate;
};
std::string user_signature_text(const UserSignature& signature);
// Returns nothing if the text is the signature of a deployer, or empty.
std::optional<UserSignature> read_user_signature(std::string_view text);

enum class Outcome : std::uint8_t {
  Nonce,      // repeat the command with this number
  UnderWay,   // accepted, not done yet
  Done,       // it is as commanded
  Unchanged,  // it was in this state already
  Failed,     // see text
  Refused,    // see text; nothing was changed
};

struct CommandReply {
  std::uint64_t commander = 0;
  std::string board;
  std::uint64_t agent = 0;
  std::uint64_t nonce = 0;
  Outcome outcome = Outcome::Refused;
  std::string text;
};

// Returns the text that is signed.
std::string command_text(const Command& command);

}  // namespace indurop::deploy
