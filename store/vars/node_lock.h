// SPDX-License-Identifier: Apache-2.0
// Ensures one node per name: a lock on a file that the kernel releases however the node ends, and a socket with the
// node's name, which still protects if the file was removed. Not real-time safe.

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

  // Returns true if the lock file still exists under its name. If not, make_again() creates a file of this process
  // there, unless another process was faster.
  [[nodiscard]] bool named(const std::string& node) const;
  bool make_again(const std::string& node);

 private:
  NodeLock(int file, int socket) noexcept : file_(file), socket_(socket) {}
  int file_ = -1;
  int socket_ = -1;
};

// Name or number of a user.
std::string user_name(uid_t user);
// Returns the uid of the owner of a node's store; nothing if there is no such store.
std::optional<uid_t> owner_of(const std::string& node);
// Returns the user who owns the files of a node of this name, by name or number; empty if it is this user or there are
// none.
std::string other_owner(const std::string& node);

// Default name of a node: "local", or "local_UID" as long as another user owns the files of a "local".
std::string default_node();

// Returns the pid of the process that runs the node, 0 if none does: the process that holds the lock of this name and
// belongs to the user who owns the lock file. The content of the store is not used. Any user may call it.
pid_t running_node(const std::string& node);

}  // namespace indurop::vars
