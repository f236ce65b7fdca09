// SPDX-License-Identifier: Apache-2.0
// Simulated slaves answer what masters asked real ones in recordings, and their answers are compared with those of the
// real slaves: every working counter, and every byte that what was recorded before decides. What it does not decide is
// counted by its reason:
//   Clock      times of clocks and of the arrival of frames
//   Busy       how long a slave takes: an EEPROM that is busy, a state or a mailbox that comes later
//   Chip       how large the chip's buffers are (DL control), and a reserved bit of the EEPROM's status
//   Mailbox    bytes behind a message, reserved ones in it, and whether the processor has read the last one
//   Protocol   messages of other protocols than CoE
//   Refusal    a device that refuses a state for reasons of its own

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>

#include "control/io/ethercat/simulator/segment.h"
#include "recording.h"

namespace indurop::io::ethercat {
namespace {

enum class Reason { Clock, Busy, Chip, Mailbox, Protocol, Refusal };
constexpr std::size_t kReasons = 6;

struct Bus {
  const char* file;
  struct Device {
    Chip chip;
    const char* image;  // "": the words that were read
  };
  std::vector<Device> devices;
  bool refuses_safeop = false;  // at the end
  bool has_ethernet = false;    // its mailbox answers to EoE, nothing else
};

constexpr char kEk1100[] = "dumps/eeprom/ek1100.hex";
constexpr char kEl2828[] = "dumps/eeprom/el2828.hex";
constexpr char kEl2889[] = "dumps/eeprom/el2889.hex";
constexpr char kEl2004[] = "dumps/el2004-eeprom-dump.bin";

const std::vector<Bus>& buses() {
  static const std::vector<Bus> all = {
      {"tests/replay-dc.pcapng", {{kEt1100, kEk1100}, {kEt1200, kEl2828}, {kEt1200, kEl2889}}},
      {"tests/replay-ek1100-alias-address.pcapng", {{kEt1100, kEk1100}, {kEt1200, kEl2828}, {kEt1200, kEl2889}}},
      {"tests/replay-ek1100-el2828-el2889.pcapng", {{kEt1100, kEk1100}, {kEt1200, kEl2828}, {kEt1200, kEl2889}}},
      {"tests/replay-issue-255.pcapng", {{kEt1100, kEk1100}, {kEt1200, kEl2828}, {kEt1200, kEl2889}}},
      {"tests/replay-ek1914-el3004-configure.pcapng", {{kEt1100, ""}, {kEt1200, ""}}},
      {"tests/replay-ek1914-el3004-mailbox.pcapng", {{kEt1100, ""}, {kEt1200, ""}}},
      {"tests/replay-ek1914-no-complete-access.pcapng", {{kEt1100, ""}, {kEt1200, ""}}},
      {"tests/replay-ek1914-segmented-upload.pcapng", {{kEt1100, ""}, {kEt1200, ""}}},
      {"dumps/rs-example-sii-el2004.pcapng", {{kEt1100, kEk1100}, {kEt1200, kEl2004}, {kEt1200, kEl2004}}},
      {"dumps/soem-single-lan9252.pcapng", {{kLan9252, ""}}},
      {"dumps/soem-dual-lan9252.pcapng", {{kLan9252, ""}, {kLan9252, ""}}},
      {"dumps/soem-sdinfo-akd.pcapng", {{kAkdCore, ""}}, true},
      {"dumps/soem-sdinfo-ek1100-only.pcapng", {{kEt1100, kEk1100}}},
      {"dumps/soem-sdinfo-ek1100-el1004.pcapng", {{kEt1100, kEk1100}, {kEt1200, ""}}},
      {"dumps/twincat-scan-boxes.pcapng", {{kEt1100, kEk1100}, {kEt1200, ""}}},
      {"dumps/twincat-akd-nc-mode.pcapng", {{kAkdCore, "dumps/eeprom/akd.hex"}}, false, true},
  };
  return all;
}

std::string hex(Bytes bytes) {
  constexpr std::size_t kMost = 40;
  constexpr char kDigits[] = "0123456789abcdef";
  std::string text;
  for (const std::uint8_t byte : bytes.first(std::min(bytes.size(), kMost))) {
    text += kDigits[byte >> 4U];
    text += kDigits[byte & 0x0FU];
    text += ' ';
  }
  return text;
}

std::string hex(std::uint32_t number) {
  std::array<std::uint8_t, 4> bytes{};
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    bytes[i] = static_cast<std::uint8_t>(number >> (24U - 8U * i));
  }
  return hex(Bytes(bytes));
}

class Judge {
 public:
  Judge(const Bus& bus, const Recording& recording) : bus_(bus), recording_(recording) {}

  void compare(const Pair& real, const Pair& ours) {
    ++datagrams;
    if (bus_.has_ethernet && real.sent.command == Command::Fprd && real.offset() >= reg::kMemory) {
      count(Reason::Protocol, real.answer.size());
      return;
    }
    const bool is_state = real.offset() == reg::kAlControl && real.sent.command <= Command::Brw;
    if (real.received.wkc != ours.received.wkc) {
      // A processor that has not read the last request does not let the next one in.
      if (is_state && real.received.wkc < ours.received.wkc) {
        count(Reason::Busy, 0);
      } else {
        differ(real, ours, "working counter");
        return;
      }
    }
    if (is_state && real.sent.command != Command::Brd) {
      expect_nothing_waits();
    }
    if (is_logical(real.sent.command) || real.offset() < reg::kMemory) {
      compare_bytes(real, ours);
    } else if (real.received.wkc > 0) {
      compare_message(real, ours);
    }
  }
  void expect_nothing_waits() {
    for (const auto& [what, text] : waiting_) {
      if (bus_.refuses_safeop) {
        count(Reason::Refusal, 1);
      } else {
        ADD_FAILURE() << bus_.file << ": the real slave never came to what the simulated one shows: " << text;
      }
    }
    waiting_.clear();
  }

  std::size_t datagrams = 0;
  std::size_t same = 0;  // bytes
  std::array<std::size_t, kReasons> undecided{};
  std::size_t differences = 0;

 private:
  void count(Reason reason, std::size_t bytes) { undecided[static_cast<std::size_t>(reason)] += bytes; }

  void differ(const Pair& real, const Pair& ours, const std::string& what) {
    ++differences;
    constexpr std::size_t kMost = 12;
    if (differences <= kMost) {
      ADD_FAILURE() << bus_.file << ": datagram " << datagrams << ": " << to_string(real.sent.command) << " "
                    << hex(real.sent.address) << "(" << register_name(real.offset()) << ") [" << hex(real.request)
                    << "]: " << what << ":\n real " << real.received.wkc << " [" << hex(real.answer) << "]\n ours "
                    << ours.received.wkc << " [" << hex(ours.answer) << "]";
    }
  }

  static std::optional<Reason> undecided_register(std::size_t offset) {
    const auto within = [offset](std::size_t first, std::size_t end) { return offset >= first && offset < end; };
    if (within(reg::kReceiveTimes, reg::kSystemTimeOffset) || within(reg::kSystemTimeDifference, reg::kSpeedCounter)) {
      return Reason::Clock;
    }
    return offset == reg::kDlControl + 2U ? std::optional(Reason::Chip) : std::nullopt;
  }

  void compare_bytes(const Pair& real, const Pair& ours) {
    const bool logical = is_logical(real.sent.command);
    const std::size_t first = real.offset();
    for (std::size_t i = 0; i < real.answer.size(); ++i) {
      const std::size_t offset = first + i;
      const std::uint8_t theirs = real.answer[i];
      const std::uint8_t mine = ours.answer[i];
      if (logical) {
        judge(theirs == mine, real, ours, "process data");
      } else if (const auto reason = undecided_register(offset)) {
        count(*reason, 1);
      } else if (offset == reg::kEepromControl) {
        constexpr unsigned kReserved = 0x10;
        judge(((theirs ^ mine) & ~kReserved) == 0, real, ours, "features of the EEPROM");
      } else if (offset == reg::kAlStatus) {
        judge_later(theirs == mine, real, "state");
      } else if (offset > reg::kAlStatus && offset < reg::kAlStatus + 6U && waiting_.contains(key(real))) {
        count(Reason::Busy, 1);
      } else if (is_manager_status(offset) && real.sent.command == Command::Fprd) {
        judge_mailbox_status(theirs, mine, real, ours);
      } else if (offset == reg::kEepromControl + 1U && (theirs & (kEepromBusy | kEepromAckError) >> 8U) != 0) {
        count(Reason::Busy, 1);
      } else {
        judge(theirs == mine, real, ours, "byte " + std::to_string(i));
      }
    }
  }
  static bool is_manager_status(std::size_t offset) {
    return offset >= reg::kSyncManager && offset < reg::kSyncManager + 0x80U && offset % kSyncManagerBytes == 5;
  }
  void judge_mailbox_status(std::uint8_t theirs, std::uint8_t mine, const Pair& real, const Pair& ours) {
    constexpr unsigned kFull = 0x08;
    constexpr unsigned kDecided = 0x0B;
    judge_later((theirs & kFull) == (mine & kFull), real, "mailbox");
    if ((theirs & mine & kFull) != 0) {
      judge((theirs & kDecided) == (mine & kDecided), real, ours, "full mailbox");
    } else {
      count(Reason::Mailbox, 1);
    }
  }
  void judge(bool is_same, const Pair& real, const Pair& ours, const std::string& what) {
    if (is_same) {
      ++same;
    } else {
      differ(real, ours, what);
    }
  }

  // The simulated slaves of this test need no time, so real ones show the same later.
  using Key = std::pair<std::size_t, std::uint16_t>;
  [[nodiscard]] Key key(const Pair& pair) const { return {recording_.place_of(pair.sent), pair.offset()}; }
  void judge_later(bool is_same, const Pair& real, const std::string& what) {
    if (is_same) {
      ++same;
      waiting_.erase(key(real));
      return;
    }
    count(Reason::Busy, 1);
    waiting_[key(real)] = "datagram " + std::to_string(datagrams) + ": " + what + " of " + hex(real.sent.address) +
                          ": " + hex(real.answer);
  }

  void compare_message(const Pair& real, const Pair& ours) {
    const auto theirs = read_mailbox(real.answer);
    if (real.answer.size() < kCoeHeader || !theirs) {
      judge(std::equal(real.answer.begin(), real.answer.end(), ours.answer.begin()), real, ours, "part of a mailbox");
      return;
    }
    if (theirs->type != MailboxType::Coe) {
      count(Reason::Protocol, real.answer.size());
      return;
    }
    std::size_t size = kMailboxHeader + theirs->data.size();
    const bool is_download =
        service_of(*theirs) == CoeService::SdoResponse && (theirs->data[2] & kSdoCommandMask) == kSdoDownloaded;
    size = is_download ? size - 4 : size;  // no data
    const Bytes mine = ours.answer;
    if (std::equal(real.answer.begin(), real.answer.begin() + static_cast<std::ptrdiff_t>(size), mine.begin())) {
      same += size;
    } else {
      differ(real, ours, "message");
    }
    count(Reason::Mailbox, real.answer.size() - size);
  }

  const Bus& bus_;
  const Recording& recording_;
  std::map<Key, std::string> waiting_;
};

struct Sum {
  std::size_t datagrams = 0;
  std::size_t bytes = 0;  // that are the same
};

void replay(const Bus& bus, Sum& sum) {
  std::vector<Chip> chips;
  for (const auto& device : bus.devices) {
    chips.push_back(device.chip);
  }
  const Recording recording(exchanges_of(real_data() / bus.file), chips);
  Segment segment;
  for (std::size_t i = 0; i < bus.devices.size(); ++i) {
    const std::string image = bus.devices[i].image;
    segment.add(recording.slave(i, image.empty() ? std::vector<std::uint8_t>() : bytes_of_file(real_data() / image)));
  }
  Judge judge(bus, recording);
  for (const Exchange& exchange : recording.exchanges()) {
    Exchange ours = exchange;
    ours.received = exchange.sent;
    ASSERT_TRUE(segment.process(ours.received, exchange.at));
    segment.compute();
    std::vector<Pair> mine;
    for_each_datagram(ours, [&mine](const Pair& pair) { mine.push_back(pair); });
    std::size_t at = 0;
    for_each_datagram(exchange, [&](const Pair& real) { judge.compare(real, mine[at++]); });
  }
  judge.expect_nothing_waits();
  EXPECT_EQ(judge.differences, 0U) << bus.file;
  sum.datagrams += judge.datagrams;
  sum.bytes += judge.same;
  for (std::size_t i = 0; i < kReasons; ++i) {
    testing::Test::RecordProperty(bus.file + (", reason " + std::to_string(i)), std::to_string(judge.undecided[i]));
  }
}

TEST(Replay, Simulated_slaves_answer_as_the_real_ones_did) {
  INDUROP_NEEDS_REAL_DATA();
  Sum sum;
  for (const Bus& bus : buses()) {
    replay(bus, sum);
  }
  EXPECT_GE(sum.datagrams, 25'000U);
  EXPECT_GE(sum.bytes, 55'000U);
}

}  // namespace
}  // namespace indurop::io::ethercat
