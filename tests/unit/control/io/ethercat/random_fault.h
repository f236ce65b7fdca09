// SPDX-License-Identifier: Apache-2.0
// A fault of a bus by chance: long enough to be noticed, short enough to be over soon.

#pragma once

#include <random>

#include "control/io/ethercat/simulator/bus.h"

namespace indurop::io::ethercat {

inline Fault random_fault(std::mt19937& random, std::size_t slaves, FaultKind kind, Time at) {
  Fault fault;
  fault.kind = kind;
  fault.at = at;
  fault.slave = random() % slaves;
  fault.duration = std::chrono::milliseconds(1 + random() % 5);
  switch (kind) {
    case FaultKind::FramesLate:
      fault.value = static_cast<std::uint32_t>(1'200'000 + random() % 3'000'000);
      break;
    case FaultKind::PowerOff:
    case FaultKind::CableCut:
      fault.duration = std::chrono::milliseconds(10 + random() % 400);
      break;
    case FaultKind::EepromBusy:
    case FaultKind::OtherIdentity:
    case FaultKind::SdoRepeated:
      fault.duration = std::chrono::milliseconds(300 + random() % 300);
      break;
    case FaultKind::StateSlow:
      fault.duration = std::chrono::milliseconds(300 + random() % 300);
      fault.value = static_cast<std::uint32_t>(100'000'000 + random() % 100'000'000);
      break;
    case FaultKind::ClockDrifts:
      fault.duration = std::chrono::milliseconds(100 + random() % 400);
      fault.value = static_cast<std::uint32_t>(20 + random() % 80);
      break;
    case FaultKind::StateRefused:
    case FaultKind::StateLost:
      fault.value = 0x8001U + static_cast<std::uint32_t>(random() % 100);
      break;
    case FaultKind::SdoAborted:
      fault.value = kAbortState;
      break;
    case FaultKind::ClockJumps:
      fault.value = static_cast<std::uint32_t>(120'000 + random() % 800'000);
      break;
    case FaultKind::Emergency:
      fault.value = static_cast<std::uint32_t>(0x2310 + random() % 16);
      break;
    default:
      break;
  }
  return fault;
}

}  // namespace indurop::io::ethercat
