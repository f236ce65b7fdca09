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

asm(R"indurop(.pushsection .indurop.schema,"G",%progbits,indurop_schema_52c3d8fc012f3d8a,comdat
.ascii "{\"schema\":1,\"abi\":5,\"variables\":[{\"name\":\"cell::both\",\"type\":{\"base\":\"struct\",\"name\":\"cell::Both\",\"s"
.ascii "ize\":8,\"align\":4,\"fields\":[{\"name\":\"dCur\",\"type\":\"int32\",\"offset\":0},{\"name\":\"d_cur\",\"type\":\"int32\","
.ascii "\"offset\":4}]},\"kind\":\"ring\",\"source\":\"in.glb:6\"},{\"name\":\"cell::target\",\"type\":\"double\",\"kind\":\"scal"
.ascii "ar\",\"source\":\"in.glb:8\"}]}"
.ascii "\n"
.popsection)indurop");

namespace cell {
struct Both {
  ::std::int32_t dCur{};
  ::std::int32_t d_cur{};
  friend bool operator==(const Both&, const Both&) = default;
};
static_assert(sizeof(Both) == 8 && alignof(Both) == 4);
static_assert(offsetof(Both, dCur) == 0);
static_assert(offsetof(Both, d_cur) == 4);
template <class indurop_visitor>
constexpr void indurop_fields(const Both& v, indurop_visitor f) {
  f("dCur", v.dCur);
  f("d_cur", v.d_cur);
}
struct Target {
  ::std::int32_t a{};
  friend bool operator==(const Target&, const Target&) = default;
};
static_assert(sizeof(Target) == 4 && alignof(Target) == 4);
static_assert(offsetof(Target, a) == 0);
template <class indurop_visitor>
constexpr void indurop_fields(const Target& v, indurop_visitor f) {
  f("a", v.a);
}
}  // namespace cell

namespace indurop_generated_52c3d8fc012f3d8a __attribute__((visibility("hidden"))) {
inline constinit ::indurop::abi::Ref refs[] = {
    {0x48a5cbd050f86922, 0xe76636a1a2cf9472, nullptr, nullptr, 8, ::indurop::abi::Kind::Ring, "cell::both"},
    {0x415cb53400bc0468, 0xdd744c18ff7ea1ab, nullptr, nullptr, 8, ::indurop::abi::Kind::Scalar, "cell::target"},
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
struct var_cell_both {
  static constexpr ::std::uint64_t kNameHash = 0x48a5cbd050f86922;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Ring;
  static constexpr ::std::size_t kSize = 8;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[0]; }
};
struct var_cell_target {
  static constexpr ::std::uint64_t kNameHash = 0x415cb53400bc0468;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 8;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[1]; }
};
template <class indurop_tag, ::std::uint32_t indurop_offset, class = ::indurop::Adl>
union ref_cell_Both {
  using value_type = ::cell::Both;
  using whole_type = value_type;
  using tag_type = indurop_tag;
  static constexpr ::std::uint32_t kOffset = indurop_offset;
  ::indurop::Place indurop_place;
  ::indurop::Leaf<indurop_tag, ::std::int32_t, indurop_offset + 0> dCur;
  ::indurop::Leaf<indurop_tag, ::std::int32_t, indurop_offset + 4> d_cur;
  INDUROP_UNION_SHAPE(ref_cell_Both)
  INDUROP_FRESHNESS(indurop_tag)
};
template <class indurop_tag, ::std::uint32_t indurop_offset, class = ::indurop::Adl>
union ref_cell_Target {
  using value_type = ::cell::Target;
  using whole_type = value_type;
  using tag_type = indurop_tag;
  static constexpr ::std::uint32_t kOffset = indurop_offset;
  ::indurop::Place indurop_place;
  ::indurop::Leaf<indurop_tag, ::std::int32_t, indurop_offset + 0> a;
  INDUROP_UNION_SHAPE(ref_cell_Target)
  INDUROP_FRESHNESS(indurop_tag)
};
}  // namespace indurop_generated_52c3d8fc012f3d8a

namespace cell {
inline constexpr ::indurop_generated_52c3d8fc012f3d8a::ref_cell_Both<::indurop_generated_52c3d8fc012f3d8a::var_cell_both, 0> both{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr INDUROP_LEAF<::indurop_generated_52c3d8fc012f3d8a::var_cell_target, double, 0> target{::indurop::Place{0}, ::indurop::detail::Make{}};
}  // namespace cell
