// SPDX-License-Identifier: Apache-2.0
// ioconfig.xml as data (chapter, Figure 9): which shared variable is bound to which point of which field device. How a
// device is driven is implemented in control/io/.

#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "config/model/config.h"

namespace indurop::config {

// ModbusServer: other devices poll this node, an operator panel for example.
enum class IoDriver { ModbusTcp, ModbusRtu, ModbusServer, Cia402, Ethercat, Csv, Opcua, Fmu };
// Its points are objects of a drive, by name, or the fields of a struct.
constexpr bool has_objects(IoDriver driver) noexcept {
  return driver == IoDriver::Cia402 || driver == IoDriver::Ethercat;
}
const char* name_of(IoDriver driver) noexcept;

// Format of a number in the registers of a device.
enum class WireType { Bool, Int16, UInt16, Int32, UInt32, Int64, UInt64, Float32, Float64 };
const char* name_of(WireType type) noexcept;
// Returns the number of 16-bit registers; a bool in a coil takes one coil.
std::uint32_t registers_of(WireType type) noexcept;

// The four tables of a Modbus device. Coils and discrete inputs are bits, the other two are 16-bit registers.
enum class IoTable { Coil, Discrete, Input, Holding };
const char* name_of(IoTable table) noexcept;
constexpr bool is_bits(IoTable table) noexcept {
  return table == IoTable::Coil || table == IoTable::Discrete;
}
constexpr bool is_read_only(IoTable table) noexcept {
  return table == IoTable::Discrete || table == IoTable::Input;
}

// Framing of a request on a TCP connection. Rtu: as on a serial line, for a gateway that forwards it unchanged.
enum class IoFraming { Tcp, Rtu };

// The address of a point in a Modbus device: "holding:100", "coil:3", "input:7.2".
struct IoAddress {
  IoTable table = IoTable::Holding;
  std::uint16_t number = 0;  // from 0, as on the wire
  int bit = -1;              // bit of the register, 0 is the least significant; -1: the whole register
};

// An object in the process data of an EtherCAT slave.
struct IoObject {
  std::uint16_t index = 0;
  std::uint8_t subindex = 0;
  std::uint8_t bytes = 0;  // as a PDO gets it; 0: only the slave knows
  bool is_signed = false;
};
constexpr bool is_same(const IoObject& a, const IoObject& b) noexcept {
  return a.index == b.index && a.subindex == b.subindex;
}

struct IoPoint {
  bool output = false;   // true: from variable to device
  std::string variable;  // as written in the file
  std::string at;        // as written in the file; csv: column, cia402 and ethercat: object, opcua: NodeId, fmu: its
                         // variable
  IoAddress address;     // Modbus
  IoObject object;       // EtherCAT
  int unit = 1;          // Modbus: unit on the line or after the gateway
  bool is_text = false;  // fmu: the variable is a text
  int every = 1;         // Modbus: exchanged in every n-th cycle of the device
  WireType type = WireType::UInt16;
  bool swap_words = false;  // low word first
  bool swap_bytes = false;  // low byte of each word first
  double scale = 1;         // variable = wire * scale + offset
  double offset = 0;
  std::string quality;              // variable for the quality of the value; empty: none
  std::optional<double> bad_value;  // value of the variable while the input is bad; empty: the last good one
  std::optional<double> stop;       // value of the output when the node stops or its tick stops
  base::SourcePlace place;
  base::SourcePlace variable_place;
  base::SourcePlace at_place;
  base::SourcePlace quality_place;
};

// The serial line of modbus_rtu.
struct IoSerial {
  int baud = 19200;
  char parity = 'E';  // N, E, O
  int stop_bits = 1;
};

// Parameters of the simulated axis. Angles are those of the encoder's shaft.
struct IoAxis {
  double counts = 1'320'000;                // encoder counts per revolution (Figure 13)
  double inertia = 0.5;                     // kg m2
  double damping = 1;                       // N m s / rad
  double torque = 200;                      // maximum of the motor, N m
  double torque_bandwidth = 0;              // with which the torque follows the demanded one, Hz; 0: it follows at once
  double speed = 180;                       // maximum, degrees / s
  double acceleration = 720;                // of the profile modes, degrees / s2
  double bandwidth = 20;                    // of the position loop, Hz
  double following = 5;                     // maximum following error, degrees
  base::Nanos following_time{100'000'000};  // time for which the following error may be exceeded
  double start = 0;                         // position at power on, degrees
  double mark = 0;                          // position of the reference mark for homing, degrees; 0 after homing
  double home_speed = 20;                   // degrees / s
  std::optional<int> homing;                // method (0x6098); empty: directly to the mark
  double creep_speed = 2;                   // homing speed after the switch was found, degrees / s
  std::optional<double> low_limit;          // limit switch: on at and below this position, degrees
  std::optional<double> high_limit;         // limit switch: on at and above this position, degrees
  std::optional<double> home_from;          // home switch: on from this position, degrees
  std::optional<double> home_to;            // to this position; empty: no end
  std::optional<double> probe;              // input of touch probe 1: on at and above this position, degrees
  std::optional<double> probe2;             // input of touch probe 2
  double torque_slope = 10'000;             // of the profile torque mode, 1/1000 of the motor's torque / s
  double noise = 0;                         // standard deviation of the encoder, counts
  std::uint64_t seed = 1;                   // of the noise
  std::string in;                           // struct of inputs; its fields are named like the objects
  std::string out;
  base::SourcePlace in_place;
  base::SourcePlace out_place;
};

// An object that is set in PREOP, each time the slave comes up.
struct IoObjectValue {
  IoObject object;
  std::vector<std::uint8_t> bytes;  // the low one first
};

// A part of a slave's process data, by the names of what is in it.
struct IoBlock {
  // Range: all that one PDO has from one object to another one.
  enum class Kind { Object, Range, Pdo };
  Kind kind = Kind::Object;
  std::string at;  // as written in the file
  IoObject first;  // Pdo: its index
  IoObject last;   // Range
  base::SourcePlace place;
};

// What goes from the inputs of another slave to outputs of this one, with no program between them.
struct IoCopy {
  std::string from;  // the device
  IoBlock source;
  IoBlock target;
  base::Nanos hold{100'000'000};  // how long the target keeps the last bits of a source that has no valid ones
  base::SourcePlace place;
  base::SourcePlace from_place;
};

// Pulses of the slave's clock (SYNC0, SYNC1), at which it takes outputs and reads inputs.
struct IoSync {
  std::uint16_t activate = 0;  // AssignActivate of the device's description; 0: none
  base::Nanos cycle{0};
  base::Nanos shift{0};  // after the frames
  base::Nanos sync1{0};  // cycle of SYNC1
};

// A slave of an EtherCAT bus; the address of the device is the network interface.
struct IoSlave {
  int position = 0;                     // on the cable, from 0, unless it has an alias
  std::optional<std::uint16_t> alias;   // the slave with this number, wherever it is
  std::optional<std::uint32_t> vendor;  // has to be found there; empty: any
  std::optional<std::uint32_t> product;
  std::optional<std::uint32_t> revision;
  base::Nanos cycle{0};               // from one exchange to the next; 0: each run of the module
  std::vector<IoObjectValue> values;  // in the order in which they are set
  IoSync sync;
  std::vector<IoCopy> copies;          // to this slave
  std::vector<IoBlock> copied;         // of its inputs, to other slaves
  std::filesystem::path description;   // the maker's file (ESI); empty: none
  std::string description_as_written;  // relative names start at the folder of ioconfig.xml
  base::SourcePlace description_place;
};

// "slave 3", "the slave with alias 5"
std::string describe(const IoSlave& slave);

struct IoCsv {
  std::filesystem::path file;  // relative names start at the folder of ioconfig.xml
  std::string as_written;
  bool loop = false;  // at the end of the file: restart at the first row; false: hold the last row
};

// How a server of OPC UA is reached. The protocol is spoken by `indurop-opcua --client`.
struct IoOpcua {
  enum class Security { Encrypt, Sign, None };
  Security security = Security::Encrypt;
  std::string user;    // empty: anonymous
  std::string socket;  // of that program; empty: the one that it has by default
};
const char* name_of(IoOpcua::Security security) noexcept;

// A value that an FMU gets before it starts.
struct IoFmuStart {
  std::string at;  // variable of the FMU
  std::string value;
  base::SourcePlace at_place;
  base::SourcePlace value_place;
};

// A model of another tool, for simulations.
struct IoFmu {
  std::filesystem::path file;  // relative names start at the folder of ioconfig.xml
  std::string as_written;
  std::string variables;  // namespace in which inputs and outputs are declared as shared variables; empty: they are not
  bool log = false;       // all of its messages are printed, not only warnings and errors
  std::vector<IoFmuStart> starts;
  base::SourcePlace file_place;
  base::SourcePlace variables_place;
};

struct IoDevice {
  std::string name;
  IoDriver driver = IoDriver::ModbusTcp;
  std::string address;  // host or serial port; ModbusServer: listening address; Opcua: URL of the server
  std::uint16_t port = 502;
  int unit = 1;  // default of points without their own
  base::Nanos cycle{10'000'000};
  base::Nanos timeout{500'000'000};
  base::Nanos retry{100'000'000};  // first pause after a lost connection; doubles up to retry_max
  base::Nanos retry_max{5'000'000'000};
  base::Nanos watchdog{500'000'000};  // outputs are not refreshed any more if the module has not run for this time
  IoFraming framing = IoFraming::Tcp;
  bool together = false;  // registers are written and read in one request (function 23)
  int gap = 0;            // maximum number of unused registers or bits that a request may also read
  IoSerial serial;
  IoAxis axis;
  IoSlave slave;
  IoCsv csv;
  IoOpcua opcua;
  IoFmu fmu;
  std::string quality;  // variables about the device as a whole; empty: none
  std::string errors;
  std::string cut;           // Ethercat on a ring
  std::string cable_errors;  // Ethercat
  std::vector<IoPoint> points;
  base::SourcePlace place;
  base::SourcePlace quality_place;
  base::SourcePlace errors_place;
  base::SourcePlace cut_place;
  base::SourcePlace cable_errors_place;
};

// The slaves that a simulation has at an EtherCAT bus instead of its cable.
struct IoSimulation {
  std::string address;              // of the devices
  std::vector<std::string> slaves;  // as `indurop-ecsim` takes them, in the order of the cable
  std::filesystem::path folder;     // at which their relative names of files start
  std::filesystem::path script;     // faults and their times; empty: none
  base::SourcePlace place;
  base::SourcePlace slaves_place;
  base::SourcePlace script_place;
};

struct IoConfig {
  std::filesystem::path file;
  std::vector<IoDevice> devices;
  std::vector<IoSimulation> simulations;
};

// An object of a CiA 402 drive by the name that a point uses.
struct AxisObject {
  const char* name = "";
  bool output = false;
  IoObject object;  // index 0: of the simulated drive only
};
inline constexpr std::array<AxisObject, 23> kAxisObjects{{{"error", false, {0x603F, 0, 2, false}},
                                                          {"status", false, {0x6041, 0, 2, false}},
                                                          {"mode", false, {0x6061, 0, 1, true}},
                                                          {"position", false, {0x6064, 0, 4, true}},
                                                          {"velocity", false, {0x606C, 0, 4, true}},
                                                          {"torque", false, {0x6077, 0, 2, true}},
                                                          {"inputs", false, {0x60FD, 0, 4, false}},
                                                          {"probe", false, {0x60B9, 0, 2, false}},
                                                          {"probe_rise", false, {0x60BA, 0, 4, true}},
                                                          {"probe_fall", false, {0x60BB, 0, 4, true}},
                                                          {"probe2_rise", false, {0x60BC, 0, 4, true}},
                                                          {"probe2_fall", false, {0x60BD, 0, 4, true}},
                                                          {"following", false, {0x60F4, 0, 4, true}},
                                                          {"control", true, {0x6040, 0, 2, false}},
                                                          {"mode", true, {0x6060, 0, 1, true}},
                                                          {"position", true, {0x607A, 0, 4, true}},
                                                          {"velocity", true, {0x60FF, 0, 4, true}},
                                                          {"torque", true, {0x6071, 0, 2, true}},
                                                          {"position_offset", true, {0x60B0, 0, 4, true}},
                                                          {"velocity_offset", true, {0x60B1, 0, 4, true}},
                                                          {"torque_offset", true, {0x60B2, 0, 2, true}},
                                                          {"load", true, {}},
                                                          {"probe", true, {0x60B8, 0, 2, false}}}};

// A module file that exports this function reads the path of an ioconfig.xml from its property "config", so the checks
// know which variables it reads and writes.
inline constexpr const char* kIoModuleSymbol = "indurop_io_format";
inline constexpr const char* kIoConfigProperty = "config";

}  // namespace indurop::config
