// SPDX-License-Identifier: Apache-2.0
// Registers of an EtherCAT slave controller, its states, and both in words.

#pragma once

#include <cstdint>
#include <string_view>

namespace indurop::io::ethercat {

namespace reg {
inline constexpr std::uint16_t kType = 0x0000;
inline constexpr std::uint16_t kFmmuCount = 0x0004;
inline constexpr std::uint16_t kSyncManagerCount = 0x0005;
inline constexpr std::uint16_t kRamSize = 0x0006;
inline constexpr std::uint16_t kPorts = 0x0007;
inline constexpr std::uint16_t kFeatures = 0x0008;
inline constexpr std::uint16_t kStation = 0x0010;
inline constexpr std::uint16_t kAlias = 0x0012;
inline constexpr std::uint16_t kDlControl = 0x0100;
inline constexpr std::uint16_t kDlStatus = 0x0110;
inline constexpr std::uint16_t kAlControl = 0x0120;
inline constexpr std::uint16_t kAlStatus = 0x0130;
inline constexpr std::uint16_t kAlStatusCode = 0x0134;
inline constexpr std::uint16_t kPdiControl = 0x0140;
inline constexpr std::uint16_t kEventMask = 0x0200;
inline constexpr std::uint16_t kEventRequest = 0x0210;
inline constexpr std::uint16_t kRxErrors = 0x0300;  // two bytes for each port: invalid frames, physical errors
inline constexpr std::uint16_t kForwardedErrors = 0x0308;
inline constexpr std::uint16_t kLostLinks = 0x0310;
inline constexpr std::uint16_t kWatchdogDivider = 0x0400;
inline constexpr std::uint16_t kWatchdogPdi = 0x0410;
inline constexpr std::uint16_t kWatchdogProcessData = 0x0420;
inline constexpr std::uint16_t kWatchdogStatus = 0x0440;
inline constexpr std::uint16_t kEepromConfig = 0x0500;
inline constexpr std::uint16_t kEepromControl = 0x0502;
inline constexpr std::uint16_t kEepromAddress = 0x0504;
inline constexpr std::uint16_t kEepromData = 0x0508;
inline constexpr std::uint16_t kFmmu = 0x0600;         // 16 bytes each
inline constexpr std::uint16_t kSyncManager = 0x0800;  // 8 bytes each
inline constexpr std::uint16_t kReceiveTimes = 0x0900;
inline constexpr std::uint16_t kSystemTime = 0x0910;
inline constexpr std::uint16_t kReceiveTimeUnit = 0x0918;  // of the processing unit
inline constexpr std::uint16_t kSystemTimeOffset = 0x0920;
inline constexpr std::uint16_t kSystemTimeDelay = 0x0928;
inline constexpr std::uint16_t kSystemTimeDifference = 0x092C;
inline constexpr std::uint16_t kSpeedCounter = 0x0930;
inline constexpr std::uint16_t kSyncActivation = 0x0980;
inline constexpr std::uint16_t kSyncStart = 0x0990;
inline constexpr std::uint16_t kSync0Cycle = 0x09A0;
inline constexpr std::uint16_t kSync1Cycle = 0x09A4;
inline constexpr std::uint16_t kMemory = 0x1000;  // process data and mailboxes
}  // namespace reg

inline constexpr std::size_t kPorts = 4;  // of a slave
inline constexpr std::uint16_t kFmmuBytes = 16;
inline constexpr std::uint16_t kSyncManagerBytes = 8;

// Status of SyncManager 1, the mailbox from the slave, and its bit for a message that waits.
inline constexpr std::uint16_t kAnswerStatus = reg::kSyncManager + kSyncManagerBytes + 5;
inline constexpr std::uint8_t kMailboxFull = 0x08;

// Bits of kFeatures.
inline constexpr std::uint16_t kHasClock = 0x0004;
inline constexpr std::uint16_t kHasLongClock = 0x0008;  // of 64 bits
inline constexpr std::uint16_t kNoLrw = 0x0200;         // it runs LRD and LWR, and leaves LRW alone

// Values of kEepromConfig: who may use the EEPROM.
inline constexpr std::uint8_t kEepromOfMaster = 0x00;
inline constexpr std::uint8_t kEepromOfDevice = 0x01;  // its processor
inline constexpr std::uint8_t kEepromForce = 0x02;     // takes it away from the processor

// Bits of kEepromControl.
inline constexpr std::uint16_t kEepromWriteEnable = 0x0001;
inline constexpr std::uint16_t kEepromEightBytes = 0x0040;
inline constexpr std::uint16_t kEepromRead = 0x0100;
inline constexpr std::uint16_t kEepromWrite = 0x0200;
inline constexpr std::uint16_t kEepromReload = 0x0400;
inline constexpr std::uint16_t kEepromErrors = 0x7800;  // checksum, device information, acknowledge, write enable
inline constexpr std::uint16_t kEepromAckError = 0x2000;
inline constexpr std::uint16_t kEepromBusy = 0x8000;

// The register that holds this byte, in words; "register" if it has no name here.
std::string_view register_name(std::uint16_t offset) noexcept;

enum class AlState : std::uint8_t { None = 0, Init = 1, PreOp = 2, Boot = 3, SafeOp = 4, Op = 8 };
inline constexpr std::uint8_t kAlStateMask = 0x0F;
inline constexpr std::uint8_t kAlError = 0x10;  // in kAlStatus; in kAlControl: acknowledges it

std::string_view to_string(AlState state) noexcept;

// AL status codes that this tree itself gives; al_status_text() knows all that are published.
inline constexpr std::uint16_t kAlNoError = 0x0000;
inline constexpr std::uint16_t kAlInvalidChange = 0x0011;
inline constexpr std::uint16_t kAlUnknownState = 0x0012;
inline constexpr std::uint16_t kAlNoBoot = 0x0013;
inline constexpr std::uint16_t kAlInvalidBootMailbox = 0x0015;
inline constexpr std::uint16_t kAlInvalidMailbox = 0x0016;
inline constexpr std::uint16_t kAlSyncWatchdog = 0x001B;
inline constexpr std::uint16_t kAlInvalidOutputs = 0x001D;
inline constexpr std::uint16_t kAlInvalidInputs = 0x001E;
inline constexpr std::uint16_t kAlNoSync = 0x002D;
inline constexpr std::uint16_t kAlInvalidDc = 0x0030;
// What the slave reports with this code.
std::string_view al_status_text(std::uint16_t code) noexcept;

}  // namespace indurop::io::ethercat
