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

asm(R"indurop(.pushsection .indurop.schema,"G",%progbits,indurop_schema_5555fe8fe02cb9e4,comdat
.ascii "{\"schema\":1,\"abi\":5,\"variables\":[{\"name\":\"demo::angle\",\"type\":\"double\",\"kind\":\"scalar\",\"unit\":\"deg\","
.ascii "\"description\":\"angle of the arm\",\"range\":[0.0,180.0],\"retain\":true,\"maxage_ns\":10000000,\"initial\":\"0"
.ascii "000000000804640\",\"fallback\":\"0000000000a05640\",\"source\":\"in.glb:2\"},{\"name\":\"demo::pos\",\"type\":\"doub"
.ascii "le\",\"kind\":\"scalar\",\"unit\":\"mm\",\"description\":\"where the tool is\",\"source\":\"in.glb:3\"},{\"name\":\"demo"
.ascii "::depth\",\"type\":\"double\",\"kind\":\"scalar\",\"unit\":\"m\",\"description\":\"where the tool is\",\"source\":\"in.g"
.ascii "lb:3\"},{\"name\":\"demo::count\",\"type\":\"int32\",\"kind\":\"scalar\",\"range\":[-5.0,5.0],\"retain\":true,\"maxage"
.ascii "_ns\":1500000000,\"source\":\"in.glb:5\"},{\"name\":\"demo::axis\",\"type\":{\"base\":\"struct\",\"name\":\"demo::Axis"
.ascii "\",\"size\":16,\"align\":4,\"fields\":[{\"name\":\"position\",\"type\":\"int32\",\"offset\":0,\"unit\":\"um\",\"descriptio"
.ascii "n\":\"of the motor\",\"range\":[-1000000.0,1000000.0]},{\"name\":\"status\",\"type\":\"uint16\",\"offset\":4,\"descr"
.ascii "iption\":\"how it is\"},{\"name\":\"speed\",\"type\":{\"base\":\"float\",\"dims\":[2]},\"offset\":8,\"unit\":\"mm/s\"}]},"
.ascii "\"kind\":\"ring\",\"maxage_ns\":100000,\"fallback\":\"07000000010000000000003f0000803e\",\"source\":\"in.glb:12\"}"
.ascii ",{\"name\":\"demo::emergency\",\"type\":\"bool\",\"kind\":\"scalar\",\"description\":\"Two lines of comment.\",\"fall"
.ascii "back\":\"01\",\"source\":\"in.glb:15\"},{\"name\":\"demo::note\",\"type\":{\"base\":\"text\",\"size\":32},\"kind\":\"ring\""
.ascii ",\"retain\":true,\"view\":true,\"optional\":true,\"initial\":\"66696e6500000000000000000000000000000000000000"
.ascii "000000000000000000\",\"fallback\":\"6c6f737400000000000000000000000000000000000000000000000000000000\",\"s"
.ascii "ource\":\"in.glb:16\"},{\"name\":\"demo::level\",\"type\":\"uint8\",\"kind\":\"scalar\",\"description\":\"\\\"quotes\\\", "
.ascii "back\\\\slash and \\u00fctf-8 \\\\\",\"range\":[0.0,255.0],\"source\":\"in.glb:17\"}]}"
.ascii "\n"
.popsection)indurop");

namespace demo {
struct Axis {
  ::std::int32_t position{};  // of the motor [um]
  ::std::uint16_t status{};  // how it is
  ::std::array<float, 2> speed{};  // [mm/s]
  friend bool operator==(const Axis&, const Axis&) = default;
};
static_assert(sizeof(Axis) == 16 && alignof(Axis) == 4);
static_assert(offsetof(Axis, position) == 0);
static_assert(offsetof(Axis, status) == 4);
static_assert(offsetof(Axis, speed) == 8);
template <class indurop_visitor>
constexpr void indurop_fields(const Axis& v, indurop_visitor f) {
  f("position", v.position);
  f("status", v.status);
  f("speed", v.speed);
}
}  // namespace demo

namespace indurop_generated_5555fe8fe02cb9e4 __attribute__((visibility("hidden"))) {
inline constexpr double initial_demo_angle{45.0};
inline constexpr ::indurop::string<32> initial_demo_note{"fine"};
inline constinit ::indurop::abi::Ref refs[] = {
    {0x0aa3fbb76ecba879, 0xdd744c18ff7ea1ab, nullptr, &initial_demo_angle, 8, ::indurop::abi::Kind::Scalar, "demo::angle"},
    {0xa3d509974749c150, 0xdd744c18ff7ea1ab, nullptr, nullptr, 8, ::indurop::abi::Kind::Scalar, "demo::pos"},
    {0xe1e2c4e9c90dbed3, 0xdd744c18ff7ea1ab, nullptr, nullptr, 8, ::indurop::abi::Kind::Scalar, "demo::depth"},
    {0x4658fbb3129c7031, 0x2af2b3192b419145, nullptr, nullptr, 4, ::indurop::abi::Kind::Scalar, "demo::count"},
    {0x8c9a1a9c912d633f, 0xdaf5b3734d3594ed, nullptr, nullptr, 16, ::indurop::abi::Kind::Ring, "demo::axis"},
    {0x9b2a8527d8063deb, 0xcd2fd49bc6b014bd, nullptr, nullptr, 1, ::indurop::abi::Kind::Scalar, "demo::emergency"},
    {0x0cbc656191f66bc6, 0x07281c69fafa8bfe, nullptr, &initial_demo_note, 32, ::indurop::abi::Kind::Ring, "demo::note"},
    {0xbe03eb9847350118, 0x08c48207b56753d8, nullptr, nullptr, 1, ::indurop::abi::Kind::Scalar, "demo::level"},
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
struct var_demo_angle {
  static constexpr ::std::uint64_t kNameHash = 0x0aa3fbb76ecba879;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 8;
  static constexpr ::std::int64_t kMaxAgeNs = 10000000;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[0]; }
};
struct var_demo_pos {
  static constexpr ::std::uint64_t kNameHash = 0xa3d509974749c150;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 8;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[1]; }
};
struct var_demo_depth {
  static constexpr ::std::uint64_t kNameHash = 0xe1e2c4e9c90dbed3;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 8;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[2]; }
};
struct var_demo_count {
  static constexpr ::std::uint64_t kNameHash = 0x4658fbb3129c7031;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 4;
  static constexpr ::std::int64_t kMaxAgeNs = 1500000000;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[3]; }
};
struct var_demo_axis {
  static constexpr ::std::uint64_t kNameHash = 0x8c9a1a9c912d633f;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Ring;
  static constexpr ::std::size_t kSize = 16;
  static constexpr ::std::int64_t kMaxAgeNs = 100000;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[4]; }
};
struct var_demo_emergency {
  static constexpr ::std::uint64_t kNameHash = 0x9b2a8527d8063deb;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 1;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[5]; }
};
struct var_demo_note {
  static constexpr ::std::uint64_t kNameHash = 0x0cbc656191f66bc6;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Ring;
  static constexpr ::std::size_t kSize = 32;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[6]; }
};
struct var_demo_level {
  static constexpr ::std::uint64_t kNameHash = 0xbe03eb9847350118;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 1;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[7]; }
};
template <class indurop_tag, ::std::uint32_t indurop_offset, class = ::indurop::Adl>
union ref_demo_Axis {
  using value_type = ::demo::Axis;
  using whole_type = value_type;
  using tag_type = indurop_tag;
  static constexpr ::std::uint32_t kOffset = indurop_offset;
  ::indurop::Place indurop_place;
  ::indurop::Leaf<indurop_tag, ::std::int32_t, indurop_offset + 0> position;
  ::indurop::Leaf<indurop_tag, ::std::uint16_t, indurop_offset + 4> status;
  ::indurop::ArrayRef<::indurop::Leaf<indurop_tag, float, indurop_offset + 8>, 2> speed;
  INDUROP_UNION_SHAPE(ref_demo_Axis)
  INDUROP_FRESHNESS(indurop_tag)
};
}  // namespace indurop_generated_5555fe8fe02cb9e4

namespace demo {
inline constexpr INDUROP_LEAF<::indurop_generated_5555fe8fe02cb9e4::var_demo_angle, double, 0> angle{::indurop::Place{0}, ::indurop::detail::Make{}};  // angle of the arm [deg]
inline constexpr INDUROP_LEAF<::indurop_generated_5555fe8fe02cb9e4::var_demo_pos, double, 0> pos{::indurop::Place{0}, ::indurop::detail::Make{}};  // where the tool is [mm]
inline constexpr INDUROP_LEAF<::indurop_generated_5555fe8fe02cb9e4::var_demo_depth, double, 0> depth{::indurop::Place{0}, ::indurop::detail::Make{}};  // where the tool is [m]
inline constexpr INDUROP_LEAF<::indurop_generated_5555fe8fe02cb9e4::var_demo_count, ::std::int32_t, 0> count{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr ::indurop_generated_5555fe8fe02cb9e4::ref_demo_Axis<::indurop_generated_5555fe8fe02cb9e4::var_demo_axis, 0> axis{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr INDUROP_LEAF<::indurop_generated_5555fe8fe02cb9e4::var_demo_emergency, bool, 0> emergency{::indurop::Place{0}, ::indurop::detail::Make{}};  // Two lines of comment.
inline constexpr ::indurop::Text<::indurop_generated_5555fe8fe02cb9e4::var_demo_note, 32, 0> note{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr INDUROP_LEAF<::indurop_generated_5555fe8fe02cb9e4::var_demo_level, ::std::uint8_t, 0> level{::indurop::Place{0}, ::indurop::detail::Make{}};  // "quotes", back\slash and ütf-8 \ .
}  // namespace demo
