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

asm(R"indurop(.pushsection .indurop.schema,"G",%progbits,indurop_schema_dccfadf6c0dc187f,comdat
.ascii "{\"schema\":1,\"abi\":5,\"variables\":[{\"name\":\"demo::speed\",\"type\":{\"base\":\"enum\",\"name\":\"demo::speed_t\","
.ascii "\"values\":[[\"SLOW\",0],[\"FAST\",1]]},\"kind\":\"scalar\",\"initial\":\"01000000\",\"source\":\"in.glb:5\"},{\"name\":"
.ascii "\"demo::mode\",\"type\":{\"base\":\"enum\",\"name\":\"demo::Mode\",\"values\":[[\"OFF\",0],[\"AUTO\",1],[\"MANUAL\",2]]}"
.ascii ",\"kind\":\"scalar\",\"initial\":\"01000000\",\"source\":\"in.glb:6\"},{\"name\":\"demo::gears\",\"type\":{\"base\":\"enu"
.ascii "m\",\"name\":\"demo::Gear\",\"values\":[[\"PARK\",0],[\"REVERSE\",1],[\"DRIVE\",2]],\"dims\":[2]},\"kind\":\"ring\",\"in"
.ascii "itial\":\"0200000000000000\",\"source\":\"in.glb:7\"},{\"name\":\"demo::motor\",\"type\":{\"base\":\"struct\",\"name\":"
.ascii "\"demo::Motor\",\"size\":8,\"align\":4,\"fields\":[{\"name\":\"mode\",\"type\":{\"base\":\"enum\",\"name\":\"demo::Mode\","
.ascii "\"values\":[[\"OFF\",0],[\"AUTO\",1],[\"MANUAL\",2]]},\"offset\":0},{\"name\":\"side\",\"type\":{\"base\":\"enum\",\"name"
.ascii "\":\"demo::Motor_side_t\",\"values\":[[\"LEFT\",0],[\"RIGHT\",1]]},\"offset\":4}]},\"kind\":\"ring\",\"initial\":\"020"
.ascii "0000001000000\",\"source\":\"in.glb:8\"},{\"name\":\"demo::other\",\"type\":{\"base\":\"enum\",\"name\":\"demo::Mode\","
.ascii "\"values\":[[\"OFF\",0],[\"AUTO\",1],[\"MANUAL\",2]]},\"kind\":\"scalar\",\"source\":\"in.glb:11\"}]}"
.ascii "\n"
.popsection)indurop");

namespace demo {
enum Mode : ::std::int32_t { OFF = 0, AUTO = 1, MANUAL = 2 };  // operating mode
enum Gear : ::std::int32_t { PARK = 0, REVERSE = 1, DRIVE = 2 };
enum : ::std::int32_t { RED = 0, GREEN = 1 };
enum speed_t : ::std::int32_t { SLOW = 0, FAST = 1 };
enum Motor_side_t : ::std::int32_t { LEFT = 0, RIGHT = 1 };
struct Motor {
  ::demo::Mode mode{};
  ::demo::Motor_side_t side{};
  friend bool operator==(const Motor&, const Motor&) = default;
};
static_assert(sizeof(Motor) == 8 && alignof(Motor) == 4);
static_assert(offsetof(Motor, mode) == 0);
static_assert(offsetof(Motor, side) == 4);
template <class indurop_visitor>
constexpr void indurop_fields(const Motor& v, indurop_visitor f) {
  f("mode", v.mode);
  f("side", v.side);
}
inline constexpr ::demo::Mode DEFAULT_MODE{static_cast<::demo::Mode>(1)};
inline constexpr ::demo::Mode START_MODE{static_cast<::demo::Mode>(0)};
}  // namespace demo

namespace indurop_generated_dccfadf6c0dc187f __attribute__((visibility("hidden"))) {
inline constexpr ::demo::speed_t initial_demo_speed{::demo::FAST};
inline constexpr ::demo::Mode initial_demo_mode{::demo::AUTO};
inline constexpr ::std::array<::demo::Gear, 2> initial_demo_gears{{::demo::DRIVE}};
inline constexpr ::demo::Motor initial_demo_motor{::demo::MANUAL, ::demo::RIGHT};
inline constinit ::indurop::abi::Ref refs[] = {
    {0x1f47d38712dfa6bd, 0x2bd8d663f06ced5e, nullptr, &initial_demo_speed, 4, ::indurop::abi::Kind::Scalar, "demo::speed"},
    {0x3b4095799f022ee1, 0xa86b924206053248, nullptr, &initial_demo_mode, 4, ::indurop::abi::Kind::Scalar, "demo::mode"},
    {0xeb7c8b29c05fa5d2, 0xd9586a3481f66f8e, nullptr, &initial_demo_gears, 8, ::indurop::abi::Kind::Ring, "demo::gears"},
    {0x3d1520a980898633, 0x0879a49f61e6ee5b, nullptr, &initial_demo_motor, 8, ::indurop::abi::Kind::Ring, "demo::motor"},
    {0x8cd7207a7a831468, 0xa86b924206053248, nullptr, nullptr, 4, ::indurop::abi::Kind::Scalar, "demo::other"},
};
inline constinit ::std::uint32_t users = 0;
[[gnu::constructor(101)]] inline void bind() {
  if (users++ == 0) {
    indurop_register_refs(refs, 5, ::indurop::abi::kVersion);
  }
}
[[gnu::destructor(101)]] inline void unbind() {
  if (--users == 0) {
    indurop_unregister_refs(refs);
  }
}
struct var_demo_speed {
  static constexpr ::std::uint64_t kNameHash = 0x1f47d38712dfa6bd;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 4;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[0]; }
};
struct var_demo_mode {
  static constexpr ::std::uint64_t kNameHash = 0x3b4095799f022ee1;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 4;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[1]; }
};
struct var_demo_gears {
  static constexpr ::std::uint64_t kNameHash = 0xeb7c8b29c05fa5d2;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Ring;
  static constexpr ::std::size_t kSize = 8;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[2]; }
};
struct var_demo_motor {
  static constexpr ::std::uint64_t kNameHash = 0x3d1520a980898633;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Ring;
  static constexpr ::std::size_t kSize = 8;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[3]; }
};
struct var_demo_other {
  static constexpr ::std::uint64_t kNameHash = 0x8cd7207a7a831468;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 4;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[4]; }
};
template <class indurop_tag, ::std::uint32_t indurop_offset, class = ::indurop::Adl>
union ref_demo_Motor {
  using value_type = ::demo::Motor;
  using whole_type = value_type;
  using tag_type = indurop_tag;
  static constexpr ::std::uint32_t kOffset = indurop_offset;
  ::indurop::Place indurop_place;
  ::indurop::Leaf<indurop_tag, ::demo::Mode, indurop_offset + 0> mode;
  ::indurop::Leaf<indurop_tag, ::demo::Motor_side_t, indurop_offset + 4> side;
  INDUROP_UNION_SHAPE(ref_demo_Motor)
  INDUROP_FRESHNESS(indurop_tag)
};
}  // namespace indurop_generated_dccfadf6c0dc187f

namespace demo {
inline constexpr INDUROP_LEAF<::indurop_generated_dccfadf6c0dc187f::var_demo_speed, ::demo::speed_t, 0> speed{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr INDUROP_LEAF<::indurop_generated_dccfadf6c0dc187f::var_demo_mode, ::demo::Mode, 0> mode{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr ::indurop::ArrayRef<::indurop::Leaf<::indurop_generated_dccfadf6c0dc187f::var_demo_gears, ::demo::Gear, 0>, 2> gears{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr ::indurop_generated_dccfadf6c0dc187f::ref_demo_Motor<::indurop_generated_dccfadf6c0dc187f::var_demo_motor, 0> motor{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr INDUROP_LEAF<::indurop_generated_dccfadf6c0dc187f::var_demo_other, ::demo::Mode, 0> other{::indurop::Place{0}, ::indurop::detail::Make{}};
}  // namespace demo
