// SPDX-License-Identifier: Apache-2.0
// One node per name: a lock on a file that the kernel frees whatever way the node ends, and a socket of the node's name
// that holds when somebody removed the file. Not real-time safe.

#pragma once

#include <indurop/result.h>
#include <sys/types.h>

#include <optional>
#include <string>

namespace indurop::vars {

class NodeLock {
 public:
  // Takes the node's name for this process. `holder` is the pid of the process that has it if the error is Busy
  // (0: unknown). Errors: InvalidArgument (node name), Busy, PermissionDenied (a node of another user used the name and
  // its files are still there: take another name, or let that user or root remove them), System.
  static Result<NodeLock> acquire(const std::string& node, pid_t& holder);

  NodeLock(NodeLock&& other) noexcept;
  NodeLock& operator=(NodeLock&& other) noexcept;
  NodeLock(const NodeLock&) = delete;
  NodeLock& operator=(const NodeLock&) = delete;
  ~NodeLock();

  // The lock file is still there under its name. If not, make_again() gives the name a file of this process, unless
  // somebody else was faster.
  [[nodiscard]] bool named(const std::string& node) const;
  bool make_again(const std::string& node);

 private:
  NodeLock(int file, int socket) noexcept : file_(file), socket_(socket) {}
  int file_ = -1;
  int socket_ = -1;
};

// Name or number of a user.
std::string user_name(uid_t user);
// User whose store of a node it is, by number; nothing if there is no such store.
std::optional<uid_t> owner_of(const std::string& node);
// User who has the files of a node of this name, by name or number; empty if it is us or nobody.
std::string other_owner(const std::string& node);

// Name of a node that was given none: "local", or "local_UID" as long as another user has the files of a "local".
std::string default_node();

// Pid of the process that runs the node, 0 if none does: whoever holds the lock of this name, and is a process of the
// user whose file the lock is. What a store says of itself does not count. Any user may ask.
pid_t running_node(const std::string& node);

}  // namespace indurop::vars
