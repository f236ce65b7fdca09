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

asm(R"indurop(.pushsection .indurop.schema,"G",%progbits,indurop_schema_a4ecf0246d5171c5,comdat
.ascii "{\"schema\":1,\"abi\":5,\"variables\":[{\"name\":\"dos::a\",\"type\":\"int32\",\"kind\":\"scalar\",\"description\":\"firs"
.ascii "t\",\"source\":\"in.glb:2\"},{\"name\":\"dos::b\",\"type\":\"int32\",\"kind\":\"scalar\",\"description\":\"two lines\",\"s"
.ascii "ource\":\"in.glb:5\"},{\"name\":\"dos::c\",\"type\":{\"base\":\"int32\",\"dims\":[3]},\"kind\":\"ring\",\"source\":\"in.gl"
.ascii "b:8\"}]}"
.ascii "\n"
.popsection)indurop");

namespace dos {
inline constexpr ::std::int32_t N{3};
}  // namespace dos

namespace indurop_generated_a4ecf0246d5171c5 __attribute__((visibility("hidden"))) {
inline constinit ::indurop::abi::Ref refs[] = {
    {0x7e22bed0aa866d7c, 0x2af2b3192b419145, nullptr, nullptr, 4, ::indurop::abi::Kind::Scalar, "dos::a"},
    {0x7e22c1d0aa867295, 0x2af2b3192b419145, nullptr, nullptr, 4, ::indurop::abi::Kind::Scalar, "dos::b"},
    {0x7e22c0d0aa8670e2, 0xbb14d8295c4cb7a2, nullptr, nullptr, 12, ::indurop::abi::Kind::Ring, "dos::c"},
};
inline constinit ::std::uint32_t users = 0;
[[gnu::constructor(101)]] inline void bind() {
  if (users++ == 0) {
    indurop_register_refs(refs, 3, ::indurop::abi::kVersion);
  }
}
[[gnu::destructor(101)]] inline void unbind() {
  if (--users == 0) {
    indurop_unregister_refs(refs);
  }
}
struct var_dos_a {
  static constexpr ::std::uint64_t kNameHash = 0x7e22bed0aa866d7c;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 4;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[0]; }
};
struct var_dos_b {
  static constexpr ::std::uint64_t kNameHash = 0x7e22c1d0aa867295;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 4;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[1]; }
};
struct var_dos_c {
  static constexpr ::std::uint64_t kNameHash = 0x7e22c0d0aa8670e2;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Ring;
  static constexpr ::std::size_t kSize = 12;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[2]; }
};
}  // namespace indurop_generated_a4ecf0246d5171c5

namespace dos {
inline constexpr INDUROP_LEAF<::indurop_generated_a4ecf0246d5171c5::var_dos_a, ::std::int32_t, 0> a{::indurop::Place{0}, ::indurop::detail::Make{}};  // first
inline constexpr INDUROP_LEAF<::indurop_generated_a4ecf0246d5171c5::var_dos_b, ::std::int32_t, 0> b{::indurop::Place{0}, ::indurop::detail::Make{}};  // two lines
inline constexpr ::indurop::ArrayRef<::indurop::Leaf<::indurop_generated_a4ecf0246d5171c5::var_dos_c, ::std::int32_t, 0>, 3> c{::indurop::Place{0}, ::indurop::detail::Make{}};
}  // namespace dos
