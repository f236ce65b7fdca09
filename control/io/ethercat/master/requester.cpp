// SPDX-License-Identifier: Apache-2.0
#include "control/io/ethercat/master/requester.h"

#include <array>
#include <utility>

namespace indurop::io::ethercat {

namespace {

constexpr Clock kFramePatience = std::chrono::milliseconds(50);
constexpr int kTries = 3;

}  // namespace

std::optional<Requester::Answer> Requester::request(Command command, std::uint32_t address, Bytes data) {
  std::array<std::uint8_t, kMaxFrame> buffer{};
  for (int i = 0; i < kTries; ++i) {
    ++index_;
    builder_.clear();
    builder_.add(command, index_, address, data);
    link_.send(builder_.finish());
    const Clock deadline = wait_() + kFramePatience;
    for (Clock now{0}; now < deadline; now = wait_()) {
      while (const std::size_t size = link_.receive(buffer)) {
        const Bytes frame = Bytes(buffer).first(size);
        FrameReader reader(frame);
        Datagram datagram;
        if (reader.next(datagram) && datagram.index == index_ && datagram.command == command &&
            datagram.length == data.size()) {
          const Bytes found = datagram.data(frame);
          return Answer{datagram.wkc, {found.begin(), found.end()}};
        }
      }
    }
  }
  return std::nullopt;
}

std::optional<std::vector<std::uint8_t>> Requester::read(std::size_t place, std::uint16_t offset, std::size_t length) {
  const std::vector<std::uint8_t> zeros(length);
  auto answer = request(Command::Aprd, address_of(position(place), offset), zeros);
  return answer && answer->wkc == 1 ? std::optional(std::move(answer->data)) : std::nullopt;
}

bool Requester::write(std::size_t place, std::uint16_t offset, Bytes data) {
  const auto answer = request(Command::Apwr, address_of(position(place), offset), data);
  return answer && answer->wkc == 1;
}

}  // namespace indurop::io::ethercat
