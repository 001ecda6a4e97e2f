// SPDX-License-Identifier: Apache-2.0
#include "studio/viewer/progressive_reference.h"

#include <sys/resource.h>
#include <tbb/task_arena.h>
#include <unistd.h>

#include <algorithm>
#include <utility>

namespace penumbra::studio::viewer {
namespace {

/// Thrown through a trace that nobody waits for any more.
struct Abandoned {};

/// The frame comes first: half of the processors at most, and those with low priority.
int threadCount() {
    return std::max(1, int(std::thread::hardware_concurrency()) / 2);
}

}  // namespace

ProgressiveReference::ProgressiveReference() : thread_([this](const std::stop_token& stop) { run(stop); }) {}

ProgressiveReference::~ProgressiveReference() {
    stop();
    thread_.request_stop();
    wake_.notify_all();
}

void ProgressiveReference::start(Request request) {
    const std::lock_guard lock(mutex_);
    ++generation_;
    pending_ = std::move(request);
    best_.reset();
    status_ = {.working = true};
    if (sceneOf_ != pending_->casters) scene_.reset();
    wake_.notify_all();
}

void ProgressiveReference::stop() {
    const std::lock_guard lock(mutex_);
    ++generation_;
    pending_.reset();
    best_.reset();
    status_ = {};
}

std::shared_ptr<const ProgressiveReference::Level> ProgressiveReference::best() const {
    const std::lock_guard lock(mutex_);
    return best_;
}

ProgressiveReference::Status ProgressiveReference::status() const {
    const std::lock_guard lock(mutex_);
    return status_;
}

std::shared_ptr<const ReferenceScene> ProgressiveReference::scene() const {
    const std::lock_guard lock(mutex_);
    return scene_;
}

void ProgressiveReference::run(const std::stop_token& stop) {
    setpriority(PRIO_PROCESS, id_t(gettid()), 10);  // of this thread alone, on Linux
    tbb::task_arena arena(threadCount());
    while (!stop.stop_requested()) {
        Request request;
        std::uint64_t generation = 0;
        {
            std::unique_lock lock(mutex_);
            if (!wake_.wait(lock, stop, [&] { return pending_.has_value(); })) return;
            request = *std::exchange(pending_, std::nullopt);
            generation = generation_;
        }
        try {
            arena.execute([&] { refine(request, generation); });
        } catch (const Abandoned&) {
            continue;
        } catch (const std::exception& error) {
            const std::lock_guard lock(mutex_);
            if (isCurrent(generation)) status_ = {.error = error.what()};
            continue;
        }
        const std::lock_guard lock(mutex_);
        if (isCurrent(generation)) status_.working = false;
    }
}

void ProgressiveReference::refine(const Request& request, std::uint64_t generation) {
    std::shared_ptr<const ReferenceScene> scene;
    {
        const std::lock_guard lock(mutex_);
        if (sceneOf_ == request.casters) scene = scene_;
    }
    if (!scene) scene = std::make_shared<const ReferenceScene>(request.casters->makeScene());
    {
        const std::lock_guard lock(mutex_);
        if (!isCurrent(generation)) throw Abandoned();
        scene_ = scene;
        sceneOf_ = request.casters;
    }
    const ReferenceScene empty((std::span<const TracedCaster>()));

    constexpr int firstSamples = 4;
    for (int samples = std::min(firstSamples, request.maxSamples);;
         samples = std::min(4 * samples, request.maxSamples)) {
        auto level = std::make_shared<Level>(Level{.samples = samples});
        for (std::size_t i = 0; i < request.lights.size(); ++i) {
            const TracedLight& light = request.lights[i];
            const auto progress = [&](double fraction) {
                if (!isCurrent(generation)) throw Abandoned();
                const std::lock_guard lock(mutex_);
                if (isCurrent(generation)) {
                    status_.nextSamples = samples;
                    status_.fraction = (double(i) + fraction) / double(request.lights.size());
                }
            };
            level->lights.push_back((light.castsShadow ? *scene : empty)
                                        .trace(request.receivers, light.light,
                                               light.texture ? &*light.texture : nullptr,
                                               {.samples = samples, .progress = progress}));
        }
        const std::lock_guard lock(mutex_);
        if (!isCurrent(generation)) throw Abandoned();
        best_ = std::move(level);
        if (samples == request.maxSamples) return;
    }
}

}  // namespace penumbra::studio::viewer
