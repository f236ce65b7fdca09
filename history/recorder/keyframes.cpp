// SPDX-License-Identifier: Apache-2.0
// The keyframes of a node in its recording: each is written before the run that begins with it.

#include <algorithm>
#include <utility>

#include "history/recorder/recorder.h"
#include "history/recorder/run_words.h"

namespace indurop::recorder {

using base::Problem;

// A keyframe is of use to a reader who can repeat the runs after it.
bool Recorder::records_inputs(std::uint32_t module) const {
  for (std::size_t track = 0; track < follower_.tracks(); ++track) {
    if (follower_.module_of(track) == module) {
      const auto read = follower_.items_of(track).only_read;
      return std::all_of(read.begin(), read.end(), [this](std::uint32_t i) { return places_[i].wanted; });
    }
  }
  return false;
}

Result<std::uint16_t, Problem> Recorder::keyframe_channel_of(std::uint32_t module) {
  std::uint16_t& channel = keyframes_.channel(module);
  if (channel != 0) {
    return channel;
  }
  auto schema = schema_of(kKeyframeSchema, std::string(kKeyframeIdl));
  if (!schema) {
    return schema;
  }
  const std::string name = module < about_.modules.size() ? about_.modules[module] : std::to_string(module);
  auto added = writer_->add_channel(*schema, prefix_ + std::string(kKeyframeTopic) + name, "cdr",
                                    {{kKeyframeForm, keyframes_.form(module)}});
  if (added) {
    channel = *added;
  }
  return added;
}

// Writes the keyframe that the run begins with, if there is one and no part of the run was written.
Result<void, Problem> Recorder::write_keyframe(const RunQueue::Held& held) {
  const tape::Run& run = held.run;
  const tape::Keyframe* const keyframe = held.written == 0 ? keyframes_.of(run.module, run.tail.number) : nullptr;
  if (keyframe == nullptr) {
    return {};
  }
  auto channel = keyframe_channel_of(run.module);
  if (!channel) {
    return std::move(channel).error();
  }
  to_cdr(KeyframeRecord{run.tail.number, keyframe->head.tick, keyframe->bytes}, cdr_);
  return writer_->write(*channel, log_time(keyframe->head.time_ns), real_time(keyframe->head.time_ns),
                        to_sequence({run.module, tape::EntryKind{}}), cdr_);
}

}  // namespace indurop::recorder
