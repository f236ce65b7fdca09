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

asm(R"indurop(.pushsection .indurop.schema,"G",%progbits,indurop_schema_3b09e1c1e8ad17b1,comdat
.ascii "{\"schema\":1,\"abi\":5,\"variables\":[{\"name\":\"demo::joints\",\"type\":{\"base\":\"double\",\"dims\":[6]},\"kind\":\""
.ascii "ring\",\"source\":\"in.glb:21\"},{\"name\":\"demo::grid\",\"type\":{\"base\":\"double\",\"dims\":[3,6]},\"kind\":\"ring\""
.ascii ",\"source\":\"in.glb:22\"},{\"name\":\"demo::from_global\",\"type\":{\"base\":\"int32\",\"dims\":[100]},\"kind\":\"ring"
.ascii "\",\"initial\":\"faffffff0a00000041000000000000000000000000000000000000000000000000000000000000000000000"
.ascii "0000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000"
.ascii "0000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000"
.ascii "0000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000"
.ascii "0000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000"
.ascii "0000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000"
.ascii "0000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000"
.ascii "0000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000"
.ascii "0000000000000\",\"source\":\"in.glb:23\"},{\"name\":\"other::part::define_is_known_everywhere\",\"type\":{\"base"
.ascii "\":\"int32\",\"dims\":[6]},\"kind\":\"ring\",\"source\":\"in.glb:25\"},{\"name\":\"other::part::qualified\",\"type\":{\""
.ascii "base\":\"int32\",\"dims\":[200]},\"kind\":\"ring\",\"source\":\"in.glb:26\"},{\"name\":\"other::part::qualified2\",\"t"
.ascii "ype\":{\"base\":\"int32\",\"dims\":[200]},\"kind\":\"ring\",\"source\":\"in.glb:26\"}]}"
.ascii "\n"
.popsection)indurop");
inline constexpr ::std::int32_t GLOBAL_LIMIT{100};

namespace demo {
inline constexpr ::std::int32_t MAX_JOINTS{6};
inline constexpr double HALF{0.5};
inline constexpr ::std::int32_t SUM{5};
inline constexpr ::std::int32_t MASK{246};
inline constexpr ::std::int32_t OCTAL{15};
inline constexpr ::std::int32_t BINARY{170};
inline constexpr ::std::int32_t LETTER{65};
inline constexpr ::std::int32_t CHOICE{10};
inline constexpr ::std::int32_t LONG_LINE{3};
inline constexpr char VERSION_TEXT[] = "1.0 beta";
inline constexpr double PI_VALUE{3.14159265358979};
inline constexpr float RATIO{0.33333334F};
inline constexpr ::std::uint8_t SMALL{200};
inline constexpr ::std::int64_t LEAST{INT64_MIN};
inline constexpr ::std::uint64_t MOST{18446744073709551615U};
inline constexpr bool READY{true};
inline constexpr char NAME[] = "arm";
}  // namespace demo

namespace indurop_generated_3b09e1c1e8ad17b1 __attribute__((visibility("hidden"))) {
inline constexpr ::std::array<::std::int32_t, 100> initial_demo_from_global{{-6, 10, 65}};
inline constinit ::indurop::abi::Ref refs[] = {
    {0x41822839aa46ec9f, 0x9e44f8fe2e115efd, nullptr, nullptr, 48, ::indurop::abi::Kind::Ring, "demo::joints"},
    {0xf5fa79a95dd06962, 0x8ec373bb3ab4984c, nullptr, nullptr, 144, ::indurop::abi::Kind::Ring, "demo::grid"},
    {0xc80c94f15bbcda28, 0xf04a5a1f8ecb03cc, nullptr, &initial_demo_from_global, 400, ::indurop::abi::Kind::Ring, "demo::from_global"},
    {0x0ce4d4ddc0166b47, 0xbb1f14295c55721b, nullptr, nullptr, 24, ::indurop::abi::Kind::Ring, "other::part::define_is_known_everywhere"},
    {0xf48b713577ef439e, 0x3ab99807c62a55bf, nullptr, nullptr, 800, ::indurop::abi::Kind::Ring, "other::part::qualified"},
    {0x783509dacb8ffd44, 0x3ab99807c62a55bf, nullptr, nullptr, 800, ::indurop::abi::Kind::Ring, "other::part::qualified2"},
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
struct var_demo_joints {
  static constexpr ::std::uint64_t kNameHash = 0x41822839aa46ec9f;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Ring;
  static constexpr ::std::size_t kSize = 48;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[0]; }
};
struct var_demo_grid {
  static constexpr ::std::uint64_t kNameHash = 0xf5fa79a95dd06962;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Ring;
  static constexpr ::std::size_t kSize = 144;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[1]; }
};
struct var_demo_from_global {
  static constexpr ::std::uint64_t kNameHash = 0xc80c94f15bbcda28;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Ring;
  static constexpr ::std::size_t kSize = 400;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[2]; }
};
struct var_other_part_define_is_known_everywhere {
  static constexpr ::std::uint64_t kNameHash = 0x0ce4d4ddc0166b47;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Ring;
  static constexpr ::std::size_t kSize = 24;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[3]; }
};
struct var_other_part_qualified {
  static constexpr ::std::uint64_t kNameHash = 0xf48b713577ef439e;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Ring;
  static constexpr ::std::size_t kSize = 800;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[4]; }
};
struct var_other_part_qualified2 {
  static constexpr ::std::uint64_t kNameHash = 0x783509dacb8ffd44;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Ring;
  static constexpr ::std::size_t kSize = 800;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[5]; }
};
}  // namespace indurop_generated_3b09e1c1e8ad17b1

namespace demo {
inline constexpr ::indurop::ArrayRef<::indurop::Leaf<::indurop_generated_3b09e1c1e8ad17b1::var_demo_joints, double, 0>, 6> joints{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr ::indurop::ArrayRef<::indurop::ArrayRef<::indurop::Leaf<::indurop_generated_3b09e1c1e8ad17b1::var_demo_grid, double, 0>, 6>, 3> grid{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr ::indurop::ArrayRef<::indurop::Leaf<::indurop_generated_3b09e1c1e8ad17b1::var_demo_from_global, ::std::int32_t, 0>, 100> from_global{::indurop::Place{0}, ::indurop::detail::Make{}};
}  // namespace demo

namespace other::part {
inline constexpr ::indurop::ArrayRef<::indurop::Leaf<::indurop_generated_3b09e1c1e8ad17b1::var_other_part_define_is_known_everywhere, ::std::int32_t, 0>, 6> define_is_known_everywhere{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr ::indurop::ArrayRef<::indurop::Leaf<::indurop_generated_3b09e1c1e8ad17b1::var_other_part_qualified, ::std::int32_t, 0>, 200> qualified{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr ::indurop::ArrayRef<::indurop::Leaf<::indurop_generated_3b09e1c1e8ad17b1::var_other_part_qualified2, ::std::int32_t, 0>, 200> qualified2{::indurop::Place{0}, ::indurop::detail::Make{}};
}  // namespace other::part
