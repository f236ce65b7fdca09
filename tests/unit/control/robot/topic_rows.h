// SPDX-License-Identifier: Apache-2.0
// What happens while a job runs, over time: speed, signals, jobs and numbered remarks.

#pragma once

#include "core/base/svg.h"
#include "topic_picture.h"
#include "topic_view.h"

namespace indurop::robot {

// Draws from `top` downwards and returns where it ends, px. `remarks`: the sample of each remark.
double draw_rows(base::SvgPart& out, double top, const PictureScript& script, const TopicTrace& trace,
                 const std::vector<std::size_t>& remarks, double top_speed);

}  // namespace indurop::robot
