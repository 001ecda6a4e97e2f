// SPDX-License-Identifier: Apache-2.0
// The open scene: what was read, what is on the device, and the moment that is shown.
#pragma once

#include <memory>
#include <string>

#include "studio/frame/gpu_scene.h"
#include "studio/scene/open_scene.h"
#include "studio/viewer/edited_lights.h"

namespace penumbra::studio::viewer {

class Document {
  public:
    /// Throws InputError for whatever is wrong with the file, and Error if the device has no room.
    Document(Device& device, const std::string& nameOrPath, const OpenOptions& options = {});

    const std::string& nameOrPath() const { return nameOrPath_; }
    const OpenOptions& options() const { return options_; }
    const Scene& scene() const { return *scene_; }
    const GpuScene& gpuScene() const { return gpuScene_; }
    const SceneMoment& moment() const { return moment_; }
    /// Everything, at all times: where a camera that frames all must look.
    const Bounds& bounds() const { return bounds_; }

    /// Length of the animations that play, 0 without one.
    double duration_s() const { return scene_->duration_s(); }
    void setTime(double time_s);
    double time_s() const { return moment_.time_s; }
    /// Counts changes of what casts shadows.
    std::uint64_t castersRevision() const { return castersRevision_; }

    const std::vector<Light>& ownLights() const { return ownLights_; }
    void editLights(std::vector<Light> lights);
    void revertLights() { restoreLights(nullptr); }
    /// As they were when EditedLights::state was this.
    void restoreLights(std::shared_ptr<const EditedLights::State> state);
    bool isBuiltin() const;
    /// The file that says something about the scene's lights, if it exists; empty for a built-in scene
    /// without --lights.
    std::filesystem::path sidecar() const;
    /// To the sidecar, or NAME.lights.json in the current folder for a built-in scene. Returns the file.
    /// Throws OutputError.
    std::filesystem::path saveLights();
    /// To another file, which is the scene's from now on. Throws OutputError, and UsageError unless the name
    /// ends with ".json".
    void saveLightsAs(const std::filesystem::path& file);
    /// A picture that lights may show: its index among the scene's textures. Throws InputError.
    int addTexture(const std::filesystem::path& file);
    EditedLights& lights() { return lights_; }
    const EditedLights& lights() const { return lights_; }

  private:
    void take(SceneMoment moment);
    void update();

    std::string nameOrPath_;
    OpenOptions options_;
    std::unique_ptr<Scene> scene_;  ///< at a fixed address: the device's copy refers to it
    GpuScene gpuScene_;
    SceneMoment moment_;
    std::vector<Light> ownLights_;  ///< the scene's, at the moment
    Bounds bounds_;
    EditedLights lights_;
    std::uint64_t castersRevision_ = 0;
};

}  // namespace penumbra::studio::viewer
