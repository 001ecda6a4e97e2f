// SPDX-License-Identifier: Apache-2.0
// The measured grid over the picture: cells in colours, lines of equal value and numbers.
#pragma once

#include "studio/viewer/canvas_mouse.h"

namespace penumbra::studio::viewer {

/// Draws over the canvas. `scale` as Ui::scale().
void drawGridOverlay(const CanvasPlace& place, const Session& session, float scale);

}  // namespace penumbra::studio::viewer
