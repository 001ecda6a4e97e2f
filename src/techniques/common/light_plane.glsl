// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/common/light_io.h"

// How far a point in light space is from where a light that is flat sends nothing: its plane, within the tolerance of
// penumbra/light_plane.h, and of one that is one-sided what is behind it. Positive for all other lights.
float insideEmission(vec3 posLight, LightConstants light) {
    if (light.shape != shapeRect && light.shape != shapeDisk) return 1.0;
    float out_m = abs(posLight.z) - light.planeTolerance * (length(posLight) + length(light.halfSize));
    return light.isOneSided && posLight.z > 0.0 ? min(out_m, -posLight.z) : out_m;
}

bool isOutsideEmission(vec3 posLight, LightConstants light) { return insideEmission(posLight, light) <= 0.0; }
