// SPDX-License-Identifier: Apache-2.0
// Implements the functions of functions.glb, except `nowhere`.
#include <indurop/generated.h>
#include <indurop/indurop.h>

#include <chrono>
#include <stdexcept>
#include <thread>

void onRun() {}

INDUROP_IMPLEMENT(calc::add, [](std::int32_t a, std::int32_t b) {
  calc::calls += 1;
  return a + b;
})
INDUROP_IMPLEMENT(calc::turn, [](const calc::Pair& pair, calc::Mode mode, const indurop::string<8>& text) {
  const auto a = static_cast<double>(pair.a);
  return calc::Pair{static_cast<std::int64_t>(pair.b) + static_cast<std::int64_t>(text.view().size()),
                    mode == calc::FAST ? -a : a};
})
INDUROP_IMPLEMENT(calc::reset, [] { calc::calls = 0; })
INDUROP_IMPLEMENT(calc::nap, [](std::uint32_t ms) {
  std::this_thread::sleep_for(std::chrono::milliseconds(ms));
  return ms;
})
INDUROP_IMPLEMENT(calc::fails, [](std::int32_t why) -> std::int32_t {
  throw std::runtime_error("as requested, " + std::to_string(why));
})
INDUROP_IMPLEMENT(calc::secret, [](std::int32_t a) { return a; })

INDUROP_MODULE(run = &::onRun, name = "functions")
