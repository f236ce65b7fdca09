// SPDX-License-Identifier: Apache-2.0
// Shared variables by name.

#include <indurop/channel.h>

#include <fmt/format.h>

#include <cstdio>
#include <cstring>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "core/rt/clock.h"
#include "store/runtime/host.h"
#include "store/runtime/process.h"

namespace channel {

namespace {

namespace runtime = indurop::runtime;
namespace schema = indurop::schema;
using indurop::Errc;
using indurop::Status;

constexpr std::int64_t kRetryNs = 100'000'000;  // interval at which a handle without a node searches for it

// A name that was resolved, or the reason why that failed.
struct Resolved {
  indurop::vars::DirectoryEntry entry{};
  std::uint32_t offset = 0;
  std::uint32_t size = 0;
  schema::Base base = schema::Base::Struct;
  bool is_array = false;
  Errc error = Errc::Ok;
  bool complained = false;  // about an access of the wrong size or type
};

bool is_made_of(const Resolved& part, detail::Basic basic) noexcept {
  if (basic == detail::Basic::Any) {
    return true;
  }
  if (part.is_array) {
    return false;
  }
  switch (part.base) {
    case schema::Base::Bool:
      return basic == detail::Basic::Bool;
    case schema::Base::Float:
    case schema::Base::Double:
      return basic == detail::Basic::Real;
    case schema::Base::Int8:
    case schema::Base::Int16:
    case schema::Base::Int32:
    case schema::Base::Int64:
    case schema::Base::Enum:
      return basic == detail::Basic::Signed;
    case schema::Base::UInt8:
    case schema::Base::UInt16:
    case schema::Base::UInt32:
    case schema::Base::UInt64:
      return basic == detail::Basic::Unsigned;
    case schema::Base::Char:
    case schema::Base::Text:
    case schema::Base::Struct:
      return false;
  }
  return false;
}

}  // namespace

struct Handle::Impl {
  std::string node = runtime::default_node();
  std::optional<runtime::Attachment> own;           // for a node this process is not bound to
  const runtime::Attachment* attachment = nullptr;  // in use; the names below belong to it
  std::map<std::string, Resolved, std::less<>> names;
  std::uint64_t layout = 0;  // of the store when they were resolved
  std::int64_t next_try_ns = 0;

  Status connect();
  Status open_own();
  // Returns null if there is no node. Reconnects if it was replaced.
  const runtime::Attachment* current();
  // Forgets the names if the node has other variables since. Returns true if it did.
  bool follow();
  Resolved& resolve(std::string_view name);
};

Handle::Handle() noexcept = default;
Handle::Handle(Handle&&) noexcept = default;
Handle& Handle::operator=(Handle&&) noexcept = default;
Handle::~Handle() = default;

Handle::Impl& Handle::impl() {
  if (impl_ == nullptr) {
    impl_ = std::make_unique<Impl>();
  }
  return *impl_;
}

Status Handle::Impl::connect() {
  next_try_ns = indurop::rt::now_ns() + kRetryNs;
  names.clear();
  attachment = nullptr;
  runtime::Attachment* shared = runtime::hot.attachment.load(std::memory_order_acquire);
  if (shared == nullptr && node == runtime::default_node()) {
    std::size_t unbound = 0;
    if (const Status status = runtime::Process::get().attach(node, unbound); !status) {
      return status;
    }
    shared = runtime::hot.attachment.load(std::memory_order_acquire);
  }
  if (shared != nullptr && shared->node() == node) {
    runtime::Process::get().refresh();
    own.reset();
    attachment = runtime::hot.attachment.load(std::memory_order_acquire);
    layout = attachment->store().layout_hash();
    return {};
  }
  return open_own();
}

Status Handle::Impl::open_own() {
  auto opened = runtime::Attachment::open(node);
  if (!opened) {
    return opened.error();
  }
  names.clear();
  own.emplace(std::move(opened).value());
  attachment = &*own;
  layout = own->store().layout_hash();
  return {};
}

// The variables of the program keep their places in the attachment that it shares, so it is not replaced.
bool Handle::Impl::follow() {
  if (attachment == nullptr) {
    return false;
  }
  if (attachment->store().grown() && !runtime::Process::get().hosted()) {
    return open_own().ok();
  }
  if (attachment->store().layout_hash() == layout) {
    return false;
  }
  names.clear();
  layout = attachment->store().layout_hash();
  return true;
}

const runtime::Attachment* Handle::Impl::current() {
  if (attachment != nullptr && !attachment->retired()) [[likely]] {
    if (own || attachment == runtime::hot.attachment.load(std::memory_order_acquire)) [[likely]] {
      return attachment;
    }
  }
  if (attachment == nullptr && indurop::rt::now_ns() < next_try_ns) {
    return nullptr;
  }
  if (const Status status = connect(); !status) {
    runtime::Process::get().report(fmt::format("cannot connect to node '{}': {} ({})", node,
                                               to_string(status.error().code), status.error().where));
  }
  return attachment;
}

Resolved& Handle::Impl::resolve(std::string_view name) {
  if (const auto known = names.find(name); known != names.end()) [[likely]] {
    return known->second;
  }
  follow();
  Resolved& part = names[std::string(name)];
  const auto place = schema::find_place(attachment->store().schema(), name);
  if (!place) {
    part.error = place.error().code;
    runtime::Process::get().report(fmt::format("channel to node '{}': {}", node, place.error().message));
    return part;
  }
  part.offset = place.value().offset;
  part.size = static_cast<std::uint32_t>(place.value().type.size());
  part.base = place.value().type.base;
  part.is_array = !place.value().type.dims.empty();
  if (const auto* entry = attachment->store().find(place.value().variable->name_hash()); entry != nullptr) {
    part.entry = *entry;
  } else {
    part.error = Errc::NotFound;
  }
  return part;
}

int connect(Handle& handle, const char* node) {
  Handle::Impl& impl = handle.impl();
  if (node != nullptr && *node != '\0' && impl.node != node) {
    impl.node = node;
    impl.own.reset();
  }
  return static_cast<int>(runtime::answer([&impl] { return -static_cast<std::int64_t>(impl.connect().error().code); }));
}

std::ptrdiff_t read(Handle& handle, std::string_view name, std::size_t size, void* to) {
  return detail::access(handle, name, size, to, detail::Basic::Any, false);
}

std::ptrdiff_t write(Handle& handle, std::string_view name, std::size_t size, const void* from) {
  return detail::access(handle, name, size, const_cast<void*>(from), detail::Basic::Any, true);  // NOLINT: only read
}

namespace {

std::ptrdiff_t access_now(Handle::Impl& impl, std::string_view name, std::size_t size, void* value, detail::Basic basic,
                          bool is_write) {
  if (impl.current() == nullptr) {
    return -static_cast<std::ptrdiff_t>(Errc::NotFound);
  }
  const auto fits = [size, basic](const Resolved& part) { return part.size == size && is_made_of(part, basic); };
  Resolved* known = &impl.resolve(name);
  if ((known->error != Errc::Ok || !fits(*known)) && impl.follow()) {
    known = &impl.resolve(name);
  }
  Resolved& part = *known;
  if (part.error != Errc::Ok) {
    return -static_cast<std::ptrdiff_t>(part.error);
  }
  if (!fits(part)) {
    if (!std::exchange(part.complained, true)) {
      const std::string is = fmt::format("{}{}", schema::name_of(part.base), part.is_array ? " array" : "");
      runtime::Process::get().report(fmt::format("channel to node '{}': {} is a {} of {} bytes, the program gives {}{}",
                                                 impl.node, name, is, part.size, size,
                                                 part.size == size ? " of another type" : ""));
    }
    return -static_cast<std::ptrdiff_t>(Errc::TypeMismatch);
  }
  auto* bytes = static_cast<std::uint8_t*>(value);
  indurop::vars::Store& store = impl.attachment->store();
  const Status status = is_write ? store.write(part.entry, part.offset, {bytes, size})
                                 : store.read(part.entry, part.offset, {bytes, size});
  return status ? static_cast<std::ptrdiff_t>(size) : -static_cast<std::ptrdiff_t>(status.error().code);
}

}  // namespace

// A repeated run reads the recorded values.
std::ptrdiff_t detail::access(Handle& handle, std::string_view name, std::size_t size, void* value, Basic basic,
                              bool is_write) {
  const auto is_read = [is_write](std::int64_t code) { return !is_write && code >= 0; };
  return static_cast<std::ptrdiff_t>(runtime::answer(value, size, is_read, [&]() -> std::int64_t {
    const std::ptrdiff_t done = access_now(handle.impl(), name, size, value, basic, is_write);
    return done < 0 && handle.impl().follow() ? access_now(handle.impl(), name, size, value, basic, is_write) : done;
  }));
}

}  // namespace channel
