// SPDX-License-Identifier: Apache-2.0
#include "studio/reference/reference.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <mutex>

#include "studio/errors.h"
#include "studio/reference/light_sampler.h"
#include "studio/reference/occlusion_scene.h"
#include "studio/reference/sobol.h"

namespace penumbra::studio {
namespace {

constexpr int tileSize_px = 16;
constexpr int maxSamples = 65536;

bool isFinite(const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

void checkCasters(std::span<const TracedCaster> casters) {
    for (std::size_t i = 0; i < casters.size(); ++i) {
        const TracedCaster& caster = casters[i];
        if (caster.indices.size() % 3 != 0) {
            throw InputError(fmt::format("caster {}: the number of indices is no multiple of three", i));
        }
        const auto outside = [&](std::uint32_t index) { return index >= caster.positions.size(); };
        if (std::ranges::any_of(caster.indices, outside)) {
            throw InputError(fmt::format("caster {}: an index is out of range; it has {} positions", i,
                                         caster.positions.size()));
        }
        if (!caster.uvs.empty() && caster.uvs.size() != caster.positions.size()) {
            throw InputError(
                fmt::format("caster {}: the number of uvs is neither zero nor that of the positions", i));
        }
    }
}

ContentHash hashOf(std::span<const TracedCaster> casters) {
    ContentHasher hasher;
    hasher.add(std::uint64_t(casters.size()));
    for (const TracedCaster& caster : casters) {
        hasher.addArray(caster.positions);
        hasher.addArray(caster.indices);
        hasher.addArray(std::span(&caster.worldFromMesh, 1));
        hasher.add(std::uint32_t(caster.blocks));
        if (caster.transmittance != glm::vec3(0)) hasher.addArray(std::span(&caster.transmittance, 1));
        hasher.add(std::uint32_t(caster.alphaMask.has_value()));
        if (!caster.alphaMask) continue;
        const TracedAlphaMask& mask = *caster.alphaMask;
        hasher.addArray(caster.uvs);
        for (const int value :
             {mask.width_px, mask.height_px, int(mask.wrapS), int(mask.wrapT), int(mask.linearFilter)}) {
            hasher.add(value);
        }
        hasher.addArray(mask.rgba);
        hasher.add(mask.factor);
        hasher.add(mask.cutoff);
    }
    return hasher.hash();
}

/// What the rounding of a receiver's position grows with.
float roundingScale(const glm::vec3& posWorld, const glm::vec3& eyeWorld) {
    const float largest = std::max({std::abs(posWorld.x), std::abs(posWorld.y), std::abs(posWorld.z)});
    return largest + glm::distance(posWorld, eyeWorld);
}

/// How far from a position, in multiples of its scale, its surface may lie. The depth of a triangle that
/// reaches close to the eye has the absolute error of its nearest point; of 24 bits, or near 1, that is 2^-24
/// times the square of the distance over that of the near plane.
constexpr float surfaceReach = 1e-3f;

/// How far off its surface a ray must start so as not to hit it again, in multiples of its position's scale.
/// A position that was multiplied by an inverse matrix carries some ten roundings of 2^-24; 4e-6 is about six
/// times that sum, and at ten metres it is less than a tenth of a millimetre.
constexpr float rayStart = 4e-6f;

/// Geometry in the light's own plane, such as the frame of a lamp, shall not block it: rays end short of it
/// by 1e-5.
constexpr float rayEnd = 1 - 1e-5f;

/// Weighted counts of one half of a pixel's samples, per channel.
struct Tally {
    glm::dvec3 seen{0}, whole{0};

    void add(const glm::vec3& weight, const glm::vec3& passing) {
        whole += weight;
        seen += weight * passing;
    }
    double visibility(int channel) const { return whole[channel] > 0 ? seen[channel] / whole[channel] : 0.0; }
};

struct PixelResult {
    glm::vec3 visibility{1};
    double squaredError = 0;  // of the mean of both halves, averaged over channels
    std::uint64_t rays = 0;
};

/// Traces pixels one after another, reusing its buffers.
class PixelTracer {
  public:
    PixelTracer(const OcclusionScene& scene, const LightSampler& light, const SobolPoints& points,
                std::uint32_t seed, const ReceiverImage& receivers, int channels)
        : scene_(scene),
          light_(light),
          points_(points),
          seed_(seed),
          eyeWorld_(receivers.eyeWorld),
          reach_(receivers.areFromDepth ? surfaceReach : 0),
          channels_(channels) {
        fan_.lightPlane = light.plane();
    }

    PixelResult trace(std::uint32_t pixel, const glm::vec3& posGiven, const glm::vec3& normalWorld) {
        const float scale = roundingScale(posGiven, eyeWorld_);
        const glm::vec3 posWorld =
            reach_ > 0 ? glm::vec3(scene_.onSurface(posGiven, normalWorld, reach_ * scale)) : posGiven;
        const glm::vec3 origin = posWorld + rayStart * scale * normalWorld;
        chooseRays(pixel, posWorld, normalWorld, origin);
        sortRays();
        passing_.resize(fan_.size());
        scene_.trace(origin, fan_, passing_);
        return tally();
    }

  private:
    /// A ray with what its answer means. Rays are traced in the order of a coarse grid over the light, so
    /// that those of a packet take the same way through the scene.
    struct Ray {
        glm::vec3 direction;
        float end;
        glm::vec3 weight;
        std::uint8_t cell;
        std::uint8_t half;
    };
    static constexpr int gridSize = 8;

    /// Of a light that is mostly below the horizon few samples count, or none, which would make a lit
    /// receiver black. Then more are drawn, until this many count or the sliver is below 1 / 64 of a sample.
    static constexpr int enoughOfSliver = 16;
    static constexpr int maxRounds = 64;

    void chooseRays(std::uint32_t pixel, const glm::vec3& posWorld, const glm::vec3& normalWorld,
                    const glm::vec3& origin) {
        rays_.clear();
        const LightSampler::FromReceiver light(light_, posWorld, normalWorld);
        if (!light.isAboveHorizon()) return;
        const std::size_t enough = std::size_t(std::min(points_.count(), enoughOfSliver));
        for (std::uint8_t half = 0; half < 2; ++half) {
            const std::uint32_t scrambling = hashBits(hashBits(hashBits(seed_) + pixel) + half);
            const std::size_t first = rays_.size();
            for (int round = 0; round < maxRounds && rays_.size() - first < enough; ++round) {
                chooseRound(light, origin - posWorld, scrambling + std::uint32_t(round), half);
            }
            if (light_.isPoint()) break;
        }
    }

    /// Appends the samples of one scrambling that count. They were chosen from the surface; the rays start at
    /// `offset` from it and still end on the samples.
    void chooseRound(const LightSampler::FromReceiver& light, const glm::vec3& offset,
                     std::uint32_t scrambling, std::uint8_t half) {
        for (int i = 0; i < points_.count(); ++i) {
            const glm::vec2 square = light_.isPoint() ? glm::vec2(0.5f) : points_.scrambled(i, scrambling);
            const LightSample sample = light.sample(square);
            if (sample.weight == glm::vec3(0)) continue;
            const int column = int(square.x * gridSize);
            const int row = int(square.y * gridSize);
            // Boustrophedon: neighbours in order are neighbours on the light.
            const int cell = row * gridSize + (row % 2 == 0 ? column : gridSize - 1 - column);
            rays_.push_back({sample.infinite ? sample.direction : sample.direction - offset,
                             sample.infinite ? std::numeric_limits<float>::infinity() : rayEnd, sample.weight,
                             std::uint8_t(cell), half});
        }
    }

    /// Counting sort by cell.
    void sortRays() {
        std::array<std::uint32_t, gridSize * gridSize + 1> first{};
        for (const Ray& ray : rays_) ++first[ray.cell + 1u];
        for (std::size_t cell = 1; cell < first.size(); ++cell) first[cell] += first[cell - 1];
        fan_.resize(rays_.size());
        order_.resize(rays_.size());
        for (std::uint32_t i = 0; i < rays_.size(); ++i) {
            const std::uint32_t place = first[rays_[i].cell]++;
            order_[i] = place;
            fan_.set(place, rays_[i].direction, rays_[i].end);
        }
    }

    PixelResult tally() const {
        std::array<Tally, 2> halves;
        for (std::size_t i = 0; i < rays_.size(); ++i) {
            halves[rays_[i].half].add(rays_[i].weight, passing_[order_[i]]);
        }
        const Tally both{halves[0].seen + halves[1].seen, halves[0].whole + halves[1].whole};
        PixelResult result{.rays = rays_.size()};
        for (int c = 0; c < channels_; ++c) {
            result.visibility[c] = float(both.visibility(c));
            if (light_.isPoint() || halves[0].whole[c] == 0 || halves[1].whole[c] == 0) continue;
            const double error = (halves[0].visibility(c) - halves[1].visibility(c)) / 2;
            result.squaredError += error * error / channels_;
        }
        return result;
    }

    const OcclusionScene& scene_;
    const LightSampler& light_;
    const SobolPoints& points_;
    std::uint32_t seed_;
    glm::vec3 eyeWorld_;
    float reach_;  // in multiples of a position's scale
    int channels_;
    std::vector<Ray> rays_;
    std::vector<std::uint32_t> order_;  // place of each ray in the fan
    RayFan fan_;
    std::vector<glm::vec3> passing_;
};

/// What the tiles contribute to the result's numbers; summed in the tiles' order, so that threads make no
/// difference.
struct TileSums {
    double squaredError = 0;
    std::uint64_t receivers = 0, rays = 0;
};

}  // namespace

struct ReferenceScene::State {
    OcclusionScene scene;
    ContentHash hash;
};

ReferenceScene::ReferenceScene(std::span<const TracedCaster> casters) {
    checkCasters(casters);
    state_.reset(new State{OcclusionScene(casters), hashOf(casters)});
}
ReferenceScene::ReferenceScene(ReferenceScene&&) noexcept = default;
ReferenceScene& ReferenceScene::operator=(ReferenceScene&&) noexcept = default;
ReferenceScene::~ReferenceScene() = default;

const ContentHash& ReferenceScene::contentHash() const {
    return state_->hash;
}

ReferenceResult ReferenceScene::trace(const ReceiverImage& receivers, const AreaLight& light,
                                      const RadianceTexture* texture, const ReferenceOptions& options) const {
    if (options.samples < 2 || options.samples > maxSamples) {
        throw UsageError(fmt::format("{} samples a pixel: use 2 to {}", options.samples, maxSamples));
    }
    const std::size_t pixels = std::size_t(receivers.width_px) * receivers.height_px;
    if (receivers.posWorld.size() != pixels || receivers.normalWorld.size() != pixels ||
        receivers.valid.size() != pixels) {
        throw InputError(
            "the receivers' positions, normals and flags are not as many as their image has pixels");
    }
    const auto start = std::chrono::steady_clock::now();
    const LightSampler sampler(light, texture, options.weight);
    const SobolPoints points(sampler.isPoint() ? 1 : (options.samples + 1) / 2);

    const int channels = std::max(sampler.channels(), state_->scene.hasPanes() ? 3 : 1);
    ReferenceResult result{.visibility = Image(receivers.width_px, receivers.height_px, channels, 1.0f)};
    const int columns = (receivers.width_px + tileSize_px - 1) / tileSize_px;
    const int rows = (receivers.height_px + tileSize_px - 1) / tileSize_px;
    std::vector<TileSums> tiles(std::size_t(columns) * rows);
    std::mutex progressMutex;
    std::size_t tilesDone = 0;

    const auto traceTile = [&](std::size_t tile) {
        PixelTracer tracer(state_->scene, sampler, points, options.seed, receivers, channels);
        const int left = int(tile) % columns * tileSize_px, top = int(tile) / columns * tileSize_px;
        for (int y = top; y < std::min(top + tileSize_px, receivers.height_px); ++y) {
            for (int x = left; x < std::min(left + tileSize_px, receivers.width_px); ++x) {
                const std::size_t pixel = std::size_t(y) * receivers.width_px + x;
                const glm::vec3 &posWorld = receivers.posWorld[pixel],
                                &normalWorld = receivers.normalWorld[pixel];
                if (receivers.valid[pixel] == 0 || !isFinite(posWorld) || !isFinite(normalWorld)) continue;
                const PixelResult traced = tracer.trace(std::uint32_t(pixel), posWorld, normalWorld);
                for (int c = 0; c < channels; ++c) result.visibility.at(x, y, c) = traced.visibility[c];
                tiles[tile].squaredError += traced.squaredError;
                tiles[tile].rays += traced.rays;
                ++tiles[tile].receivers;
            }
        }
        if (options.progress) {
            const std::lock_guard lock(progressMutex);
            options.progress(double(++tilesDone) / double(tiles.size()));
        }
    };
    tbb::parallel_for(std::size_t(0), tiles.size(), traceTile);

    TileSums sums;
    for (const TileSums& tile : tiles) {
        sums.squaredError += tile.squaredError;
        sums.receivers += tile.receivers;
        sums.rays += tile.rays;
    }
    result.rays = sums.rays;
    if (sums.receivers > 0) result.noise_rms = std::sqrt(sums.squaredError / double(sums.receivers));
    result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return result;
}

}  // namespace penumbra::studio
