// SPDX-License-Identifier: Apache-2.0
#include "control/io/ecsim/drive.h"

#include <algorithm>
#include <string_view>

#include "control/io/ethercat/simulator/sii_image.h"

namespace indurop::io::ecsim {

namespace {

using ethercat::Bytes;
using ethercat::PdoEntry;

// Vendor numbers are given to makers of devices, and this is none.
constexpr ethercat::Identity kIdentity{0, 0x49525001, 1, 0};
constexpr std::string_view kName = "InduRoP simulated drive";
constexpr std::uint16_t kMailboxBytes = 128;
constexpr std::uint16_t kOutputsAt = 0x1100;
constexpr std::uint16_t kInputsAt = 0x1180;
constexpr std::uint16_t kRxPdo = 0x1600;
constexpr std::uint16_t kTxPdo = 0x1A00;
constexpr std::uint16_t kAssignments = 0x1C10;
// After a pause of the bus the axis continues from here; it is not computed for all of it.
constexpr ethercat::Time kMaxStep = std::chrono::milliseconds(20);

// Types of objects, as CoE numbers them.
constexpr std::uint8_t kInt8 = 2;
constexpr std::uint8_t kInt16 = 3;
constexpr std::uint8_t kInt32 = 4;
constexpr std::uint8_t kUint16 = 6;
constexpr std::uint8_t kUint32 = 7;

const std::vector<PdoEntry>& outputs_of_drive() {
  static const std::vector<PdoEntry> entries = {
      {0x6040, 0, 16, kUint16, "Controlword"},         {0x6060, 0, 8, kInt8, "Modes of operation"},
      {0x607A, 0, 32, kInt32, "Target position"},      {0x60FF, 0, 32, kInt32, "Target velocity"},
      {0x6071, 0, 16, kInt16, "Target torque"},        {0x60B0, 0, 32, kInt32, "Position offset"},
      {0x60B1, 0, 32, kInt32, "Velocity offset"},      {0x60B2, 0, 16, kInt16, "Torque offset"},
      {0x60B8, 0, 16, kUint16, "Touch probe function"}};
  return entries;
}

const std::vector<PdoEntry>& inputs_of_drive() {
  static const std::vector<PdoEntry> entries = {{0x603F, 0, 16, kUint16, "Error code"},
                                                {0x6041, 0, 16, kUint16, "Statusword"},
                                                {0x6061, 0, 8, kInt8, "Modes of operation"},
                                                {0x6064, 0, 32, kInt32, "Position actual value"},
                                                {0x606C, 0, 32, kInt32, "Velocity actual value"},
                                                {0x6077, 0, 16, kInt16, "Torque actual value"},
                                                {0x60F4, 0, 32, kInt32, "Following error"},
                                                {0x60FD, 0, 32, kUint32, "Digital inputs"},
                                                {0x60B9, 0, 16, kUint16, "Touch probe status"},
                                                {0x60BA, 0, 32, kInt32, "Touch probe 1 positive edge"},
                                                {0x60BB, 0, 32, kInt32, "Touch probe 1 negative edge"}};
  return entries;
}

std::uint16_t bytes_of(const std::vector<PdoEntry>& entries) {
  unsigned bits = 0;
  for (const PdoEntry& entry : entries) {
    bits += entry.bits;
  }
  return static_cast<std::uint16_t>(bits / 8);
}

ethercat::Sii sii_of_drive() {
  using namespace ethercat;
  Sii sii;
  sii.identity = kIdentity;
  sii.name = kName;
  sii.order = "ECSIM-DRIVE";
  sii.mailbox = {0x1000, kMailboxBytes, 0x1080, kMailboxBytes};
  sii.protocols = kProtocolCoe;
  sii.coe_details = kCoeSdo | kCoeCompleteAccess;
  sii.fmmus = {FmmuUse::Outputs, FmmuUse::Inputs};
  sii.sync_managers = {{0x1000, kMailboxBytes, 0x26, 1, SyncManagerUse::MailboxOut},
                       {0x1080, kMailboxBytes, 0x22, 1, SyncManagerUse::MailboxIn},
                       {kOutputsAt, bytes_of(outputs_of_drive()), 0x64, 1, SyncManagerUse::Outputs},
                       {kInputsAt, bytes_of(inputs_of_drive()), 0x20, 1, SyncManagerUse::Inputs}};
  sii.outputs = {{kRxPdo, 2, 0, "Outputs", outputs_of_drive()}};
  sii.inputs = {{kTxPdo, 3, 0, "Inputs", inputs_of_drive()}};
  return sii;
}

void add_mapping(ethercat::ObjectDictionary& objects, std::uint16_t manager, std::uint16_t pdo,
                 const std::vector<PdoEntry>& entries) {
  objects.add_number<std::uint8_t>(pdo, 0, static_cast<std::uint8_t>(entries.size()));
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const auto& entry = entries[i];
    objects.add_number<std::uint32_t>(
        pdo, static_cast<std::uint8_t>(i + 1),
        static_cast<std::uint32_t>(entry.index) << 16U | static_cast<std::uint32_t>(entry.subindex) << 8U | entry.bits);
  }
  objects.add_number<std::uint8_t>(kAssignments + manager, 0, 1);
  objects.add_number<std::uint16_t>(kAssignments + manager, 1, pdo);
}

// Numbers one after the other, as the mapping has them.
class Reader {
 public:
  explicit Reader(Bytes bytes) : bytes_(bytes) {}
  template <class T>
  void next(T& into) {
    into = ethercat::load<T>(bytes_, at_);
    at_ += sizeof(T);
  }

 private:
  Bytes bytes_;
  std::size_t at_ = 0;
};

class Writer {
 public:
  explicit Writer(std::span<std::uint8_t> bytes) : bytes_(bytes) {}
  template <class T>
  void next(T value) {
    ethercat::store<T>(bytes_, at_, value);
    at_ += sizeof(T);
  }

 private:
  std::span<std::uint8_t> bytes_;
  std::size_t at_ = 0;
};

DriveCommand command_of(Bytes outputs) {
  DriveCommand command;
  Reader from(outputs);
  from.next(command.control);
  from.next(command.mode);
  from.next(command.position);
  from.next(command.velocity);
  from.next(command.torque);
  from.next(command.position_offset);
  from.next(command.velocity_offset);
  from.next(command.torque_offset);
  from.next(command.probe);
  return command;
}

void write(const DriveFeedback& feedback, std::span<std::uint8_t> inputs) {
  Writer to(inputs);
  to.next(feedback.error);
  to.next(feedback.status);
  to.next(feedback.mode);
  to.next(feedback.position);
  to.next(feedback.velocity);
  to.next(feedback.torque);
  to.next(feedback.following);
  to.next(feedback.inputs);
  to.next(feedback.probe);
  to.next(feedback.probe_rise);
  to.next(feedback.probe_fall);
}

}  // namespace

ethercat::SlaveConfig Drive::slave() {
  ethercat::SlaveConfig config;
  config.esc.eeprom = ethercat::sii_image(sii_of_drive());
  auto& objects = config.objects;
  objects.add_number<std::uint32_t>(0x1000, 0, 0x00020192, false);  // servo drive, profile 402
  objects.add(0x1008, 0, {kName.begin(), kName.end()}, false);
  objects.add_number<std::uint8_t>(0x1018, 0, 4, false);
  objects.add_number<std::uint32_t>(0x1018, 1, kIdentity.vendor, false);
  objects.add_number<std::uint32_t>(0x1018, 2, kIdentity.product, false);
  objects.add_number<std::uint32_t>(0x1018, 3, kIdentity.revision, false);
  objects.add_number<std::uint32_t>(0x1018, 4, kIdentity.serial, false);
  add_mapping(objects, 2, kRxPdo, outputs_of_drive());
  add_mapping(objects, 3, kTxPdo, inputs_of_drive());
  return config;
}

void Drive::compute(Bytes outputs, std::span<std::uint8_t> inputs, ethercat::Time now) {
  const auto elapsed = std::min(now - last_, kMaxStep);
  last_ = now;
  const bool operates = outputs.size() == bytes_of(outputs_of_drive());
  const DriveFeedback feedback = drive_.step(operates ? command_of(outputs) : DriveCommand(), elapsed);
  if (inputs.size() == bytes_of(inputs_of_drive())) {
    write(feedback, inputs);
  }
}

}  // namespace indurop::io::ecsim
