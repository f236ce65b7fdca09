// SPDX-License-Identifier: Apache-2.0
// Calls of shared functions by modules: in the store to which the process is bound.

#include <indurop/detail/call.h>
#include <indurop/result.h>

#include "store/runtime/call_server.h"
#include "store/runtime/host.h"
#include "store/runtime/process.h"
#include "store/vars/call_exchange.h"

namespace indurop::runtime {

namespace {

using vars::CallFunction;

// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): what a thread keeps from call to call
[[gnu::tls_model("initial-exec")]] thread_local vars::Caller t_caller;

Errc call_now(const detail::CallRequest& request) noexcept {
  const Attachment* attachment = hot.attachment.load(std::memory_order_acquire);
  CallFunction* function = attachment != nullptr ? attachment->calls().function(request.name_hash) : nullptr;
  if (function == nullptr) {
    return Errc::NotFound;
  }
  if (function->type_hash != request.type_hash || function->args_size != request.args_size ||
      function->result_size != request.result_size) {
    return Errc::TypeMismatch;
  }
  // A module's server thread cannot wait for itself.
  if (const detail::FunctionOffer* own = offer_of_this_server(request.name_hash)) {
    return invoke_contained(*own, request.args, request.result);
  }
  const Errc code = vars::find_call_server(*function);
  return code == Errc::Ok ? vars::exchange_call(attachment->calls(), *function,
                                                {request.args, request.result, request.args_size, request.result_size,
                                                 request.deadline_ns},
                                                t_caller)
                          : code;
}

// A repeated run gets the recorded answer.
Errc call(const detail::CallRequest& request) noexcept {
  const auto is_good = [](std::int64_t code) { return code == static_cast<std::int64_t>(Errc::Ok); };
  return static_cast<Errc>(answer(request.result, request.result_size, is_good,
                                  [&] { return static_cast<std::int64_t>(call_now(request)); }));
}

}  // namespace

void release_calls_of_this_thread() noexcept {
  vars::release_call(t_caller);
}

}  // namespace indurop::runtime

extern "C" int indurop_call(const indurop::detail::CallRequest* request) noexcept {
  return static_cast<int>(indurop::runtime::call(*request));
}
