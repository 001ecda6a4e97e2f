// SPDX-License-Identifier: Apache-2.0
#include "studio/viewer/sides.h"

#include <algorithm>

#include "studio/workbench/reference_inputs.h"

namespace penumbra::studio::viewer {
namespace {

void copy(const gl::Texture& from, gl::Texture& to, std::string_view label) {
    if (to.width_px() != from.width_px() || to.height_px() != from.height_px() || to.name() == 0) {
        to = gl::Texture({.width_px = from.width_px(),
                          .height_px = from.height_px(),
                          .format = from.format(),
                          .filter = gl::Filter::linear,
                          .label = label});
    }
    glCopyImageSubData(from.name(), GL_TEXTURE_2D, 0, 0, 0, 0, to.name(), GL_TEXTURE_2D, 0, 0, 0, 0,
                       from.width_px(), from.height_px(), 1);
}

void showTruth(VisibilityBuffer& visibility, const ProgressiveReference::Level* truth, std::size_t light) {
    if (truth != nullptr) return writeVisibility(truth->lights[light].visibility, visibility);
    constexpr std::array<float, 4> all = {1, 1, 1, 1};
    glClearTexImage(visibility.texture(), 0, GL_RGBA, GL_FLOAT, all.data());
}

}  // namespace

void Sides::draw(const Document& document, const Camera& camera, int width_px, int height_px) {
    frame_.draw(document.gpuScene(), document.moment(), camera, width_px, height_px);
}

void Sides::fit(Side& side, const std::vector<Light>& lights) {
    const View& view = frame_.gbuffer().view();
    const auto fits = [&](const VisibilityBuffer& buffer, const Light& light) {
        return buffer.width_px() == view.width_px && buffer.height_px() == view.height_px &&
               buffer.colored() == frame_.needsColor(light);
    };
    if (std::ranges::equal(side.visibilities, lights, fits)) return;
    side.visibilities.clear();
    for (const Light& light : lights) {
        const VisibilityBuffer& made = side.visibilities.emplace_back(frame_.makeVisibility(light));
        if (made.colored()) continue;
        // One number for whoever samples three.
        glTextureParameteri(made.texture(), GL_TEXTURE_SWIZZLE_G, GL_RED);
        glTextureParameteri(made.texture(), GL_TEXTURE_SWIZZLE_B, GL_RED);
    }
}

void Sides::shadow(Side& side, Technique& technique, const std::vector<Light>& lights,
                   std::span<const std::size_t> asked) {
    std::vector<FrameLight> together;
    for (const std::size_t i : asked) together.push_back(frame_.frameLight(lights[i], side.visibilities[i]));
    FrameInputs inputs = frame_.frameInputs(together);
    inputs.answered = [&](std::size_t i) { side.statistics[asked[i]].statistics = technique.statistics(); };
    technique.renderLights(inputs);
}

void Sides::light(std::size_t index, const Document& document, const std::vector<std::string>& names,
                  TechniqueBank& techniques, const ProgressiveReference::Level* truth, std::size_t last) {
    const std::vector<Light>& lights = document.moment().lights;
    Side& side = sides_[index];
    fit(side, lights);
    side.statistics.assign(lights.size(), {});

    // A technique's lights at once; last the one whose intermediate buffers are shown.
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < lights.size(); ++i) {
        side.statistics[i] = {lights[i].name, names[i], {}};
        if (i != last) order.push_back(i);
    }
    if (last < lights.size()) {
        order.push_back(last);
        std::ranges::stable_partition(order, [&](std::size_t i) { return names[i] != names[last]; });
    }
    for (auto begin = order.begin(); begin != order.end();) {
        const std::string& name = names[*begin];
        const auto end =
            std::stable_partition(begin, order.end(), [&](std::size_t i) { return names[i] == name; });
        const std::span<const std::size_t> asked(begin, end);
        if (name != referenceName) {
            shadow(side, techniques.get(name), lights, asked);
        } else {
            for (const std::size_t i : asked) showTruth(side.visibilities[i], truth, i);
        }
        begin = end;
    }

    // In the scene's order, as the command does: floating-point sums depend on it.
    frame_.beginLighting();
    for (std::size_t i = 0; i < lights.size(); ++i) {
        frame_.addLight(lights[i], side.visibilities[i]);
        if (i == last) copy(frame_.reach(), side.reach, "viewer/reach");
    }
    frame_.addLuminaires(lights);
    copy(frame_.toneMap(), side.display, "viewer/display");
    copy(frame_.radiance(), side.radiance, "viewer/radiance");
    copy(frame_.illuminance(), side.illuminance, "viewer/illuminance");
}

}  // namespace penumbra::studio::viewer
