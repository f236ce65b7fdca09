// SPDX-License-Identifier: Apache-2.0
// The lock is that of a file; its text "PID START_TIME" only serves to say who has it. The file may be removed by
// the one who holds the lock, so whoever got a lock looks whether its file still has the name.

#include "vars/node_lock.h"

#include <fcntl.h>
#include <pwd.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <thread>
#include <utility>

#include "rt/file_lock.h"
#include "vars/block.h"
#include "vars/os_error.h"
#include "vars/process.h"
#include "vars/shm_file.h"

namespace indurop::vars {

namespace {

// Others cannot open it: who can open a file can lock it, and so keep a node from starting.
constexpr mode_t kLockMode = 0660;
constexpr int kTries = 100;
constexpr std::chrono::milliseconds kPause{1};

std::string path_of(const std::string& node) {
  return std::string(kShmDirectory) + "/" + lock_file(node);
}

// First without O_CREAT: in a sticky directory the kernel may refuse O_CREAT on another user's file, even to root.
int open_lock(const std::string& path) noexcept {
  constexpr int kFlags = O_RDWR | O_NOFOLLOW | O_CLOEXEC | O_NONBLOCK;
  const int file = ::open(path.c_str(), kFlags);
  if (file >= 0 || errno != ENOENT) {
    return file;
  }
  const int made = ::open(path.c_str(), kFlags | O_CREAT | O_EXCL, kLockMode);
  if (made >= 0) {
    ::fchmod(made, kLockMode);
  }
  return made;
}

bool has_name(int file, const std::string& path) noexcept {
  struct stat ours {};
  struct stat named {};
  return ::fstat(file, &ours) == 0 && ::lstat(path.c_str(), &named) == 0 && ours.st_dev == named.st_dev &&
         ours.st_ino == named.st_ino;
}

// The living process that wrote its name into the file, else 0.
pid_t read_holder(int file) noexcept {
  char text[64];
  const ssize_t length = ::pread(file, text, sizeof(text) - 1, 0);
  if (length <= 0) {
    return 0;
  }
  text[length] = '\0';
  int pid = 0;
  unsigned long long start_time = 0;
  // NOLINTNEXTLINE(cert-err34-c): a number that is too large is no living process either
  if (std::sscanf(text, "%d %llu", &pid, &start_time) != 2 || !process_alive(pid, start_time)) {
    return 0;
  }
  return pid;
}

// On a full file system the text may be missing; the lock holds without it.
void write_holder(int file) noexcept {
  char text[64];
  const int length = std::snprintf(text, sizeof(text), "%d %llu\n", static_cast<int>(::getpid()),
                                   static_cast<unsigned long long>(process_start_time(::getpid())));
  [[maybe_unused]] const bool told =
      ::ftruncate(file, 0) == 0 && ::pwrite(file, text, static_cast<std::size_t>(length), 0) == length;
}

pid_t holder_by_block(const std::string& node) {
  auto file = ShmFile::open(block_file(node), Mode::ReadOnly);
  if (!file || !check_block({file->data(), file->size()})) {
    return 0;
  }
  const BlockHeader& header = *header_of(file->data());
  const pid_t pid = header.node_pid.load();
  return process_alive(pid, header.node_start_time.load()) ? pid : 0;
}

}  // namespace

Result<NodeLock> NodeLock::acquire(const std::string& node, pid_t& holder) {
  holder = 0;
  if (!valid_node_name(node)) {
    return Error{Errc::InvalidArgument, 0, "node name: 1 to 40 letters, digits, '_' or '-'"};
  }
  const std::string path = path_of(node);
  for (int i = 0; i < kTries && holder == 0; ++i) {
    const int number = open_lock(path);
    if (number < 0) {
      if (errno == EEXIST || errno == ENOENT) {  // made or removed by somebody at this moment
        continue;
      }
      return os_error(errno, "open the node's lock file");
    }
    NodeLock lock(number);
    const Status locked = rt::lock_file(number, rt::FileLock::Exclusive);
    if (locked) {
      if (has_name(number, path)) {
        write_holder(number);
        return lock;
      }
      continue;
    }
    if (locked.error().code != Errc::Busy) {
      return os_error(locked.error().sys_errno, "lock the node's name");
    }
    // A holder that is ending, or one that is just removing the node's files, is gone in a moment.
    holder = read_holder(number);
    if (holder == 0) {
      std::this_thread::sleep_for(kPause);
    }
  }
  return Error{Errc::Busy, 0, "a node of this name is running"};
}

NodeLock::NodeLock(NodeLock&& other) noexcept : file_(std::exchange(other.file_, -1)) {}
NodeLock& NodeLock::operator=(NodeLock&& other) noexcept {
  std::swap(file_, other.file_);
  return *this;
}
NodeLock::~NodeLock() {
  if (file_ >= 0) {
    ::close(file_);
  }
}

std::string other_owner(const std::string& node) {
  struct stat status {};
  if (::lstat(path_of(node).c_str(), &status) != 0 || status.st_uid == ::geteuid()) {
    return {};
  }
  passwd entry{};
  passwd* found = nullptr;
  char text[1024];
  const bool known = ::getpwuid_r(status.st_uid, &entry, text, sizeof(text), &found) == 0 && found != nullptr;
  return known ? found->pw_name : std::to_string(status.st_uid);
}

std::string default_node() {
  const std::string name = "local";
  return other_owner(name).empty() ? name : name + "_" + std::to_string(::geteuid());
}

pid_t running_node(const std::string& node) {
  if (!valid_node_name(node)) {
    return 0;
  }
  const int file = ::open(path_of(node).c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC | O_NONBLOCK);
  if (file < 0) {
    return errno == EACCES ? holder_by_block(node) : 0;
  }
  const pid_t pid = read_holder(file);
  ::close(file);
  return pid;
}

}  // namespace indurop::vars
