// SPDX-License-Identifier: Apache-2.0
// A DDS entity that is deleted with its holder, the meaning of DDS return codes, and the loop that takes all samples of
// a reader. Code outside network/dds/ uses the names of this folder for DDS things; only generated types keep their own
// names.

#pragma once

#include <dds/dds.h>

#include <array>
#include <cstdint>
#include <string>
#include <utility>

namespace indurop::dds {

// Handles of participants, readers and writers, which DDS assigns in this process.
using Handle = dds_entity_t;
using InstanceHandle = dds_instance_handle_t;
using TypeDescriptor = dds_topic_descriptor_t;  // made by idlc for each type

class Entity {
 public:
  Entity() = default;
  explicit Entity(Handle handle) noexcept : handle_(handle) {}
  Entity(Entity&& other) noexcept : handle_(std::exchange(other.handle_, 0)) {}
  Entity& operator=(Entity&& other) noexcept {
    if (this != &other) {
      reset();
      handle_ = std::exchange(other.handle_, 0);
    }
    return *this;
  }
  Entity(const Entity&) = delete;
  Entity& operator=(const Entity&) = delete;
  ~Entity() { reset(); }

  void reset() noexcept {
    if (handle_ > 0) {
      (void)dds_delete(handle_);
    }
    handle_ = 0;
  }
  [[nodiscard]] Handle get() const noexcept { return handle_; }
  [[nodiscard]] bool ok() const noexcept { return handle_ > 0; }
  [[nodiscard]] std::string why() const { return dds_strretcode(-handle_); }
  // Returns true if the keys of this participant do not permit it.
  [[nodiscard]] bool forbidden() const noexcept { return handle_ == DDS_RETCODE_NOT_ALLOWED_BY_SECURITY; }

 private:
  Handle handle_ = 0;
};

// The metadata of a sample.
struct SampleInfo {
  explicit SampleInfo(const dds_sample_info_t& info) noexcept
      : valid(info.valid_data),
        alive(info.instance_state == DDS_IST_ALIVE),
        instance(info.instance_handle),
        publication(info.publication_handle) {}
  bool valid;  // false: the sample has only its key
  bool alive;  // the instance has a writer
  InstanceHandle instance;
  InstanceHandle publication;  // its writer, see participant_of()
};

// Takes all samples of a reader and calls `use(sample, info)` for each. Samples are loaned: valid until `use` returns.
template <class Sample, class Use>
void take_all(Handle reader, Use use) {
  constexpr std::uint32_t kAtOnce = 32;
  std::array<void*, kAtOnce> samples{};
  std::array<dds_sample_info_t, kAtOnce> infos{};
  for (;;) {
    samples[0] = nullptr;  // DDS loans the memory
    const int count = dds_take(reader, samples.data(), infos.data(), kAtOnce, kAtOnce);
    if (count <= 0) {
      return;
    }
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      use(*static_cast<const Sample*>(samples[i]), SampleInfo(infos[i]));
    }
    (void)dds_return_loan(reader, samples.data(), count);
  }
}

// Takes one sample, if there is one; for readers that keep only one.
template <class Sample, class Use>
void take_one(Handle reader, Use use) {
  void* sample = nullptr;  // DDS loans the memory
  dds_sample_info_t info{};
  if (dds_take(reader, &sample, &info, 1, 1) > 0) {
    use(*static_cast<const Sample*>(sample), SampleInfo(info));
    (void)dds_return_loan(reader, &sample, 1);
  }
}

// The result of a write.
class Written {
 public:
  explicit Written(dds_return_t code) noexcept : code_(code) {}
  [[nodiscard]] bool ok() const noexcept { return code_ >= 0; }
  [[nodiscard]] bool timed_out() const noexcept { return code_ == DDS_RETCODE_TIMEOUT; }        // no space
  [[nodiscard]] bool bad_value() const noexcept { return code_ == DDS_RETCODE_BAD_PARAMETER; }  // wrong type
  [[nodiscard]] std::string why() const { return dds_strretcode(-code_); }

 private:
  dds_return_t code_;
};

// Writes a sample; `Sample` must be the type of the writer. Blocks at most as long as its QoS allows; InduRoP allocates
// no heap.
template <class Sample>
Written write(Handle writer, const Sample& sample) noexcept {
  return Written(dds_write(writer, &sample));
}
// Writes the bytes of a sample, for a type known at run time only.
inline Written write_bytes(Handle writer, const void* sample) noexcept {
  return Written(dds_write(writer, sample));
}

}  // namespace indurop::dds
