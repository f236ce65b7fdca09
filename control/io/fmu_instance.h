// SPDX-License-Identifier: Apache-2.0
// One running instance of an FMU, of either version of FMI: its library, called as the standard says. Not real-time
// safe: an FMU may allocate and wait. What it does wrong in its own code, a crash or an exception, is the caller's.

#pragma once

#include <indurop/result.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "control/io/fmu/description.h"
#include "control/io/sample.h"

namespace indurop::io {

// Messages of an FMU, from any of its threads.
class FmuLog {
 public:
  using Print = std::function<void(const std::string&)>;
  // `all`: also those that are neither warnings nor errors.
  FmuLog(Print print, bool all) : print_(std::move(print)), all_(all) {}
  [[nodiscard]] bool wants_all() const noexcept { return all_; }
  enum class Kind { Information, Warning, Error };
  void add(Kind kind, const char* category, const char* text);
  // The last error or warning since the previous call; empty: none.
  std::string take_reason();

 private:
  Print print_;
  bool all_;
  std::mutex mutex_;
  std::string reason_;
};

struct FmuIdentity {
  std::string name;              // of the instance
  std::filesystem::path folder;  // of the unpacked FMU
};

// Each function returns false if the FMU refuses; problem() says why.
class FmuInstance {
 public:
  // Loads the library and creates the instance. `description` and `log` are borrowed. Errors: why it cannot.
  static Result<std::unique_ptr<FmuInstance>, std::string> make(const fmu::Description& description,
                                                                const FmuIdentity& identity, FmuLog& log);
  FmuInstance(const FmuInstance&) = delete;
  FmuInstance& operator=(const FmuInstance&) = delete;
  virtual ~FmuInstance() = default;

  // All elements of a variable. The values fit its type.
  virtual bool set(const fmu::Variable& variable, std::span<const Number> values) = 0;
  virtual bool get(const fmu::Variable& variable, std::span<Number> values) = 0;
  virtual bool set_text(const fmu::Variable& variable, const std::string& text) = 0;
  virtual bool get_text(const fmu::Variable& variable, std::string& text) = 0;
  virtual bool enter_initialization() = 0;  // at time 0
  bool exit_initialization();
  // Advances from `at` by `size`, in seconds.
  virtual bool step(double at, double size) = 0;
  // Ends the instance as the standard wants it, and unloads the library. Without this call both stay in the process: a
  // crash has left them in no usable state.
  void end();

  [[nodiscard]] const std::string& problem() const noexcept { return problem_; }

 protected:
  FmuInstance(const fmu::Description& description, FmuLog& log) : description_(description), log_(log) {}
  // Creates the instance. Returns why it cannot; empty: created.
  virtual std::string start(const FmuIdentity& identity) = 0;
  virtual bool finish_initialization() = 0;
  // The calls of the standard with which an instance ends.
  virtual void terminate() = 0;
  virtual void free() = 0;
  template <class Function>
  void find(Function& function, const char* name) {
    function = reinterpret_cast<Function>(symbol(name));
  }
  // The first function of the standard that find() did not find.
  [[nodiscard]] const std::string& missing() const noexcept { return missing_; }
  // Notes which call failed and how, with what the FMU said of it. Returns false.
  bool fail(const std::string& what);
  // The same for a call with the name of its status. After a fatal one, no function may be called any more.
  bool fail_call(const std::string& call, const char* status, bool is_fatal);
  // What the FMU said since the last call: ": no such file", or nothing.
  std::string reason();
  // The categories of its messages about errors and warnings; empty: it has none, or all messages are wanted.
  [[nodiscard]] std::vector<const char*> categories() const;

  const fmu::Description& description_;  // NOLINT(*-non-private-member-variables-in-classes)
  FmuLog& log_;                          // NOLINT(*-non-private-member-variables-in-classes)

 private:
  std::string load(const std::filesystem::path& library);
  void unload() noexcept;
  void* symbol(const char* name);

  bool is_initialized_ = false;
  bool has_failed_ = false;
  bool is_fatal_ = false;
  void* library_ = nullptr;
  std::string missing_;
  std::string problem_;
};

std::unique_ptr<FmuInstance> new_fmi2_instance(const fmu::Description& description, FmuLog& log);
std::unique_ptr<FmuInstance> new_fmi3_instance(const fmu::Description& description, FmuLog& log);

}  // namespace indurop::io
