// SPDX-License-Identifier: Apache-2.0
// From the C interface to an instance: null pointers, exceptions and the log end here.

#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <span>

#include "doors/fmi/library/instance.h"

namespace indurop::fmi {

// Calls `act` with the instance, and logs what is wrong under the name of the function. Nothing is thrown.
template <class Act>
Outcome at_border(void* component, const char* function, Act act) noexcept {
  auto* const instance = static_cast<Instance*>(component);
  if (instance == nullptr) {
    return Outcome::Error;
  }
  try {
    const Done done = act(*instance);
    if (done) {
      return Outcome::Ok;
    }
    const Outcome outcome = done.error().outcome;
    instance->log(outcome, category_of(outcome), fmt::format("{}: {}", function, done.error().text));
    return outcome;
  } catch (...) {  // memory is exhausted
    return Outcome::Error;
  }
}

inline Done refused(const char* why) {
  return Trouble{Outcome::Error, why};
}

// Calls `act` with the value references, if no pointer is null.
template <class Act>
Done with_arrays(const std::uint32_t* references, std::size_t count, const void* values, Act act) {
  if (count > 0 && (references == nullptr || values == nullptr)) {
    return refused("an array is a null pointer");
  }
  return act(std::span(references, count));
}

// Instantiates, or logs why that is not possible. Nothing is thrown. `strings` may be null.
inline void* instantiate(const std::filesystem::path& resources, const char* token, bool logging,
                         const Logger& logger) {
  auto made = Instance::make(resources, token == nullptr ? "" : token, logger);
  if (!made) {
    logger(Outcome::Error, category_of(Outcome::Error), made.error().text);
    return nullptr;
  }
  (void)(*made)->set_logging(logging, {});
  return std::move(made).value().release();
}

inline std::vector<std::string_view> texts_of(const char* const* texts, std::size_t count) {
  std::vector<std::string_view> all;
  for (std::size_t i = 0; texts != nullptr && i < count; ++i) {
    all.emplace_back(texts[i] == nullptr ? "" : texts[i]);
  }
  return all;
}

}  // namespace indurop::fmi
