// SPDX-License-Identifier: Apache-2.0
// What a generated header leaves in a module, by hand: one schema line and the access records of two variables; and
// what the PLC compiler leaves of variables that it cannot declare.

#include <indurop/detail/variable_access.h>

asm(R"(.pushsection .indurop.schema,"G",%progbits,indurop_schema_sample,comdat
.ascii "{\"schema\":1,\"abi\":1,\"variables\":[{\"name\":\"a::x\",\"type\":\"double\",\"kind\":\"scalar\"}]}\n"
.popsection)");

asm(R"asm(.pushsection .indurop.undeclarable,"",%progbits
.ascii "table (an array of more than 1000 addresses)"
.popsection)asm");

namespace {
struct Both {
  static constexpr std::uint64_t kNameHash = 0x1122334455667788;
};
struct OnlyRead {
  static constexpr std::uint64_t kNameHash = 7;
};
double filtered = 0.5;
volatile int untouched = 3;
constexpr int kTable[] = {1, 2, 3};

struct Meter {
  static inline const char* const kUnits[] = {"mm", "rad"};
  static int number;
};
int Meter::number = 1;
}  // namespace

extern "C" {
extern int sample_import();
int sample_data = 0;
void run() {
  indurop::detail::record_access<Both, indurop::detail::kRead>();
  indurop::detail::record_access<Both, indurop::detail::kWrite>();
  indurop::detail::record_access<OnlyRead, indurop::detail::kRead>();
  static int calls = 0;
  static thread_local int calls_of_thread = 0;
  sample_data = sample_import() + kTable[calls % 3] + ++calls_of_thread + untouched + *Meter::kUnits[calls++ % 2];
  filtered += Meter::number++;
}
[[gnu::weak]] int condition() {
  return sample_data;
}
[[gnu::visibility("hidden")]] int sample_hidden() {
  return 1;
}
}
