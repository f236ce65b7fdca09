// SPDX-License-Identifier: Apache-2.0
// Linux: AF_PACKET with a mapped ring.

#include "core/rt/packet_socket.h"

#include <arpa/inet.h>
#include <linux/if_packet.h>
#include <net/if.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>

namespace indurop::rt {

namespace {

constexpr std::size_t kSlotBytes = 2048;  // of the ring: the kernel's header and one frame
constexpr std::size_t kSlots = 256;
constexpr std::size_t kBlockBytes = 16 * kSlotBytes;
constexpr std::size_t kRingBytes = kSlots * kSlotBytes;

unsigned flags_of(int socket, const std::string& interface) noexcept {
  ifreq request{};
  interface.copy(request.ifr_name, IFNAMSIZ - 1);
  return ioctl(socket, SIOCGIFFLAGS, &request) == 0 ? static_cast<unsigned short>(request.ifr_flags) : 0U;
}

PacketProblem system_problem(int error) noexcept {
  return {error == EPERM || error == EACCES ? PacketProblem::Kind::NoRight : PacketProblem::Kind::System, error};
}

}  // namespace

Result<std::unique_ptr<PacketSocket>, PacketProblem> PacketSocket::open(const std::string& interface,
                                                                        std::uint16_t protocol) {
  // Without a protocol it receives nothing before it is bound to its interface.
  const int socket = ::socket(AF_PACKET, SOCK_RAW | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (socket < 0) {
    return system_problem(errno);
  }
  std::unique_ptr<PacketSocket> opened(new PacketSocket(interface, socket));  // NOLINT: the constructor is private
  const unsigned index = interface.size() < IFNAMSIZ ? if_nametoindex(interface.c_str()) : 0;
  if (index == 0) {
    return PacketProblem{PacketProblem::Kind::NoInterface, 0};
  }
  if ((flags_of(socket, interface) & IFF_UP) == 0) {
    return PacketProblem{PacketProblem::Kind::SwitchedOff, 0};
  }
  if (const int error = opened->share_ring(); error != 0) {
    return system_problem(error);
  }
  sockaddr_ll address{};
  address.sll_family = AF_PACKET;
  address.sll_protocol = htons(protocol);
  address.sll_ifindex = static_cast<int>(index);
  if (bind(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    return system_problem(errno);
  }
  return opened;
}

PacketSocket::~PacketSocket() {
  if (ring_ != nullptr) {
    munmap(ring_, kRingBytes);
  }
  close(socket_);
}

// Returns the error number, 0 if there is none.
int PacketSocket::share_ring() noexcept {
  const int version = TPACKET_V2;
  tpacket_req request{};
  request.tp_block_size = kBlockBytes;
  request.tp_block_nr = kRingBytes / kBlockBytes;
  request.tp_frame_size = kSlotBytes;
  request.tp_frame_nr = kSlots;
  if (setsockopt(socket_, SOL_PACKET, PACKET_VERSION, &version, sizeof version) != 0 ||
      setsockopt(socket_, SOL_PACKET, PACKET_RX_RING, &request, sizeof request) != 0) {
    return errno;
  }
  // Frames are sent past the queues of traffic control. Where that is not possible they go through them.
  const int bypass = 1;
  (void)setsockopt(socket_, SOL_PACKET, PACKET_QDISC_BYPASS, &bypass, sizeof bypass);
  void* const mapped = mmap(nullptr, kRingBytes, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_POPULATE, socket_, 0);
  if (mapped == MAP_FAILED) {
    return errno;
  }
  ring_ = static_cast<std::uint8_t*>(mapped);
  return 0;
}

bool PacketSocket::send(std::span<const std::uint8_t> frame) noexcept {
  return ::send(socket_, frame.data(), frame.size(), MSG_DONTWAIT) == static_cast<ssize_t>(frame.size());
}

std::size_t PacketSocket::receive(std::span<std::uint8_t> to) noexcept {
  std::uint8_t* const slot = ring_ + next_ * kSlotBytes;
  auto& header = *reinterpret_cast<tpacket2_hdr*>(slot);
  if ((header.tp_status & TP_STATUS_USER) == 0) {
    return 0;
  }
  std::atomic_thread_fence(std::memory_order_acquire);  // the kernel wrote the frame before the status
  const std::size_t size = std::min<std::size_t>(header.tp_snaplen, to.size());
  std::memcpy(to.data(), slot + header.tp_mac, size);
  std::atomic_thread_fence(std::memory_order_release);
  header.tp_status = TP_STATUS_KERNEL;
  next_ = (next_ + 1) % kSlots;
  return size;
}

bool PacketSocket::has_carrier() const noexcept {
  return (flags_of(socket_, interface_) & IFF_RUNNING) != 0;
}

bool PacketSocket::wait(std::chrono::nanoseconds at_most) noexcept {
  pollfd waiting{socket_, POLLIN, 0};
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(at_most);
  const timespec patience{static_cast<time_t>(seconds.count()), static_cast<long>((at_most - seconds).count())};
  return ppoll(&waiting, 1, &patience, nullptr) > 0;
}

}  // namespace indurop::rt
