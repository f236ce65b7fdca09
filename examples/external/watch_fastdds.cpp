// SPDX-License-Identifier: Apache-2.0
// Prints the state of the axis, with Fast DDS and the types that fastddsgen made of station.idl: nothing of InduRoP.
//   watch_fastdds [DOMAIN [COUNT]]    default: domain 0, until Ctrl-C
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/Topic.hpp>

#include <array>
#include <cstdio>
#include <cstdlib>

#include "fastdds_participant.h"

namespace {

namespace fast = eprosima::fastdds::dds;

void print(const station::State& state) {
  constexpr std::array<const char*, 3> kModes{"holding", "moving", "arrived"};
  const auto& force = state.force();
  std::printf("cycle %llu position %.3f mm force %.2f %.2f %.2f N mode %s inside %d program '%s'\n",
              static_cast<unsigned long long>(state.cycle()), state.position(), static_cast<double>(force[0]),
              static_cast<double>(force[1]), static_cast<double>(force[2]),
              kModes.at(static_cast<std::size_t>(state.mode())), state.inside() ? 1 : 0, state.program().c_str());
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  const auto domain = static_cast<std::uint32_t>(argc > 1 ? std::strtoul(argv[1], nullptr, 10) : 0);
  long left = argc > 2 ? std::strtol(argv[2], nullptr, 10) : -1;
  auto* const participant = join(domain);
  if (participant == nullptr) {
    std::fprintf(stderr, "cannot join DDS domain %u\n", domain);
    return 1;
  }
  fast::TypeSupport type(new station::StatePubSubType);
  type.register_type(participant);
  auto* const topic = participant->create_topic("station/state", type.get_type_name(), fast::TOPIC_QOS_DEFAULT);
  auto* const subscriber = participant->create_subscriber(fast::SUBSCRIBER_QOS_DEFAULT);
  // Reliable and transient-local: the last value comes at once, even if it changed long ago.
  fast::DataReaderQos qos = fast::DATAREADER_QOS_DEFAULT;
  qos.reliability().kind = fast::RELIABLE_RELIABILITY_QOS;
  qos.durability().kind = fast::TRANSIENT_LOCAL_DURABILITY_QOS;
  auto* const reader = subscriber->create_datareader(topic, qos);
  if (reader == nullptr) {
    std::fprintf(stderr, "cannot read station/state\n");
    return 1;
  }
  while (left != 0) {
    reader->wait_for_unread_message({1, 0});
    station::State state;
    fast::SampleInfo info;
    while (left != 0 && reader->take_next_sample(&state, &info) == kOk) {
      if (info.valid_data) {
        print(state);
        left -= left > 0 ? 1 : 0;
      }
    }
    fast::SubscriptionMatchedStatus nodes;
    reader->get_subscription_matched_status(nodes);
    if (nodes.current_count_change < 0 && nodes.current_count == 0) {
      std::printf("no node publishes station/state any more\n");
      std::fflush(stdout);
    }
  }
  participant->delete_contained_entities();
  fast::DomainParticipantFactory::get_instance()->delete_participant(participant);
  return 0;
}
