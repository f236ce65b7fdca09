// Written by indurop plc from in.st: change that, not this.
#include <indurop/indurop.h>
#include <indurop/plc/keep.h>
#include <indurop/plc/library.h>
#include <indurop/plc/program.h>
#define INDUROP_LEAF ::indurop::iec::SharedNumber
#include <indurop/generated.h>

#include <array>
#include <cstdint>
#include <limits>

namespace {
namespace iec = indurop::iec;

namespace plc {
}  // namespace plc

// What the program sees of the shared variables during a scan.
struct Image {
  std::int16_t handed{};
  bool I0{};
  bool O0{};
  std::int16_t PLC_ROBOT_I1{};
  ::PLC_ROBOT::ROBOT_MODULE_STATE_t PLC_ROBOT_ROBOT_MODULE_STATE{};
  ::PLC_ROBOT::ROBOT_MODULE_SERVICE_t PLC_ROBOT_ROBOT_MODULE_SERVICE{};
};
Image shared;
Image before;

namespace plc {
struct Fast {
  std::int32_t starts{};
  void operator()(const iec::Scan& scan);
};

inline void Fast::operator()([[maybe_unused]] const iec::Scan& scan) {
  shared.O0 = shared.I0 && (shared.PLC_ROBOT_I1 != 0);
  if (shared.PLC_ROBOT_ROBOT_MODULE_STATE.eState == ::PLC_ROBOT::State::STANDBY) {
    shared.PLC_ROBOT_ROBOT_MODULE_SERVICE.eOpCode = iec::mul(shared.PLC_ROBOT_ROBOT_MODULE_STATE.dCurJoint[2], 2);
  }
  starts = iec::add(starts, 1);
  shared.handed = iec::add(shared.handed, std::int16_t{1});
}
}  // namespace plc

plc::Fast instance_first;

asm(R"(.pushsection .indurop.access,"",%progbits
.long 2494403304,1036407876,3
.long 3010591142,678381738,3
.popsection)");
constinit const std::array<iec::SharedWord, 1> table_2 {
  iec::SharedWord{&INDUROP_TYPEOF(::golden::handed)::tag_type::ref(), &shared.handed},
};
constinit iec::SharedWords<std::uint16_t, 1, 1> words_2{table_2};
constinit const std::array<iec::SharedWord, 1> table_4 {
  iec::SharedWord{&INDUROP_TYPEOF(::golden::first_starts)::tag_type::ref(), &instance_first.starts},
};
constinit iec::SharedWords<std::uint32_t, 1, 1> words_4{table_4};

void read_shared() {
  words_2.read();
  words_4.read();
  iec::read_image(shared.I0, ::PLC_ROBOT::I0);
  iec::read_image(shared.O0, ::PLC_ROBOT::O0);
  iec::read_image(shared.PLC_ROBOT_I1, ::PLC_ROBOT::I1);
  iec::read_image(shared.PLC_ROBOT_ROBOT_MODULE_STATE, ::PLC_ROBOT::ROBOT_MODULE_STATE);
  iec::read_image(shared.PLC_ROBOT_ROBOT_MODULE_SERVICE, ::PLC_ROBOT::ROBOT_MODULE_SERVICE);
  before = shared;
}

void write_shared() {
  words_2.write();
  words_4.write();
  iec::write_changed(::PLC_ROBOT::O0, shared.O0, before.O0);
  iec::write_changed(::PLC_ROBOT::ROBOT_MODULE_SERVICE.eOpCode, shared.PLC_ROBOT_ROBOT_MODULE_SERVICE.eOpCode, before.PLC_ROBOT_ROBOT_MODULE_SERVICE.eOpCode);
}
// One scan: all variables it sees are from its beginning, what it changed is there at its end.
void one_scan() {
  const iec::Scan scan{irp::release_ns()};
  read_shared();
  instance_first(scan);
  write_shared();
}
}  // namespace

void POU_PROGRAM() { one_scan(); }
void run() { POU_PROGRAM(); }

// What it keeps between its scans.
extern "C" void indurop_module_state(indurop::StateDescriptor* to) {
  static constexpr std::array<indurop::StateItem, 1> items{
      iec::kept("first.starts", "DINT", instance_first.starts),
  };
  iec::declare_kept(items, nullptr, to);
}

INDUROP_MODULE(run = &::run, name = "golden_fast")
// Written by indurop plc from in.st: change that, not this.
#include <indurop/indurop.h>
#include <indurop/plc/keep.h>
#include <indurop/plc/library.h>
#include <indurop/plc/program.h>
#define INDUROP_LEAF ::indurop::iec::SharedNumber
#include <indurop/generated.h>

#include <array>
#include <cstdint>
#include <limits>

namespace {
namespace iec = indurop::iec;

namespace plc {
}  // namespace plc

// What the program sees of the shared variables during a scan.
struct Image {
  std::int16_t handed{};
  std::int32_t hours{};
  double speed{};
};
Image shared;
Image before;

namespace plc {
struct Slow {
  void operator()(const iec::Scan& scan);
};

inline void Slow::operator()([[maybe_unused]] const iec::Scan& scan) {
  shared.hours = iec::add(shared.hours, static_cast<std::int32_t>(shared.handed));
  shared.speed = shared.speed * 2.0;
}
}  // namespace plc

plc::Slow instance_second;

asm(R"(.pushsection .indurop.access,"",%progbits
.long 2494403304,1036407876,1
.long 152152703,2512190842,3
.popsection)");
constinit const std::array<iec::SharedWord, 1> table_2 {
  iec::SharedWord{&INDUROP_TYPEOF(::golden::handed)::tag_type::ref(), &shared.handed},
};
constinit iec::SharedWords<std::uint16_t, 1, 0> words_2{table_2};
constinit const std::array<iec::SharedWord, 1> table_4 {
  iec::SharedWord{&INDUROP_TYPEOF(::golden::hours)::tag_type::ref(), &shared.hours},
};
constinit iec::SharedWords<std::uint32_t, 1, 1> words_4{table_4};

void read_shared() {
  words_2.read();
  words_4.read();
  iec::read_image(shared.speed, ::PLC_ROBOT::speed);
  before = shared;
}

void write_shared() {
  words_2.write();
  words_4.write();
  iec::write_changed(::PLC_ROBOT::speed, shared.speed, before.speed);
}
// One scan: all variables it sees are from its beginning, what it changed is there at its end.
void one_scan() {
  const iec::Scan scan{irp::release_ns()};
  read_shared();
  instance_second(scan);
  write_shared();
}
}  // namespace

void POU_PROGRAM() { one_scan(); }
void run() { POU_PROGRAM(); }

// What it keeps between its scans.
extern "C" void indurop_module_state(indurop::StateDescriptor* to) {
  static constexpr std::array<indurop::StateItem, 0> items{
  };
  iec::declare_kept(items, nullptr, to);
}

INDUROP_MODULE(run = &::run, name = "golden_slow")
