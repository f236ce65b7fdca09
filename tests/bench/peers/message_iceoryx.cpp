// SPDX-License-Identifier: Apache-2.0
// iceoryx posh: a publisher and a subscriber. iox-roudi has to run.
#include <array>
#include <cstdint>
#include <iceoryx_posh/popo/publisher.hpp>
#include <iceoryx_posh/popo/subscriber.hpp>
#include <iceoryx_posh/runtime/posh_runtime.hpp>
#include <string>

#include "measure.h"

namespace {

template <std::size_t kBytes>
void exchange() {
  using Message = std::array<std::uint8_t, kBytes>;
  const iox::capro::ServiceDescription service(
      "peers", "message", iox::capro::IdString_t(iox::cxx::TruncateToCapacity, std::to_string(kBytes).c_str()));
  iox::popo::Publisher<Message> publisher(service);
  iox::popo::Subscriber<Message> subscriber(service);
  while (subscriber.getSubscriptionState() != iox::SubscribeState::SUBSCRIBED) {
  }
  Message message{};
  std::uint8_t count = 0;
  peers::measure(kBytes, [&] {
    message[0] = ++count;
    publisher.publishCopyOf(message).or_else([](auto&) {});
    Message got{};
    subscriber.take().and_then([&](auto& sample) { got = *sample; });
    return got[0] == count;
  });
}

}  // namespace

int main() {
  iox::runtime::PoshRuntime::initRuntime("peers_message");
  exchange<64>();
  exchange<256>();
  exchange<4096>();
  return 0;
}
