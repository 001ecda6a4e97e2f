// SPDX-License-Identifier: Apache-2.0
// Visibility within what the depth map proves. Includer includes divisions.glsl.
#include "src/techniques/common/map_proof.glsl"

// The nearness of the highest blocker known about a receiver.
float highestBlocker(Receiving r) {
    float highest = storedNearness(r.depth, storedHere(r));
    for (int kind = 0; kind < kinds; ++kind) {
        uvec4 edge = nearestTo(r.place_px, r.camera + kind * mapCount);
        if (isEdge(edge)) highest = max(highest, storedNearness(r.depth, storedAtEdge(edge)));
    }
    return highest;
}

float proven(Receiver receiver, Receiving r, float seen) {
    MapWindow window = cameraOf(r.camera).window;
    vec3 normalFace = turnedToFace(r.camera, receiver.normalLight);
    float texel_m = r.depth.texelSize * (r.depth.isOrthographic ? 1.0 : r.posFace.z);
    MapReceiver mapped =
        MapReceiver(r.camera, window, r.depth, r.posFace, normalFace, mapTolerance_m(texel_m, r.posFace));
    LightFigure light = LightFigure(constants.light.shape, turnedToFace(r.camera, constants.halfAxisX),
                                    turnedToFace(r.camera, constants.halfAxisY), constants.radius);
    float highest = max(highestBlocker(r), r.nearness);
    return within(proofOf(depthMaps, farthestMaps, kinds > 2, mapped, light, highest), seen);
}
