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

asm(R"indurop(.pushsection .indurop.schema,"G",%progbits,indurop_schema_a279fd697389e543,comdat
.ascii "{\"schema\":1,\"abi\":5,\"variables\":[{\"name\":\"PLC_ROBOT::I0\",\"type\":\"int16\",\"kind\":\"scalar\",\"description"
.ascii "\":\"PLC input point 0\",\"source\":\"in.glb:2\"},{\"name\":\"PLC_ROBOT::I1\",\"type\":\"int16\",\"kind\":\"scalar\",\"d"
.ascii "escription\":\"PLC input point 1\",\"source\":\"in.glb:3\"},{\"name\":\"PLC_ROBOT::O0\",\"type\":\"int16\",\"kind\":\""
.ascii "scalar\",\"description\":\"PLC output point 0\",\"source\":\"in.glb:4\"},{\"name\":\"PLC_ROBOT::ROBOT_MODULE_STA"
.ascii "TE\",\"type\":{\"base\":\"struct\",\"name\":\"PLC_ROBOT::ROBOT_MODULE_STATE_t\",\"size\":408,\"align\":8,\"fields\":["
.ascii "{\"name\":\"nAXESGROUP\",\"type\":\"uint16\",\"offset\":0},{\"name\":\"MotionDone\",\"type\":\"int16\",\"offset\":2},{\"n"
.ascii "ame\":\"Busy\",\"type\":\"int16\",\"offset\":4},{\"name\":\"eState\",\"type\":\"int16\",\"offset\":6},{\"name\":\"bRuntime"
.ascii "Service\",\"type\":\"int16\",\"offset\":8,\"description\":\"Motion command interpreting\"},{\"name\":\"bJob_RobotM"
.ascii "oving\",\"type\":\"int16\",\"offset\":10},{\"name\":\"dCurJoint\",\"type\":{\"base\":\"uint64\",\"dims\":[6]},\"offset\":"
.ascii "16,\"description\":\"servo current joint angle 6 --> MAX_JOINTS\"},{\"name\":\"dCmdJoint\",\"type\":{\"base\":\"u"
.ascii "int64\",\"dims\":[6]},\"offset\":64,\"description\":\"servo command joint angle 6 --> MAX_JOINTS\"},{\"name\":\""
.ascii "dWorldPos\",\"type\":{\"base\":\"uint64\",\"dims\":[6]},\"offset\":112,\"description\":\"world position (command p"
.ascii "osition)\"},{\"name\":\"dUserPos\",\"type\":{\"base\":\"uint64\",\"dims\":[6]},\"offset\":160,\"description\":\"User p"
.ascii "osition (command position)\"},{\"name\":\"dBasePos\",\"type\":{\"base\":\"uint64\",\"dims\":[6]},\"offset\":208,\"de"
.ascii "scription\":\"Base position (command position)\"},{\"name\":\"dJointSpeed\",\"type\":{\"base\":\"uint64\",\"dims\":"
.ascii "[6]},\"offset\":256,\"description\":\"6 --> MAX_JOINTS\"},{\"name\":\"dBaseSpeed\",\"type\":{\"base\":\"uint64\",\"di"
.ascii "ms\":[6]},\"offset\":304},{\"name\":\"dWorldSpeed\",\"type\":{\"base\":\"uint64\",\"dims\":[6]},\"offset\":352},{\"nam"
.ascii "e\":\"nposeINFO\",\"type\":{\"base\":\"uint8\",\"dims\":[6]},\"offset\":400,\"description\":\"6 --> MAX_JOINTS\"}]},\""
.ascii "kind\":\"ring\",\"description\":\"External Information\",\"source\":\"in.glb:22\"},{\"name\":\"PLC_ROBOT::ROBOT_MO"
.ascii "DULE_SERVICE\",\"type\":{\"base\":\"struct\",\"name\":\"PLC_ROBOT::ROBOT_MODULE_SERVICE_t\",\"size\":24,\"align\":8"
.ascii ",\"fields\":[{\"name\":\"eOpCode\",\"type\":\"int32\",\"offset\":0},{\"name\":\"t_pl\",\"type\":\"uint16\",\"offset\":4,\"d"
.ascii "escription\":\"position level\"},{\"name\":\"t_speed\",\"type\":\"uint64\",\"offset\":8,\"description\":\"speed\"},{\""
.ascii "name\":\"p_Target\",\"type\":\"uint16\",\"offset\":16},{\"name\":\"p_Mid\",\"type\":\"uint16\",\"offset\":18}]},\"kind\":"
.ascii "\"ring\",\"description\":\"To ROBOT MODULE\",\"source\":\"in.glb:29\"},{\"name\":\"PLC_ROBOT::AXIS1_IN\",\"type\":{\""
.ascii "base\":\"struct\",\"name\":\"PLC_ROBOT::AXIS1_IN_t\",\"size\":12,\"align\":4,\"fields\":[{\"name\":\"error\",\"type\":\""
.ascii "uint16\",\"offset\":0},{\"name\":\"status\",\"type\":\"uint16\",\"offset\":2},{\"name\":\"mode\",\"type\":\"int8\",\"offse"
.ascii "t\":4},{\"name\":\"position\",\"type\":\"int32\",\"offset\":8}]},\"kind\":\"ring\",\"source\":\"in.glb:35\"}]}"
.ascii "\n"
.popsection)indurop");

namespace PLC_ROBOT {
inline constexpr ::std::int32_t MAX_JOINTS{6};
struct ROBOT_MODULE_STATE_t {  // External Information
  ::std::uint16_t nAXESGROUP{};
  ::std::int16_t MotionDone{};
  ::std::int16_t Busy{};
  ::std::int16_t eState{};
  ::std::int16_t bRuntimeService{};  // Motion command interpreting
  ::std::int16_t bJob_RobotMoving{};
  ::std::array<::std::uint64_t, 6> dCurJoint{};  // servo current joint angle 6 --> MAX_JOINTS
  ::std::array<::std::uint64_t, 6> dCmdJoint{};  // servo command joint angle 6 --> MAX_JOINTS
  ::std::array<::std::uint64_t, 6> dWorldPos{};  // world position (command position)
  ::std::array<::std::uint64_t, 6> dUserPos{};  // User position (command position)
  ::std::array<::std::uint64_t, 6> dBasePos{};  // Base position (command position)
  ::std::array<::std::uint64_t, 6> dJointSpeed{};  // 6 --> MAX_JOINTS
  ::std::array<::std::uint64_t, 6> dBaseSpeed{};
  ::std::array<::std::uint64_t, 6> dWorldSpeed{};
  ::std::array<::std::uint8_t, 6> nposeINFO{};  // 6 --> MAX_JOINTS
  friend bool operator==(const ROBOT_MODULE_STATE_t&, const ROBOT_MODULE_STATE_t&) = default;
};
static_assert(sizeof(ROBOT_MODULE_STATE_t) == 408 && alignof(ROBOT_MODULE_STATE_t) == 8);
static_assert(offsetof(ROBOT_MODULE_STATE_t, nAXESGROUP) == 0);
static_assert(offsetof(ROBOT_MODULE_STATE_t, MotionDone) == 2);
static_assert(offsetof(ROBOT_MODULE_STATE_t, Busy) == 4);
static_assert(offsetof(ROBOT_MODULE_STATE_t, eState) == 6);
static_assert(offsetof(ROBOT_MODULE_STATE_t, bRuntimeService) == 8);
static_assert(offsetof(ROBOT_MODULE_STATE_t, bJob_RobotMoving) == 10);
static_assert(offsetof(ROBOT_MODULE_STATE_t, dCurJoint) == 16);
static_assert(offsetof(ROBOT_MODULE_STATE_t, dCmdJoint) == 64);
static_assert(offsetof(ROBOT_MODULE_STATE_t, dWorldPos) == 112);
static_assert(offsetof(ROBOT_MODULE_STATE_t, dUserPos) == 160);
static_assert(offsetof(ROBOT_MODULE_STATE_t, dBasePos) == 208);
static_assert(offsetof(ROBOT_MODULE_STATE_t, dJointSpeed) == 256);
static_assert(offsetof(ROBOT_MODULE_STATE_t, dBaseSpeed) == 304);
static_assert(offsetof(ROBOT_MODULE_STATE_t, dWorldSpeed) == 352);
static_assert(offsetof(ROBOT_MODULE_STATE_t, nposeINFO) == 400);
template <class indurop_visitor>
constexpr void indurop_fields(const ROBOT_MODULE_STATE_t& v, indurop_visitor f) {
  f("nAXESGROUP", v.nAXESGROUP);
  f("MotionDone", v.MotionDone);
  f("Busy", v.Busy);
  f("eState", v.eState);
  f("bRuntimeService", v.bRuntimeService);
  f("bJob_RobotMoving", v.bJob_RobotMoving);
  f("dCurJoint", v.dCurJoint);
  f("dCmdJoint", v.dCmdJoint);
  f("dWorldPos", v.dWorldPos);
  f("dUserPos", v.dUserPos);
  f("dBasePos", v.dBasePos);
  f("dJointSpeed", v.dJointSpeed);
  f("dBaseSpeed", v.dBaseSpeed);
  f("dWorldSpeed", v.dWorldSpeed);
  f("nposeINFO", v.nposeINFO);
}
struct ROBOT_MODULE_SERVICE_t {  // To ROBOT MODULE
  ::std::int32_t eOpCode{};
  ::std::uint16_t t_pl{};  // position level
  ::std::uint64_t t_speed{};  // speed
  ::std::uint16_t p_Target{};
  ::std::uint16_t p_Mid{};
  friend bool operator==(const ROBOT_MODULE_SERVICE_t&, const ROBOT_MODULE_SERVICE_t&) = default;
};
static_assert(sizeof(ROBOT_MODULE_SERVICE_t) == 24 && alignof(ROBOT_MODULE_SERVICE_t) == 8);
static_assert(offsetof(ROBOT_MODULE_SERVICE_t, eOpCode) == 0);
static_assert(offsetof(ROBOT_MODULE_SERVICE_t, t_pl) == 4);
static_assert(offsetof(ROBOT_MODULE_SERVICE_t, t_speed) == 8);
static_assert(offsetof(ROBOT_MODULE_SERVICE_t, p_Target) == 16);
static_assert(offsetof(ROBOT_MODULE_SERVICE_t, p_Mid) == 18);
template <class indurop_visitor>
constexpr void indurop_fields(const ROBOT_MODULE_SERVICE_t& v, indurop_visitor f) {
  f("eOpCode", v.eOpCode);
  f("t_pl", v.t_pl);
  f("t_speed", v.t_speed);
  f("p_Target", v.p_Target);
  f("p_Mid", v.p_Mid);
}
struct AXIS1_IN_t {
  ::std::uint16_t error{};
  ::std::uint16_t status{};
  ::std::int8_t mode{};
  ::std::int32_t position{};
  friend bool operator==(const AXIS1_IN_t&, const AXIS1_IN_t&) = default;
};
static_assert(sizeof(AXIS1_IN_t) == 12 && alignof(AXIS1_IN_t) == 4);
static_assert(offsetof(AXIS1_IN_t, error) == 0);
static_assert(offsetof(AXIS1_IN_t, status) == 2);
static_assert(offsetof(AXIS1_IN_t, mode) == 4);
static_assert(offsetof(AXIS1_IN_t, position) == 8);
template <class indurop_visitor>
constexpr void indurop_fields(const AXIS1_IN_t& v, indurop_visitor f) {
  f("error", v.error);
  f("status", v.status);
  f("mode", v.mode);
  f("position", v.position);
}
}  // namespace PLC_ROBOT

namespace indurop_generated_a279fd697389e543 __attribute__((visibility("hidden"))) {
inline constinit ::indurop::abi::Ref refs[] = {
    {0xa2e56741e5d74570, 0x2aebbf192b3b86fb, nullptr, nullptr, 2, ::indurop::abi::Kind::Scalar, "PLC_ROBOT::I0"},
    {0xa2e56841e5d74723, 0x2aebbf192b3b86fb, nullptr, nullptr, 2, ::indurop::abi::Kind::Scalar, "PLC_ROBOT::I1"},
    {0xa2f9eb41e5e8cec6, 0x2aebbf192b3b86fb, nullptr, nullptr, 2, ::indurop::abi::Kind::Scalar, "PLC_ROBOT::O0"},
    {0x33065a90e698b70a, 0x9b75892af0b1c5c4, nullptr, nullptr, 408, ::indurop::abi::Kind::Ring, "PLC_ROBOT::ROBOT_MODULE_STATE"},
    {0xaf2df9b9a1ffc198, 0xdf76e8167c01cdc7, nullptr, nullptr, 24, ::indurop::abi::Kind::Ring, "PLC_ROBOT::ROBOT_MODULE_SERVICE"},
    {0xbbff3cfd5c1fbae3, 0xa2510b2ab3df67cd, nullptr, nullptr, 12, ::indurop::abi::Kind::Ring, "PLC_ROBOT::AXIS1_IN"},
};
inline constinit ::std::uint32_t users = 0;
[[gnu::constructor(101)]] inline void bind() {
  if (users++ == 0) {
    indurop_register_refs(refs, 6, ::indurop::abi::kVersion);
  }
}
[[gnu::destructor(101)]] inline void unbind() {
  if (--users == 0) {
    indurop_unregister_refs(refs);
  }
}
struct var_PLC_ROBOT_I0 {
  static constexpr ::std::uint64_t kNameHash = 0xa2e56741e5d74570;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 2;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[0]; }
};
struct var_PLC_ROBOT_I1 {
  static constexpr ::std::uint64_t kNameHash = 0xa2e56841e5d74723;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 2;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[1]; }
};
struct var_PLC_ROBOT_O0 {
  static constexpr ::std::uint64_t kNameHash = 0xa2f9eb41e5e8cec6;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 2;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[2]; }
};
struct var_PLC_ROBOT_ROBOT_MODULE_STATE {
  static constexpr ::std::uint64_t kNameHash = 0x33065a90e698b70a;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Ring;
  static constexpr ::std::size_t kSize = 408;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[3]; }
};
struct var_PLC_ROBOT_ROBOT_MODULE_SERVICE {
  static constexpr ::std::uint64_t kNameHash = 0xaf2df9b9a1ffc198;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Ring;
  static constexpr ::std::size_t kSize = 24;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[4]; }
};
struct var_PLC_ROBOT_AXIS1_IN {
  static constexpr ::std::uint64_t kNameHash = 0xbbff3cfd5c1fbae3;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Ring;
  static constexpr ::std::size_t kSize = 12;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[5]; }
};
template <class indurop_tag, ::std::uint32_t indurop_offset, class = ::indurop::Adl>
union ref_PLC_ROBOT_ROBOT_MODULE_STATE_t {
  using value_type = ::PLC_ROBOT::ROBOT_MODULE_STATE_t;
  using whole_type = value_type;
  using tag_type = indurop_tag;
  static constexpr ::std::uint32_t kOffset = indurop_offset;
  ::indurop::Place indurop_place;
  ::indurop::Leaf<indurop_tag, ::std::uint16_t, indurop_offset + 0> nAXESGROUP;
  ::indurop::Leaf<indurop_tag, ::std::int16_t, indurop_offset + 2> MotionDone;
  ::indurop::Leaf<indurop_tag, ::std::int16_t, indurop_offset + 4> Busy;
  ::indurop::Leaf<indurop_tag, ::std::int16_t, indurop_offset + 6> eState;
  ::indurop::Leaf<indurop_tag, ::std::int16_t, indurop_offset + 8> bRuntimeService;
  ::indurop::Leaf<indurop_tag, ::std::int16_t, indurop_offset + 10> bJob_RobotMoving;
  ::indurop::ArrayRef<::indurop::Leaf<indurop_tag, ::std::uint64_t, indurop_offset + 16>, 6> dCurJoint;
  ::indurop::ArrayRef<::indurop::Leaf<indurop_tag, ::std::uint64_t, indurop_offset + 64>, 6> dCmdJoint;
  ::indurop::ArrayRef<::indurop::Leaf<indurop_tag, ::std::uint64_t, indurop_offset + 112>, 6> dWorldPos;
  ::indurop::ArrayRef<::indurop::Leaf<indurop_tag, ::std::uint64_t, indurop_offset + 160>, 6> dUserPos;
  ::indurop::ArrayRef<::indurop::Leaf<indurop_tag, ::std::uint64_t, indurop_offset + 208>, 6> dBasePos;
  ::indurop::ArrayRef<::indurop::Leaf<indurop_tag, ::std::uint64_t, indurop_offset + 256>, 6> dJointSpeed;
  ::indurop::ArrayRef<::indurop::Leaf<indurop_tag, ::std::uint64_t, indurop_offset + 304>, 6> dBaseSpeed;
  ::indurop::ArrayRef<::indurop::Leaf<indurop_tag, ::std::uint64_t, indurop_offset + 352>, 6> dWorldSpeed;
  ::indurop::ArrayRef<::indurop::Leaf<indurop_tag, ::std::uint8_t, indurop_offset + 400>, 6> nposeINFO;
  INDUROP_UNION_SHAPE(ref_PLC_ROBOT_ROBOT_MODULE_STATE_t)
  INDUROP_FRESHNESS(indurop_tag)
};
template <class indurop_tag, ::std::uint32_t indurop_offset, class = ::indurop::Adl>
union ref_PLC_ROBOT_ROBOT_MODULE_SERVICE_t {
  using value_type = ::PLC_ROBOT::ROBOT_MODULE_SERVICE_t;
  using whole_type = value_type;
  using tag_type = indurop_tag;
  static constexpr ::std::uint32_t kOffset = indurop_offset;
  ::indurop::Place indurop_place;
  ::indurop::Leaf<indurop_tag, ::std::int32_t, indurop_offset + 0> eOpCode;
  ::indurop::Leaf<indurop_tag, ::std::uint16_t, indurop_offset + 4> t_pl;
  ::indurop::Leaf<indurop_tag, ::std::uint64_t, indurop_offset + 8> t_speed;
  ::indurop::Leaf<indurop_tag, ::std::uint16_t, indurop_offset + 16> p_Target;
  ::indurop::Leaf<indurop_tag, ::std::uint16_t, indurop_offset + 18> p_Mid;
  INDUROP_UNION_SHAPE(ref_PLC_ROBOT_ROBOT_MODULE_SERVICE_t)
  INDUROP_FRESHNESS(indurop_tag)
};
template <class indurop_tag, ::std::uint32_t indurop_offset, class = ::indurop::Adl>
union ref_PLC_ROBOT_AXIS1_IN_t {
  using value_type = ::PLC_ROBOT::AXIS1_IN_t;
  using whole_type = value_type;
  using tag_type = indurop_tag;
  static constexpr ::std::uint32_t kOffset = indurop_offset;
  ::indurop::Place indurop_place;
  ::indurop::Leaf<indurop_tag, ::std::uint16_t, indurop_offset + 0> error;
  ::indurop::Leaf<indurop_tag, ::std::uint16_t, indurop_offset + 2> status;
  ::indurop::Leaf<indurop_tag, ::std::int8_t, indurop_offset + 4> mode;
  ::indurop::Leaf<indurop_tag, ::std::int32_t, indurop_offset + 8> position;
  INDUROP_UNION_SHAPE(ref_PLC_ROBOT_AXIS1_IN_t)
  INDUROP_FRESHNESS(indurop_tag)
};
}  // namespace indurop_generated_a279fd697389e543

namespace PLC_ROBOT {
inline constexpr INDUROP_LEAF<::indurop_generated_a279fd697389e543::var_PLC_ROBOT_I0, ::std::int16_t, 0> I0{::indurop::Place{0}, ::indurop::detail::Make{}};  // PLC input point 0
inline constexpr INDUROP_LEAF<::indurop_generated_a279fd697389e543::var_PLC_ROBOT_I1, ::std::int16_t, 0> I1{::indurop::Place{0}, ::indurop::detail::Make{}};  // PLC input point 1
inline constexpr INDUROP_LEAF<::indurop_generated_a279fd697389e543::var_PLC_ROBOT_O0, ::std::int16_t, 0> O0{::indurop::Place{0}, ::indurop::detail::Make{}};  // PLC output point 0
inline constexpr ::indurop_generated_a279fd697389e543::ref_PLC_ROBOT_ROBOT_MODULE_STATE_t<::indurop_generated_a279fd697389e543::var_PLC_ROBOT_ROBOT_MODULE_STATE, 0> ROBOT_MODULE_STATE{::indurop::Place{0}, ::indurop::detail::Make{}};  // External Information
inline constexpr ::indurop_generated_a279fd697389e543::ref_PLC_ROBOT_ROBOT_MODULE_SERVICE_t<::indurop_generated_a279fd697389e543::var_PLC_ROBOT_ROBOT_MODULE_SERVICE, 0> ROBOT_MODULE_SERVICE{::indurop::Place{0}, ::indurop::detail::Make{}};  // To ROBOT MODULE
inline constexpr ::indurop_generated_a279fd697389e543::ref_PLC_ROBOT_AXIS1_IN_t<::indurop_generated_a279fd697389e543::var_PLC_ROBOT_AXIS1_IN, 0> AXIS1_IN{::indurop::Place{0}, ::indurop::detail::Make{}};
}  // namespace PLC_ROBOT
