// SPDX-License-Identifier: Apache-2.0
#version 450
#include "studio/frame/gbuffer_io.h"

layout(std140) uniform Constants { InstanceConstants instance; };
layout(std430) readonly buffer Positions { float positions[]; };
layout(std430) readonly buffer Indices { uint indices[]; };
uniform sampler2D baseColorTexture;
uniform sampler2D emissionTexture;

layout(location = 0) in vec3 posView;
layout(location = 1) in vec3 normalView;
layout(location = 2) in vec2 uv;
layout(location = 3) in vec3 vertexColor;
layout(location = 4) in vec3 tangentDiagonal;
layout(location = 5) in vec3 tangentRest;
layout(location = 6) in vec3 tangentOffset;

layout(location = 0) out vec4 geometricNormalWorld;
layout(location = 1) out vec4 shadingNormalWorld;  // a: see View::shadingNormalTexture
layout(location = 2) out vec4 albedo;  // a: 1 lit, 0 unlit
layout(location = 3) out float receives;
layout(location = 4) out vec4 emission;  // nits

vec3 corner(int i) {
    uint first = 3u * indices[3 * gl_PrimitiveID + i];
    return vec3(positions[first], positions[first + 1u], positions[first + 2u]);
}

// From the triangle's point to the mean of its projections onto the planes that touch the smooth surface at the corners
// (Hanika, "Hacking the Shadow Terminator", 2021): those planes' matrices are interpolated in place of the projections.
vec3 towardsSmoothSurface() {
    mat3 tangents = mat3(tangentDiagonal.x, tangentRest.z, tangentRest.y,  //
                         tangentRest.z, tangentDiagonal.y, tangentRest.x,  //
                         tangentRest.y, tangentRest.x, tangentDiagonal.z);
    return tangentOffset - tangents * posView;
}

void main() {
    vec4 color = instance.baseColor * vec4(vertexColor, 1.0);
    if (instance.hasBaseColorTexture) color *= texture(baseColorTexture, uv);
    if (color.a < instance.alphaCutoff) discard;

    // The triangle's own normal, from its corners: screen-space derivatives would be noisy far away and at edges.
    mat3 viewFromMesh = mat3(instance.viewFromMesh);
    vec3 geometricView =
        normalize(cross(viewFromMesh * (corner(1) - corner(0)), viewFromMesh * (corner(2) - corner(0))));
    vec3 towardsCamera = instance.isOrthographic ? vec3(0.0, 0.0, 1.0) : -posView;
    if (dot(geometricView, towardsCamera) < 0.0) geometricView = -geometricView;
    // Interpolated normals may vanish; then the triangle's serves.
    vec3 shadingView = dot(normalView, normalView) > 0.0 ? normalize(normalView) : geometricView;
    if (dot(shadingView, geometricView) < 0.0) shadingView = -shadingView;

    geometricNormalWorld = vec4(mat3(instance.worldFromView) * geometricView, 0.0);
    float height = max(dot(towardsSmoothSurface(), shadingView), 0.0);
    shadingNormalWorld = vec4(mat3(instance.worldFromView) * shadingView, height);
    albedo = vec4(color.rgb, instance.isUnlit ? 0.0 : 1.0);
    receives = instance.receives ? 1.0 : 0.0;
    emission = vec4(instance.emission_nits, 1.0);
    if (instance.hasEmissionTexture) emission.rgb *= texture(emissionTexture, uv).rgb;
}
