// SPDX-License-Identifier: Apache-2.0
// ioconfig.xml as data (chapter, Figure 9): which shared variables stand for which points of which field device. What
// the devices do with it is the business of io/.

#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "config/model/config.h"

namespace indurop::config {

// ModbusServer: others ask us, an operator panel for example.
enum class IoDriver { ModbusTcp, ModbusRtu, ModbusServer, Cia402, Csv };
const char* name_of(IoDriver driver) noexcept;

// How a number is written on the wire of a device with registers.
enum class WireType { Bool, Int16, UInt16, Int32, UInt32, Int64, UInt64, Float32, Float64 };
const char* name_of(WireType type) noexcept;
// Registers of 16 bits; a bool in a coil takes one coil.
std::uint32_t registers_of(WireType type) noexcept;

// The four tables of a Modbus device. Coils and discrete inputs are bits, the other two registers of 16 bits.
enum class IoTable { Coil, Discrete, Input, Holding };
const char* name_of(IoTable table) noexcept;
constexpr bool is_bits(IoTable table) noexcept {
  return table == IoTable::Coil || table == IoTable::Discrete;
}
constexpr bool is_read_only(IoTable table) noexcept {
  return table == IoTable::Discrete || table == IoTable::Input;
}

// How a request looks on a TCP connection. Rtu: as on a serial line, behind a gateway that hands it on as it is.
enum class IoFraming { Tcp, Rtu };

// A point's place in a Modbus device: "holding:100", "coil:3", "input:7.2".
struct IoAddress {
  IoTable table = IoTable::Holding;
  std::uint16_t number = 0;  // from 0, as on the wire
  int bit = -1;              // of the register, 0 is the least significant; -1: the whole
};

struct IoPoint {
  bool output = false;   // variable to device
  std::string variable;  // as written
  std::string at;        // as written; csv: column, cia402: object
  IoAddress address;     // Modbus
  int unit = 1;          // Modbus: of several on one line, or behind one gateway
  int every = 1;         // Modbus: exchanged in every so many cycles of the device
  WireType type = WireType::UInt16;
  bool swap_words = false;  // low word first
  bool swap_bytes = false;  // low byte of each word first
  double scale = 1;         // variable = wire * scale + offset
  double offset = 0;
  std::string quality;              // variable that says how good the value is; empty: none
  std::optional<double> bad_value;  // the variable's value while the input is bad; empty: the last good one
  std::optional<double> stop;       // the output's value when the node stops or its tick stands still
  base::SourcePlace place;
  base::SourcePlace variable_place;
  base::SourcePlace at_place;
  base::SourcePlace quality_place;
};

// Serial line of modbus_rtu.
struct IoSerial {
  int baud = 19200;
  char parity = 'E';  // N, E, O
  int stop_bits = 1;
};

// The simulated axis. Angles are those of the encoder's shaft.
struct IoAxis {
  double counts = 1'320'000;                // encoder counts per revolution (Figure 13)
  double inertia = 0.5;                     // kg m2
  double damping = 1;                       // N m s / rad
  double torque = 200;                      // most the motor gives, N m
  double speed = 180;                       // most, degrees / s
  double acceleration = 720;                // of the profile modes, degrees / s2
  double bandwidth = 20;                    // of the position loop, Hz
  double following = 5;                     // largest following error, degrees
  base::Nanos following_time{100'000'000};  // and for how long it may be exceeded
  double start = 0;                         // where the axis is at power on, degrees
  double mark = 0;                          // where homing finds the reference mark, degrees; 0 from then on
  double home_speed = 20;                   // degrees / s
  std::optional<int> homing;                // method (0x6098); empty: straight to the mark
  double creep_speed = 2;                   // of homing, once the switch is found, degrees / s
  std::optional<double> low_limit;          // limit switch: on there and below, degrees
  std::optional<double> high_limit;         // on there and above
  std::optional<double> home_from;          // home switch: on from there
  std::optional<double> home_to;            // to there; empty: without end
  std::optional<double> probe;              // input of touch probe 1: on there and above, degrees
  std::optional<double> probe2;             // of touch probe 2
  double torque_slope = 10'000;             // of the profile torque mode, 1/1000 of the motor's torque / s
  double noise = 0;                         // standard deviation of the encoder, counts
  std::uint64_t seed = 1;                   // of the noise
  std::string in;                           // struct of inputs, its fields named like the objects
  std::string out;
  base::SourcePlace in_place;
  base::SourcePlace out_place;
};

struct IoCsv {
  std::filesystem::path file;  // names that are not absolute start at the folder of ioconfig.xml
  std::string as_written;
  bool loop = false;  // at its end: from the start again, or the last row holds
};

struct IoDevice {
  std::string name;
  IoDriver driver = IoDriver::ModbusTcp;
  std::string address;  // host, serial port; ModbusServer: where it listens
  std::uint16_t port = 502;
  int unit = 1;  // of points that do not say another
  base::Nanos cycle{10'000'000};
  base::Nanos timeout{500'000'000};
  base::Nanos retry{100'000'000};  // first pause after a lost connection; doubles up to retry_most
  base::Nanos retry_most{5'000'000'000};
  base::Nanos watchdog{500'000'000};  // without a run of the module for so long outputs are not refreshed any more
  IoFraming framing = IoFraming::Tcp;
  bool together = false;  // registers are written and read in one request, function 23
  int gap = 0;            // registers or bits that nobody asked for and that may be read along
  IoSerial serial;
  IoAxis axis;
  IoCsv csv;
  std::string quality;  // variables about the device as a whole; empty: none
  std::string errors;
  std::vector<IoPoint> points;
  base::SourcePlace place;
  base::SourcePlace quality_place;
  base::SourcePlace errors_place;
};

struct IoConfig {
  std::filesystem::path file;
  std::vector<IoDevice> devices;
};

// An object of a CiA 402 drive as a point may name it.
struct AxisObject {
  const char* name;
  bool output;
};
inline constexpr std::array<AxisObject, 23> kAxisObjects{{{"error", false},
                                                          {"status", false},
                                                          {"mode", false},
                                                          {"position", false},
                                                          {"velocity", false},
                                                          {"torque", false},
                                                          {"inputs", false},
                                                          {"probe", false},
                                                          {"probe_rise", false},
                                                          {"probe_fall", false},
                                                          {"probe2_rise", false},
                                                          {"probe2_fall", false},
                                                          {"following", false},
                                                          {"control", true},
                                                          {"mode", true},
                                                          {"position", true},
                                                          {"velocity", true},
                                                          {"torque", true},
                                                          {"position_offset", true},
                                                          {"velocity_offset", true},
                                                          {"torque_offset", true},
                                                          {"load", true},
                                                          {"probe", true}}};

// A module file that exports this function takes the path of an ioconfig.xml from its property "config"; so the checks
// know what it reads and writes.
inline constexpr const char* kIoModuleSymbol = "indurop_io_format";
inline constexpr const char* kIoConfigProperty = "config";

}  // namespace indurop::config
