// SPDX-License-Identifier: Apache-2.0
// A pixel's receiver as the light cameras see it: step 5 of Chan and Durand 2003, section 3.
#include "src/techniques/common/view.glsl"
#include "src/techniques/common/depth_map.glsl"
#include "src/techniques/smoothies/layers.glsl"
#include "src/techniques/smoothies/smoothies.glsl"

uniform usampler2DArray deepestEdges;
layout(std140) uniform Constants { PictureConstants picture; };

struct Lookup {
    int camera;
    MapPoint point;
    vec3 normalFace;
    float tolerance_m;
};

// False: no camera sees the receiver.
bool findCamera(Receiver receiver, out Lookup l) {
    for (l.camera = 0; l.camera < picture.mapCount; ++l.camera) {
        l.point = mapPoint(l.camera, receiver.posLight);
        if (isInWindow(l.camera, l.point)) break;
    }
    if (l.camera == picture.mapCount) return false;
    l.normalFace = mat3(lightCameras[l.camera].faceFromLight) * receiver.normalLight;
    l.tolerance_m = mapTolerance_m(l.point.texel_m, l.point.posFace);
    return true;
}

// Whether a blocker hides the receiver's own plane where a texel's centre sees it: compared so, no plane shadows itself.
// The plane is followed up and down as receiverPlaneDepth_m() says.
bool isBehindBlocker(Lookup l, ivec2 texel, float before_m, float behind_m) {
    vec2 uv = (vec2(texel) + 0.5) / float(textureSize(depthMaps, 0).x);
    float receiver_m = receiverPlaneDepth_m(l.camera, l.point, l.normalFace, uv, before_m, behind_m);
    float stored = texelFetch(depthMaps, ivec3(texel, l.camera), 0).r;
    return receiver_m - l.tolerance_m > depthFace_m(l.camera, stored);
}

// The four texels nearest to the receiver, weighted bilinearly.
struct Neighbours {
    float behind;       // share of those whose blocker hides the receiver
    ivec2 litTexel;     // the heaviest that lets the light's centre see it, if any
    ivec2 behindTexel;  // the heaviest that does not, if any
};

Neighbours neighboursOf(Lookup l) {
    int size_px = textureSize(depthMaps, 0).x;
    vec2 place_px = l.point.uv * float(size_px) - 0.5;
    ivec2 base = ivec2(floor(place_px));
    vec2 f = place_px - vec2(base);
    Neighbours n = Neighbours(0.0, ivec2(0), ivec2(0));
    vec2 most = vec2(-1.0), sums = vec2(0.0);
    for (int i = 0; i < 4; ++i) {
        ivec2 offset = ivec2(i & 1, i >> 1);
        vec2 weights = mix(1.0 - f, f, vec2(offset));
        float weight = weights.x * weights.y;
        ivec2 texel = clamp(base + offset, ivec2(0), ivec2(size_px - 1));
        bool behind = isBehindBlocker(l, texel, 64.0 * l.point.texel_m, 0.0);
        sums += behind ? vec2(weight, 0.0) : vec2(0.0, weight);
        if (behind && weight > most.x) n.behindTexel = texel;
        if (!behind && weight > most.y) n.litTexel = texel;
        most = behind ? vec2(max(most.x, weight), most.y) : vec2(most.x, max(most.y, weight));
    }
    n.behind = sums.x / (sums.x + sums.y);  // exactly 1 where all are
    return n;
}

uint edgeAt(Lookup l, ivec2 texel, int layer) {
    texel = texel * textureSize(deepestEdges, 0).xy / textureSize(depthMaps, 0).xy;
    return texelFetch(deepestEdges, ivec3(texel, layersPerCamera * l.camera + layer), 0).r;
}

// Where the light stands over the receiver's horizon.
struct Horizon {
    float height;  // of its centre, from -1 (all of it below) to 1 (above)
    LightExtent extent;
};

Horizon horizonOf(Receiver receiver) {
    LightExtent none = LightExtent(0.0, 0.0, vec2(0.0));
    if (picture.light.isOneSided && receiver.posLight.z >= 0.0) return Horizon(-1.0, none);
    vec3 normal = receiver.normalLight;
    float elevation = dot(normal, picture.light.shape == shapeDistant ? vec3(0.0, 0.0, 1.0) : -receiver.posLight);
    SmoothieConstants c = smoothies[0];
    LightExtent extent = none;
    if (c.light.shape == shapeDistant) {
        extent.half_m = c.radius * sqrt(max(1.0 - elevation * elevation, 0.0));
    } else if (c.light.shape == shapeSphere) {
        extent.half_m = c.radius;
    } else {
        vec3 normalFace = mat3(c.camera.faceFromLight) * normal;
        float x = dot(c.halfX, normalFace), y = dot(c.halfY, normalFace);
        extent = c.light.shape == shapeDisk ? LightExtent(length(vec2(x, y)), 0.0, vec2(0.0)) : rectExtent(x, y);
    }
    bool whole = abs(elevation) >= extent.half_m;  // a light of no size, too
    return Horizon(whole ? (elevation > 0.0 ? 1.0 : -1.0) : elevation / extent.half_m, extent);
}
