// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace penumbra::studio::viewer {

/// Colours, spacing and font of the panels, for a display on which things must be drawn `scale` times as
/// large.
void applyTheme(float scale);

}  // namespace penumbra::studio::viewer
