// SPDX-License-Identifier: Apache-2.0
// Holes of alpha-masked casters.
layout(rgba32ui) uniform readonly uimageBuffer maskedTriangles;
// x: factor; y: cutoff; z: which texture, w: of which group. The textures of one group are bound at a time.
layout(std430) readonly buffer Masks { vec4 masks[]; };
uniform sampler2D alphaTextures[EXACT_GROUP_TEXTURES];

float alphaOf(int which, vec2 uv) {
    // Samplers may only be indexed by what is the same for all.
    switch (which) {
        case 0: return textureLod(alphaTextures[0], uv, 0.0).a;
        case 1: return textureLod(alphaTextures[1], uv, 0.0).a;
        case 2: return textureLod(alphaTextures[2], uv, 0.0).a;
        case 3: return textureLod(alphaTextures[3], uv, 0.0).a;
        case 4: return textureLod(alphaTextures[4], uv, 0.0).a;
        case 5: return textureLod(alphaTextures[5], uv, 0.0).a;
        case 6: return textureLod(alphaTextures[6], uv, 0.0).a;
        default: return textureLod(alphaTextures[7], uv, 0.0).a;
    }
}

int placeOf(uint triangle) { return int(imageLoad(triangles, int(3u * triangle)).w); }

int groupOf(uint triangle) { return int(masks[imageLoad(maskedTriangles, 2 * placeOf(triangle) + 1).w].w); }

// Whether the triangle blocks light at a point of it, given as the shares of its corners.
bool isSolid(uint triangle, vec3 share) {
    int place = placeOf(triangle);
    uvec4 low = imageLoad(maskedTriangles, 2 * place), high = imageLoad(maskedTriangles, 2 * place + 1);
    vec2 uv = share.x * uintBitsToFloat(low.xy) + share.y * uintBitsToFloat(low.zw) + share.z * uintBitsToFloat(high.xy);
    vec4 mask = masks[high.w];
    return alphaOf(int(mask.z), uv) * mask.x >= mask.y;
}
