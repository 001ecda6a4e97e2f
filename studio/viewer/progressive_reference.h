// SPDX-License-Identifier: Apache-2.0
// The ray-traced truth for the current view, getting better in the background.
#pragma once

#include <atomic>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "studio/reference/reference.h"
#include "studio/workbench/reference_inputs.h"

namespace penumbra::studio::viewer {

/// A thread of low priority that traces the same view with four times as many rays again and again: 4, 16, 64
/// ... up to the wanted number. Every level is a trace of its own, the very picture that `penumbra render -t
/// reference
/// --set samples=N` makes; all that came before cost a third more together.
class ProgressiveReference {
  public:
    struct TracedLight {
        AreaLight light;
        std::optional<RadianceTexture> texture;
        bool castsShadow = true;
    };
    struct Request {
        std::shared_ptr<const CasterCopies> casters;  ///< the same pointer: the same casters
        ReceiverImage receivers;
        std::vector<TracedLight> lights;
        int maxSamples = 1024;
    };
    /// One finished level.
    struct Level {
        int samples = 0;
        std::vector<ReferenceResult> lights;  ///< as requested
    };
    struct Status {
        bool working = false;
        int nextSamples = 0;  ///< of the level that is being traced
        double fraction = 0;  ///< of it, done
        std::string error;    ///< why there is no truth, or empty
    };

    ProgressiveReference();
    ProgressiveReference(const ProgressiveReference&) = delete;
    ProgressiveReference& operator=(const ProgressiveReference&) = delete;
    ~ProgressiveReference();

    /// Gives up what is being traced and starts on this.
    void start(Request request);
    void stop();

    /// The best level so far of the request last started; null before the first is done. Counts up in
    /// `samples`.
    std::shared_ptr<const Level> best() const;
    Status status() const;

    /// The casters as rays see them, for single questions; null until they are ready. Const calls of it may
    /// run beside this thread's.
    std::shared_ptr<const ReferenceScene> scene() const;

  private:
    void run(const std::stop_token& stop);
    void refine(const Request& request, std::uint64_t generation);
    bool isCurrent(std::uint64_t generation) const { return generation == generation_; }

    mutable std::mutex mutex_;
    std::condition_variable_any wake_;
    std::optional<Request> pending_;
    std::atomic<std::uint64_t> generation_ = 0;
    std::shared_ptr<const Level> best_;
    std::shared_ptr<const ReferenceScene> scene_;
    std::shared_ptr<const CasterCopies> sceneOf_;
    Status status_;
    std::jthread thread_;  ///< last: it ends before what it uses
};

}  // namespace penumbra::studio::viewer
