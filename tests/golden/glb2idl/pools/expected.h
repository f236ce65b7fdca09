// Shared variables of in.glb, written by glb2idl. Do not edit.
#pragma once

#include <indurop/lock.h>
#include <indurop/var.h>
#include <indurop/pool.h>

#include <array>
#include <cstddef>
#include <cstdint>

#ifndef INDUROP_LEAF
#define INDUROP_LEAF ::indurop::Leaf
#endif

asm(R"indurop(.pushsection .indurop.schema,"G",%progbits,indurop_schema_f8cd2522d655200d,comdat
.ascii "{\"schema\":1,\"abi\":5,\"variables\":[{\"name\":\"cell::Vision::table\",\"type\":{\"base\":\"struct\",\"name\":\"cell:"
.ascii ":Vision::pool\",\"size\":4,\"align\":4,\"fields\":[{\"name\":\"balls\",\"type\":\"int32\",\"offset\":0}]},\"kind\":\"rin"
.ascii "g\",\"source\":\"in.glb:20\"},{\"name\":\"cell::Vision::x\",\"type\":{\"base\":\"int32\",\"dims\":[2]},\"kind\":\"ring\","
.ascii "\"source\":\"in.glb:21\"}],\"pools\":[{\"name\":\"cell::Vision::camera\",\"type\":{\"base\":\"struct\",\"name\":\"cell:"
.ascii ":Vision::camera_t\",\"size\":3080,\"align\":8,\"fields\":[{\"name\":\"exposed_ns\",\"type\":\"int64\",\"offset\":0,\"u"
.ascii "nit\":\"ns\"},{\"name\":\"pixels\",\"type\":{\"base\":\"uint8\",\"dims\":[48,64]},\"offset\":8}],\"dims\":[4]},\"source\""
.ascii ":\"in.glb:12\"},{\"name\":\"cell::Vision::left\",\"type\":{\"base\":\"struct\",\"name\":\"cell::Vision::Cloud\",\"siz"
.ascii "e\":12004,\"align\":4,\"fields\":[{\"name\":\"count\",\"type\":\"uint32\",\"offset\":0},{\"name\":\"points\",\"type\":{\"b"
.ascii "ase\":\"struct\",\"name\":\"cell::Vision::Point\",\"size\":12,\"align\":4,\"fields\":[{\"name\":\"x\",\"type\":\"float\","
.ascii "\"offset\":0,\"unit\":\"mm\"},{\"name\":\"y\",\"type\":\"float\",\"offset\":4,\"unit\":\"mm\"},{\"name\":\"z\",\"type\":\"float"
.ascii "\",\"offset\":8,\"unit\":\"mm\"}],\"dims\":[1000]},\"offset\":4}],\"dims\":[3]},\"description\":\"of the two scanner"
.ascii "s\",\"source\":\"in.glb:15\"},{\"name\":\"cell::Vision::right\",\"type\":{\"base\":\"struct\",\"name\":\"cell::Vision:"
.ascii ":Cloud\",\"size\":12004,\"align\":4,\"fields\":[{\"name\":\"count\",\"type\":\"uint32\",\"offset\":0},{\"name\":\"points"
.ascii "\",\"type\":{\"base\":\"struct\",\"name\":\"cell::Vision::Point\",\"size\":12,\"align\":4,\"fields\":[{\"name\":\"x\",\"ty"
.ascii "pe\":\"float\",\"offset\":0,\"unit\":\"mm\"},{\"name\":\"y\",\"type\":\"float\",\"offset\":4,\"unit\":\"mm\"},{\"name\":\"z\",\""
.ascii "type\":\"float\",\"offset\":8,\"unit\":\"mm\"}],\"dims\":[1000]},\"offset\":4}],\"dims\":[4]},\"description\":\"of the"
.ascii " two scanners\",\"source\":\"in.glb:15\"},{\"name\":\"cell::Vision::merged\",\"type\":{\"base\":\"struct\",\"name\":\""
.ascii "cell::Vision::Cloud\",\"size\":12004,\"align\":4,\"fields\":[{\"name\":\"count\",\"type\":\"uint32\",\"offset\":0},{\""
.ascii "name\":\"points\",\"type\":{\"base\":\"struct\",\"name\":\"cell::Vision::Point\",\"size\":12,\"align\":4,\"fields\":[{\""
.ascii "name\":\"x\",\"type\":\"float\",\"offset\":0,\"unit\":\"mm\"},{\"name\":\"y\",\"type\":\"float\",\"offset\":4,\"unit\":\"mm\"},"
.ascii "{\"name\":\"z\",\"type\":\"float\",\"offset\":8,\"unit\":\"mm\"}],\"dims\":[1000]},\"offset\":4}],\"dims\":[2]},\"descrip"
.ascii "tion\":\"filtered\",\"source\":\"in.glb:16\"}]}"
.ascii "\n"
.popsection)indurop");

namespace cell::Vision {
inline constexpr ::std::int32_t WIDTH{64};
inline constexpr ::std::int32_t HEIGHT{48};
struct Point {
  float x{};  // [mm]
  float y{};  // [mm]
  float z{};  // [mm]
  friend bool operator==(const Point&, const Point&) = default;
};
static_assert(sizeof(Point) == 12 && alignof(Point) == 4);
static_assert(offsetof(Point, x) == 0);
static_assert(offsetof(Point, y) == 4);
static_assert(offsetof(Point, z) == 8);
template <class indurop_visitor>
constexpr void indurop_fields(const Point& v, indurop_visitor f) {
  f("x", v.x);
  f("y", v.y);
  f("z", v.z);
}
struct camera_t {
  ::std::int64_t exposed_ns{};  // [ns]
  ::std::array<::std::array<::std::uint8_t, 64>, 48> pixels{};
  friend bool operator==(const camera_t&, const camera_t&) = default;
};
static_assert(sizeof(camera_t) == 3080 && alignof(camera_t) == 8);
static_assert(offsetof(camera_t, exposed_ns) == 0);
static_assert(offsetof(camera_t, pixels) == 8);
template <class indurop_visitor>
constexpr void indurop_fields(const camera_t& v, indurop_visitor f) {
  f("exposed_ns", v.exposed_ns);
  f("pixels", v.pixels);
}
struct Cloud {
  ::std::uint32_t count{};
  ::std::array<::cell::Vision::Point, 1000> points{};
  friend bool operator==(const Cloud&, const Cloud&) = default;
};
static_assert(sizeof(Cloud) == 12004 && alignof(Cloud) == 4);
static_assert(offsetof(Cloud, count) == 0);
static_assert(offsetof(Cloud, points) == 4);
template <class indurop_visitor>
constexpr void indurop_fields(const Cloud& v, indurop_visitor f) {
  f("count", v.count);
  f("points", v.points);
}
struct pool {  // "pool" is a word in front of a type only
  ::std::int32_t balls{};
  friend bool operator==(const pool&, const pool&) = default;
};
static_assert(sizeof(pool) == 4 && alignof(pool) == 4);
static_assert(offsetof(pool, balls) == 0);
template <class indurop_visitor>
constexpr void indurop_fields(const pool& v, indurop_visitor f) {
  f("balls", v.balls);
}
}  // namespace cell::Vision

namespace indurop_generated_f8cd2522d655200d __attribute__((visibility("hidden"))) {
inline constinit ::indurop::abi::Ref refs[] = {
    {0xf054ebc677f1ae23, 0xd51d605b182d15fd, nullptr, nullptr, 4, ::indurop::abi::Kind::Ring, "cell::Vision::table"},
    {0xda06d8ef9668fc23, 0xbb10d4295c48c7ff, nullptr, nullptr, 8, ::indurop::abi::Kind::Ring, "cell::Vision::x"},
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
struct var_cell_Vision_table {
  static constexpr ::std::uint64_t kNameHash = 0xf054ebc677f1ae23;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Ring;
  static constexpr ::std::size_t kSize = 4;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[0]; }
};
struct var_cell_Vision_x {
  static constexpr ::std::uint64_t kNameHash = 0xda06d8ef9668fc23;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Ring;
  static constexpr ::std::size_t kSize = 8;
  INDUROP_ALWAYS_INLINE static constexpr const ::indurop::abi::Ref& ref() noexcept { return refs[1]; }
};
template <class indurop_tag, ::std::uint32_t indurop_offset, class = ::indurop::Adl>
union ref_cell_Vision_Point {
  using value_type = ::cell::Vision::Point;
  using whole_type = value_type;
  using tag_type = indurop_tag;
  static constexpr ::std::uint32_t kOffset = indurop_offset;
  ::indurop::Place indurop_place;
  ::indurop::Leaf<indurop_tag, float, indurop_offset + 0> x;
  ::indurop::Leaf<indurop_tag, float, indurop_offset + 4> y;
  ::indurop::Leaf<indurop_tag, float, indurop_offset + 8> z;
  INDUROP_UNION_SHAPE(ref_cell_Vision_Point)
  INDUROP_FRESHNESS(indurop_tag)
};
template <class indurop_tag, ::std::uint32_t indurop_offset, class = ::indurop::Adl>
union ref_cell_Vision_camera_t {
  using value_type = ::cell::Vision::camera_t;
  using whole_type = value_type;
  using tag_type = indurop_tag;
  static constexpr ::std::uint32_t kOffset = indurop_offset;
  ::indurop::Place indurop_place;
  ::indurop::Leaf<indurop_tag, ::std::int64_t, indurop_offset + 0> exposed_ns;
  ::indurop::ArrayRef<::indurop::ArrayRef<::indurop::Leaf<indurop_tag, ::std::uint8_t, indurop_offset + 8>, 64>, 48> pixels;
  INDUROP_UNION_SHAPE(ref_cell_Vision_camera_t)
  INDUROP_FRESHNESS(indurop_tag)
};
template <class indurop_tag, ::std::uint32_t indurop_offset, class = ::indurop::Adl>
union ref_cell_Vision_Cloud {
  using value_type = ::cell::Vision::Cloud;
  using whole_type = value_type;
  using tag_type = indurop_tag;
  static constexpr ::std::uint32_t kOffset = indurop_offset;
  ::indurop::Place indurop_place;
  ::indurop::Leaf<indurop_tag, ::std::uint32_t, indurop_offset + 0> count;
  ::indurop::ArrayRef<::indurop_generated_f8cd2522d655200d::ref_cell_Vision_Point<indurop_tag, indurop_offset + 4>, 1000> points;
  INDUROP_UNION_SHAPE(ref_cell_Vision_Cloud)
  INDUROP_FRESHNESS(indurop_tag)
};
template <class indurop_tag, ::std::uint32_t indurop_offset, class = ::indurop::Adl>
union ref_cell_Vision_pool {
  using value_type = ::cell::Vision::pool;
  using whole_type = value_type;
  using tag_type = indurop_tag;
  static constexpr ::std::uint32_t kOffset = indurop_offset;
  ::indurop::Place indurop_place;
  ::indurop::Leaf<indurop_tag, ::std::int32_t, indurop_offset + 0> balls;
  INDUROP_UNION_SHAPE(ref_cell_Vision_pool)
  INDUROP_FRESHNESS(indurop_tag)
};
struct pool_cell_Vision_camera {
  using chunk_type = ::cell::Vision::camera_t;
  static constexpr const char* kName = "cell::Vision::camera";
  static constexpr ::std::uint64_t kNameHash = 0xc60a32ba69f4e5a2;
  static constexpr ::std::uint64_t kTypeHash = 0x31ee527ee9fa7297;
};
struct pool_cell_Vision_left {
  using chunk_type = ::cell::Vision::Cloud;
  static constexpr const char* kName = "cell::Vision::left";
  static constexpr ::std::uint64_t kNameHash = 0x5160658e2aad3704;
  static constexpr ::std::uint64_t kTypeHash = 0x867367ea1737b4a5;
};
struct pool_cell_Vision_right {
  using chunk_type = ::cell::Vision::Cloud;
  static constexpr const char* kName = "cell::Vision::right";
  static constexpr ::std::uint64_t kNameHash = 0x25d30d9ecd801e51;
  static constexpr ::std::uint64_t kTypeHash = 0x866267ea17294172;
};
struct pool_cell_Vision_merged {
  using chunk_type = ::cell::Vision::Cloud;
  static constexpr const char* kName = "cell::Vision::merged";
  static constexpr ::std::uint64_t kNameHash = 0xd1624f5b8b1edc85;
  static constexpr ::std::uint64_t kTypeHash = 0x867663ea1739e3b0;
};
}  // namespace indurop_generated_f8cd2522d655200d

namespace cell::Vision {
inline constexpr ::indurop::Pool<::indurop_generated_f8cd2522d655200d::pool_cell_Vision_camera> camera{};
inline constexpr ::indurop::Pool<::indurop_generated_f8cd2522d655200d::pool_cell_Vision_left> left{};  // of the two scanners
inline constexpr ::indurop::Pool<::indurop_generated_f8cd2522d655200d::pool_cell_Vision_right> right{};  // of the two scanners
inline constexpr ::indurop::Pool<::indurop_generated_f8cd2522d655200d::pool_cell_Vision_merged> merged{};  // filtered
inline constexpr ::indurop_generated_f8cd2522d655200d::ref_cell_Vision_pool<::indurop_generated_f8cd2522d655200d::var_cell_Vision_table, 0> table{::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr ::indurop::ArrayRef<::indurop::Leaf<::indurop_generated_f8cd2522d655200d::var_cell_Vision_x, ::std::int32_t, 0>, 2> x{::indurop::Place{0}, ::indurop::detail::Make{}};
}  // namespace cell::Vision
