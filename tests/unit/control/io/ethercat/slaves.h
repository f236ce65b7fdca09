// SPDX-License-Identifier: Apache-2.0
// Slaves that tests simulate: a drive with mailbox and process data, and what a master sends them one by one.

#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "control/io/ethercat/simulator/segment.h"
#include "control/io/ethercat/simulator/sii_image.h"

namespace indurop::io::ethercat {

inline constexpr std::uint16_t kDriveOutputs = 0x1100;
inline constexpr std::uint16_t kDriveInputs = 0x1180;

inline Sii drive_sii(std::uint32_t serial = 0) {
  Sii sii;
  sii.identity = {0x4D8, 0x402, 1, serial};
  sii.name = "Test drive";
  sii.order = "TD1";
  sii.mailbox = {0x1000, 64, 0x1040, 64};
  sii.protocols = kProtocolCoe;
  sii.coe_details = kCoeSdo | kCoeCompleteAccess;
  sii.fmmus = {FmmuUse::Outputs, FmmuUse::Inputs};
  sii.sync_managers = {{0x1000, 64, 0x26, 1, SyncManagerUse::MailboxOut},
                       {0x1040, 64, 0x22, 1, SyncManagerUse::MailboxIn},
                       {kDriveOutputs, 6, 0x64, 1, SyncManagerUse::Outputs},
                       {kDriveInputs, 6, 0x20, 1, SyncManagerUse::Inputs}};
  sii.outputs = {{0x1600, 2, 0, "Outputs", {{0x6040, 0, 16, 6, "Controlword"}, {0x607A, 0, 32, 4, "Target"}}}};
  sii.inputs = {{0x1A00, 3, 0, "Inputs", {{0x6041, 0, 16, 6, "Statusword"}, {0x6064, 0, 32, 4, "Position"}}}};
  return sii;
}

inline SlaveConfig drive_config(std::uint32_t serial = 0) {
  SlaveConfig config;
  config.esc.eeprom = sii_image(drive_sii(serial));
  config.objects.add_number<std::uint32_t>(0x1000, 0, 0x00020192, false);
  const char name[] =
      "A drive whose name is longer than its mailbox, so that it comes in three segments or in more than that";
  config.objects.add(0x1008, 0, {std::begin(name), std::end(name) - 1}, false);
  config.objects.add_number<std::uint8_t>(0x1018, 0, 4, false);
  config.objects.add_number<std::uint32_t>(0x1018, 1, 0x4D8, false);
  config.objects.add_number<std::uint32_t>(0x1018, 2, 0x402, false);
  config.objects.add_number<std::uint32_t>(0x1018, 3, 1, false);
  config.objects.add_number<std::uint32_t>(0x1018, 4, serial, false);
  config.objects.add_number<std::int8_t>(0x6060, 0, 0);
  config.objects.add_number<std::uint32_t>(0x6065, 0, 100);
  config.objects.add(0x2000, 0, std::vector<std::uint8_t>(150));
  return config;
}

// Copies outputs to inputs, so that what arrives can be seen.
inline void reflect(Bytes outputs, std::span<std::uint8_t> inputs) {
  std::copy_n(outputs.begin(), std::min(outputs.size(), inputs.size()), inputs.begin());
}

// Sends datagrams one by one, each a microsecond after the other.
class Prober {
 public:
  explicit Prober(Segment& segment) : segment_(segment) {}

  // Returns the working counter; 0xFFFF: nothing came back.
  std::uint16_t send(Command command, std::uint32_t address, std::vector<std::uint8_t>& data) {
    FrameBuilder builder({2, 0, 0, 0, 0, 1});
    builder.add(command, 0, address, Bytes(data));
    const Bytes sent = builder.finish();
    std::vector<std::uint8_t> frame(sent.begin(), sent.end());
    now_ += Time(1000);
    const auto back = segment_.process(frame, now_);
    segment_.compute();
    if (!back) {
      return 0xFFFF;
    }
    FrameReader reader(frame);
    Datagram datagram;
    EXPECT_TRUE(reader.next(datagram));
    address_ = datagram.address;
    const Bytes answer = datagram.data(frame);
    data.assign(answer.begin(), answer.end());
    return datagram.wkc;
  }
  template <class T>
  T read(Command command, std::uint32_t address, std::uint16_t expected_wkc = 1) {
    std::vector<std::uint8_t> data(sizeof(T));
    EXPECT_EQ(send(command, address, data), expected_wkc);
    return load<T>(data, 0);
  }
  template <class T>
  std::uint16_t write(Command command, std::uint32_t address, T value) {
    std::vector<std::uint8_t> data(sizeof(T));
    store<T>(data, 0, value);
    return send(command, address, data);
  }
  void wait(Time time) { now_ += time; }
  [[nodiscard]] Time now() const { return now_; }
  [[nodiscard]] std::uint32_t address() const { return address_; }

 private:
  Segment& segment_;
  Time now_{0};
  std::uint32_t address_ = 0;
};

}  // namespace indurop::io::ethercat
