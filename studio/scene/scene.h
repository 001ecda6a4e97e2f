// SPDX-License-Identifier: Apache-2.0
// A scene on the CPU: what was loaded or generated, and what it is at one moment. Knows no OpenGL.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "penumbra/light.h"
#include "studio/image/image.h"
#include "studio/scene/sun/sun_origin.h"

namespace penumbra::studio {

/// An axis-aligned box in world space; empty when min.x > max.x.
struct Bounds {
    glm::vec3 min{1}, max{-1};
    bool empty() const { return min.x > max.x; }
    void include(const glm::vec3& point);
    glm::vec3 center() const { return 0.5f * (min + max); }
    float radius() const { return empty() ? 0 : 0.5f * glm::length(max - min); }
};

/// Whether a box is so much farther from the origin than large that its middle is the better origin for
/// floats.
inline bool isFar(const glm::dvec3& min, const glm::dvec3& max) {
    constexpr double manyTimes = 8;
    return glm::length(0.5 * (min + max)) > manyTimes * 0.5 * glm::length(max - min);
}

/// A picture with its sampler; the enums are glTF's (and OpenGL's) numbers.
struct Texture {
    int picture = -1;
    int minFilter = 9987, magFilter = 9729;  // GL_LINEAR_MIPMAP_LINEAR, GL_LINEAR
    int wrapS = 10497, wrapT = 10497;        // GL_REPEAT
};

/// The axis of a file's coordinates that points away from the ground.
enum class UpAxis { y, z };

/// What surfaces do to light that one can see through: glTF's BLEND with an alpha below 0.5, transmission
/// above 0.5.
enum class Glass {
    clear,   ///< they let it through
    tinted,  ///< these, and all others that let any light through, take their share of it
    blocks,  ///< they cast shadows as all others do
};

struct Material {
    enum class Alpha { opaque, mask };
    std::string name;
    glm::vec4 baseColor{1};  ///< linear; alpha multiplies the texture's
    /// Index into Scene::textures; its UV set and transform are baked into Mesh::uvs. Where alpha varies over
    /// vertices and not over a picture, the texture is a ramp, at whose place for its alpha each vertex is.
    int baseColorTexture = -1;
    Alpha alpha = Alpha::opaque;
    float alphaCutoff = 0.5f;
    bool doubleSided = false;
    bool unlit = false;
    /// Where set, a pane: what is behind it is seen through it, multiplied by this colour, and it casts no
    /// shadow unless its node's `casts` says so, or `transmittance`.
    std::optional<glm::vec3> glass;
    /// Where set, it takes its share of the light: what passes, a channel each, linear.
    std::optional<glm::vec3> transmittance;
    bool isPane() const { return glass || transmittance; }
    bool casts() const { return !glass || transmittance; }  ///< where nothing else is said
    glm::vec3 emission_nits{0};                             ///< linear; seen, but lights nothing
    int emissionTexture = -1;  ///< multiplies it; index into Scene::textures, at Mesh::uvs
};

struct MorphTarget {
    std::vector<glm::vec3> positionDeltas;  ///< one a vertex, or empty
    std::vector<glm::vec3> normalDeltas;    ///< one a vertex, or empty
};

/// A triangle list of one material (a glTF primitive, whatever its stored mode).
struct Mesh {
    std::string name;
    int solid =
        -1;  ///< meshes of one number are surfaces of one thing, of a material each; -1: a thing of its own
    int material = 0;  ///< index into Scene::materials, always valid
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;  ///< one a vertex, unit; flat ones are computed where the file has none
    std::vector<glm::vec2> uvs;      ///< one a vertex, or empty where the material has no texture
    std::vector<glm::vec3> colors;   ///< one a vertex, linear, multiply the base colour; or empty: white
    std::vector<std::uint32_t> indices;
    std::vector<MorphTarget> morphTargets;
    std::vector<float> morphWeights;      ///< default weights, one a target
    std::vector<glm::u16vec4> joints;     ///< one a vertex, or empty; up to four influences (the largest)
    std::vector<glm::vec4> jointWeights;  ///< one a vertex, or empty; sums to 1
    bool deforms() const { return !morphTargets.empty() || !joints.empty(); }
};

/// How much light leaves the light. Linear Rec. 709.
struct Emission {
    enum class Unit {
        nits,     ///< radiance-like: luminance of the emitting surface
        candela,  ///< a light of size zero; of a luminaire (see Light::profile): a factor of its profile's
        lux,      ///< a distant light of angle zero
    };
    Unit unit = Unit::nits;
    glm::vec3 value{1};
};

struct LightProfile;

/// How strongly a light shines, direction by direction.
struct ProfiledEmission {
    std::shared_ptr<const LightProfile> profile;  ///< never null
    bool isLuminaire = false;  ///< each part of the light sends the candela by its share of the area
    /// A rotation: the axes of the light's shape in the luminaire's space.
    glm::mat3 luminaireFromShape{1};
    float turn_rad = 0;    ///< of its C0, from the light's, or the luminaire's, +X towards +Y
    float angleScale = 0;  ///< UsdLux's shaping:ies:angleScale
    float factor = 1;      ///< of its candela
    float tilt = 1;        ///< another, of a luminaire: what it gives as it is tilted
};

struct Light {
    std::string name;
    AreaLight shape;  ///< in world space at the evaluated time; radianceTexture is filled in by the renderer
    Emission emission;
    int texture = -1;  ///< index into Scene::textures, rect lights only
    bool castsShadow = true;
    /// Spot lights: half-angles of the cone about -Z in which light falls off from full to none.
    std::optional<std::array<float, 2>> cone_rad;  ///< {inner, outer}
    /// The emission (of a luminaire in candela, else as the unit says) is multiplied by the profile,
    /// direction by direction.
    std::optional<ProfiledEmission> profile;
    /// A distant light that is the sun of a place and a time.
    std::optional<SunOrigin> sun;
};

struct Camera {
    std::string name;
    glm::mat4 worldFromCamera{1};               ///< rigid; looks along -Z, +Y up
    float yfov_rad = 0.8f;                      ///< perspective
    std::optional<float> orthographicHeight_m;  ///< whole height of the picture; orthographic where set
};

/// A mesh placed in the world at one moment.
struct Instance {
    int mesh = 0;  ///< index into Scene::meshes
    int node = 0;  ///< index into Scene::nodeNames, always valid
    glm::mat4 worldFromMesh{1};
    bool casts = true, receives = true;
    glm::vec3 transmittance{
        0};  ///< where it casts: what it lets through nevertheless (Caster::transmittance)
    /// Where the mesh deforms: its vertices at this moment, in mesh space (a skin's include worldFromMesh =
    /// identity).
    std::vector<glm::vec3> positions, normals;
};

/// Everything at one moment. Instances and their order are the same at all times.
struct SceneMoment {
    double time_s = 0;
    std::vector<glm::mat4> worldFromNode;  ///< one for each of Scene::nodeNames
    std::vector<Instance> instances;
    std::vector<Light> lights;
    std::vector<Camera> cameras;  ///< never empty once opened: a scene without one gets one
    Bounds bounds;                ///< of all instances
};

struct Animation {
    std::string name;
    double duration_s = 0;
    bool plays = true;
};

/// What was loaded, and how it moves.
class Scene {
  public:
    /// What moves the scene; made by whoever made the scene.
    class Motion {
      public:
        virtual ~Motion() = default;
        virtual SceneMoment at(const Scene& scene, double time_s) const = 0;
    };

    std::string name;
    std::vector<Picture> pictures;
    std::vector<Texture> textures;
    std::vector<Material> materials;
    std::vector<Mesh> meshes;
    std::vector<std::string> nodeNames;
    std::vector<Animation> animations;
    std::vector<std::string> warnings;  ///< each names the place in the file
    std::shared_ptr<const Motion> motion;
    /// From the coordinates of the file, in its unit and with its axes, to those of the moments: metres, Y
    /// up, from an origin near the scene. What a user states or reads is in the file's.
    glm::dmat4 worldFromFile{1};

    /// Of the longest animation that plays, after which they start again; 0: nothing moves.
    double duration_s() const;

    SceneMoment at(double time_s) const { return motion->at(*this, time_s); }
};

}  // namespace penumbra::studio
