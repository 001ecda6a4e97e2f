// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "penumbra/penumbra.h"
#include "src/gl/buffer.h"
#include "src/gl/texture.h"
#include "studio/scene/scene.h"

namespace penumbra::studio {

/// A scene on the device: textures, and a mesh for every instance that deforms or mesh that does not.
class GpuScene {
  public:
    /// Uploads everything. `scene` must outlive this.
    GpuScene(Device& device, const Scene& scene);

    /// Moves everything to `moment`, which must be of this scene.
    void update(const SceneMoment& moment);

    /// What is drawn: one entry an instance, in the moment's order.
    struct Drawable {
        const penumbra::Mesh* mesh = nullptr;
        const gl::Buffer* normals = nullptr;
        GLuint colorBuffer = 0;  ///< three floats a vertex; 0: white
        const Material* material = nullptr;
        glm::mat4 worldFromMesh{1};
        bool receives = true;
        bool isGlass() const { return material->glass.has_value(); }
    };
    const std::vector<Drawable>& drawables() const { return drawables_; }
    /// The surfaces of one solid are one caster, unless they deform or have holes.
    const std::vector<Caster>& casters() const { return casters_; }

    /// Texture name for an index into Scene::textures; 0 for -1.
    GLuint texture(int index) const { return index < 0 ? 0 : textures_[std::size_t(index)].name(); }

    /// The same for a texture that a light of the moment shows, oriented as AreaLight::radianceTexture wants
    /// it: the picture's bottom row lies at the light's -Y edge.
    GLuint radianceTexture(int index) const { return index < 0 ? 0 : radianceTextures_.at(index).name(); }

    /// The angles (radians) and candela of a light of the moment, as studio/frame/profile.glsl reads them; a
    /// buffer of nothing for one without a profile.
    const gl::Buffer& profile(const Light& light) const;

  private:
    struct ProfileOnDevice {
        std::shared_ptr<const LightProfile> profile;
        gl::Buffer values;
    };
    struct MeshOnDevice {
        penumbra::Mesh mesh;
        gl::Buffer normals;
        std::optional<gl::Buffer> colors;
    };
    MeshOnDevice upload(const Mesh& mesh);
    Caster casterOf(const Instance& instance, const MeshOnDevice& onDevice) const;
    const penumbra::Mesh& solidOf(std::vector<int> meshes);

    Device& device_;
    const Scene& scene_;
    std::vector<gl::Texture> textures_;
    std::map<int, gl::Texture> radianceTextures_;  ///< by index into Scene::textures
    std::map<const LightProfile*, ProfileOnDevice> profiles_;
    gl::Buffer noProfile_;
    std::vector<MeshOnDevice> shared_;                   ///< one a mesh of the scene
    std::vector<MeshOnDevice> deforming_;                ///< one an instance that deforms, in their order
    std::map<std::vector<int>, penumbra::Mesh> solids_;  ///< of several meshes each, as casters
    std::vector<Drawable> drawables_;
    std::vector<Caster> casters_;
};

}  // namespace penumbra::studio
