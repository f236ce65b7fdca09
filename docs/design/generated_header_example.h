// What glb2idl writes for Figure 3 plus a nested struct. THIS FILE IS THE CONTRACT with glb2idl/emit_cpp.
#pragma once
#include <indurop/lock.h>
#include <indurop/var.h>

// The schema: one JSON text, not loaded at run time, one copy per object thanks to comdat.
asm(R"indurop(.pushsection .indurop.schema,"G",%progbits,indurop_schema_0123456789abcdef,comdat
.ascii "{\"schema\":1}\n"
.popsection)indurop");

namespace knu::Robot {

struct joints_t {
  double x{};
  double y{};
  double z{};
  friend bool operator==(const joints_t&, const joints_t&) = default;
};
static_assert(sizeof(joints_t) == 24 && alignof(joints_t) == 8);
static_assert(offsetof(joints_t, x) == 0 && offsetof(joints_t, y) == 8 && offsetof(joints_t, z) == 16);
template <class F>
constexpr void indurop_fields(const joints_t& v, F f) {
  f("x", v.x);
  f("y", v.y);
  f("z", v.z);
}

}  // namespace knu::Robot

namespace indurop_generated_0123456789abcdef __attribute__((visibility("hidden"))) {
inline constexpr std::uint32_t tick_initial{0};
inline constinit ::indurop::abi::Ref refs[] = {
    {0x1111111111111111, 0x2222222222222222, nullptr, nullptr, 4, ::indurop::abi::Kind::Scalar, "knu::Robot::tick"},
    {0x3333333333333333, 0x4444444444444444, nullptr, nullptr, 240, ::indurop::abi::Kind::Ring, "knu::Robot::joints"},
};
struct knu_Robot_tick {
  static constexpr std::uint64_t kNameHash = 0x1111111111111111;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Scalar;
  static constexpr std::size_t kSize = 4;
  INDUROP_ALWAYS_INLINE static const ::indurop::abi::Ref& ref() noexcept { return refs[0]; }
};
struct knu_Robot_joints {
  static constexpr std::uint64_t kNameHash = 0x3333333333333333;
  static constexpr ::indurop::abi::Kind kKind = ::indurop::abi::Kind::Ring;
  static constexpr std::size_t kSize = 240;
  INDUROP_ALWAYS_INLINE static const ::indurop::abi::Ref& ref() noexcept { return refs[1]; }
};
// One union per struct type: all members share the Place.
template <class Tag, std::uint32_t Offset, class = ::indurop::Adl>
union knu_Robot_joints_t_ref {
  using value_type = ::knu::Robot::joints_t;
  using whole_type = value_type;
  using tag_type = Tag;
  static constexpr std::uint32_t kOffset = Offset;
  ::indurop::Place place;
  ::indurop::Leaf<Tag, double, Offset + 0> x;
  ::indurop::Leaf<Tag, double, Offset + 8> y;
  ::indurop::Leaf<Tag, double, Offset + 16> z;
  INDUROP_STRUCT_SHAPE(knu_Robot_joints_t_ref)
};
[[gnu::constructor(101)]] inline void bind() { indurop_register_refs(refs, 2, ::indurop::abi::kVersion); }
[[gnu::destructor(101)]] inline void unbind() { indurop_unregister_refs(refs); }
}  // namespace indurop_generated_0123456789abcdef

namespace knu::Robot {
inline constexpr ::indurop::Leaf<::indurop_generated_0123456789abcdef::knu_Robot_tick, std::uint32_t, 0> tick{
    ::indurop::Place{0}, ::indurop::detail::Make{}};
inline constexpr ::indurop::ArrayRef<::indurop_generated_0123456789abcdef::knu_Robot_joints_t_ref<::indurop_generated_0123456789abcdef::knu_Robot_joints, 0>, 10> joints{
    ::indurop::Place{0}, ::indurop::detail::Make{}};
}  // namespace knu::Robot

// A shared function:  double add(double a, double b) deadline 5ms;   (void results: Function<Tag, void(...)>)
namespace knu::Robot {
struct add_args {
  double a{};
  double b{};
};
}  // namespace knu::Robot
namespace indurop_generated_0123456789abcdef __attribute__((visibility("hidden"))) {
struct knu_Robot_add {
  using args = ::knu::Robot::add_args;
  using result = double;  // absent members are never needed: void results say `using result = void;`
  static constexpr const char* kName = "knu::Robot::add";
  static constexpr std::uint64_t kNameHash = 0x5555555555555555;
  static constexpr std::uint64_t kTypeHash = 0x6666666666666666;
  static constexpr std::int64_t kDeadlineNs = 5'000'000;
  template <class F>
  static result apply(F&& f, const args& a) {
    return f(a.a, a.b);
  }
};
}  // namespace indurop_generated_0123456789abcdef
#if 0  // needs <indurop/function.h>
namespace knu::Robot {
inline constexpr ::indurop::Function<::indurop_generated_0123456789abcdef::knu_Robot_add, double(double, double)> add{};
}
#endif
