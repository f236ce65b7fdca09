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
struct SFC_STEP {
  bool X{};
  iec::Time T{};
  friend bool operator==(const SFC_STEP&, const SFC_STEP&) = default;
};
template <class From> void copy_fields(SFC_STEP& to, const From& from) { iec::copy_value(to.X, from.X); iec::copy_value(to.T, from.T); }
template <class To> void copy_fields(To& to, const SFC_STEP& from) { iec::copy_value(to.X, from.X); iec::copy_value(to.T, from.T); }
}  // namespace plc

namespace plc {
struct press {
  bool go{};
  bool down{};
  bool clamped{};
  bool fault{};
  bool horn{};
  std::int16_t count{};
  plc::SFC_STEP Ready = plc::SFC_STEP{true, {}};
  iec::Ton _st0{};
  bool _sx0{};
  plc::SFC_STEP Lower{};
  iec::Ton _st1{};
  bool _sx1{};
  plc::SFC_STEP Clamp{};
  iec::Ton _st2{};
  bool _sx2{};
  plc::SFC_STEP Alarm{};
  iec::Ton _st3{};
  bool _sx3{};
  bool _running{};
  bool _aq1{};
  iec::Ton _at2{};
  bool _aq2{};
  bool _aq3{};
  void operator()(const iec::Scan& scan);
};
struct list {
  bool a{};
  bool b{};
  bool c{};
  void operator()(const iec::Scan& scan);
};

inline void press::operator()([[maybe_unused]] const iec::Scan& scan) {
  [[maybe_unused]] bool _f0{};
  [[maybe_unused]] bool _f1{};
  [[maybe_unused]] bool _f2{};
  [[maybe_unused]] bool _f3{};
  [[maybe_unused]] bool _al1{};
  [[maybe_unused]] bool _al2{};
  [[maybe_unused]] bool _al3{};
  _st0.in = Ready.X;
  _st0.pt = iec::Time{3153600000000000000};
  _st0(scan);
  if (Ready.X) {
    Ready.T = _st0.et;
  }
  _st1.in = Lower.X;
  _st1.pt = iec::Time{3153600000000000000};
  _st1(scan);
  if (Lower.X) {
    Lower.T = _st1.et;
  }
  _st2.in = Clamp.X;
  _st2.pt = iec::Time{3153600000000000000};
  _st2(scan);
  if (Clamp.X) {
    Clamp.T = _st2.et;
  }
  _st3.in = Alarm.X;
  _st3.pt = iec::Time{3153600000000000000};
  _st3(scan);
  if (Alarm.X) {
    Alarm.T = _st3.et;
  }
  _f0 = (_running && Ready.X) && fault;
  _f1 = ((_running && Ready.X) && !_f0) && (go && !fault);
  _f2 = ((_running && Lower.X) && Clamp.X) && (down && clamped);
  _f3 = (_running && Alarm.X) && !fault;
  if (_f0) {
    Ready.X = false;
  }
  if (_f1) {
    Ready.X = false;
  }
  if (_f2) {
    Lower.X = false;
    Clamp.X = false;
  }
  if (_f3) {
    Alarm.X = false;
  }
  if (_f0) {
    Alarm.X = true;
  }
  if (_f1) {
    Lower.X = true;
    Clamp.X = true;
  }
  if (_f2) {
    Ready.X = true;
  }
  if (_f3) {
    Ready.X = true;
  }
  _st0.in = Ready.X;
  _st0.pt = iec::Time{3153600000000000000};
  _st0(scan);
  if (Ready.X) {
    Ready.T = _st0.et;
  }
  _st1.in = Lower.X;
  _st1.pt = iec::Time{3153600000000000000};
  _st1(scan);
  if (Lower.X) {
    Lower.T = _st1.et;
  }
  _st2.in = Clamp.X;
  _st2.pt = iec::Time{3153600000000000000};
  _st2(scan);
  if (Clamp.X) {
    Clamp.T = _st2.et;
  }
  _st3.in = Alarm.X;
  _st3.pt = iec::Time{3153600000000000000};
  _st3(scan);
  if (Alarm.X) {
    Alarm.T = _st3.et;
  }
  if (Lower.X && !_sx1) {
    count = iec::add(count, std::int16_t{1});
  }
  _al1 = Lower.X;
  if (_al1 || _aq1) {
    down = _al1;
  }
  _aq1 = _al1;
  _at2.in = Clamp.X;
  _at2.pt = iec::Time{500000000};
  _at2(scan);
  _al2 = _at2.q;
  if (_al2 || _aq2) {
    clamped = _al2;
  }
  _aq2 = _al2;
  _al3 = Alarm.X;
  if (_al3 || _aq3) {
    horn = fault;
  }
  _aq3 = _al3;
  _sx0 = Ready.X;
  _sx1 = Lower.X;
  _sx2 = Clamp.X;
  _sx3 = Alarm.X;
  _running = true;
}

inline void list::operator()([[maybe_unused]] const iec::Scan& scan) {
  c = a && !b;
}
}  // namespace plc

plc::press instance_press;
plc::list instance_list;


void read_shared() {
}

void write_shared() {
}
// One scan: all variables it sees are from its beginning, what it changed is there at its end.
void one_scan() {
  const iec::Scan scan{irp::release_ns()};
  read_shared();
  instance_press(scan);
  instance_list(scan);
  write_shared();
}
}  // namespace

void POU_PROGRAM() { one_scan(); }
void run() { POU_PROGRAM(); }

// What it keeps between its scans.
extern "C" void indurop_module_state(indurop::StateDescriptor* to) {
  static constexpr std::array<indurop::StateItem, 26> items{
      iec::kept("press.go", "BOOL", instance_press.go),
      iec::kept("press.down", "BOOL", instance_press.down),
      iec::kept("press.clamped", "BOOL", instance_press.clamped),
      iec::kept("press.fault", "BOOL", instance_press.fault),
      iec::kept("press.horn", "BOOL", instance_press.horn),
      iec::kept("press.count", "INT", instance_press.count),
      iec::kept("press.Ready", "SFC_STEP #5e1767297c4aa84b", instance_press.Ready),
      iec::kept("press._st0", "TON", instance_press._st0),
      iec::kept("press._sx0", "BOOL", instance_press._sx0),
      iec::kept("press.Lower", "SFC_STEP #5e1767297c4aa84b", instance_press.Lower),
      iec::kept("press._st1", "TON", instance_press._st1),
      iec::kept("press._sx1", "BOOL", instance_press._sx1),
      iec::kept("press.Clamp", "SFC_STEP #5e1767297c4aa84b", instance_press.Clamp),
      iec::kept("press._st2", "TON", instance_press._st2),
      iec::kept("press._sx2", "BOOL", instance_press._sx2),
      iec::kept("press.Alarm", "SFC_STEP #5e1767297c4aa84b", instance_press.Alarm),
      iec::kept("press._st3", "TON", instance_press._st3),
      iec::kept("press._sx3", "BOOL", instance_press._sx3),
      iec::kept("press._running", "BOOL", instance_press._running),
      iec::kept("press._aq1", "BOOL", instance_press._aq1),
      iec::kept("press._at2", "TON", instance_press._at2),
      iec::kept("press._aq2", "BOOL", instance_press._aq2),
      iec::kept("press._aq3", "BOOL", instance_press._aq3),
      iec::kept("list.a", "BOOL", instance_list.a),
      iec::kept("list.b", "BOOL", instance_list.b),
      iec::kept("list.c", "BOOL", instance_list.c),
  };
  iec::declare_kept(items, nullptr, to);
}

INDUROP_MODULE(run = &::run, name = "golden")
