// SPDX-License-Identifier: Apache-2.0
// Variables and values of the C interface.
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <span>
#include <utility>

#include "core/rt/clock.h"
#include "core/schema/schema.h"
#include "doors/c/describe.h"
#include "doors/c/failure.h"
#include "doors/c/node.h"
#include "store/operate/hold.h"
#include "store/operate/item.h"
#include "store/operate/set.h"
#include "store/vars/snapshot.h"

using indurop::Result;
using indurop::Status;
using indurop::c::Failure;
using indurop::c::failure_of;
using indurop::c::Found;
using indurop::c::guarded;
namespace abi = indurop::abi;
namespace operate = indurop::operate;
namespace rt = indurop::rt;
namespace schema = indurop::schema;
namespace vars = indurop::vars;

namespace {

constexpr std::int64_t kPollNs = 500'000;  // between two reads of a value that is waited for

Failure null_argument(const char* function) {
  return {IRP_INVALID, fmt::format("{}: an argument is null", function)};
}

Result<const Found*, Failure> sized(const irp_node& node, std::uint32_t id, std::size_t size) {
  auto found = node.found(id);
  if (found && (*found)->item.place.type.size() != size) {
    return Failure{IRP_SIZE, fmt::format("{} has {} bytes, the buffer {}", (*found)->item.name,
                                         (*found)->item.place.type.size(), size)};
  }
  return found;
}

Result<void, Failure> read(const irp_node& node, const Found& found, std::span<std::uint8_t> to) {
  const Status status = node.store().read(*found.item.entry, found.item.place.offset, to);
  return status ? Result<void, Failure>() : failure_of(status.error(), found.item.name);
}

Result<const Found*, Failure> to_change(const irp_node& node, Result<const Found*, Failure> found) {
  return !found || node.access() == IRP_WRITE
             ? std::move(found)
             : Failure{IRP_DENIED, fmt::format("node '{}' was opened to read; use IRP_WRITE", node.name())};
}

operate::Who who(const char* reason) {
  return {{}, {}, reason == nullptr ? "" : reason};
}

Result<operate::Assignment, Failure> assignment(const irp_node& node, const Found& found, const std::string& text) {
  auto parsed = operate::parse(node.store(), found.item, text);
  if (!parsed) {
    return Failure{IRP_RANGE, std::move(parsed).error().text};
  }
  return std::move(parsed).value();
}

Result<operate::Assignment, Failure> assignment(const irp_node& node, const Found& found,
                                                std::span<const std::uint8_t> bytes) {
  const schema::Type& type = found.item.place.type;
  auto made = assignment(node, found, schema::format_value(type, bytes));
  if (made && schema::format_value(type, made->bytes) != made->text) {
    return Failure{IRP_RANGE,
                   fmt::format("{}: {} is not a value of {}", found.item.name, made->text, found.texts.type)};
  }
  return made;
}

Result<void, Failure> set(irp_node& node, Result<operate::Assignment, Failure> made, const char* reason) {
  if (!made) {
    return std::move(made).error();
  }
  auto done = operate::set(node.name(), node.store(), {std::move(made).value()}, who(reason));
  return done ? Result<void, Failure>() : failure_of(done.error());
}

constexpr std::uint32_t flag(bool is_set, std::uint32_t value) {
  return is_set ? value : 0;
}

std::uint64_t hash_of(std::span<const std::uint8_t> bytes) {
  const std::uint64_t hash = abi::fnv1a64(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  return hash == 0 ? 1 : hash;  // 0 stands for no value
}

}  // namespace

irp_code irp_find(irp_node* node, const char* name, uint32_t* id) {
  return guarded([&]() -> Result<void, Failure> {
    if (node == nullptr || name == nullptr || id == nullptr) {
      return null_argument("irp_find");
    }
    auto found = node->find(name);
    if (!found) {
      return std::move(found).error();
    }
    *id = *found;
    return {};
  });
}

irp_code irp_describe(const irp_node* node, uint32_t id, irp_variable* variable) {
  return guarded([&]() -> Result<void, Failure> {
    if (node == nullptr || variable == nullptr) {
      return null_argument("irp_describe");
    }
    const auto found = node->found(id);
    if (!found) {
      return found.error();
    }
    return indurop::c::describe((*found)->texts, (*found)->item.place, variable)
               ? Result<void, Failure>()
               : Failure{IRP_INVALID, "irp_describe: struct_size is not set"};
  });
}

irp_code irp_read(const irp_node* node, uint32_t id, void* to, size_t size) {
  return guarded([&]() -> Result<void, Failure> {
    if (node == nullptr || to == nullptr) {
      return null_argument("irp_read");
    }
    const auto found = sized(*node, id, size);
    return found ? read(*node, **found, {static_cast<std::uint8_t*>(to), size}) : found.error();
  });
}

irp_code irp_read_together(const irp_node* node, const uint32_t* ids, size_t count, void* const* to,
                           const size_t* sizes) {
  return guarded([&]() -> Result<void, Failure> {
    if (node == nullptr || (count != 0 && (ids == nullptr || to == nullptr || sizes == nullptr))) {
      return null_argument("irp_read_together");
    }
    std::vector<const Found*> found;
    std::vector<vars::PartToRead> parts;
    for (std::size_t i = 0; i < count; ++i) {
      auto one = to[i] == nullptr ? null_argument("irp_read_together") : sized(*node, ids[i], sizes[i]);
      if (!one) {
        return std::move(one).error();
      }
      found.push_back(*one);
      parts.push_back({(*one)->item.entry, (*one)->item.place.offset, {static_cast<std::uint8_t*>(to[i]), sizes[i]}});
    }
    const Status together = vars::read_snapshot(node->store(), parts);
    if (together || together.error().code != indurop::Errc::Busy) {
      return together ? Result<void, Failure>() : failure_of(together.error(), node->name());
    }
    for (std::size_t i = 0; i < count; ++i) {
      if (auto alone = read(*node, *found[i], parts[i].to); !alone) {
        return alone;
      }
    }
    return Failure{IRP_APART, "the values change without a pause, or come from several boards: each was read alone"};
  });
}

irp_code irp_get_quality(const irp_node* node, uint32_t id, irp_quality* quality) {
  return guarded([&]() -> Result<void, Failure> {
    if (node == nullptr || quality == nullptr || quality->struct_size < sizeof quality->struct_size) {
      return Failure{IRP_INVALID, "irp_get_quality: an argument is null, or struct_size is not set"};
    }
    const auto found = node->found(id);
    if (!found) {
      return found.error();
    }
    const operate::Item& item = (*found)->item;
    irp_quality full{};
    full.struct_size = quality->struct_size;
    const std::vector<vars::Force> forces = node->store().forces();
    const bool forced = std::any_of(forces.begin(), forces.end(),
                                    [&](const vars::Force& force) { return operate::touches(force, item); });
    full.flags = flag(forced, IRP_IS_FORCED);
    const std::int64_t confirmed =
        abi::confirmed_of(node->store().entry(item.entry->name_hash, 0), item.entry->kind).load();
    if (confirmed == abi::kNeverConfirmed) {
      full.flags |= IRP_REMOTE | IRP_NEVER;
    } else if (confirmed != 0) {
      full.flags |= flag(true, IRP_REMOTE) | flag(confirmed < 0, IRP_SILENT);
      full.confirmed_ns = rt::to_ns(node->store().now()) - (confirmed < 0 ? -confirmed : confirmed);
    }
    std::memcpy(quality, &full, std::min(quality->struct_size, sizeof full));
    return {};
  });
}

irp_code irp_get_text(const irp_node* node, uint32_t id, char* to, size_t size, size_t* needed) {
  return guarded([&]() -> Result<void, Failure> {
    if (node == nullptr || (to == nullptr && size != 0)) {
      return null_argument("irp_get_text");
    }
    const auto found = node->found(id);
    if (!found) {
      return found.error();
    }
    std::vector<std::uint8_t> bytes((*found)->item.place.type.size());
    if (auto done = read(*node, **found, bytes); !done) {
      return done;
    }
    const std::string text = schema::format_value((*found)->item.place.type, bytes);
    if (needed != nullptr) {
      *needed = text.size() + 1;
    }
    if (size <= text.size()) {
      return Failure{IRP_SIZE, fmt::format("the text of {} needs {} bytes", (*found)->item.name, text.size() + 1)};
    }
    std::memcpy(to, text.c_str(), text.size() + 1);
    return {};
  });
}

irp_code irp_wait_change(const irp_node* node, uint32_t id, uint64_t* seen, int64_t timeout_ns) {
  return guarded([&]() -> Result<void, Failure> {
    if (node == nullptr || seen == nullptr || timeout_ns < 0) {
      return Failure{IRP_INVALID, "irp_wait_change: an argument is null, or the time is negative"};
    }
    std::vector<std::uint8_t> bytes;
    for (const std::int64_t begin = rt::now_ns();;) {
      const auto found = node->found(id);
      if (!found) {
        return found.error();
      }
      bytes.resize((*found)->item.place.type.size());
      if (auto done = read(*node, **found, bytes); !done) {
        return done;
      }
      if (const std::uint64_t now = hash_of(bytes); now != *seen) {
        *seen = now;
        return {};
      }
      if (auto running = node->running(); !running) {
        return running;
      }
      const std::int64_t left = timeout_ns - (rt::now_ns() - begin);
      if (left <= 0) {
        return Failure{IRP_TIMEOUT, fmt::format("{} did not change", (*found)->item.name)};
      }
      rt::sleep_until(rt::now_ns() + std::min(left, kPollNs));
    }
  });
}

irp_code irp_write(irp_node* node, uint32_t id, const void* from, size_t size, const char* reason) {
  return guarded([&]() -> Result<void, Failure> {
    if (node == nullptr || from == nullptr) {
      return null_argument("irp_write");
    }
    const auto found = to_change(*node, sized(*node, id, size));
    if (!found) {
      return found.error();
    }
    return set(*node, assignment(*node, **found, {static_cast<const std::uint8_t*>(from), size}), reason);
  });
}

irp_code irp_set_text(irp_node* node, uint32_t id, const char* text, const char* reason) {
  return guarded([&]() -> Result<void, Failure> {
    if (node == nullptr || text == nullptr) {
      return null_argument("irp_set_text");
    }
    const auto found = to_change(*node, node->found(id));
    if (!found) {
      return found.error();
    }
    return set(*node, assignment(*node, **found, std::string(text)), reason);
  });
}

irp_code irp_force(irp_node* node, uint32_t id, const void* from, size_t size, int64_t for_ns, const char* reason) {
  return guarded([&]() -> Result<void, Failure> {
    if (node == nullptr || from == nullptr || for_ns < 0) {
      return Failure{IRP_INVALID, "irp_force: an argument is null, or the time is negative"};
    }
    const auto found = to_change(*node, sized(*node, id, size));
    if (!found) {
      return found.error();
    }
    auto made = assignment(*node, **found, {static_cast<const std::uint8_t*>(from), size});
    if (!made) {
      return std::move(made).error();
    }
    auto held = operate::hold(node->name(), node->store(), {std::move(made).value()}, for_ns, operate::Ends::AtTime,
                              who(reason));
    return held ? Result<void, Failure>() : failure_of(held.error());
  });
}

irp_code irp_release(irp_node* node, uint32_t id, const char* reason) {
  return guarded([&]() -> Result<void, Failure> {
    if (node == nullptr) {
      return null_argument("irp_release");
    }
    const auto found = to_change(*node, node->found(id));
    if (!found) {
      return found.error();
    }
    auto released = operate::release(node->name(), node->store(), {(*found)->item}, who(reason));
    if (!released) {
      return failure_of(released.error());
    }
    return released->empty() ? Failure{IRP_NOT_FOUND, fmt::format("{} is not forced", (*found)->item.name)}
                             : Result<void, Failure>();
  });
}
