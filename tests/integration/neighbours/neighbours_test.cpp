// SPDX-License-Identifier: Apache-2.0
// Messages as an earlier release wrote them (tests/golden/neighbours/RELEASE): this release writes the same bytes, and
// reads them with the same meaning, as long as its protocol has the same number. docs/design/neighbours.md says what to
// do if this fails. INDUROP_UPDATE_GOLDEN=1 keeps the bytes of a release that was made.

#include <dds/dds.h>
#include <dds/ddsi/ddsi_serdata.h>
#include <gmock/gmock.h>
#include <indurop/idl/wire.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <tuple>
#include <vector>

#include "core/schema/topic_name.h"
#include "deploy/link/wire_words.h"
#include "deploy/words/command_words.h"
#include "network/dds/entity.h"
#include "tests/support/dds_domain.h"

namespace indurop::test {
namespace {

constexpr const char* kRelease = "0.2";
constexpr unsigned kProtocol = 6;  // of that release
constexpr const char* kOffTheNetwork =
    "<General><AllowMulticast>false</AllowMulticast><Interfaces><NetworkInterface address=\"127.0.0.1\"/></Interfaces>"
    "</General><Discovery><ParticipantIndex>none</ParticipantIndex></Discovery>";

std::string hexadecimal(const std::vector<std::uint8_t>& bytes) {
  constexpr const char* kDigits = "0123456789abcdef";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    text += kDigits[bytes[i] >> 4U];
    text += kDigits[bytes[i] & 15U];
    text += i % 16 == 15 ? "\n" : " ";
  }
  return text + "\n";
}

std::vector<std::uint8_t> bytes_of(const std::string& text) {
  std::vector<std::uint8_t> bytes;
  const char* at = text.c_str();
  for (char* end = nullptr;; at = end) {
    const unsigned long byte = std::strtoul(at, &end, 16);
    if (end == at) {
      return bytes;
    }
    bytes.push_back(static_cast<std::uint8_t>(byte));
  }
}

// A topic whose writer and reader are in this process: what goes over it can be taken as bytes, and given as bytes.
class Wire {
 public:
  explicit Wire(const dds::TypeDescriptor& type)
      : domain_(dds_create_domain(static_cast<dds_domainid_t>(dds_domain()), kOffTheNetwork)),
        participant_(dds_create_participant(static_cast<dds_domainid_t>(dds_domain()), nullptr, nullptr)),
        topic_(dds_create_topic(participant_.get(), &type, "neighbours", nullptr, nullptr)),
        reader_(dds_create_reader(participant_.get(), topic_.get(), nullptr, nullptr)),
        writer_(dds_create_writer(participant_.get(), topic_.get(), nullptr, nullptr)) {
    EXPECT_TRUE(reader_.ok() && writer_.ok());
  }
  template <class Sample>
  std::vector<std::uint8_t> written(const Sample& sample) {
    EXPECT_EQ(dds_write(writer_.get(), &sample), DDS_RETCODE_OK);
    ddsi_serdata* data = nullptr;
    dds_sample_info_t info{};
    if (dds_takecdr(reader_.get(), &data, 1, &info, DDS_ANY_STATE) != 1) {
      ADD_FAILURE() << "it did not arrive";
      return {};
    }
    std::vector<std::uint8_t> bytes(ddsi_serdata_size(data));
    ddsi_serdata_to_ser(data, 0, bytes.size(), bytes.data());
    type_ = data->type;
    ddsi_serdata_unref(data);
    return bytes;
  }
  // Gives bytes as if a neighbour had sent them, and returns what the reader makes of them. After written().
  template <class Sample, class Use>
  void read(std::vector<std::uint8_t> bytes, const Use& use) {
    ddsrt_iovec_t all{bytes.data(), bytes.size()};
    ddsi_serdata* data = ddsi_serdata_from_ser_iov(type_, SDK_DATA, 1, &all, bytes.size());
    ASSERT_NE(data, nullptr) << "these bytes are no sample of this type";
    ASSERT_EQ(dds_forwardcdr(writer_.get(), data), DDS_RETCODE_OK);
    int count = 0;
    dds::take_all<Sample>(reader_.get(), [&](const Sample& sample, const dds::SampleInfo&) {
      ++count;
      use(sample);
    });
    EXPECT_EQ(count, 1);
  }

 private:
  dds::Entity domain_;
  dds::Entity participant_;
  dds::Entity topic_;
  dds::Entity reader_;
  dds::Entity writer_;
  const ddsi_sertype* type_ = nullptr;
};

// Gives each field another value, in order.
class Different {
 public:
  void put(std::string& field) { field = "text " + std::to_string(++count_); }
  void put(std::vector<std::string>& field) { field = {std::to_string(++count_), "", std::to_string(++count_)}; }
  void put(std::vector<std::uint8_t>& field) { field = {static_cast<std::uint8_t>(++count_), 0, 255}; }
  void put(bool& field) { field = true; }
  template <std::integral Number>
  void put(Number& field) {
    field = static_cast<Number>(0x0102030405060708 + ++count_);
  }
  template <class Enum>
  requires std::is_enum_v<Enum>
  void put(Enum& field) { field = static_cast<Enum>(2); }

 private:
  unsigned count_ = 100;
};

class Neighbours : public testing::Test {
 protected:
  void SetUp() override {
    if (schema::protocol() != kProtocol) {
      GTEST_SKIP() << "this release has another protocol and says so to its neighbours";
    }
  }
  // Compares with what was kept, or keeps it.
  static std::string kept(const std::string& name, const std::string& now) {
    const std::filesystem::path file = std::filesystem::path(GOLDEN_FOLDER) / kRelease / name;
    if (std::getenv("INDUROP_UPDATE_GOLDEN") != nullptr) {
      std::ofstream(file) << now;
    }
    std::ifstream from(file);
    return {std::istreambuf_iterator<char>(from), {}};
  }
  template <class Word>
  static void expect_kept(const std::string& name, const dds::TypeDescriptor& type) {
    Word word;
    Different values;
    const auto fill = [&](const auto&... pair) { (values.put(word.*pair.word), ...); };
    std::apply(fill, deploy::wire::Wire<Word>::kFields);
    const deploy::wire::Lent lent(word);
    Wire wire(type);
    const std::string now = hexadecimal(wire.written(lent.sample()));
    const std::string before = kept(name, now);
    EXPECT_EQ(now, before) << name << ": neighbours of release " << kRelease << " do not understand it";
    wire.read<typename deploy::wire::Wire<Word>::Sample>(bytes_of(before), [&](const auto& sample) {
      const Word read = deploy::wire::word_of<Word>(sample);
      const auto compare = [](const auto& a, const auto& b) { EXPECT_TRUE(a == b); };
      std::apply([&](const auto&... pair) { (compare(read.*pair.word, word.*pair.word), ...); },
                 deploy::wire::Wire<Word>::kFields);
    });
  }
};

TEST_F(Neighbours, Understand_reports_of_boards) {
  expect_kept<deploy::BoardReport>("board_report.hex", indurop_deploy_BoardReport_desc);
}

TEST_F(Neighbours, Understand_orders) {
  expect_kept<deploy::Order>("order.hex", indurop_deploy_Order_desc);
}

TEST_F(Neighbours, Understand_requests_and_pieces_of_files) {
  expect_kept<deploy::BlobRequest>("request.hex", indurop_deploy_Request_desc);
  expect_kept<deploy::BlobChunk>("chunk.hex", indurop_deploy_Chunk_desc);
}

TEST_F(Neighbours, Understand_commands_and_replies) {
  expect_kept<deploy::Command>("command.hex", indurop_deploy_Command_desc);
  expect_kept<deploy::CommandReply>("reply.hex", indurop_deploy_Reply_desc);
}

TEST_F(Neighbours, Understand_beacons_between_boards) {
  std::string name = "drive";
  indurop_wire_Heard heard{name.data(), -5};
  indurop_wire_Beacon beacon{};
  beacon.board = name.data();
  beacon.session = 0x1122334455667788;
  beacon.source_time_ns = 2;
  beacon.epoch_ns = 3;
  beacon.basic_period_ns = 4;
  beacon.macro_period_ns = 5;
  beacon.synchronised = true;
  beacon.heard._buffer = &heard;
  beacon.heard._length = beacon.heard._maximum = 1;
  Wire wire(indurop_wire_Beacon_desc);
  const std::string now = hexadecimal(wire.written(beacon));
  const std::string before = kept("beacon.hex", now);
  EXPECT_EQ(now, before);
  wire.read<indurop_wire_Beacon>(bytes_of(before), [&](const indurop_wire_Beacon& sample) {
    EXPECT_STREQ(sample.board, "drive");
    EXPECT_EQ(sample.session, beacon.session);
    EXPECT_EQ(sample.macro_period_ns, 5);
    ASSERT_EQ(sample.heard._length, 1U);
    EXPECT_EQ(sample.heard._buffer[0].delay_ns, -5);
  });
}

TEST_F(Neighbours, Understand_frames_between_boards) {
  std::vector<std::uint8_t> data{1, 2, 3};
  indurop_wire_Frame frame{};
  frame.part = 1;
  frame.layout = 2;
  frame.session = 3;
  frame.update = 4;
  frame.update_sum = 5;
  frame.tick = 6;
  frame.source_time_ns = -7;
  frame.data._buffer = data.data();
  frame.data._length = frame.data._maximum = 3;
  Wire wire(indurop_wire_Frame_desc);
  const std::string now = hexadecimal(wire.written(frame));
  const std::string before = kept("frame.hex", now);
  EXPECT_EQ(now, before);
  wire.read<indurop_wire_Frame>(bytes_of(before), [&](const indurop_wire_Frame& sample) {
    EXPECT_EQ(sample.source_time_ns, -7);
    EXPECT_EQ(sample.data._length, 3U);
  });
}

TEST_F(Neighbours, Verify_the_same_signed_texts) {
  deploy::Order order;
  order.plant = "cell";
  order.deployment = "abc";
  order.generation = 7;
  order.deployer = 8;
  order.size = 9;
  order.step = deploy::Step::Switch;
  order.said_at_ns = 10;
  order.switch_at_ns = 11;
  order.health_ns = 12;
  order.boards = {"a", "b"};
  deploy::Command command;
  command.plant = "cell";
  command.board = "a";
  command.agent = 13;
  command.action = deploy::Action::Set;
  command.target = "0 {}\nx=1";
  command.commander = 14;
  command.nonce = 15;
  const std::string now = deploy::grant_text("cell", "abc", 7) + order_text(order) + command_text(command);
  EXPECT_EQ(now, kept("signed.txt", now));
}

}  // namespace
}  // namespace indurop::test
