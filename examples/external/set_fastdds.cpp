// SPDX-License-Identifier: Apache-2.0
// Sets the target of the axis, with Fast DDS and the types that fastddsgen made of station.idl: nothing of InduRoP.
//   set_fastdds MILLIMETRES [DOMAIN]    exit code 0: the axis said that this is its target now; 3: it has another one
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/Topic.hpp>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <thread>

#include "fastdds_participant.h"

namespace {

namespace fast = eprosima::fastdds::dds;
using namespace std::chrono_literals;

constexpr auto kPatience = 20s;
constexpr auto kUnderWay = 2s;  // a value from before may still come
constexpr auto kAgain = 200ms;

template <class Condition>
bool wait_until(Condition condition) {
  const auto end = std::chrono::steady_clock::now() + kPatience;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) {
      return false;
    }
    std::this_thread::sleep_for(5ms);
  }
  return true;
}

int set_target(fast::DomainParticipant& participant, double wanted) {
  fast::TypeSupport type(new station::target_PubSubType);
  type.register_type(&participant);
  auto* const topic = participant.create_topic("station/target", type.get_type_name(), fast::TOPIC_QOS_DEFAULT);
  auto* const writer = participant.create_publisher(fast::PUBLISHER_QOS_DEFAULT)
                           ->create_datawriter(topic, fast::DATAWRITER_QOS_DEFAULT);  // reliable
  // A program that sets a variable also receives its value afterwards: a value out of range is rejected.
  fast::DataReaderQos qos = fast::DATAREADER_QOS_DEFAULT;
  qos.reliability().kind = fast::RELIABLE_RELIABILITY_QOS;
  auto* const reader = participant.create_subscriber(fast::SUBSCRIBER_QOS_DEFAULT)->create_datareader(topic, qos);

  // A value written before the axis listens is lost.
  fast::PublicationMatchedStatus listeners;
  const bool discovered = wait_until([&] {
    writer->get_publication_matched_status(listeners);
    fast::SubscriptionMatchedStatus speakers;
    reader->get_subscription_matched_status(speakers);
    return listeners.current_count >= 2 && speakers.current_count >= 2;  // the axis, and we ourselves
  });
  if (!discovered) {
    std::fprintf(stderr, "no node reads station/target: is the node running, in this domain?\n");
    return 1;
  }
  station::target_ value;
  const auto own = writer->get_instance_handle();
  const auto began = std::chrono::steady_clock::now();
  auto next = began;
  bool reported = false;
  double now = -1;
  (void)wait_until([&] {
    // We may know the axis before it knows us, so the target is sent again until the axis reports it.
    if (const auto time = std::chrono::steady_clock::now(); time >= next) {
      value.value(wanted);
      writer->write(&value);
      next = time + kAgain;
    }
    fast::SampleInfo info;
    while (reader->take_next_sample(&value, &info) == kOk) {
      if (info.valid_data && info.publication_handle != own) {
        reported = true;
        now = value.value();
      }
    }
    return reported && (now == wanted || std::chrono::steady_clock::now() - began > kUnderWay);
  });
  if (!reported) {
    std::fprintf(stderr, "the axis does not report its target\n");
    return 1;
  }
  std::printf("target is %.3f mm\n", now);
  return now == wanted ? 0 : 3;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: set_fastdds MILLIMETRES [DOMAIN]\n");
    return 2;
  }
  const auto domain = static_cast<std::uint32_t>(argc > 2 ? std::strtoul(argv[2], nullptr, 10) : 0);
  auto* const participant = join(domain);
  if (participant == nullptr) {
    std::fprintf(stderr, "cannot join DDS domain %u\n", domain);
    return 1;
  }
  const int code = set_target(*participant, std::strtod(argv[1], nullptr));
  participant->delete_contained_entities();
  fast::DomainParticipantFactory::get_instance()->delete_participant(participant);
  return code;
}
