// SPDX-License-Identifier: Apache-2.0
// The lock is that of a file; its text "PID START_TIME" only identifies the holder. The file may be removed by the
// holder of the lock, so a process that got a lock checks whether its file still has the name.

#include "store/vars/node_lock.h"

#include <fcntl.h>
#include <pwd.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <thread>
#include <utility>

#include "core/rt/file_lock.h"
#include "store/vars/block.h"
#include "store/vars/os_error.h"
#include "store/vars/process.h"
#include "store/vars/shm_file.h"

namespace indurop::vars {

namespace {

// Other users cannot open it: a process that can open a file can lock it, and so prevent a node from starting.
constexpr mode_t kLockMode = 0660;
constexpr int kLockTries = 100;
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

// The living process that wrote its pid into the file, else 0.
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
  [[maybe_unused]] const bool announced =
      ::ftruncate(file, 0) == 0 && ::pwrite(file, text, static_cast<std::size_t>(length), 0) == length;
}

pid_t pid_in_block(const std::string& node) {
  auto file = ShmFile::open(block_file(node), Mode::ReadOnly);
  if (!file || !check_header({file->data(), file->size()})) {
    return 0;
  }
  const BlockHeader& header = *header_of(file->data());
  const pid_t pid = header.node_pid.load();
  return process_alive(pid, header.node_start_time.load()) ? pid : 0;
}

// For users who may not open the file. The kernel shows all locks, with the numbers of their files.
bool has_kernel_lock(const struct stat& file) {
  char wanted[64];
  std::snprintf(wanted, sizeof wanted, " %02x:%02x:%llu ", major(file.st_dev), minor(file.st_dev),
                static_cast<unsigned long long>(file.st_ino));
  std::ifstream locks("/proc/locks");
  for (std::string line; std::getline(locks, line);) {
    if (line.find(wanted) != std::string::npos && line.find(" WRITE ") != std::string::npos) {
      return true;
    }
  }
  return false;
}

// Checks that the process belongs to this user: otherwise anyone could copy a lock's text and present another user's
// process as a node.
bool belongs_to(pid_t pid, uid_t user) {
  std::ifstream status("/proc/" + std::to_string(pid) + "/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with("Uid:")) {
      return std::strtoull(line.c_str() + 4, nullptr, 10) == user;  // the real user id
    }
  }
  return false;
}

// A name of the network namespace, which no user can remove while the node runs. Containers that share a network have
// memory of their own, and so may have nodes of the same name.
sockaddr_un address_of(const std::string& node, socklen_t& length) noexcept {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  struct stat memory {};
  (void)::stat("/dev/shm", &memory);
  char device[24];
  std::snprintf(device, sizeof device, ".%llx", static_cast<unsigned long long>(memory.st_dev));
  const std::string name = block_file(node) + device;
  name.copy(address.sun_path + 1, sizeof address.sun_path - 1);
  length = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + name.size());
  return address;
}

int new_socket() noexcept {
  return ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
}

// -1 with EADDRINUSE: another process has the name.
int take_socket(const std::string& node) noexcept {
  socklen_t length = 0;
  const sockaddr_un address = address_of(node, length);
  const int number = new_socket();
  if (number >= 0 && ::bind(number, reinterpret_cast<const sockaddr*>(&address), length) == 0 &&
      ::listen(number, 1) == 0) {
    return number;
  }
  const int error = errno;
  if (number >= 0) {
    ::close(number);
  }
  errno = error;
  return -1;
}

// The process that has the name of the socket, 0 if that cannot be determined.
pid_t holder_by_socket(const std::string& node) noexcept {
  socklen_t length = 0;
  const sockaddr_un address = address_of(node, length);
  const int number = new_socket();
  ucred peer{};
  socklen_t size = sizeof peer;
  const bool known = number >= 0 && ::connect(number, reinterpret_cast<const sockaddr*>(&address), length) == 0 &&
                     ::getsockopt(number, SOL_SOCKET, SO_PEERCRED, &peer, &size) == 0;
  if (number >= 0) {
    ::close(number);
  }
  return known ? peer.pid : 0;
}

// Root takes over the name of another user whose node has ended; from then on the lock is root's.
void make_ours(int file) noexcept {
  struct stat info {};
  if (::geteuid() == 0 && ::fstat(file, &info) == 0 && info.st_uid != 0) {
    [[maybe_unused]] const int forbidden = ::fchown(file, 0, info.st_gid);
  }
}

}  // namespace

Result<NodeLock> NodeLock::acquire(const std::string& node, pid_t& holder) {
  holder = 0;
  if (!valid_node_name(node)) {
    return Error{Errc::InvalidArgument, 0, "node name: 1 to 40 letters, digits, '_' or '-'"};
  }
  const std::string path = path_of(node);
  for (int i = 0; i < kLockTries && holder == 0; ++i) {
    const int number = open_lock(path);
    if (number < 0) {
      if (errno == EEXIST || errno == ENOENT) {  // created or removed by another process at this moment
        continue;
      }
      return os_error(errno, "open the node's lock file");
    }
    NodeLock lock(number, -1);
    const Status locked = rt::lock_file(number, rt::FileLock::Exclusive);
    if (locked) {
      if (!has_name(number, path)) {
        continue;
      }
      lock.socket_ = take_socket(node);
      if (lock.socket_ >= 0 || errno != EADDRINUSE) {
        make_ours(number);
        write_holder(number);
        return lock;
      }
      // The files of a running node were removed, or it is just ending.
      if (i + 1 == kLockTries) {
        holder = holder_by_socket(node);
      }
      std::this_thread::sleep_for(kPause);
      continue;
    }
    if (locked.error().code != Errc::Busy) {
      return os_error(locked.error().sys_errno, "lock the node's name");
    }
    // A holder that is ending, or that is just removing the node's files, is gone in a moment.
    holder = read_holder(number);
    if (holder == 0) {
      std::this_thread::sleep_for(kPause);
    }
  }
  return Error{Errc::Busy, 0, "a node of this name is running"};
}

NodeLock::NodeLock(NodeLock&& other) noexcept
    : file_(std::exchange(other.file_, -1)), socket_(std::exchange(other.socket_, -1)) {}
NodeLock& NodeLock::operator=(NodeLock&& other) noexcept {
  std::swap(file_, other.file_);
  std::swap(socket_, other.socket_);
  return *this;
}
NodeLock::~NodeLock() {
  for (const int number : {file_, socket_}) {
    if (number >= 0) {
      ::close(number);
    }
  }
}

bool NodeLock::named(const std::string& node) const {
  return has_name(file_, path_of(node));
}

bool NodeLock::make_again(const std::string& node) {
  const std::string path = path_of(node);
  const int number = open_lock(path);
  if (number < 0) {
    return false;
  }
  if (!rt::lock_file(number, rt::FileLock::Exclusive) || !has_name(number, path)) {
    ::close(number);
    return false;
  }
  write_holder(number);
  ::close(std::exchange(file_, number));
  return true;
}

std::string user_name(uid_t user) {
  passwd entry{};
  passwd* found = nullptr;
  char text[1024];
  const bool known = ::getpwuid_r(user, &entry, text, sizeof(text), &found) == 0 && found != nullptr;
  return known ? found->pw_name : std::to_string(user);
}

std::optional<uid_t> owner_of(const std::string& node) {
  struct stat status {};
  const std::string path = std::string(kShmDirectory) + "/" + block_file(node);
  return ::lstat(path.c_str(), &status) == 0 ? std::optional(status.st_uid) : std::nullopt;
}

std::string other_owner(const std::string& node) {
  struct stat status {};
  return ::lstat(path_of(node).c_str(), &status) != 0 || status.st_uid == ::geteuid() ? std::string()
                                                                                      : user_name(status.st_uid);
}

std::string default_node() {
  const std::string name = "local";
  return other_owner(name).empty() ? name : name + "_" + std::to_string(::geteuid());
}

pid_t running_node(const std::string& node) {
  if (!valid_node_name(node)) {
    return 0;
  }
  const std::string path = path_of(node);
  struct stat info {};
  const int file = ::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC | O_NONBLOCK);
  if (file < 0) {
    const bool closed = errno == EACCES && ::lstat(path.c_str(), &info) == 0 && has_kernel_lock(info);
    const pid_t pid = closed ? pid_in_block(node) : 0;
    return pid != 0 && belongs_to(pid, info.st_uid) ? pid : 0;
  }
  const bool locked = ::fstat(file, &info) == 0 && S_ISREG(info.st_mode) && rt::is_locked(file);
  const pid_t pid = locked ? read_holder(file) : 0;
  ::close(file);
  return pid != 0 && belongs_to(pid, info.st_uid) ? pid : 0;
}

}  // namespace indurop::vars
