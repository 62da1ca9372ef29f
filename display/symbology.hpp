// Everything that is drawn over the video, by power and mode: the table of docs/spec/pilots_interface.md#symbology.
// OFF draws nothing; STBY legends and STBY; a mode without video its legends and its symbols. A patch map has
// the format of the patch, whichever mode shows it, and a view and a frame of its own. What has gone silent is named,
// whatever the power, but for a radar that is off.
// Pure: the same input and memory give the same list; with the memory that it leaves, again.
#pragma once

#include "display/draw_list.hpp"
#include "display/glass_geometry.hpp"
#include "display/glass_input.hpp"
#include "display/label_layout.hpp"
#include "lib/radar/configuration.hpp"

namespace yars::display {

// True when the radar operates and sweeps are what the mode shows.
bool shows_video(const databuffer::RadarState& state);
// True when the radar operates and the map of the input is on the glass.
bool shows_map(const GlassInput& input);

// `view` and `frame` are those of sweeps; on a map they are not used. `labels` is what the picture before left.
void draw_symbology(const GlassInput& input, const radar::RadarConfiguration& configuration, const GlassView& view,
                    const GlassFrame& frame, LabelMemory& labels, DrawList& list);

}  // namespace yars::display
