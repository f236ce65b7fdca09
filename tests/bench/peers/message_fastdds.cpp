// SPDX-License-Identifier: Apache-2.0
// Fast DDS: a reliable writer and a reader in one participant, which hands messages over within the process. The type
// is bytes that are copied, so nothing is spent on a wire format.
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/TopicDataType.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>
#include <functional>
#include <string>

#include "measure.h"

namespace {

namespace fast = eprosima::fastdds::dds;
using eprosima::fastrtps::rtps::InstanceHandle_t;
using eprosima::fastrtps::rtps::SerializedPayload_t;

template <std::size_t kBytes>
class Type : public fast::TopicDataType {
 public:
  using Message = std::array<std::uint8_t, kBytes>;
  Type() {
    setName(("Bytes" + std::to_string(kBytes)).c_str());
    m_typeSize = kBytes;
    m_isGetKeyDefined = false;
  }
  bool serialize(void* data, SerializedPayload_t* payload) override {
    std::memcpy(payload->data, data, kBytes);
    payload->length = kBytes;
    return true;
  }
  bool deserialize(SerializedPayload_t* payload, void* data) override {
    std::memcpy(data, payload->data, kBytes);
    return true;
  }
  std::function<std::uint32_t()> getSerializedSizeProvider(void* /*data*/) override {
    return [] { return static_cast<std::uint32_t>(kBytes); };
  }
  void* createData() override { return new Message{}; }
  void deleteData(void* data) override { delete static_cast<Message*>(data); }
  bool getKey(void* /*data*/, InstanceHandle_t* /*handle*/, bool /*force_md5*/) override { return false; }
};

template <std::size_t kBytes>
bool exchange(fast::DomainParticipant& participant) {
  const fast::TypeSupport type(new Type<kBytes>());
  type.register_type(&participant);
  fast::Topic* topic =
      participant.create_topic("peers_" + std::to_string(kBytes), type.get_type_name(), fast::TOPIC_QOS_DEFAULT);
  fast::DataReaderQos reading = fast::DATAREADER_QOS_DEFAULT;
  reading.reliability().kind = fast::RELIABLE_RELIABILITY_QOS;
  fast::DataReader* reader =
      participant.create_subscriber(fast::SUBSCRIBER_QOS_DEFAULT)->create_datareader(topic, reading);
  fast::DataWriter* writer =
      participant.create_publisher(fast::PUBLISHER_QOS_DEFAULT)->create_datawriter(topic, fast::DATAWRITER_QOS_DEFAULT);
  typename Type<kBytes>::Message message{};
  typename Type<kBytes>::Message got{};
  fast::SampleInfo info;
  std::uint8_t count = 0;
  // The two have to find each other first.
  while (reader->take_next_sample(&got, &info) != ReturnCode_t::RETCODE_OK) {
    writer->write(&message);
  }
  while (reader->take_next_sample(&got, &info) == ReturnCode_t::RETCODE_OK) {
  }
  peers::measure(kBytes, [&] {
    message[0] = ++count;
    return writer->write(&message) && reader->take_next_sample(&got, &info) == ReturnCode_t::RETCODE_OK &&
           got[0] == count;
  });
  return true;
}

}  // namespace

int main() {
  fast::DomainParticipant* participant =
      fast::DomainParticipantFactory::get_instance()->create_participant(0, fast::PARTICIPANT_QOS_DEFAULT);
  return participant != nullptr && exchange<64>(*participant) && exchange<256>(*participant) &&
                 exchange<4096>(*participant)
             ? 0
             : 1;
}
