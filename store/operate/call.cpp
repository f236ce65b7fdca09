// SPDX-License-Identifier: Apache-2.0
#include "store/operate/call.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <indurop/function.h>

#include <algorithm>
#include <cstring>

#include "core/rt/clock.h"
#include "store/operate/journal.h"
#include "store/operate/set.h"
#include "store/vars/call_exchange.h"

namespace indurop::operate {
namespace {

std::uint64_t hash_of_name(const schema::Function& function) noexcept {
  return abi::fnv1a64(function.name.data(), function.name.size());
}

std::int64_t deadline_of(const schema::Function& function) noexcept {
  return std::min(function.deadline_ns > 0 ? function.deadline_ns : kDefaultCallDeadline.count(), kMaxCallNs);
}

// Returns what is wrong with an argument; empty: its value is in the bytes.
std::string take_argument(const schema::Field& parameter, const std::string& text, ReadLiteral literal,
                          std::span<std::uint8_t> bytes) {
  const std::span<std::uint8_t> part = bytes.subspan(parameter.offset, parameter.type.size());
  if (const auto parsed = schema::parse_value(parameter.type, text, part);
      !parsed && (literal == nullptr || !literal(parameter.type, text, part))) {
    return fmt::format("{}: {}", parameter.name, parsed.error().message);
  }
  if (parameter.range) {
    if (const auto inside = schema::check_range(*parameter.range, parameter.type, part); !inside) {
      return fmt::format("{}: {}", parameter.name, inside.error().message);
    }
  }
  return {};
}

Refusal refusal_of(const schema::Function& function, Errc code) {
  const auto because = [&function](Why why, std::string_view reason) {
    return Refusal{why, {fmt::format("{}: {}", function.name, reason)}};
  };
  switch (code) {
    case Errc::NotFound:
      return because(Why::Absent, "no module implements it");
    case Errc::Dead:
      return because(Why::Absent, "the process that implements it has died");
    case Errc::Busy:
      return because(Why::Busy, "all its call slots are in use; try again");
    case Errc::Timeout:
      return because(Why::Busy, "no result in time; it may have been executed all the same");
    case Errc::Failed:
      return because(Why::Wrong, "the function has failed; see the messages of its node");
    default:
      return because(Why::Wrong, to_string(code));
  }
}

}  // namespace

const schema::Function* find_function(const vars::Store& store, std::string_view name) noexcept {
  const auto& functions = store.schema().functions;
  const auto found = std::find_if(functions.begin(), functions.end(),
                                  [name](const schema::Function& function) { return function.name == name; });
  return found == functions.end() ? nullptr : &*found;
}

bool is_void(const schema::Function& function) noexcept {
  return function.result.base == schema::Base::Struct && function.result.fields.empty();
}

bool is_served(const vars::Store& store, const schema::Function& function) noexcept {
  const vars::CallFunction* const shared = vars::CallArea(store.header()).function(hash_of_name(function));
  return shared != nullptr && shared->server_pid.load(std::memory_order_relaxed) != 0;
}

Result<FunctionCall, Refusal> prepare_call(const schema::Function& function,
                                           const std::vector<std::pair<std::string, std::string>>& arguments,
                                           ReadLiteral literal) {
  FunctionCall out{&function, std::vector<std::uint8_t>(function.arguments.size(), 0), {}};
  Refusal wrong;
  const auto given = [&arguments](const std::string& name) {
    return std::find_if(arguments.begin(), arguments.end(), [&name](const auto& one) { return one.first == name; });
  };
  for (const schema::Field& parameter : function.arguments.fields) {
    const auto argument = given(parameter.name);
    std::string problem = argument == arguments.end()
                              ? fmt::format("{} is missing", parameter.name)
                              : take_argument(parameter, argument->second, literal, out.arguments);
    if (!problem.empty()) {
      wrong.reasons.push_back(std::move(problem));
    } else {
      out.text += fmt::format("{}{}={}", out.text.empty() ? "" : ", ", parameter.name, argument->second);
    }
  }
  for (const auto& [name, text] : arguments) {
    const auto& parameters = function.arguments.fields;
    const bool known =
        std::ranges::any_of(parameters, [&name = name](const schema::Field& one) { return one.name == name; });
    if (!known) {
      wrong.reasons.push_back(fmt::format("{} has no argument '{}'", function.name, name));
    }
  }
  return wrong.reasons.empty() ? Result<FunctionCall, Refusal>(std::move(out)) : std::move(wrong);
}

Result<std::vector<std::uint8_t>, Refusal> call(const std::string& node, vars::Store& store, const FunctionCall& call,
                                                const Who& who) {
  if (auto locked = refusal(node, vars::Act::Command)) {
    return std::move(*locked);
  }
  const schema::Function& function = *call.function;
  const vars::CallArea area(store.header());
  vars::CallFunction* const shared = area.function(hash_of_name(function));
  const std::size_t result_size = is_void(function) ? 0 : function.result.size();
  const std::size_t args_size = function.arguments.fields.empty() ? 0 : call.arguments.size();
  if (shared == nullptr || shared->type_hash != function.type_hash || shared->args_size != args_size ||
      shared->result_size != result_size) {
    return refusal_of(function, Errc::TypeMismatch);
  }
  // A server that was never there is not looked for: that would take its lock.
  Errc code =
      shared->server_pid.load(std::memory_order_relaxed) != 0 ? vars::find_call_server(*shared) : Errc::NotFound;
  std::vector<std::uint8_t> result(result_size);
  if (code == Errc::Ok) {
    note(node, {rt::to_ns(store.now()), 0, who.name, who.from, "call", function.name, call.text, 0, who.reason});
    vars::Caller caller;
    code = vars::exchange_call(area, *shared,
                               {call.arguments.data(), result.data(), static_cast<std::uint32_t>(args_size),
                                static_cast<std::uint32_t>(result_size), deadline_of(function)},
                               caller);
  }
  if (code != Errc::Ok) {
    return refusal_of(function, code);
  }
  return result;
}

}  // namespace indurop::operate
