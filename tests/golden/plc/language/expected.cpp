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
enum class Mode : std::int16_t {
  Off = 0,
  Auto = 1,
  Manual = 2,
};
struct Point {
  float x{};
  float y{};
  iec::String<10> name{};
  friend bool operator==(const Point&, const Point&) = default;
};
template <class From> void copy_fields(Point& to, const From& from) { iec::copy_value(to.x, from.x); iec::copy_value(to.y, from.y); iec::copy_value(to.name, from.name); }
template <class To> void copy_fields(To& to, const Point& from) { iec::copy_value(to.x, from.x); iec::copy_value(to.y, from.y); iec::copy_value(to.name, from.name); }
}  // namespace plc

// What the program sees of the shared variables during a scan.
struct Image {
  bool start{};
  bool motor{};
  std::int16_t speed{};
  plc::Point place{};
  std::array<std::int32_t, 10> list{};
  plc::Mode mode{};
  bool IX0_3{};
};
Image shared;
Image before;

namespace plc {
[[maybe_unused]] const std::int16_t N = std::int16_t{10};
[[maybe_unused]] std::int32_t square([[maybe_unused]] std::int32_t x);
struct Ramp_up {
  bool enable{};
  std::int16_t step = std::int16_t{2};
  std::int16_t value{};
  std::uint32_t count{};
  void operator()(const iec::Scan& scan);
};
struct MAIN {
  iec::Ton delay{};
  plc::Ramp_up ramp{};
  std::int16_t i{};
  std::int32_t sum{};
  float r{};
  void operator()(const iec::Scan& scan);
};

std::int32_t square([[maybe_unused]] std::int32_t x) {
  std::int32_t square_result{};
  square_result = iec::mul(x, x);
  return square_result;
}

inline void Ramp_up::operator()([[maybe_unused]] const iec::Scan& scan) {
  if (enable) {
    value = iec::add(value, step);
    count = iec::add(count, std::uint32_t{1});
  } else {
    value = 0;
  }
}

inline void MAIN::operator()([[maybe_unused]] const iec::Scan& scan) {
  delay.in = shared.start;
  delay.pt = iec::Time{100000000};
  delay(scan);
  shared.motor = delay.q && !shared.IX0_3;
  ramp.enable = shared.motor;
  ramp(scan);
  shared.speed = ramp.value;
  sum = 0;
   {
    std::int64_t counter_1 = 1;
    const std::int64_t end_1 = plc::N;
    for (; counter_1 <= end_1; ++counter_1) {
      const auto i = static_cast<std::int16_t>(counter_1);
      // the sum of all squares
      shared.list[i - 1] = plc::square(static_cast<std::int32_t>(i));
      sum = iec::add(sum, shared.list[i - 1]);
    }
    i = static_cast<std::int16_t>(counter_1);
  }
  r = iec::div({"in.st:55:26", "MAIN"}, iec::to<float>(sum), 2.0F) + iec::sqrt(2.0F);
  shared.place.x = r;
   {
    const std::int16_t case_2 = shared.speed;
    if (case_2 == 0) {
      shared.mode = plc::Mode::Off;
    } else if ((case_2 >= 1 && case_2 <= 5) || case_2 == 7) {
      shared.mode = plc::Mode::Auto;
    } else {
      shared.mode = plc::Mode::Manual;
    }
  }
}
}  // namespace plc

plc::MAIN instance_MAIN;

asm(R"(.pushsection .indurop.access,"",%progbits
.long 3288734364,4016406993,1
.long 2122710761,621967709,3
.long 3986820077,4020119091,1
.long 1170899563,1760137135,3
.popsection)");
constinit const std::array<iec::SharedWord, 3> table_1 {
  iec::SharedWord{&INDUROP_TYPEOF(::golden::motor)::tag_type::ref(), &shared.motor},
  iec::SharedWord{&INDUROP_TYPEOF(::golden::start)::tag_type::ref(), &shared.start},
  iec::SharedWord{&INDUROP_TYPEOF(::golden::IX0_3)::tag_type::ref(), &shared.IX0_3},
};
constinit iec::SharedWords<std::uint8_t, 3, 1> words_1{table_1};
constinit const std::array<iec::SharedWord, 1> table_2 {
  iec::SharedWord{&INDUROP_TYPEOF(::golden::speed)::tag_type::ref(), &shared.speed},
};
constinit iec::SharedWords<std::uint16_t, 1, 1> words_2{table_2};

void read_shared() {
  words_1.read();
  words_2.read();
  iec::read_image(shared.place, ::golden::place);
  iec::read_image(shared.list, ::golden::list);
  iec::read_image(shared.mode, ::golden::mode);
  before = shared;
}

void write_shared() {
  words_1.write();
  words_2.write();
  iec::write_changed(::golden::place.x, shared.place.x, before.place.x);
  iec::write_changed(::golden::list, shared.list, before.list);
  iec::write_changed(::golden::mode, shared.mode, before.mode);
}
// One scan: all variables it sees are from its beginning, what it changed is there at its end.
void one_scan() {
  const iec::Scan scan{irp::release_ns()};
  read_shared();
  instance_MAIN(scan);
  write_shared();
}
}  // namespace

void POU_PROGRAM() { one_scan(); }
void run() { POU_PROGRAM(); }

// What it keeps between its scans.
extern "C" void indurop_module_state(indurop::StateDescriptor* to) {
  static constexpr std::array<indurop::StateItem, 8> items{
      iec::kept("MAIN.delay", "TON", instance_MAIN.delay),
      iec::kept("MAIN.ramp.enable", "BOOL", instance_MAIN.ramp.enable),
      iec::kept("MAIN.ramp.step", "INT", instance_MAIN.ramp.step),
      iec::kept("MAIN.ramp.value", "INT", instance_MAIN.ramp.value),
      iec::kept("MAIN.ramp.count", "UDINT", instance_MAIN.ramp.count),
      iec::kept("MAIN.i", "INT", instance_MAIN.i),
      iec::kept("MAIN.sum", "DINT", instance_MAIN.sum),
      iec::kept("MAIN.r", "REAL", instance_MAIN.r),
  };
  iec::declare_kept(items, nullptr, to);
}

INDUROP_MODULE(run = &::run, name = "golden")
