// Shared variables of in.glb, written by glb2idl. Do not edit.
#pragma once

#include <indurop/lock.h>
#include <indurop/var.h>

#include <array>
#include <cstddef>
#include <cstdint>

#ifndef INDUROP_LEAF
#define INDUROP_LEAF ::indurop::Leaf
#endif

#include "arm.glb.h"

#include "base.glb.h"

asm(R"indurop(.pushsection .indurop.schema,"G",%progbits,indurop_schema_596cc97f5b73dfa1,comdat
.ascii "{\"schema\":1,\"abi\":5,\"variables\":[{\"name\":\"cell::home\",\"type\":{\"base\":\"struct\",\"name\":\"Point\",\"size\":"
.ascii "16,\"align\":8,\"fields\":[{\"name\":\"x\",\"type\":\"double\",\"offset\":0},{\"name\":\"y\",\"type\":\"double\",\"offset\":"
.ascii "8}]},\"kind\":\"ring\",\"initial\":\"00000000000010400000000000000040\",\"source\":\"in.glb:6\"},{\"name\":\"cell::"
.ascii "joints\",\"type\":{\"base\":\"struct\",\"name\":\"arm::Joint\",\"size\":24,\"align\":8,\"fields\":[{\"name\":\"p\",\"type\""
.ascii ":{\"base\":\"struct\",\"name\":\"Point\",\"size\":16,\"align\":8,\"fields\":[{\"name\":\"x\",\"type\":\"double\",\"offset\":"
.ascii "0},{\"name\":\"y\",\"type\":\"double\",\"offset\":8}]},\"offset\":0},{\"name\":\"angle\",\"type\":\"double\",\"offset\":16"
.ascii "}],\"dims\":[4]},\"kind\":\"ring\",\"source\":\"in.glb:7\"}]}"
.ascii "\n"
.popsection)indurop");

namespace indurop_generated_596cc97f5b73dfa1 __attribute__((visibility("hidden"))) {
inline constexpr ::Point initial_cell_home{4.0, 2.0};
inline constinit ::indurop::abi::Ref refs[] = {
    {0xbbbaf10108cc49ee, 0x4b12722cf7960421, nullptr, &initial_cell_home, 16, ::indurop::abi::Kind::Ring, "cell::home"},
    {0xc70082e710edd62c, 0xde46c4d0554a39ad, nullptr, nullptr, 96, ::indurop::abi::Kind::Ring, "cell::joints"},
};
inline constinit ::std::uint32_t users = 0;
[[gnu::constructor(101)]] inline void bind() {
  if (users++ == 0) {
    indurop_register_refs(refs, 2, ::indurop::abi::kVersion);
  }
}
[[gnu::destructor(101)]] inline void unbind() {
  if (--users == 0) {
    indurop_unregister_refs(refs);
  }
}
struct var_cell_home {
  static constexpr ::std::uint64_t kNameHash = 0xbbbaf10108cc49ee;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Ring;
  static constexpr ::std::size_t kSize = 16;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[0]; }
};
struct var_cell_joints {
  static constexpr ::std::uint64_t kNameHash = 0xc70082e710edd62c;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Ring;
  static constexpr ::std::size_t kSize = 96;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[1]; }
};
}  // namespace indurop_generated_596cc97f5b73dfa1

namespace cell {
inline constexpr ::indurop_generated_19f57a3b786c1d69::ref_Point<::indurop_generated_596cc97f5b73dfa1::var_cell_home, 0> home{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr ::indurop::ArrayRef<::indurop_generated_60bc378070ac8221::ref_arm_Joint<::indurop_generated_596cc97f5b73dfa1::var_cell_joints, 0>, 4> joints{::indurop::Place{0}, ::indurop::detail::Make{}};
}  // namespace cell
