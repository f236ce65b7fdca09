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

asm(R"indurop(.pushsection .indurop.schema,"G",%progbits,indurop_schema_a24ea9fe5370d836,comdat
.ascii "{\"schema\":1,\"abi\":5,\"variables\":[{\"name\":\"cell::left::places\",\"type\":{\"base\":\"struct\",\"name\":\"cell::"
.ascii "left::Place\",\"size\":24,\"align\":8,\"fields\":[{\"name\":\"x\",\"type\":\"double\",\"offset\":0,\"unit\":\"mm\",\"descr"
.ascii "iption\":\"from the wall\"},{\"name\":\"mode\",\"type\":{\"base\":\"enum\",\"name\":\"cell::left::Mode\",\"values\":[[\""
.ascii "OFF\",0],[\"AUTO\",1]]},\"offset\":8},{\"name\":\"from\",\"type\":\"char\",\"offset\":12},{\"name\":\"part\",\"type\":{\"b"
.ascii "ase\":\"struct\",\"name\":\"cell::left::Place_part_t\",\"size\":6,\"align\":2,\"fields\":[{\"name\":\"seen\",\"type\":\""
.ascii "bool\",\"offset\":0},{\"name\":\"count\",\"type\":{\"base\":\"uint16\",\"dims\":[2]},\"offset\":2}]},\"offset\":14}],\"d"
.ascii "ims\":[2]},\"kind\":\"ring\",\"source\":\"in.glb:9\"},{\"name\":\"cell::left::gain\",\"type\":\"int32\",\"kind\":\"scala"
.ascii "r\",\"source\":\"in.glb:10\"},{\"name\":\"cell::left::big\",\"type\":{\"base\":\"bool\",\"dims\":[257]},\"kind\":\"ring\""
.ascii ",\"source\":\"in.glb:11\"},{\"name\":\"cell::right::place\",\"type\":{\"base\":\"struct\",\"name\":\"cell::right::Pla"
.ascii "ce\",\"size\":4,\"align\":4,\"fields\":[{\"name\":\"y\",\"type\":\"float\",\"offset\":0}]},\"kind\":\"ring\",\"source\":\"in"
.ascii ".glb:13\"},{\"name\":\"cell::right::mode\",\"type\":{\"base\":\"enum\",\"name\":\"cell::right::Mode\",\"values\":[[\"L"
.ascii "OW\",0],[\"HIGH\",1]]},\"kind\":\"scalar\",\"source\":\"in.glb:15\"},{\"name\":\"cell::right::gain\",\"type\":\"float\""
.ascii ",\"kind\":\"scalar\",\"source\":\"in.glb:16\"},{\"name\":\"cell::right::text\",\"type\":{\"base\":\"text\",\"size\":8},\""
.ascii "kind\":\"ring\",\"source\":\"in.glb:17\"}]}"
.ascii "\n"
.popsection)indurop");

namespace cell::left {
enum Mode : ::std::int32_t { OFF = 0, AUTO = 1 };
struct Place_part_t {
  bool seen{};
  ::std::array<::std::uint16_t, 2> count{};
  friend bool operator==(const Place_part_t&, const Place_part_t&) = default;
};
static_assert(sizeof(Place_part_t) == 6 && alignof(Place_part_t) == 2);
static_assert(offsetof(Place_part_t, seen) == 0);
static_assert(offsetof(Place_part_t, count) == 2);
template <class indurop_visitor>
constexpr void indurop_fields(const Place_part_t& v, indurop_visitor f) {
  f("seen", v.seen);
  f("count", v.count);
}
struct Place {
  double x{};  // from the wall [mm]
  ::cell::left::Mode mode{};
  char from{};
  ::cell::left::Place_part_t part{};
  friend bool operator==(const Place&, const Place&) = default;
};
static_assert(sizeof(Place) == 24 && alignof(Place) == 8);
static_assert(offsetof(Place, x) == 0);
static_assert(offsetof(Place, mode) == 8);
static_assert(offsetof(Place, from) == 12);
static_assert(offsetof(Place, part) == 14);
template <class indurop_visitor>
constexpr void indurop_fields(const Place& v, indurop_visitor f) {
  f("x", v.x);
  f("mode", v.mode);
  f("from", v.from);
  f("part", v.part);
}
}  // namespace cell::left

namespace cell::right {
struct Place {
  float y{};
  friend bool operator==(const Place&, const Place&) = default;
};
static_assert(sizeof(Place) == 4 && alignof(Place) == 4);
static_assert(offsetof(Place, y) == 0);
template <class indurop_visitor>
constexpr void indurop_fields(const Place& v, indurop_visitor f) {
  f("y", v.y);
}
enum Mode : ::std::int32_t { LOW = 0, HIGH = 1 };
}  // namespace cell::right

namespace indurop_generated_a24ea9fe5370d836 __attribute__((visibility("hidden"))) {
inline constinit ::indurop::abi::Ref refs[] = {
    {0xe30ac49dbba8c07c, 0x624700a7806d4159, nullptr, nullptr, 48, ::indurop::abi::Kind::Ring, "cell::left::places"},
    {0x4429bf553aaf4f4f, 0x2af2b3192b419145, nullptr, nullptr, 4, ::indurop::abi::Kind::Scalar, "cell::left::gain"},
    {0x0924f1a1803bed9a, 0xeb7c253e006ef02f, nullptr, nullptr, 257, ::indurop::abi::Kind::Ring, "cell::left::big"},
    {0x63528410a3c05d4c, 0x8af388f83de12169, nullptr, nullptr, 4, ::indurop::abi::Kind::Ring, "cell::right::place"},
    {0x06b8ce6214af4782, 0x631010d40b8ed6c5, nullptr, nullptr, 4, ::indurop::abi::Kind::Scalar, "cell::right::mode"},
    {0xade7a1328e13e78e, 0xdd635018ff703544, nullptr, nullptr, 4, ::indurop::abi::Kind::Scalar, "cell::right::gain"},
    {0xf56ff6a3a48367ae, 0x8b0f3cc69209f1e5, nullptr, nullptr, 8, ::indurop::abi::Kind::Ring, "cell::right::text"},
};
inline constinit ::std::uint32_t users = 0;
[[gnu::constructor(101)]] inline void bind() {
  if (users++ == 0) {
    indurop_register_refs(refs, 7, ::indurop::abi::kVersion);
  }
}
[[gnu::destructor(101)]] inline void unbind() {
  if (--users == 0) {
    indurop_unregister_refs(refs);
  }
}
struct var_cell_left_places {
  static constexpr ::std::uint64_t kNameHash = 0xe30ac49dbba8c07c;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Ring;
  static constexpr ::std::size_t kSize = 48;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[0]; }
};
struct var_cell_left_gain {
  static constexpr ::std::uint64_t kNameHash = 0x4429bf553aaf4f4f;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 4;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[1]; }
};
struct var_cell_left_big {
  static constexpr ::std::uint64_t kNameHash = 0x0924f1a1803bed9a;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Ring;
  static constexpr ::std::size_t kSize = 257;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[2]; }
};
struct var_cell_right_place {
  static constexpr ::std::uint64_t kNameHash = 0x63528410a3c05d4c;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Ring;
  static constexpr ::std::size_t kSize = 4;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[3]; }
};
struct var_cell_right_mode {
  static constexpr ::std::uint64_t kNameHash = 0x06b8ce6214af4782;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 4;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[4]; }
};
struct var_cell_right_gain {
  static constexpr ::std::uint64_t kNameHash = 0xade7a1328e13e78e;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr ::std::size_t kSize = 4;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[5]; }
};
struct var_cell_right_text {
  static constexpr ::std::uint64_t kNameHash = 0xf56ff6a3a48367ae;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Ring;
  static constexpr ::std::size_t kSize = 8;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[6]; }
};
template <class indurop_tag, ::std::uint32_t indurop_offset, class = ::indurop::Adl>
union ref_cell_left_Place_part_t {
  using value_type = ::cell::left::Place_part_t;
  using whole_type = value_type;
  using tag_type = indurop_tag;
  static constexpr ::std::uint32_t kOffset = indurop_offset;
  ::indurop::Place indurop_place;
  ::indurop::Leaf<indurop_tag, bool, indurop_offset + 0> seen;
  ::indurop::ArrayRef<::indurop::Leaf<indurop_tag, ::std::uint16_t, indurop_offset + 2>, 2> count;
  INDUROP_UNION_SHAPE(ref_cell_left_Place_part_t)
  INDUROP_FRESHNESS(indurop_tag)
};
template <class indurop_tag, ::std::uint32_t indurop_offset, class = ::indurop::Adl>
union ref_cell_left_Place {
  using value_type = ::cell::left::Place;
  using whole_type = value_type;
  using tag_type = indurop_tag;
  static constexpr ::std::uint32_t kOffset = indurop_offset;
  ::indurop::Place indurop_place;
  ::indurop::Leaf<indurop_tag, double, indurop_offset + 0> x;
  ::indurop::Leaf<indurop_tag, ::cell::left::Mode, indurop_offset + 8> mode;
  ::indurop::Leaf<indurop_tag, char, indurop_offset + 12> from;
  ::indurop_generated_a24ea9fe5370d836::ref_cell_left_Place_part_t<indurop_tag, indurop_offset + 14> part;
  INDUROP_UNION_SHAPE(ref_cell_left_Place)
  INDUROP_FRESHNESS(indurop_tag)
};
template <class indurop_tag, ::std::uint32_t indurop_offset, class = ::indurop::Adl>
union ref_cell_right_Place {
  using value_type = ::cell::right::Place;
  using whole_type = value_type;
  using tag_type = indurop_tag;
  static constexpr ::std::uint32_t kOffset = indurop_offset;
  ::indurop::Place indurop_place;
  ::indurop::Leaf<indurop_tag, float, indurop_offset + 0> y;
  INDUROP_UNION_SHAPE(ref_cell_right_Place)
  INDUROP_FRESHNESS(indurop_tag)
};
}  // namespace indurop_generated_a24ea9fe5370d836

namespace cell::left {
inline constexpr ::indurop::ArrayRef<::indurop_generated_a24ea9fe5370d836::ref_cell_left_Place<::indurop_generated_a24ea9fe5370d836::var_cell_left_places, 0>, 2> places{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr INDUROP_LEAF<::indurop_generated_a24ea9fe5370d836::var_cell_left_gain, ::std::int32_t, 0> gain{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr ::indurop::ArrayRef<::indurop::Leaf<::indurop_generated_a24ea9fe5370d836::var_cell_left_big, bool, 0>, 257> big{::indurop::Place{0}, ::indurop::detail::Make{}};
}  // namespace cell::left

namespace cell::right {
inline constexpr ::indurop_generated_a24ea9fe5370d836::ref_cell_right_Place<::indurop_generated_a24ea9fe5370d836::var_cell_right_place, 0> place{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr INDUROP_LEAF<::indurop_generated_a24ea9fe5370d836::var_cell_right_mode, ::cell::right::Mode, 0> mode{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr INDUROP_LEAF<::indurop_generated_a24ea9fe5370d836::var_cell_right_gain, float, 0> gain{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr ::indurop::Text<::indurop_generated_a24ea9fe5370d836::var_cell_right_text, 8, 0> text{::indurop::Place{0}, ::indurop::detail::Make{}};
}  // namespace cell::right
