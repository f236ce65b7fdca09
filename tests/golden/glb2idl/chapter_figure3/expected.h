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

asm(R"indurop(.pushsection .indurop.schema,"G",%progbits,indurop_schema_87455c64b2b427de,comdat
.ascii "{\"schema\":1,\"abi\":5,\"variables\":[{\"name\":\"knu::Robot::tick\",\"type\":\"uint32\",\"kind\":\"scalar\",\"source\""
.ascii ":\"in.glb:3\"},{\"name\":\"knu::Robot::joints\",\"type\":{\"base\":\"struct\",\"name\":\"knu::Robot::joints_t\",\"siz"
.ascii "e\":24,\"align\":8,\"fields\":[{\"name\":\"x\",\"type\":\"double\",\"offset\":0},{\"name\":\"y\",\"type\":\"double\",\"offse"
.ascii "t\":8},{\"name\":\"z\",\"type\":\"double\",\"offset\":16}],\"dims\":[10]},\"kind\":\"ring\",\"source\":\"in.glb:6\"}]}"
.ascii "\n"
.popsection)indurop");

namespace knu::Robot {
struct joints_t {
  double x{};
  double y{};
  double z{};
  friend bool operator==(const joints_t&, const joints_t&) = default;
};
static_assert(sizeof(joints_t) == 24 && alignof(joints_t) == 8);
static_assert(offsetof(joints_t, x) == 0);
static_assert(offsetof(joints_t, y) == 8);
static_assert(offsetof(joints_t, z) == 16);
template <class indurop_visitor>
constexpr void indurop_fields(const joints_t& v, indurop_visitor f) {
  f("x", v.x);
  f("y", v.y);
  f("z", v.z);
}
}  // namespace knu::Robot

namespace indurop_generated_87455c64b2b427de __attribute__((visibility("hidden"))) {
inline constinit ::indurop::abi::Ref refs[] = {
    {0xf1dc60870b76ee98, 0x4d2bdf193e8526d1, nullptr, nullptr, 4, ::indurop::abi::Kind::Scalar, "knu::Robot::tick"},
    {0x1050cb5f44a9d9d0, 0xfcf46c306778d7e4, nullptr, nullptr, 240, ::indurop::abi::Kind::Ring, "knu::Robot::joints"},
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
struct var_knu_Robot_tick {
  static constexpr ::std::uint64_t kNameHash = 0xf1dc60870b76ee98;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 4;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[0]; }
};
struct var_knu_Robot_joints {
  static constexpr ::std::uint64_t kNameHash = 0x1050cb5f44a9d9d0;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Ring;
  static constexpr ::std::size_t kSize = 240;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[1]; }
};
template <class indurop_tag, ::std::uint32_t indurop_offset, class = ::indurop::Adl>
union ref_knu_Robot_joints_t {
  using value_type = ::knu::Robot::joints_t;
  using whole_type = value_type;
  using tag_type = indurop_tag;
  static constexpr ::std::uint32_t kOffset = indurop_offset;
  ::indurop::Place indurop_place;
  ::indurop::Leaf<indurop_tag, double, indurop_offset + 0> x;
  ::indurop::Leaf<indurop_tag, double, indurop_offset + 8> y;
  ::indurop::Leaf<indurop_tag, double, indurop_offset + 16> z;
  INDUROP_UNION_SHAPE(ref_knu_Robot_joints_t)
  INDUROP_FRESHNESS(indurop_tag)
};
}  // namespace indurop_generated_87455c64b2b427de

namespace knu::Robot {
inline constexpr INDUROP_LEAF<::indurop_generated_87455c64b2b427de::var_knu_Robot_tick, ::std::uint32_t, 0> tick{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr ::indurop::ArrayRef<::indurop_generated_87455c64b2b427de::ref_knu_Robot_joints_t<::indurop_generated_87455c64b2b427de::var_knu_Robot_joints, 0>, 10> joints{::indurop::Place{0}, ::indurop::detail::Make{}};
}  // namespace knu::Robot
