// SPDX-License-Identifier: Apache-2.0
#include "control/io/fmu_instance.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <utility>

#include "control/io/fmu/fmu_file.h"
#include "core/base/printable.h"

namespace indurop::io {

void FmuLog::add(Kind kind, const char* category, const char* text) {
  constexpr std::size_t kMaxText = 2000;
  std::string line(text == nullptr ? "" : text);
  line.resize(std::min(line.size(), kMaxText));
  while (line.ends_with('\n') || line.ends_with(' ')) {
    line.pop_back();
  }
  line = base::printable(line);
  const std::lock_guard lock(mutex_);
  if (kind != Kind::Information) {
    reason_ = line;
  }
  if (all_ || kind != Kind::Information) {
    print_(category == nullptr || kind != Kind::Information ? line
                                                            : fmt::format("{}: {}", base::printable(category), line));
  }
}

std::string FmuLog::take_reason() {
  const std::lock_guard lock(mutex_);
  return std::exchange(reason_, {});
}

Result<std::unique_ptr<FmuInstance>, std::string> FmuInstance::make(const fmu::Description& description,
                                                                    const FmuIdentity& identity, FmuLog& log) {
  auto made = description.version == fmu::Version::Fmi2 ? new_fmi2_instance(description, log)
                                                        : new_fmi3_instance(description, log);
  std::string wrong = made->load(identity.folder / fmu::library_member(description));
  if (wrong.empty()) {
    wrong = made->start(identity);
    if (!wrong.empty()) {
      made->unload();
    }
  }
  if (!wrong.empty()) {
    return wrong;
  }
  return made;
}

std::string FmuInstance::load(const std::filesystem::path& library) {
  library_ = ::dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library_ != nullptr) {
    return {};
  }
  const char* const why = ::dlerror();
  return fmt::format("its library cannot be loaded: {}", why == nullptr ? "unknown reason" : why);
}

void FmuInstance::unload() noexcept {
  if (library_ != nullptr) {
    ::dlclose(std::exchange(library_, nullptr));
  }
}

void* FmuInstance::symbol(const char* name) {
  void* const found = ::dlsym(library_, name);
  if (found == nullptr && missing_.empty()) {
    missing_ = name;
  }
  return found;
}

std::string FmuInstance::reason() {
  const std::string said = log_.take_reason();
  return said.empty() ? "" : ": " + said;
}

bool FmuInstance::exit_initialization() {
  is_initialized_ = finish_initialization();
  return is_initialized_;
}

void FmuInstance::end() {
  if (is_fatal_) {
    return;
  }
  if (is_initialized_ && !has_failed_) {
    terminate();
  }
  free();
  unload();
}

bool FmuInstance::fail_call(const std::string& call, const char* status, bool is_fatal) {
  has_failed_ = true;
  is_fatal_ = is_fatal_ || is_fatal;
  return fail(fmt::format("{} failed ({})", call, status));
}

bool FmuInstance::fail(const std::string& what) {
  problem_ = what + reason();
  return false;
}

std::vector<const char*> FmuInstance::categories() const {
  std::vector<const char*> found;
  for (const std::string& category : description_.log_categories) {
    std::string word = category;
    std::transform(word.begin(), word.end(), word.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    const auto has = [&word](const char* part) { return word.find(part) != std::string::npos; };
    if (!log_.wants_all() && (has("error") || has("fatal") || has("warning") || has("discard"))) {
      found.push_back(category.c_str());
    }
  }
  return found;
}

}  // namespace indurop::io
