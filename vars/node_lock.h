// SPDX-License-Identifier: Apache-2.0
// One node per name: a lock on a file that the kernel frees whatever way the node ends. Not real-time safe.

#pragma once

#include <indurop/result.h>
#include <sys/types.h>

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

 private:
  explicit NodeLock(int file) noexcept : file_(file) {}
  int file_ = -1;
};

// User who has the files of a node of this name, by name or number; empty if it is us or nobody.
std::string other_owner(const std::string& node);

// Name of a node that was given none: "local", or "local_UID" as long as another user has the files of a "local".
std::string default_node();

// Pid of the process that runs the node, 0 if none does. Any user may ask.
pid_t running_node(const std::string& node);

}  // namespace indurop::vars
