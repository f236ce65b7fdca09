// Written by indurop plc from in.st: change that, not this.
#include <indurop/indurop.h>
#include <indurop/plc/library.h>
#include <indurop/plc/program.h>
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

void read_shared() {
  iec::copy_value(shared.lock, ::golden::lock_value.get());
  iec::copy_value(shared.virtual_, ::golden::virtual_value.get());
  iec::copy_value(shared.fine, ::golden::fine.get());
  before = shared;
}

void write_shared() {
  iec::write_changed(::golden::lock_value, shared.lock, before.lock);
  iec::write_changed(::golden::fine, shared.fine, before.fine);
}
}  // namespace

// One scan: all variables it sees are from its beginning, what it changed is there at its end.
void POU_PROGRAM() {
  const iec::Scan scan{irp::release_ns()};
  read_shared();
  instance_main(scan);
  write_shared();
}

void run() { POU_PROGRAM(); }

INDUROP_MODULE(run = &::run, name = "golden")
