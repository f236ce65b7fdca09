// SPDX-License-Identifier: Apache-2.0
#include "tools/iceoryx/roudi.h"

#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace indurop::iceoryx {
namespace {

// The socket to which every client of iceoryx 2 sends its requests on Linux.
constexpr char kSocket[] = "/tmp/roudi";

}  // namespace

Roudi find_roudi() noexcept {
  Roudi found;
  struct stat info {};
  if (stat(kSocket, &info) != 0) {
    return found;
  }
  const int fd = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (fd < 0) {
    return found;
  }
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::memcpy(address.sun_path, kSocket, sizeof kSocket);
  // The socket file of a RouDi that was killed still exists, but no process receives from it.
  if (connect(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0) {
    found.state = Roudi::State::There;
    found.inode = info.st_ino;
    // Time of the bind(): later changes of permissions and the like must not look like another RouDi.
    found.since_ns = std::int64_t{info.st_mtim.tv_sec} * 1'000'000'000 + info.st_mtim.tv_nsec;
  } else if (errno == EACCES || errno == EPERM) {
    found.state = Roudi::State::NoPermission;
  }
  close(fd);
  return found;
}

}  // namespace indurop::iceoryx
