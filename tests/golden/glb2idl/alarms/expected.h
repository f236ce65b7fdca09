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

asm(R"indurop(.pushsection .indurop.schema,"G",%progbits,indurop_schema_cd607970ad9343e0,comdat
.ascii "{\"schema\":1,\"abi\":5,\"variables\":[{\"name\":\"press::door_open\",\"type\":\"bool\",\"kind\":\"scalar\",\"alarms\":["
.ascii "{\"text\":\"the door is open\",\"priority\":\"high\",\"when\":[\"==\",1.0],\"delay_ns\":500000000}],\"source\":\"in.g"
.ascii "lb:4\"},{\"name\":\"press::air\",\"type\":\"bool\",\"kind\":\"scalar\",\"alarms\":[{\"text\":\"no compressed air\",\"pri"
.ascii "ority\":\"critical\",\"when\":[\"==\",0.0]}],\"source\":\"in.glb:5\"},{\"name\":\"press::fault\",\"type\":{\"base\":\"bo"
.ascii "ol\",\"dims\":[3]},\"kind\":\"ring\",\"alarms\":[{\"text\":\"an axis has a fault\",\"priority\":\"medium\",\"when\":[\"="
.ascii "=\",1.0]}],\"source\":\"in.glb:6\"},{\"name\":\"press::temperature\",\"type\":\"double\",\"kind\":\"scalar\",\"unit\":\""
.ascii "degC\",\"alarms\":[{\"text\":\"the oil is warm\",\"priority\":\"low\",\"when\":[\">\",80.0],\"deadband\":5.0,\"delay_n"
.ascii "s\":2000000000},{\"text\":\"the oil is too hot\",\"priority\":\"critical\",\"when\":[\">=\",100.0]}],\"source\":\"in"
.ascii ".glb:7\"},{\"name\":\"press::state\",\"type\":{\"base\":\"enum\",\"name\":\"press::State\",\"values\":[[\"IDLE\",0],[\"R"
.ascii "UNNING\",1],[\"FAULT\",2]]},\"kind\":\"scalar\",\"alarms\":[{\"text\":\"the press has a fault\",\"priority\":\"high\""
.ascii ",\"when\":[\"==\",2.0]}],\"source\":\"in.glb:10\"},{\"name\":\"press::lost\",\"type\":\"uint32\",\"kind\":\"scalar\",\"al"
.ascii "arms\":[{\"text\":\"a counter of errors counts\",\"priority\":\"medium\",\"when\":[\"!=\",0.0]}],\"source\":\"in.glb"
.ascii ":11\"},{\"name\":\"press::broken\",\"type\":\"uint32\",\"kind\":\"scalar\",\"alarms\":[{\"text\":\"much is broken\",\"pr"
.ascii "iority\":\"medium\",\"when\":[\">\",10.0]}],\"source\":\"in.glb:11\"},{\"name\":\"press::tank\",\"type\":{\"base\":\"str"
.ascii "uct\",\"name\":\"press::tank_t\",\"size\":8,\"align\":4,\"fields\":[{\"name\":\"pressure\",\"type\":\"float\",\"offset\":"
.ascii "0,\"unit\":\"bar\",\"alarms\":[{\"text\":\"too little pressure\",\"priority\":\"medium\",\"when\":[\"<\",4.0],\"delay_n"
.ascii "s\":100000000}]},{\"name\":\"level\",\"type\":\"int32\",\"offset\":4}],\"dims\":[2]},\"kind\":\"ring\",\"source\":\"in.g"
.ascii "lb:15\"}]}"
.ascii "\n"
.popsection)indurop");

namespace press {
enum State : ::std::int32_t { IDLE = 0, RUNNING = 1, FAULT = 2 };
inline constexpr ::std::int32_t HOT{80};
struct tank_t {
  float pressure{};  // [bar]
  ::std::int32_t level{};
  friend bool operator==(const tank_t&, const tank_t&) = default;
};
static_assert(sizeof(tank_t) == 8 && alignof(tank_t) == 4);
static_assert(offsetof(tank_t, pressure) == 0);
static_assert(offsetof(tank_t, level) == 4);
template <class indurop_visitor>
constexpr void indurop_fields(const tank_t& v, indurop_visitor f) {
  f("pressure", v.pressure);
  f("level", v.level);
}
}  // namespace press

namespace indurop_generated_cd607970ad9343e0 __attribute__((visibility("hidden"))) {
inline constinit ::indurop::abi::Ref refs[] = {
    {0xbd2edc26c04171b1, 0xcd2fd49bc6b014bd, nullptr, nullptr, 1, ::indurop::abi::Kind::Scalar, "press::door_open"},
    {0xf86e559a0c751244, 0xcd2fd49bc6b014bd, nullptr, nullptr, 1, ::indurop::abi::Kind::Scalar, "press::air"},
    {0xa61d3a433d441c04, 0x61a3d366e00f03ca, nullptr, nullptr, 3, ::indurop::abi::Kind::Ring, "press::fault"},
    {0xd93e07adfa69d10a, 0xdd744c18ff7ea1ab, nullptr, nullptr, 8, ::indurop::abi::Kind::Scalar, "press::temperature"},
    {0x808d949ded6d1d85, 0x425c67b24b0b3d17, nullptr, nullptr, 4, ::indurop::abi::Kind::Scalar, "press::state"},
    {0x4d921b1da4ea3e86, 0x4d2bdf193e8526d1, nullptr, nullptr, 4, ::indurop::abi::Kind::Scalar, "press::lost"},
    {0x182469e5729c7ee5, 0x4d2bdf193e8526d1, nullptr, nullptr, 4, ::indurop::abi::Kind::Scalar, "press::broken"},
    {0x6f7ca757e6fc9f10, 0x7c5d9c7cb6314e69, nullptr, nullptr, 16, ::indurop::abi::Kind::Ring, "press::tank"},
};
inline constinit ::std::uint32_t users = 0;
[[gnu::constructor(101)]] inline void bind() {
  if (users++ == 0) {
    indurop_register_refs(refs, 8, ::indurop::abi::kVersion);
  }
}
[[gnu::destructor(101)]] inline void unbind() {
  if (--users == 0) {
    indurop_unregister_refs(refs);
  }
}
struct var_press_door_open {
  static constexpr ::std::uint64_t kNameHash = 0xbd2edc26c04171b1;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 1;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[0]; }
};
struct var_press_air {
  static constexpr ::std::uint64_t kNameHash = 0xf86e559a0c751244;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 1;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[1]; }
};
struct var_press_fault {
  static constexpr ::std::uint64_t kNameHash = 0xa61d3a433d441c04;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Ring;
  static constexpr ::std::size_t kSize = 3;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[2]; }
};
struct var_press_temperature {
  static constexpr ::std::uint64_t kNameHash = 0xd93e07adfa69d10a;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 8;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[3]; }
};
struct var_press_state {
  static constexpr ::std::uint64_t kNameHash = 0x808d949ded6d1d85;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 4;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[4]; }
};
struct var_press_lost {
  static constexpr ::std::uint64_t kNameHash = 0x4d921b1da4ea3e86;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 4;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[5]; }
};
struct var_press_broken {
  static constexpr ::std::uint64_t kNameHash = 0x182469e5729c7ee5;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 4;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[6]; }
};
struct var_press_tank {
  static constexpr ::std::uint64_t kNameHash = 0x6f7ca757e6fc9f10;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Ring;
  static constexpr ::std::size_t kSize = 16;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[7]; }
};
template <class indurop_tag, ::std::uint32_t indurop_offset, class = ::indurop::Adl>
union ref_press_tank_t {
  using value_type = ::press::tank_t;
  using whole_type = value_type;
  using tag_type = indurop_tag;
  static constexpr ::std::uint32_t kOffset = indurop_offset;
  ::indurop::Place indurop_place;
  ::indurop::Leaf<indurop_tag, float, indurop_offset + 0> pressure;
  ::indurop::Leaf<indurop_tag, ::std::int32_t, indurop_offset + 4> level;
  INDUROP_UNION_SHAPE(ref_press_tank_t)
  INDUROP_FRESHNESS(indurop_tag)
};
}  // namespace indurop_generated_cd607970ad9343e0

namespace press {
inline constexpr INDUROP_LEAF<::indurop_generated_cd607970ad9343e0::var_press_door_open, bool, 0> door_open{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr INDUROP_LEAF<::indurop_generated_cd607970ad9343e0::var_press_air, bool, 0> air{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr ::indurop::ArrayRef<::indurop::Leaf<::indurop_generated_cd607970ad9343e0::var_press_fault, bool, 0>, 3> fault{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr INDUROP_LEAF<::indurop_generated_cd607970ad9343e0::var_press_temperature, double, 0> temperature{::indurop::Place{0}, ::indurop::detail::Make{}};  // [degC]
inline constexpr INDUROP_LEAF<::indurop_generated_cd607970ad9343e0::var_press_state, ::press::State, 0> state{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr INDUROP_LEAF<::indurop_generated_cd607970ad9343e0::var_press_lost, ::std::uint32_t, 0> lost{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr INDUROP_LEAF<::indurop_generated_cd607970ad9343e0::var_press_broken, ::std::uint32_t, 0> broken{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr ::indurop::ArrayRef<::indurop_generated_cd607970ad9343e0::ref_press_tank_t<::indurop_generated_cd607970ad9343e0::var_press_tank, 0>, 2> tank{::indurop::Place{0}, ::indurop::detail::Make{}};
}  // namespace press
