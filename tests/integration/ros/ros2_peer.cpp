// SPDX-License-Identifier: Apache-2.0
// A participant of Fast DDS that tests drive line by line: raw bytes to and from topics of any type, and what it has
// discovered. Nothing of InduRoP. ros2_peer DOMAIN, then on stdin
//   reader TOPIC TYPE MARK     a reader, reliable; MARK is its USER_DATA; "-": none
//   late TOPIC TYPE MARK       the same, also for what was written before
//   writer TOPIC TYPE MARK     a writer, reliable
//   write TOPIC HEX            the bytes of a sample, with the header of CDR
// and on stdout
//   sample TOPIC HEX
//   matched TOPIC COUNT
//   endpoint reader|writer TOPIC TYPE MARK
//   participant MARK
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/domain/DomainParticipantListener.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/DataWriterListener.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/Topic.hpp>
#include <fastdds/dds/topic/TopicDataType.hpp>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <map>
#include <memory>
#include <mutex>
#include <sstream>
#include <string>
#include <vector>

#if __has_include(<fastdds/rtps/transport/UDPv4TransportDescriptor.hpp>)
#define FAST_DDS_3
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.hpp>
#else
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#endif

namespace {

namespace fast = eprosima::fastdds::dds;
#ifdef FAST_DDS_3
namespace rtps = eprosima::fastdds::rtps;
constexpr auto kOk = fast::RETCODE_OK;
#else
namespace rtps = eprosima::fastrtps::rtps;
constexpr auto kOk = ReturnCode_t::RETCODE_OK;
#endif
using Bytes = std::vector<std::uint8_t>;

void say(const std::string& line) {
  static std::mutex one_at_a_time;
  const std::lock_guard<std::mutex> guard(one_at_a_time);
  std::cout << line << std::endl;
}

std::string hex_of(const Bytes& bytes) {
  std::string text;
  char digits[3] = "";
  for (const std::uint8_t byte : bytes) {
    std::snprintf(digits, sizeof digits, "%02x", byte);
    text += digits;
  }
  return text;
}

Bytes bytes_of(const std::string& hex) {
  Bytes bytes;
  for (std::size_t i = 0; i + 1 < hex.size(); i += 2) {
    bytes.push_back(static_cast<std::uint8_t>(std::strtoul(hex.substr(i, 2).c_str(), nullptr, 16)));
  }
  return bytes;
}

std::string mark_of(const std::vector<std::uint8_t>& data) {
  return data.empty() ? "-" : std::string(data.begin(), data.end());
}

// A type of which only the name is known.
#ifdef FAST_DDS_3
class RawType : public fast::TopicDataType {
 public:
  explicit RawType(const std::string& name) {
    constexpr std::uint32_t kMost = 1U << 20U;
    set_name(name);
    max_serialized_type_size = kMost;
    is_compute_key_provided = false;
  }
  bool serialize(const void* data, rtps::SerializedPayload_t& payload, fast::DataRepresentationId_t /*form*/) override {
    const Bytes& bytes = *static_cast<const Bytes*>(data);
    payload.length = static_cast<std::uint32_t>(bytes.size());
    std::copy(bytes.begin(), bytes.end(), payload.data);
    return true;
  }
  bool deserialize(rtps::SerializedPayload_t& payload, void* data) override {
    static_cast<Bytes*>(data)->assign(payload.data, payload.data + payload.length);
    return true;
  }
  std::uint32_t calculate_serialized_size(const void* data, fast::DataRepresentationId_t /*form*/) override {
    return static_cast<std::uint32_t>(static_cast<const Bytes*>(data)->size());
  }
  void* create_data() override { return new Bytes; }
  void delete_data(void* data) override { delete static_cast<Bytes*>(data); }
  bool compute_key(rtps::SerializedPayload_t& /*payload*/, rtps::InstanceHandle_t& /*key*/, bool /*force*/) override {
    return false;
  }
  bool compute_key(const void* /*data*/, rtps::InstanceHandle_t& /*key*/, bool /*force*/) override { return false; }
};

class Discoveries : public fast::DomainParticipantListener {
 public:
  void on_participant_discovery(fast::DomainParticipant* /*own*/, rtps::ParticipantDiscoveryStatus status,
                                const fast::ParticipantBuiltinTopicData& found, bool& /*ignore*/) override {
    if (status == rtps::ParticipantDiscoveryStatus::DISCOVERED_PARTICIPANT) {
      say("participant " + mark_of(found.user_data.data_vec()));
    }
  }
  void on_data_reader_discovery(fast::DomainParticipant* /*own*/, rtps::ReaderDiscoveryStatus status,
                                const fast::SubscriptionBuiltinTopicData& found, bool& /*ignore*/) override {
    if (status == rtps::ReaderDiscoveryStatus::DISCOVERED_READER) {
      say("endpoint reader " + found.topic_name.to_string() + " " + found.type_name.to_string() + " " +
          mark_of(found.user_data.data_vec()));
    }
  }
  void on_data_writer_discovery(fast::DomainParticipant* /*own*/, rtps::WriterDiscoveryStatus status,
                                const fast::PublicationBuiltinTopicData& found, bool& /*ignore*/) override {
    if (status == rtps::WriterDiscoveryStatus::DISCOVERED_WRITER) {
      say("endpoint writer " + found.topic_name.to_string() + " " + found.type_name.to_string() + " " +
          mark_of(found.user_data.data_vec()));
    }
  }
};
#else
class RawType : public fast::TopicDataType {
 public:
  explicit RawType(const std::string& name) {
    constexpr std::uint32_t kMost = 1U << 20U;
    setName(name.c_str());
    m_typeSize = kMost;
    m_isGetKeyDefined = false;
  }
  bool serialize(void* data, rtps::SerializedPayload_t* payload) override {
    const Bytes& bytes = *static_cast<Bytes*>(data);
    payload->length = static_cast<std::uint32_t>(bytes.size());
    std::copy(bytes.begin(), bytes.end(), payload->data);
    return true;
  }
  bool deserialize(rtps::SerializedPayload_t* payload, void* data) override {
    static_cast<Bytes*>(data)->assign(payload->data, payload->data + payload->length);
    return true;
  }
  std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override {
    const auto size = static_cast<std::uint32_t>(static_cast<Bytes*>(data)->size());
    return [size] { return size; };
  }
  void* createData() override { return new Bytes; }
  void deleteData(void* data) override { delete static_cast<Bytes*>(data); }
  bool getKey(void* /*data*/, rtps::InstanceHandle_t* /*key*/, bool /*force*/) override { return false; }
};

class Discoveries : public fast::DomainParticipantListener {
 public:
  void on_participant_discovery(fast::DomainParticipant* /*own*/, rtps::ParticipantDiscoveryInfo&& found) override {
    if (found.status == rtps::ParticipantDiscoveryInfo::DISCOVERED_PARTICIPANT) {
      say("participant " + mark_of(found.info.m_userData.dataVec()));
    }
  }
  void on_subscriber_discovery(fast::DomainParticipant* /*own*/, rtps::ReaderDiscoveryInfo&& found) override {
    if (found.status == rtps::ReaderDiscoveryInfo::DISCOVERED_READER) {
      say("endpoint reader " + found.info.topicName().to_string() + " " + found.info.typeName().to_string() + " " +
          mark_of(found.info.m_qos.m_userData.dataVec()));
    }
  }
  void on_publisher_discovery(fast::DomainParticipant* /*own*/, rtps::WriterDiscoveryInfo&& found) override {
    if (found.status == rtps::WriterDiscoveryInfo::DISCOVERED_WRITER) {
      say("endpoint writer " + found.info.topicName().to_string() + " " + found.info.typeName().to_string() + " " +
          mark_of(found.info.m_qos.m_userData.dataVec()));
    }
  }
};
#endif  // FAST_DDS_3

class Reading : public fast::DataReaderListener {
 public:
  void on_data_available(fast::DataReader* reader) override {
    Bytes bytes;
    fast::SampleInfo info;
    while (reader->take_next_sample(&bytes, &info) == kOk) {
      if (info.valid_data) {
        say("sample " + reader->get_topicdescription()->get_name() + " " + hex_of(bytes));
      }
    }
  }
  void on_subscription_matched(fast::DataReader* reader, const fast::SubscriptionMatchedStatus& status) override {
    say("matched " + reader->get_topicdescription()->get_name() + " " + std::to_string(status.current_count));
  }
};
class Writing : public fast::DataWriterListener {
 public:
  void on_publication_matched(fast::DataWriter* writer, const fast::PublicationMatchedStatus& status) override {
    say("matched " + writer->get_topic()->get_name() + " " + std::to_string(status.current_count));
  }
};

class Peer {
 public:
  explicit Peer(std::uint32_t domain) {
    auto qos = fast::PARTICIPANT_QOS_DEFAULT;
    // Loopback, without the shared memory of Fast DDS.
    auto udp = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
    udp->interfaceWhiteList.emplace_back("127.0.0.1");
    qos.transport().use_builtin_transports = false;
    qos.transport().user_transports.push_back(udp);
    participant_ = fast::DomainParticipantFactory::get_instance()->create_participant(domain, qos, &discoveries_,
                                                                                      fast::StatusMask::none());
    publisher_ = participant_->create_publisher(fast::PUBLISHER_QOS_DEFAULT);
    subscriber_ = participant_->create_subscriber(fast::SUBSCRIBER_QOS_DEFAULT);
  }
  ~Peer() {
    participant_->delete_contained_entities();
    fast::DomainParticipantFactory::get_instance()->delete_participant(participant_);
  }
  Peer(const Peer&) = delete;
  Peer& operator=(const Peer&) = delete;

  void run(const std::string& line) {
    std::istringstream words(line);
    std::string what;
    std::string topic;
    std::string type;
    std::string mark;
    words >> what >> topic >> type >> mark;
    if (what == "write") {
      Bytes bytes = bytes_of(type);
      writers_.at(topic)->write(&bytes);
    } else if (what == "writer") {
      auto qos = fast::DATAWRITER_QOS_DEFAULT;
      qos.durability().kind = fast::VOLATILE_DURABILITY_QOS;
      qos.user_data().setValue(mark == "-" ? Bytes() : Bytes(mark.begin(), mark.end()));
      writers_[topic] = publisher_->create_datawriter(topic_of(topic, type), qos, &writing_);
    } else {
      auto qos = fast::DATAREADER_QOS_DEFAULT;
      qos.reliability().kind = fast::RELIABLE_RELIABILITY_QOS;
      qos.durability().kind = what == "late" ? fast::TRANSIENT_LOCAL_DURABILITY_QOS : fast::VOLATILE_DURABILITY_QOS;
      constexpr int kDepth = 100;
      qos.history().depth = kDepth;
      qos.user_data().setValue(mark == "-" ? Bytes() : Bytes(mark.begin(), mark.end()));
      subscriber_->create_datareader(topic_of(topic, type), qos, &reading_);
    }
  }

 private:
  fast::Topic* topic_of(const std::string& name, const std::string& type) {
    fast::TypeSupport support(new RawType(type));
    support.register_type(participant_);
    return participant_->create_topic(name, type, fast::TOPIC_QOS_DEFAULT);
  }

  Discoveries discoveries_;
  Reading reading_;
  Writing writing_;
  fast::DomainParticipant* participant_ = nullptr;
  fast::Publisher* publisher_ = nullptr;
  fast::Subscriber* subscriber_ = nullptr;
  std::map<std::string, fast::DataWriter*> writers_;
};

}  // namespace

int main(int argc, char** argv) {
  Peer peer(argc > 1 ? static_cast<std::uint32_t>(std::strtoul(argv[1], nullptr, 10)) : 0);
  for (std::string line; std::getline(std::cin, line);) {
    peer.run(line);
  }
  return 0;
}
