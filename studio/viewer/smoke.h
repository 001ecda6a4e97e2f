// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "studio/viewer/viewer.h"

namespace penumbra::studio::viewer {

/// Shows `frames` frames in which the camera turns while every technique, every way of showing and every
/// light has its turn. Throws std::runtime_error if a frame could not be made, or the driver reported
/// something severe.
void runSmoke(Viewer& viewer, int frames);

}  // namespace penumbra::studio::viewer
