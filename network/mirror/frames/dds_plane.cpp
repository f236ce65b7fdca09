// SPDX-License-Identifier: Apache-2.0
#include "network/mirror/frames/dds_plane.h"

#include <utility>

#include "core/rt/lost_pages.h"
#include "network/mirror/frames/plane_topics.h"

namespace indurop::mirror {
namespace {

class Reader final : public Subscription {
 public:
  Reader(FrameListener& listener, Stream stream) noexcept : listener_(listener), stream_(stream) {}

  Plane::Opened open(dds::Handle participant, const std::string& topic, const dds::Qos& qos) {
    reader_ =
        dds::make_reader(participant, indurop_wire_Frame_desc, topic, qos, dds::data_listener(&Reader::on_data, this));
    if (!reader_.ok()) {
      return base::Problem{"cannot receive: " + reader_.why()};
    }
    return {};
  }

 private:
  static void on_data(dds::Handle reader, void* self) {
    auto& into = *static_cast<Reader*>(self);
    rt::unblock_fault_signals();  // a DDS thread that writes into shared memory
    dds::take_all<indurop_wire_Frame>(reader, [&into](const indurop_wire_Frame& frame, const dds::SampleInfo& info) {
      if (info.valid) {
        into.listener_.frame_came(frame, into.stream_);
      }
    });
  }

  FrameListener& listener_;
  Stream stream_;
  dds::Endpoint reader_;
};

Plane::Opened offered(const dds::Endpoint& end, const char* what) {
  if (!end.ok()) {
    return base::Problem{what + end.why()};
  }
  return {};
}

}  // namespace

Plane::Opened DdsPlane::offer_frames(Stream stream) {
  dds::Endpoint& writer = frames_[static_cast<std::size_t>(stream)];
  if (!writer.ok()) {
    writer = dds::make_writer(participant_, indurop_wire_Frame_desc,
                              frames_topic(settings_.plant, settings_.network.board, stream), plane_qos(stream));
  }
  return offered(writer, "cannot send values: ");
}

Plane::Opened DdsPlane::offer_catalogue() {
  catalogue_ = dds::make_writer(participant_, indurop_wire_Catalogue_desc, catalogue_topic(settings_.plant),
                                plane_qos(Stream::Prompt));
  return offered(catalogue_, "cannot send the catalogue: ");
}

Plane::Opened DdsPlane::exchange_beacons(BeaconListener& listener) {
  const dds::Qos qos = beacon_qos(settings_);
  const std::string topic = beacon_topic(settings_.plant);
  beacons_ = dds::make_writer(participant_, indurop_wire_Beacon_desc, topic, qos);
  beacon_reader_ = dds::make_reader(participant_, indurop_wire_Beacon_desc, topic, qos,
                                    dds::data_listener(&DdsPlane::on_beacon, &listener));
  return offered(beacons_.ok() ? beacon_reader_ : beacons_, "cannot exchange beacons: ");
}

void DdsPlane::on_beacon(dds::Handle reader, void* listener) {
  rt::unblock_fault_signals();
  dds::take_all<indurop_wire_Beacon>(reader, [&](const indurop_wire_Beacon& beacon, const dds::SampleInfo& info) {
    auto& into = *static_cast<BeaconListener*>(listener);
    if (!info.alive) {
      into.beacons_ended(beacon.board);
    } else if (info.valid) {
      into.beacon_came(beacon);
    }
  });
}

// Two in a row may be lost.
std::chrono::nanoseconds DdsPlane::beat() const noexcept {
  return std::chrono::nanoseconds{settings_.network.lease_ns} * 2 / 5;
}

Result<std::unique_ptr<Subscription>, base::Problem> DdsPlane::subscribe(const std::string& board, Stream stream,
                                                                         FrameListener& listener) {
  auto reader = std::make_unique<Reader>(listener, stream);
  auto opened = reader->open(participant_, frames_topic(settings_.plant, board, stream), plane_qos(stream));
  if (!opened) {
    return std::move(opened).error();
  }
  return std::unique_ptr<Subscription>(std::move(reader));
}

void DdsPlane::close() noexcept {
  beacon_reader_.reset();
  beacons_.reset();
  for (dds::Endpoint& writer : frames_) {
    writer.reset();
  }
  catalogue_.reset();
}

bool DdsPlane::send(const indurop_wire_Frame& frame, Stream stream) noexcept {
  return dds::write(frames_[static_cast<std::size_t>(stream)].get(), frame).ok();
}

bool DdsPlane::send(const indurop_wire_Catalogue& catalogue) noexcept {
  return dds::write(catalogue_.get(), catalogue).ok();
}

bool DdsPlane::send(const indurop_wire_Beacon& beacon) noexcept {
  return dds::write(beacons_.get(), beacon).ok();
}

}  // namespace indurop::mirror
