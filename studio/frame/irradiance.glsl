// SPDX-License-Identifier: Apache-2.0
// What a light sends to a receiver without shadows, for an emission of 1. Includers have declared `light`
// (LightingConstants) and the buffer `Profile` of floats, `profileValues`. Light space: see unshadowed.glsl.
#include "studio/frame/unshadowed.glsl"

const vec3 luminanceOfRec709 = vec3(0.2126, 0.7152, 0.0722);

// Where an includer knows what kind of light it has, software rasterizers, which run both sides of a branch and every loop
// once, are spared all others.
#ifdef ONLY_SHAPE
const int lightShape = ONLY_SHAPE;
const int profileType = ONLY_PROFILE;
const bool hasEvenAngles = ONLY_EVEN_ANGLES != 0;
#else
int lightShape = light.shape;
int profileType = light.profile.type;
const bool hasEvenAngles = false;  // or not known
#endif
#include "studio/frame/profile.glsl"

// Irradiance of a light of size zero whose emission is 1 candela or 1 lux.
float pointIrradiance(vec3 pos, vec3 normal) {
    vec3 towards = lightShape == shapeDistant ? vec3(0.0, 0.0, 1.0) : -pos;
    float distance2 = lightShape == shapeDistant ? 1.0 : dot(towards, towards);
    return distance2 > 0.0 ? max(0.0, dot(normal, normalize(towards))) / distance2 : 0.0;
}

// Whether it lies in the plane of a flat light.
bool isInLightPlane(vec3 pos) {
    vec2 halfSize_m = lightShape == shapeRect ? light.halfSize_m : vec2(light.radius_m);
    bool isFlat = (lightShape == shapeRect || lightShape == shapeDisk) && !light.isPoint;
    return isFlat && abs(pos.z) <= light.planeTolerance * (length(pos) + length(halfSize_m));
}

// What is behind a flat light, or lies in its plane, sees nothing of it.
bool isAside(vec3 pos) {
    bool isBehind = (lightShape == shapeRect || lightShape == shapeDisk) && pos.z >= 0.0;
    return (isBehind && !light.isTwoSided) || isInLightPlane(pos);
}

float irradianceBeforeCone(vec3 pos, vec3 normal) {
    int shape = lightShape;
    if (isAside(pos)) return 0.0;
    if (profileType != noProfile)
        return profiledIrradiance(light.profile, shape, light.isPoint, light.halfSize_m, light.radius_m, pos, normal);
    if (light.isPoint) return pointIrradiance(pos, normal);
    if (shape == shapeRect) return rectIrradiance(pos, normal, light.halfSize_m);
    if (shape == shapeDisk) return diskIrradiance(pos, normal, light.radius_m);
    if (shape == shapeSphere) {
        float distance = length(pos);
        return distance > 0.0 ? coneIrradiance(-pos / distance, normal, min(1.0, light.radius_m / distance)) : 0.0;
    }
    if (shape == shapeCylinder) return tubeIrradiance(pos, normal, light.halfSize_m.x, light.radius_m);
    return coneIrradiance(vec3(0.0, 0.0, 1.0), normal, sin(light.halfAngle_rad));
}

// The falloff of KHR_lights_punctual, between the inner and the outer cone.
float spotFactor(vec3 pos) {
    if (light.coneCosines.y < -1.5) return 1.0;
    float cosine = dot(normalize(pos), vec3(0.0, 0.0, -1.0));
    float factor = clamp((cosine - light.coneCosines.y) / max(1e-4, light.coneCosines.x - light.coneCosines.y), 0.0, 1.0);
    return factor * factor;
}

float irradiance(vec3 pos, vec3 normal) {
    float all = irradianceBeforeCone(pos, normal);
    return all > 0.0 ? all * spotFactor(pos) : 0.0;
}
