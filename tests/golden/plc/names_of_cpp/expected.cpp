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
  std::int16_t lock{};
  std::int16_t virtual_{};
  std::int16_t fine{};
};
Image shared;
Image before;

namespace plc {
struct main_ {
  void operator()(const iec::Scan& scan);
};

inline void main_::operator()([[maybe_unused]] const iec::Scan& scan) {
  shared.fine = 1;
  shared.lock = shared.virtual_;
}
}  // namespace plc

plc::main_ instance_main;

asm(R"(.pushsection .indurop.access,"",%progbits
.long 2617284537,3715618131,3
.long 979773781,1195062668,1
.long 2513238408,2420247943,3
.popsection)");
constinit const std::array<iec::SharedWord, 3> table_2 {
  iec::SharedWord{&INDUROP_TYPEOF(::golden::lock_value)::tag_type::ref(), &shared.lock},
  iec::SharedWord{&INDUROP_TYPEOF(::golden::fine)::tag_type::ref(), &shared.fine},
  iec::SharedWord{&INDUROP_TYPEOF(::golden::virtual_value)::tag_type::ref(), &shared.virtual_},
};
constinit iec::SharedWords<std::uint16_t, 3, 2> words_2{table_2};

void read_shared() {
  words_2.read();
}

void write_shared() {
  words_2.write();
}
// One scan: all variables it sees are from its beginning, what it changed is there at its end.
void one_scan() {
  const iec::Scan scan{irp::release_ns()};
  read_shared();
  instance_main(scan);
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

INDUROP_MODULE(run = &::run, name = "golden")
