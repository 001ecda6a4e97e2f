// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/python/camera.h"
#include "apps/python/frame.h"
#include "studio/workbench/workbench.h"

namespace penumbra::studio::python {

struct RenderOptions {
    std::string technique;
    std::vector<std::pair<std::string, std::string>> settings;
    PictureSize size;
    CameraChoice camera;
    double time_s = 0;
    std::optional<float> exposure_ev;
    int timedRuns = 0;
    pybind11::object progress;  ///< called with the share that is done, or None
};

/// A device without a window. Its context is current during calls alone, so that any thread may call, one at
/// a time, and several renderers live in a process. All but `run` is called with Python's lock held.
class Renderer {
  public:
    explicit Renderer(std::optional<int> device);
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;
    ~Renderer();

    Frame render(const std::shared_ptr<Scene>& scene, const RenderOptions& options);
    pybind11::list parameters(const std::string& technique);
    const std::string& device() const { return workbench_->renderer(); }
    std::string clock() const { return std::string(workbench_->clock().name()); }

  private:
    class Turn;

    /// Without Python's lock.
    Rendered run(const std::shared_ptr<Scene>& scene, const RenderOptions& options);

    std::unique_ptr<Workbench> workbench_;
    std::shared_ptr<Scene> open_;  ///< on the workbench
    std::atomic_flag isAtWork_;
};

}  // namespace penumbra::studio::python
