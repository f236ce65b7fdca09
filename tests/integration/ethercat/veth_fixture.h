// SPDX-License-Identifier: Apache-2.0
// A cable without hardware: a veth pair in a network of the test's own, simulated drives at its end (indurop-ecsim) and
// a master at its beginning, and what tshark says of all frames.

#pragma once

#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "control/io/ethercat/link/packet_link.h"
#include "control/io/ethercat/master/mapping.h"
#include "control/io/ethercat/master/master.h"
#include "control/io/slaves/drive.h"
#include "tests/support/program.h"

namespace indurop::io::ethercat {

inline std::vector<SlavePlan> plans_of_drives(std::size_t count) {
  const auto sii = read_sii(slaves::Drive::slave().esc.eeprom);
  std::vector<SlavePlan> plans;
  std::uint32_t logical = 0x10000;
  for (std::size_t i = 0; i < count; ++i) {
    plans.push_back(plan_of(*sii, logical));
    logical += static_cast<std::uint32_t>(plans.back().output_bytes + plans.back().input_bytes);
  }
  return plans;
}

// Lets time pass as frames come back, however busy the machine is: who asks for frames waits for those under way.
class PatientLink final : public Link {
 public:
  explicit PatientLink(PacketLink& link) : link_(link) {}
  bool send(Bytes frame) noexcept override {
    const bool sent = link_.send(frame);
    under_way_ += sent ? 1 : 0;
    return sent;
  }
  std::size_t receive(std::span<std::uint8_t> to) noexcept override {
    std::size_t size = link_.receive(to);
    if (size == 0 && under_way_ > 0 && link_.wait(patience_)) {
      size = link_.receive(to);
    }
    under_way_ = size == 0 ? 0 : std::max(under_way_ - 1, 0);
    return size;
  }
  void set_patience(Clock patience) noexcept { patience_ = patience; }

 private:
  PacketLink& link_;
  int under_way_ = 0;
  Clock patience_ = test::kPatience;
};

inline constexpr const char* kEnv = "/usr/bin/env";  // finds programs
inline constexpr const char* kMasterEnd = "ec0";
inline constexpr const char* kSlaveEnd = "ec1";

// Gives this process a network of its own with a cable. False if it may not.
inline bool make_cable() {
  if (!test::own_network() ||
      test::Program({kEnv, "ip", "link", "add", kMasterEnd, "type", "veth", "peer", "name", kSlaveEnd}).wait() != 0) {
    return false;
  }
  for (const char* const end : {"lo", kMasterEnd, kSlaveEnd}) {
    EXPECT_EQ(test::Program({kEnv, "ip", "link", "set", end, "up"}).wait(), 0);
  }
  return true;
}

// A second cable in that network, ec2 to ec3, for the way back of a ring.
inline bool make_way_back() {
  bool good = test::Program({kEnv, "ip", "link", "add", "ec2", "type", "veth", "peer", "name", "ec3"}).wait() == 0;
  for (const char* const end : {"ec2", "ec3"}) {
    good = good && test::Program({kEnv, "ip", "link", "set", end, "up"}).wait() == 0;
  }
  return good;
}

// These slaves at the end of the cable, with these options. Faults are lines of input.
inline std::unique_ptr<test::Program> start_slaves(const std::vector<std::string>& slaves, const std::string& pcap,
                                                   const std::vector<std::string>& options = {}) {
  std::vector<std::string> command = {ECSIM_PROGRAM, kSlaveEnd};
  command.insert(command.end(), slaves.begin(), slaves.end());
  command.insert(command.end(), options.begin(), options.end());
  command.insert(command.end(), {"--pcap", pcap, "--script", "-"});
  auto started = std::make_unique<test::Program>(command);
  EXPECT_TRUE(started->prints("slaves at")) << started->err();
  return started;
}
inline std::unique_ptr<test::Program> start_drives(std::size_t drives, const std::string& pcap,
                                                   const std::vector<std::string>& options = {}) {
  return start_slaves(std::vector<std::string>(drives, "drive"), pcap, options);
}

class VethTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!make_cable()) {
      GTEST_SKIP() << "no right to a network with a veth pair of its own";
    }
    folder_ = std::filesystem::temp_directory_path() / ("indurop_veth_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override {
    slaves_.reset();
    if (!folder_.empty()) {
      std::filesystem::remove_all(folder_);
    }
  }

  void simulate(std::size_t drives) { slaves_ = start_drives(drives, pcap()); }
  // Ends them; the frames are in the file then.
  void end_simulation() {
    slaves_->signal(SIGTERM);
    EXPECT_EQ(slaves_->wait(), 0) << slaves_->err();
  }
  [[nodiscard]] std::string pcap() const { return (folder_ / "frames.pcap").string(); }

  // One line for each frame that fits the filter, with these fields.
  [[nodiscard]] std::vector<std::string> tshark(const std::string& filter,
                                                const std::vector<std::string>& fields) const {
    std::vector<std::string> command = {kEnv, "tshark", "-r", pcap(), "-Y", filter, "-T", "fields"};
    for (const std::string& field : fields) {
      command.insert(command.end(), {"-e", field});
    }
    const test::Outcome outcome = test::Program(command).finish();
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    std::vector<std::string> lines;
    std::istringstream text(outcome.out);
    for (std::string line; std::getline(text, line);) {
      lines.push_back(line);
    }
    return lines;
  }
  static bool has_tshark() { return test::Program({kEnv, "tshark", "--version"}).wait() == 0; }

  std::filesystem::path folder_;
  std::unique_ptr<test::Program> slaves_;
};

}  // namespace indurop::io::ethercat
