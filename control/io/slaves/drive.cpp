// SPDX-License-Identifier: Apache-2.0
#include "control/io/slaves/drive.h"

#include <algorithm>
#include <initializer_list>
#include <string_view>
#include <type_traits>

#include "control/io/ethercat/simulator/sii_image.h"

namespace indurop::io::slaves {

namespace {

using ethercat::Bytes;
using ethercat::ObjectDictionary;
using ethercat::Pdo;

// Vendor numbers are given to makers of devices, and this is none.
constexpr ethercat::Identity kIdentity{0, 0x49525001, 1, 0};
constexpr std::string_view kName = "InduRoP simulated drive";
constexpr std::uint16_t kMailboxBytes = 128;
constexpr std::uint16_t kOutputsAt = 0x1100;
constexpr std::uint16_t kInputsAt = 0x1180;
constexpr std::uint8_t kOutputManager = 2;
constexpr std::uint8_t kInputManager = 3;
// After a pause of the bus the axis continues from here; it is not computed for all of it.
constexpr ethercat::Time kMaxStep = std::chrono::milliseconds(20);

// Types of objects, as CoE numbers them.
constexpr std::uint8_t kInt8 = 2;
constexpr std::uint8_t kInt16 = 3;
constexpr std::uint8_t kInt32 = 4;
constexpr std::uint8_t kUint8 = 5;
constexpr std::uint8_t kUint16 = 6;
constexpr std::uint8_t kUint32 = 7;
constexpr std::uint8_t kVisibleString = 9;

struct Object {
  std::uint16_t index;
  std::uint8_t bits;
  std::uint8_t type;
  const char* name;
};
constexpr Object kControl{0x6040, 16, kUint16, "Controlword"};
constexpr Object kMode{0x6060, 8, kInt8, "Modes of operation"};
constexpr Object kTarget{0x607A, 32, kInt32, "Target position"};
constexpr Object kTargetVelocity{0x60FF, 32, kInt32, "Target velocity"};
constexpr Object kTargetTorque{0x6071, 16, kInt16, "Target torque"};
constexpr Object kTorqueOffset{0x60B2, 16, kInt16, "Torque offset"};
constexpr Object kError{0x603F, 16, kUint16, "Error code"};
constexpr Object kStatus{0x6041, 16, kUint16, "Statusword"};
constexpr Object kModeShown{0x6061, 8, kInt8, "Modes of operation display"};
constexpr Object kPosition{0x6064, 32, kInt32, "Position actual value"};
constexpr Object kVelocity{0x606C, 32, kInt32, "Velocity actual value"};
constexpr Object kTorque{0x6077, 16, kInt16, "Torque actual value"};
constexpr std::uint16_t kInterpolation = 0x60C2;

Pdo pdo_of(std::uint16_t index, std::uint8_t manager, std::uint16_t flags, const char* name,
           std::initializer_list<Object> objects) {
  Pdo pdo{index, manager, flags, name, {}};
  for (const Object& object : objects) {
    pdo.entries.push_back({object.index, 0, object.bits, object.type, object.name});
  }
  return pdo;
}

// Two PDOs of each direction that a master may fill, the first with what a position loop needs; and fixed ones for
// loops of speed and torque in the master.
ethercat::Sii sii_of_drive() {
  using namespace ethercat;
  Sii sii;
  sii.identity = kIdentity;
  sii.name = kName;
  sii.order = "ECSIM-DRIVE";
  sii.mailbox = {0x1000, kMailboxBytes, 0x1080, kMailboxBytes};
  sii.bootstrap = sii.mailbox;
  sii.protocols = kProtocolCoe | kProtocolFoe;
  sii.coe_details = kCoeSdo | kCoeSdoInfo | kCoePdoAssign | kCoePdoConfiguration | kCoeCompleteAccess;
  sii.fmmus = {FmmuUse::Outputs, FmmuUse::Inputs};
  sii.outputs = {pdo_of(0x1600, kOutputManager, 0, "Outputs", {kControl, kMode, kTarget}),
                 pdo_of(0x1601, kNotAssigned, 0, "More outputs", {}),
                 pdo_of(0x1700, kNotAssigned, kPdoFixed, "Velocity", {kControl, kMode, kTargetVelocity}),
                 pdo_of(0x1701, kNotAssigned, kPdoFixed, "Torque", {kControl, kMode, kTargetTorque, kTorqueOffset})};
  sii.inputs = {
      pdo_of(0x1A00, kInputManager, 0, "Inputs", {kError, kStatus, kModeShown, kPosition}),
      pdo_of(0x1A01, kNotAssigned, 0, "More inputs", {}),
      pdo_of(0x1B00, kNotAssigned, kPdoFixed, "Motion", {kError, kStatus, kModeShown, kPosition, kVelocity, kTorque})};
  const auto bytes = [](const Pdo& pdo) { return static_cast<std::uint16_t>(bits_of(pdo) / 8); };
  sii.sync_managers = {{0x1000, kMailboxBytes, 0x26, 1, SyncManagerUse::MailboxOut},
                       {0x1080, kMailboxBytes, 0x22, 1, SyncManagerUse::MailboxIn},
                       {kOutputsAt, bytes(sii.outputs.front()), 0x64, 1, SyncManagerUse::Outputs},
                       {kInputsAt, bytes(sii.inputs.front()), 0x20, 1, SyncManagerUse::Inputs}};
  return sii;
}

// Calls `field` with each object of a drive, and what it is here.
template <class Field>
void visit(DriveCommand& command, const Field& field) {
  field(0x6040, command.control);
  field(0x6060, command.mode);
  field(0x607A, command.position);
  field(0x60FF, command.velocity);
  field(0x6071, command.torque);
  field(0x60B0, command.position_offset);
  field(0x60B1, command.velocity_offset);
  field(0x60B2, command.torque_offset);
  field(0x60B8, command.probe);
}
template <class Field>
void visit(DriveFeedback& feedback, const Field& field) {
  field(0x603F, feedback.error);
  field(0x6041, feedback.status);
  field(0x6061, feedback.mode);
  field(0x6064, feedback.position);
  field(0x606C, feedback.velocity);
  field(0x6077, feedback.torque);
  field(0x60F4, feedback.following);
  field(0x60FD, feedback.inputs);
  field(0x60B9, feedback.probe);
  field(0x60BA, feedback.probe_rise);
  field(0x60BB, feedback.probe_fall);
  field(0x60BC, feedback.probe2_rise);
  field(0x60BD, feedback.probe2_fall);
}

void add_objects(ObjectDictionary& objects) {
  objects.add_number<std::uint32_t>(0x1000, 0, 0x00020192, false);  // servo drive, profile 402
  objects.add(0x1008, 0, {kName.begin(), kName.end()}, false);
  objects.add_number<std::uint8_t>(0x1018, 0, 4, false);
  objects.add_number<std::uint32_t>(0x1018, 1, kIdentity.vendor, false);
  objects.add_number<std::uint32_t>(0x1018, 2, kIdentity.product, false);
  objects.add_number<std::uint32_t>(0x1018, 3, kIdentity.revision, false);
  objects.add_number<std::uint32_t>(0x1018, 4, kIdentity.serial, false);
  // The time between two set points, 1 ms at first. It is only kept: the axis is computed up to when a frame comes.
  objects.add_number<std::uint8_t>(kInterpolation, 0, 2, false);
  objects.add_number<std::uint8_t>(kInterpolation, 1, 1);
  objects.add_number<std::int8_t>(kInterpolation, 2, -3);
  DriveCommand command;
  visit(command, [&objects](std::uint16_t index, auto value) { objects.add_number(index, 0, value); });
  DriveFeedback feedback;
  visit(feedback, [&objects](std::uint16_t index, auto value) { objects.add_number(index, 0, value, false); });
  for (const Object& object : {kControl, kMode, kTarget, kTargetVelocity, kTargetTorque, kTorqueOffset, kError, kStatus,
                               kModeShown, kPosition, kVelocity, kTorque}) {
    objects.describe(object.index, 0, object.type, object.name);
  }
  objects.describe(0x1000, 0, kUint32, "Device type");
  objects.describe(0x1008, 0, kVisibleString, "Device name");
  objects.describe(0x1018, 0, kUint8, "Identity");
  objects.describe(kInterpolation, 1, kUint8, "Interpolation time period");
  objects.describe(kInterpolation, 2, kInt8, "Interpolation time index");
}

}  // namespace

ethercat::SlaveConfig Drive::slave(std::uint16_t alias) {
  ethercat::SlaveConfig config;
  ethercat::Sii sii = sii_of_drive();
  sii.alias = alias;
  config.esc.eeprom = ethercat::sii_image(sii);
  add_objects(config.objects);
  return config;
}

void Drive::attach(ethercat::Slave& slave) {
  objects_ = &slave.objects();
  constexpr std::string_view kLog = "a simulated drive has nothing to tell\n";
  slave.foe().files()["log.txt"] = {kLog.begin(), kLog.end()};
  mapped_.emplace(*objects_, slave.sii());
}

void Drive::compute(Bytes outputs, std::span<std::uint8_t> inputs, ethercat::Time now) {
  const auto elapsed = std::min(now - last_, kMaxStep);
  last_ = now;
  DriveCommand command;
  if (!outputs.empty()) {
    mapped_->take(outputs);
    visit(command, [this](std::uint16_t index, auto& value) {
      value = ethercat::load<std::remove_reference_t<decltype(value)>>(objects_->storage(index, 0), 0);
    });
  }
  DriveFeedback feedback = drive_.step(command, elapsed);
  visit(feedback, [this](std::uint16_t index, auto value) { ethercat::store(objects_->storage(index, 0), 0, value); });
  mapped_->give(inputs);
}

}  // namespace indurop::io::slaves
