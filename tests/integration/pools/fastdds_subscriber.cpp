// SPDX-License-Identifier: Apache-2.0
// As subscriber.c, with Fast DDS and the types that fastddsgen made of pool.idl.
//   fastdds_subscriber DOMAIN TOPIC COUNT
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/Topic.hpp>

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <vector>

#if __has_include("poolPubSubTypes.hpp")  // of fastddsgen 4, for Fast DDS 3
#include "poolPubSubTypes.hpp"
constexpr auto kOk = eprosima::fastdds::dds::RETCODE_OK;
#else
#include "poolPubSubTypes.h"
constexpr auto kOk = ReturnCode_t::RETCODE_OK;
#endif

namespace {

namespace fast = eprosima::fastdds::dds;
using indurop::pool::Part;

struct Chunk {
  std::uint64_t session = 0;
  std::uint64_t number = 0;
  std::uint64_t received = 0;
  std::vector<std::uint8_t> bytes{};
};

// Returns true if the part makes the chunk whole.
bool add(Chunk& chunk, const Part& part) {
  if (part.session() != chunk.session || part.number() != chunk.number) {
    chunk = {part.session(), part.number(), 0, std::vector<std::uint8_t>(part.size())};
  }
  if (part.offset() + part.data().size() > chunk.bytes.size()) {
    return false;
  }
  std::memcpy(chunk.bytes.data() + part.offset(), part.data().data(), part.data().size());
  chunk.received += part.data().size();
  return chunk.received == chunk.bytes.size();
}

bool is_right(const Chunk& chunk) {
  std::uint64_t word = 0;
  std::memcpy(&word, chunk.bytes.data(), sizeof word);
  for (std::size_t at = sizeof word; at < chunk.bytes.size(); at += sizeof word) {
    word = word * 6364136223846793005U + 1442695040888963407U;
    if (std::memcmp(&word, chunk.bytes.data() + at, sizeof word) != 0) {
      return false;
    }
  }
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) {
    return 3;
  }
  auto* const participant = fast::DomainParticipantFactory::get_instance()->create_participant(
      static_cast<std::uint32_t>(std::strtoul(argv[1], nullptr, 10)), fast::PARTICIPANT_QOS_DEFAULT);
  if (participant == nullptr) {
    return 3;
  }
  fast::TypeSupport type(new indurop::pool::PartPubSubType);
  type.register_type(participant);
  auto* const topic = participant->create_topic(argv[2], type.get_type_name(), fast::TOPIC_QOS_DEFAULT);
  auto* const subscriber = participant->create_subscriber(fast::SUBSCRIBER_QOS_DEFAULT);
  fast::DataReaderQos qos = fast::DATAREADER_QOS_DEFAULT;
  qos.reliability().kind = fast::RELIABLE_RELIABILITY_QOS;
  qos.history().depth = 64;
  auto* const reader = subscriber->create_datareader(topic, qos);
  if (reader == nullptr) {
    return 3;
  }
  Chunk chunk;
  long whole = 0;
  long wrong = 0;
  const long wanted = std::strtol(argv[3], nullptr, 10);
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  while (whole < wanted && wrong == 0 && std::chrono::steady_clock::now() < end) {
    reader->wait_for_unread_message({0, 100'000'000});
    Part part;
    fast::SampleInfo info;
    while (reader->take_next_sample(&part, &info) == kOk) {
      if (info.valid_data && add(chunk, part)) {
        ++whole;
        wrong += is_right(chunk) ? 0 : 1;
      }
    }
  }
  std::printf("%ld whole, %ld wrong\n", whole, wrong);
  participant->delete_contained_entities();
  fast::DomainParticipantFactory::get_instance()->delete_participant(participant);
  return wrong > 0 ? 1 : whole < wanted ? 2 : 0;
}
