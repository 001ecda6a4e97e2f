// SPDX-License-Identifier: Apache-2.0
#include "studio/scene/gltf/animation.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>
#include <utility>

namespace penumbra::studio::gltf {

namespace {

using enum ComponentType;
using Interpolation = Track::Interpolation;
using Path = Channel::Path;

glm::quat quaternion(const float* xyzw) {
    return {xyzw[3], xyzw[0], xyzw[1], xyzw[2]};
}

std::optional<Path> pathOf(const std::string& name) {
    if (name == "translation") return Path::translation;
    if (name == "rotation") return Path::rotation;
    if (name == "scale") return Path::scale;
    if (name == "weights") return Path::weights;
    return std::nullopt;
}

Interpolation interpolationOf(const JsonView& sampler) {
    const std::string name = sampler.string("interpolation", "LINEAR");
    if (name == "STEP") return Interpolation::step;
    if (name == "LINEAR") return Interpolation::linear;
    if (name == "CUBICSPLINE") return Interpolation::cubicSpline;
    sampler.at("interpolation").fail(fmt::format("'{}' is not STEP, LINEAR or CUBICSPLINE", name));
}

std::vector<float> loadTimes(const JsonView& sampler, const Accessors& accessors, Budget& budget) {
    const Accessor& input = accessors[sampler.at("input").asIndex(accessors.size())];
    requireFormat(input, sampler.pointer() + "/input", "SCALAR", {f32});
    std::vector<float> times = readFloats(input, budget);
    if (times.front() < 0) throw PlaceError(input.pointer, "has a negative time");
    if (std::ranges::adjacent_find(times, std::greater_equal<>()) != times.end())
        throw PlaceError(input.pointer, "its times must increase strictly");
    return times;
}

Track loadTrack(const JsonView& sampler, Path path, std::size_t targetCount, const Accessors& accessors,
                Budget& budget) {
    Track track{.interpolation = interpolationOf(sampler), .times_s = loadTimes(sampler, accessors, budget)};
    const Accessor& output = accessors[sampler.at("output").asIndex(accessors.size())];
    const std::string place = sampler.pointer() + "/output";
    switch (path) {
        case Path::translation:
        case Path::scale:
            requireFormat(output, place, "VEC3", {f32, i8, u8, i16, u16});
            track.width = 3;
            break;
        case Path::rotation:
            requireFormat(output, place, "VEC4", {f32, i8, u8, i16, u16});
            track.width = 4;
            break;
        case Path::weights:
            requireFormat(output, place, "SCALAR", {f32, i8, u8, i16, u16});
            track.width = targetCount;
            break;
    }
    const std::size_t valuesPerKey = track.interpolation == Interpolation::cubicSpline ? 3 : 1;
    track.values = readFloats(output, budget);
    if (track.values.size() != track.times_s.size() * valuesPerKey * track.width)
        throw PlaceError(place, fmt::format("{} has {} elements, which do not match {} key times",
                                            output.pointer, output.count, track.times_s.size()));
    return track;
}

// Nothing for a channel that moves no node, or a property that is not known here.
std::optional<Channel> loadChannel(const JsonView& json, const std::vector<JsonView>& samplers,
                                   const Accessors& accessors, const Hierarchy& hierarchy,
                                   const std::vector<MeshGroup>& meshes, Budget& budget,
                                   std::vector<std::string>& warnings) {
    const JsonView& sampler = samplers[std::size_t(json.at("sampler").asIndex(samplers.size()))];
    const JsonView target = json.at("target");
    const auto index = target.index("node", hierarchy.nodes.size());
    const auto path = pathOf(target.at("path").asString());
    if (!index || !path) {
        warnings.push_back(target.pointer() + ": moves nothing that is known here; ignored");
        return std::nullopt;
    }
    const Node& node = hierarchy.nodes[std::size_t(*index)];
    if (node.matrix && path != Path::weights) target.fail("a node with a matrix cannot be animated");
    const std::size_t targetCount = node.mesh < 0 ? 0 : meshes[std::size_t(node.mesh)].targetCount;
    if (path == Path::weights && targetCount == 0) target.fail("its node has no morph targets");
    return Channel{
        .node = *index, .path = *path, .track = loadTrack(sampler, *path, targetCount, accessors, budget)};
}

}  // namespace

std::vector<float> Track::at(float time_s, bool isRotation) const {
    const std::size_t last = times_s.size() - 1;
    const bool isCubic = interpolation == Interpolation::cubicSpline;
    // Part 0, 1 or 2 of a cubic key: in-tangent, value, out-tangent.
    const auto key = [&](std::size_t index, std::size_t part) {
        return values.data() + width * (isCubic ? 3 * index + part : index);
    };
    const auto exactly = [&](std::size_t index) {
        return std::vector<float>(key(index, 1), key(index, 1) + width);
    };

    const std::size_t after = std::size_t(std::ranges::upper_bound(times_s, time_s) - times_s.begin());
    if (after == 0) return exactly(0);
    if (after > last) return exactly(last);
    const std::size_t before = after - 1;
    if (interpolation == Interpolation::step) return exactly(before);

    const float span_s = times_s[after] - times_s[before];
    const float t = (time_s - times_s[before]) / span_s;
    const float *v0 = key(before, 1), *v1 = key(after, 1);
    if (interpolation == Interpolation::linear && isRotation) {
        const glm::quat q = glm::slerp(glm::normalize(quaternion(v0)), glm::normalize(quaternion(v1)), t);
        return {q.x, q.y, q.z, q.w};
    }
    std::vector<float> result(width);
    if (interpolation == Interpolation::linear) {
        for (std::size_t i = 0; i < width; ++i) result[i] = (1 - t) * v0[i] + t * v1[i];
        return result;
    }
    const float t2 = t * t, t3 = t2 * t;
    const float *outTangent = key(before, 2), *inTangent = key(after, 0);
    for (std::size_t i = 0; i < width; ++i)
        result[i] = (2 * t3 - 3 * t2 + 1) * v0[i] + span_s * (t3 - 2 * t2 + t) * outTangent[i] +
                    (3 * t2 - 2 * t3) * v1[i] + span_s * (t3 - t2) * inTangent[i];
    return result;
}

std::vector<Channel> loadAnimations(const JsonView& root, const Accessors& accessors,
                                    const Hierarchy& hierarchy, const std::vector<MeshGroup>& meshes,
                                    const std::optional<std::vector<int>>& wanted, Budget& budget,
                                    Scene& scene) {
    std::vector<Channel> playing;
    std::set<std::pair<int, Path>> moved;  // by what plays
    std::vector<std::string> standing;
    for (const JsonView& json : root.list("animations")) {
        const int index = int(scene.animations.size());
        Animation animation{.name = json.string("name", fmt::format("animation {}", index))};
        std::vector<Channel> channels;
        const std::vector<JsonView> samplers = json.at("samplers").elements();
        for (const JsonView& channelJson : json.at("channels").elements())
            if (auto channel = loadChannel(channelJson, samplers, accessors, hierarchy, meshes, budget,
                                           scene.warnings)) {
                animation.duration_s = std::max(animation.duration_s, double(channel->track.times_s.back()));
                channels.push_back(std::move(*channel));
            }

        // Blender writes an animation for each object, which belong together; what moves the same thing in
        // another way (walking, running) does not.
        const bool isAlternative = std::ranges::any_of(channels, [&](const Channel& c) {
            return moved.contains({c.node, c.path});
        });
        animation.plays = wanted ? std::ranges::find(*wanted, index) != wanted->end() : !isAlternative;
        if (!wanted && isAlternative) standing.push_back(fmt::format("'{}'", animation.name));
        if (animation.plays)
            for (Channel& channel : channels) {
                moved.insert({channel.node, channel.path});
                playing.push_back(std::move(channel));
            }
        scene.animations.push_back(std::move(animation));
    }
    const int count = int(scene.animations.size());
    for (const int index : wanted.value_or(std::vector<int>{}))
        if (index < 0 || index >= count)
            throw PlaceError("/animations",
                             fmt::format("there is no animation {}: the file has {}", index, count),
                             "ask for another");
    if (!standing.empty())
        scene.warnings.push_back(
            fmt::format("/animations: {} would move what an earlier one moves and stand{} still; --animation "
                        "chooses",
                        fmt::join(standing, ", "), standing.size() == 1 ? "s" : ""));
    return playing;
}

}  // namespace penumbra::studio::gltf
