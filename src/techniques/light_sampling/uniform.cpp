// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/light_sampling/uniform.h"

namespace penumbra::light_sampling {
namespace {

constexpr double memory_bytes = 320.0 * 1024 * 1024;  // of all 289 maps of 512 x 512, and some

}  // namespace

UniformLightSampling::UniformLightSampling(Device& device)
    : maps_(device), evaluation_(device), radiance_(device) {}

void UniformLightSampling::describe(ParameterVisitor& visitor) {
    static constexpr std::array<std::string_view, 3> patterns = {"cells", "corners", "sequence"};
    static constexpr std::array<std::string_view, 2> weights = {"area", "equal"};
    visitor.integer({.name = "samples", .help = "n of n x n samples of the light"}, perSide_, {1, 64});
    visitor.choice(
        {.name = "pattern",
         .help = "middles of cells, the paper's lattice with the light's corners, or a shifted sequence"},
        pattern_, patterns);
    visitor.choice(
        {.name = "weights", .help = "of samples: the area each stands for, or all equal (equation 2)"},
        weights_, weights);
    visitor.integer({.name = "map_size", .unit = "texels", .help = "width and height of each shadow map"},
                    mapSize_px_, {16, 16384});
    visitor.integer({.name = "seed", .help = "shifts the sequence"}, seed_, {0, 1 << 20});
    evaluationOptions_.describe(visitor);
}

void UniformLightSampling::choose(const LightSurface& surface) {
    samples_.clear();
    cells_.clear();
    const int perSide = surface.isPoint() ? 1 : perSide_;
    for (const PatternPoint& point : makePattern(SamplePattern(pattern_), perSide, seed_, weights_ == 1)) {
        LightSample& sample = samples_.emplace_back(surface.sample(point.square));
        setShare(sample, float(point.weight));
        cells_.emplace_back(glm::vec2(point.cellMin), glm::vec2(point.cellMax));
    }
}

void UniformLightSampling::render(const ShadowInputs& inputs, VisibilityBuffer& out) {
    const glm::dmat4 lightFromWorldMatrix = lightFromWorld(inputs);
    const LightSpaceScene scene = makeLightSpaceScene(inputs, lightFromWorldMatrix);
    const LightSurface surface(inputs.light, scene);
    choose(surface);
    const int count = int(samples_.size());
    const int mapSize_px = cameras_.fitMaps(inputs.light, surface, samples_, scene, mapSize_px_,
                                            memory_bytes / (count * SampleMaps::texel_bytes));
    maps_.prepare(inputs.casters, scene, samples_, cameras_, mapSize_px,
                  {.samples = count, .compared = count, .memory_bytes = memory_bytes});
    maps_.planAll();
    if (inputs.light.radianceTexture != 0) {
        const auto pass = timers_.pass("uniform/weights");
        radiance_.weigh(inputs.light.radianceTexture, cells_, maps_.samples());
    }

    view_.fill(inputs.view, lightFromWorldMatrix);
    batches_ = maps_.batches(count);
    for (int batch = 0; batch < batches_; ++batch) {
        {
            const auto pass = timers_.pass("uniform/maps");
            maps_.draw(stageOfAll, batch, cameras_, {});
        }
        {
            const auto pass = timers_.pass("uniform/evaluation");
            evaluation_.add(
                inputs, view_, cameras_, evaluationOptions_, maps_,
                {.batch = batch, .mostSlots = std::min(maps_.capacity(), count), .isOnlyOne = batches_ == 1},
                out);
        }
    }
}

void UniformLightSampling::inspect(InspectionVisitor& visitor) const {
    visitor.texture(
        {.name = "depth maps", .texture = maps_.texture().name(), .layers = maps_.texture().layers()});
}

Statistics UniformLightSampling::statistics() const {
    return {.counts = {{"maps", double(samples_.size()) * cameras_.faces},
                       {"samples", double(samples_.size())},
                       {"batches", double(batches_)}},
            .passes = passTimes(timers_)};
}

}  // namespace penumbra::light_sampling
