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

asm(R"indurop(.pushsection .indurop.schema,"G",%progbits,indurop_schema_22395bf62343e1ab,comdat
.ascii "{\"schema\":1,\"abi\":5,\"variables\":[{\"name\":\"cell::Arm::state\",\"type\":{\"base\":\"struct\",\"name\":\"cell::Ar"
.ascii "m::state_t\",\"size\":144,\"align\":8,\"fields\":[{\"name\":\"dCurJoint\",\"type\":{\"base\":\"float\",\"dims\":[6]},\"o"
.ascii "ffset\":0,\"description\":\"of the six axes\"},{\"name\":\"pose\",\"type\":{\"base\":\"struct\",\"name\":\"cell::Arm::"
.ascii "TcpPose\",\"size\":16,\"align\":8,\"fields\":[{\"name\":\"x\",\"type\":\"double\",\"offset\":0,\"unit\":\"mm\",\"range\":[-"
.ascii "500.0,500.0]},{\"name\":\"rotZ\",\"type\":\"double\",\"offset\":8}]},\"offset\":24},{\"name\":\"path\",\"type\":{\"base"
.ascii "\":\"struct\",\"name\":\"cell::Arm::TcpPose\",\"size\":16,\"align\":8,\"fields\":[{\"name\":\"x\",\"type\":\"double\",\"of"
.ascii "fset\":0,\"unit\":\"mm\",\"range\":[-500.0,500.0]},{\"name\":\"rotZ\",\"type\":\"double\",\"offset\":8}],\"dims\":[4]},"
.ascii "\"offset\":40},{\"name\":\"mode\",\"type\":{\"base\":\"enum\",\"name\":\"cell::Arm::Mode\",\"values\":[[\"HOLDING\",0],["
.ascii "\"movingFast\",1]]},\"offset\":104},{\"name\":\"program\",\"type\":{\"base\":\"text\",\"size\":16},\"offset\":108},{\"n"
.ascii "ame\":\"grid\",\"type\":{\"base\":\"int16\",\"dims\":[2,3]},\"offset\":124},{\"name\":\"letter\",\"type\":\"char\",\"offse"
.ascii "t\":136},{\"name\":\"inside\",\"type\":\"bool\",\"offset\":137}]},\"kind\":\"ring\",\"source\":\"in.glb:20\"},{\"name\":\""
.ascii "cell::Arm::target\",\"type\":\"double\",\"kind\":\"scalar\",\"unit\":\"mm\",\"description\":\"where to go\",\"initial\""
.ascii ":\"0000000000005940\",\"source\":\"in.glb:22\"},{\"name\":\"cell::Hand::grip_poses\",\"type\":{\"base\":\"struct\",\""
.ascii "name\":\"cell::Arm::TcpPose\",\"size\":16,\"align\":8,\"fields\":[{\"name\":\"x\",\"type\":\"double\",\"offset\":0,\"uni"
.ascii "t\":\"mm\",\"range\":[-500.0,500.0]},{\"name\":\"rotZ\",\"type\":\"double\",\"offset\":8}],\"dims\":[2]},\"kind\":\"ring"
.ascii "\",\"source\":\"in.glb:25\"}]}"
.ascii "\n"
.popsection)indurop");

namespace cell::Arm {
enum Mode : ::std::int32_t { HOLDING = 0, movingFast = 1 };
struct TcpPose {
  double x{};  // [mm]
  double rotZ{};
  friend bool operator==(const TcpPose&, const TcpPose&) = default;
};
static_assert(sizeof(TcpPose) == 16 && alignof(TcpPose) == 8);
static_assert(offsetof(TcpPose, x) == 0);
static_assert(offsetof(TcpPose, rotZ) == 8);
template <class indurop_visitor>
constexpr void indurop_fields(const TcpPose& v, indurop_visitor f) {
  f("x", v.x);
  f("rotZ", v.rotZ);
}
struct state_t {
  ::std::array<float, 6> dCurJoint{};  // of the six axes
  ::cell::Arm::TcpPose pose{};
  ::std::array<::cell::Arm::TcpPose, 4> path{};
  ::cell::Arm::Mode mode{};
  ::indurop::string<16> program{};
  ::std::array<::std::array<::std::int16_t, 3>, 2> grid{};
  char letter{};
  bool inside{};
  friend bool operator==(const state_t&, const state_t&) = default;
};
static_assert(sizeof(state_t) == 144 && alignof(state_t) == 8);
static_assert(offsetof(state_t, dCurJoint) == 0);
static_assert(offsetof(state_t, pose) == 24);
static_assert(offsetof(state_t, path) == 40);
static_assert(offsetof(state_t, mode) == 104);
static_assert(offsetof(state_t, program) == 108);
static_assert(offsetof(state_t, grid) == 124);
static_assert(offsetof(state_t, letter) == 136);
static_assert(offsetof(state_t, inside) == 137);
template <class indurop_visitor>
constexpr void indurop_fields(const state_t& v, indurop_visitor f) {
  f("dCurJoint", v.dCurJoint);
  f("pose", v.pose);
  f("path", v.path);
  f("mode", v.mode);
  f("program", v.program);
  f("grid", v.grid);
  f("letter", v.letter);
  f("inside", v.inside);
}
}  // namespace cell::Arm

namespace indurop_generated_22395bf62343e1ab __attribute__((visibility("hidden"))) {
inline constexpr double initial_cell_Arm_target{100.0};
inline constinit ::indurop::abi::Ref refs[] = {
    {0x791e23e227f9b276, 0x31e5c9b2aef03a83, nullptr, nullptr, 144, ::indurop::abi::Kind::Ring, "cell::Arm::state"},
    {0x19d0793cd247f3c8, 0xdd744c18ff7ea1ab, nullptr, &initial_cell_Arm_target, 8, ::indurop::abi::Kind::Scalar, "cell::Arm::target"},
    {0x876cc254d6af298d, 0xc2d70b9dbcfab323, nullptr, nullptr, 32, ::indurop::abi::Kind::Ring, "cell::Hand::grip_poses"},
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
struct var_cell_Arm_state {
  static constexpr ::std::uint64_t kNameHash = 0x791e23e227f9b276;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Ring;
  static constexpr ::std::size_t kSize = 144;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[0]; }
};
struct var_cell_Arm_target {
  static constexpr ::std::uint64_t kNameHash = 0x19d0793cd247f3c8;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 8;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[1]; }
};
struct var_cell_Hand_grip_poses {
  static constexpr ::std::uint64_t kNameHash = 0x876cc254d6af298d;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Ring;
  static constexpr ::std::size_t kSize = 32;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[2]; }
};
template <class indurop_tag, ::std::uint32_t indurop_offset, class = ::indurop::Adl>
union ref_cell_Arm_TcpPose {
  using value_type = ::cell::Arm::TcpPose;
  using whole_type = value_type;
  using tag_type = indurop_tag;
  static constexpr ::std::uint32_t kOffset = indurop_offset;
  ::indurop::Place indurop_place;
  ::indurop::Leaf<indurop_tag, double, indurop_offset + 0> x;
  ::indurop::Leaf<indurop_tag, double, indurop_offset + 8> rotZ;
  INDUROP_UNION_SHAPE(ref_cell_Arm_TcpPose)
  INDUROP_FRESHNESS(indurop_tag)
};
template <class indurop_tag, ::std::uint32_t indurop_offset, class = ::indurop::Adl>
union ref_cell_Arm_state_t {
  using value_type = ::cell::Arm::state_t;
  using whole_type = value_type;
  using tag_type = indurop_tag;
  static constexpr ::std::uint32_t kOffset = indurop_offset;
  ::indurop::Place indurop_place;
  ::indurop::ArrayRef<::indurop::Leaf<indurop_tag, float, indurop_offset + 0>, 6> dCurJoint;
  ::indurop_generated_22395bf62343e1ab::ref_cell_Arm_TcpPose<indurop_tag, indurop_offset + 24> pose;
  ::indurop::ArrayRef<::indurop_generated_22395bf62343e1ab::ref_cell_Arm_TcpPose<indurop_tag, indurop_offset + 40>, 4> path;
  ::indurop::Leaf<indurop_tag, ::cell::Arm::Mode, indurop_offset + 104> mode;
  ::indurop::Text<indurop_tag, 16, indurop_offset + 108> program;
  ::indurop::ArrayRef<::indurop::ArrayRef<::indurop::Leaf<indurop_tag, ::std::int16_t, indurop_offset + 124>, 3>, 2> grid;
  ::indurop::Leaf<indurop_tag, char, indurop_offset + 136> letter;
  ::indurop::Leaf<indurop_tag, bool, indurop_offset + 137> inside;
  INDUROP_UNION_SHAPE(ref_cell_Arm_state_t)
  INDUROP_FRESHNESS(indurop_tag)
};
}  // namespace indurop_generated_22395bf62343e1ab

namespace cell::Arm {
inline constexpr ::indurop_generated_22395bf62343e1ab::ref_cell_Arm_state_t<::indurop_generated_22395bf62343e1ab::var_cell_Arm_state, 0> state{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr INDUROP_LEAF<::indurop_generated_22395bf62343e1ab::var_cell_Arm_target, double, 0> target{::indurop::Place{0}, ::indurop::detail::Make{}};  // where to go [mm]
}  // namespace cell::Arm

namespace cell::Hand {
inline constexpr ::indurop::ArrayRef<::indurop_generated_22395bf62343e1ab::ref_cell_Arm_TcpPose<::indurop_generated_22395bf62343e1ab::var_cell_Hand_grip_poses, 0>, 2> grip_poses{::indurop::Place{0}, ::indurop::detail::Make{}};
}  // namespace cell::Hand
