// SPDX-License-Identifier: Apache-2.0
// Where scenes, techniques and pictures meet: what the command and the tests do with them.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "penumbra/penumbra.h"
#include "studio/context/headless_context.h"
#include "studio/frame/frame_renderer.h"
#include "studio/image/image.h"
#include "studio/scene/scene.h"
#include "studio/workbench/any_technique.h"
#include "studio/workbench/cost_clock.h"

namespace penumbra::studio {

/// What a technique did for one light.
struct LightResult {
    std::string light;
    Image visibility;  ///< 1 channel, or 3 for a textured light
    Image reach;  ///< the light's unshadowed irradiance for unit emission; 0: the light does not reach the
                  ///< pixel
    Statistics statistics;
    std::vector<double> milliseconds;  ///< cost of each timed render (see Workbench::clock)
};

struct TechniqueResult {
    std::string technique;
    std::vector<LightResult> lights;
    Image display;            ///< sRGB-encoded RGB in [0, 1]
    Image radiance;           ///< nits, RGB
    float exposureValue = 0;  ///< that `display` is shown with: see FrameRenderer::setExposure
};

/// A device without a window, and a frame on it.
class Workbench {
  public:
    /// Throws NoOpenGLError.
    explicit Workbench(std::optional<int> device = std::nullopt,
                       ContextProfile profile = ContextProfile::core);

    /// Where a process has several, each call is for the one whose context is current.
    void makeCurrent() const { context_.makeCurrent(); }
    const HeadlessContext& context() const { return context_; }

    Device& device() { return device_; }
    const std::string& renderer() const { return device_.renderer(); }
    const std::string& openGLVersion() const { return device_.openGLVersion(); }
    const CostClock& clock() const { return clock_; }
    FrameRenderer& frame() { return frame_; }
    /// The scene that is open.
    GpuScene& scene() { return *scene_; }

    /// See makeAnyTechnique.
    std::unique_ptr<Technique> makeTechnique(std::string_view name);

    /// Takes the scene in; it must outlive its use. Replaces the one before.
    void open(const Scene& scene);

    /// Renders all lights of `moment` at once, and then each by itself `timedRuns` times with the clock
    /// running.
    TechniqueResult run(std::string_view name, Technique& technique, const SceneMoment& moment,
                        const Camera& camera, PictureSize size, int timedRuns = 0);
    /// The same where lights have techniques of their own.
    using TechniqueOf = std::function<Technique&(const Light&)>;
    TechniqueResult run(std::string_view name, const TechniqueOf& techniqueOf, const SceneMoment& moment,
                        const Camera& camera, PictureSize size, int timedRuns = 0);

    /// Throws UsageError if the device cannot make pictures of this size.
    void requireSize(PictureSize size) const;

  private:
    HeadlessContext context_;
    Device device_;
    CostClock clock_;
    FrameRenderer frame_;
    std::unique_ptr<GpuScene> scene_;
};

/// The camera called `nameOrIndex`, or the first one. Throws UsageError listing the names.
const Camera& findCamera(const SceneMoment& moment, const std::optional<std::string>& nameOrIndex);

}  // namespace penumbra::studio
