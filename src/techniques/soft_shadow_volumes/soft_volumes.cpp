// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/soft_shadow_volumes/soft_volumes.h"

#include <algorithm>
#include <array>
#include <limits>

#include "src/geometry/edge_mesh.h"

namespace penumbra::soft_shadow_volumes {
namespace {

constexpr std::array<std::string_view, 3> sizePasses = {
    "soft-volumes at full size", "soft-volumes at half size", "soft-volumes at quarter size"};
constexpr int framesToSettle = 5;  // one more than PassTimers keeps in flight

}  // namespace

SoftVolumes::SoftVolumes(Device& device)
    : device_(internalsOf(device)),
      isSoftware_(device_.isSoftware),
      counter_(device),
      layers_(device),
      wedges_(device),
      hardResolve_(internalsOf(device).shaders,
                   {"src/techniques/soft_shadow_volumes/hard_volumes.comp.glsl"}),
      upsampleEven_(internalsOf(device).shaders,
                    {"src/techniques/soft_shadow_volumes/upsample_even.comp.glsl"}),
      upsample_(internalsOf(device).shaders, {"src/techniques/soft_shadow_volumes/upsample.comp.glsl"}),
      alphaMaskWarning_(device) {
    effort_.roundWork = isSoftware_ ? TileLayers::softwareRoundWork : TileLayers::hardwareRoundWork;
}

void SoftVolumes::describe(ParameterVisitor& visitor) {
    static constexpr std::array<std::string_view, 2> methods = {"layers", "wedges"};
    visitor.choice(
        {.name = "method",
         .help = "layers: counted at points of the light, from the silhouettes that each receiver sees; "
                 "wedges: as published, from the centre's silhouettes, each darkening by itself"},
        method_, methods);
    visitor.integer(
        {.name = "samples", .help = "points of the light at which overlapping blockers are told apart"},
        effort_.samples, {16, LightPoints::most});
    static constexpr std::array<std::string_view, 3> sizes = {"full", "half", "quarter"};
    visitor.choice(
        {.name = "v_buffer", .help = "width and height of the V-buffer, as a part of the picture's"},
        vBufferSize_, sizes);
    static constexpr std::array<std::string_view, 2> upsamplings = {"plane", "point"};
    visitor.choice(
        {.name = "upsampling",
         .help = "of a smaller V-buffer: plane: pixels take from texels on their own plane; point: as "
                 "published, from the one they lie in, so that shadows bleed over outlines"},
        upsampling_, upsamplings);
    visitor.real({.name = "frame_budget_ms",
                  .unit = "ms",
                  .help = "device time that the V-buffer's size is chosen to keep to; 0: v_buffer says"},
                 frameBudget_ms_, {0, 1e9f});
    describeCounting(visitor, counting_);
    static constexpr std::array<std::string_view, 2> markings = {"none", "stencil"};
    visitor.choice(
        {.name = "marking",
         .help = "of wedges: stencil marks the pixels inside each half wedge first, as published; far slower "
                 "than to find out while drawing"},
        marking_, markings);
    static constexpr std::array<std::string_view, 2> formats = {"float", "split"};
    visitor.choice(
        {.name = "layer_format",
         .help = "of the V-buffer that wedges are added up in: split: as published, 12 bits in four "
                 "bytes, which 31 wedges a pixel fill"},
        layerFormat_, formats);
    describeOpenMeshes(visitor, openMeshes_);
    visitor.boolean({.name = "wireframe", .help = "outlines wedges for inspection"}, wireframe_);
    visitor.integer(
        {.name = "edge_memory",
         .unit = "MiB",
         .help = "at most, for the edges that matter to the light: 16,384 in each; if they do not "
                 "fit, shadows are hard and the statistics say so"},
        effort_.edgeMemory_MiB, {1, 2048});
    visitor.integer({.name = "round_work",
                     .unit = "iterations",
                     .help = "how much is done for a tile before it pauses, to go on in another dispatch"},
                    effort_.roundWork,
                    {2000, isSoftware_ ? TileLayers::softwareRoundWork : std::numeric_limits<int>::max()});
}

void SoftVolumes::resolveHard(const VisibilityBuffer& out) {
    const auto pass = timers_.pass("soft-volumes/visibility");
    gl::Pass(hardResolve_)
        .bind(binding_)
        .bind(counter_)
        .bind("visibility", imageOf(out))
        .dispatchPixels(out.width_px(), out.height_px());
}

int SoftVolumes::chooseSize() {
    if (frameBudget_ms_ <= 0) return vBufferSize_;
    // Times arrive some frames late; until then those at hand are of an earlier visit to this size.
    if (++framesAtSize_ <= framesToSettle) return budgetedSize_;
    double frame_ms = 0;
    for (const gl::PassTimers::Result& size : sizeTimers_.latest()) {
        if (size.name == sizePasses[std::size_t(budgetedSize_)]) frame_ms = size.milliseconds;
    }
    // A step changes the cost by four at most: below a fifth of the budget there is room for the larger size.
    const int wanted = frame_ms > frameBudget_ms_         ? budgetedSize_ + 1
                       : frame_ms < 0.2 * frameBudget_ms_ ? budgetedSize_ - 1
                                                          : budgetedSize_;
    if (std::clamp(wanted, 0, 2) != budgetedSize_) framesAtSize_ = 0;
    budgetedSize_ = std::clamp(wanted, 0, 2);
    return budgetedSize_;
}

void SoftVolumes::upsample(const VisibilityBuffer& out) {
    const auto pass = timers_.pass("soft-volumes/upsample");
    const std::size_t tiles = std::size_t((out.width_px() + 7) / 8) * std::size_t((out.height_px() + 7) / 8);
    mixedTiles_.reserve((3 + tiles) * sizeof(GLuint), "soft-volumes/mixed tiles");
    const std::array<GLuint, 3> none = {0, 1, 1};
    mixedTiles_.write(std::as_bytes(std::span(none)));
    gl::Pass(upsampleEven_)
        .constants(UpsampleConstants{.byPoint = upsampling_ == int(Upsampling::point)})
        .bind(binding_)
        .bind("MixedTiles", mixedTiles_)
        .bind("vBuffer", vBuffer_)
        .bind("visibility", imageOf(out))
        .dispatchPixels(out.width_px(), out.height_px());
    gl::Pass(upsample_)
        .bind(binding_)
        .bind("MixedTiles", mixedTiles_)
        .bind("vBuffer", vBuffer_)
        .bind("liftedDepths", counter_.depth())
        .bind("visibility", imageOf(out))
        .dispatchIndirect(mixedTiles_);
}

void SoftVolumes::render(const ShadowInputs& inputs, VisibilityBuffer& out) {
    const bool isSoft = hasSize(inputs.light);
    const int size = isSoft ? chooseSize() : 0;
    const int pixelsPerTexel = 1 << size;
    const auto frameTime = sizeTimers_.pass(sizePasses[std::size_t(size)]);
    const bool wedges = method_ == int(Method::wedges) && isSoft;
    const bool isDrawn = wedges || !isSoft;
    VolumeFrame frame(inputs, pixelsPerTexel,
                      isDrawn ? VolumeFrame::Count::drawn : VolumeFrame::Count::asked);
    if (openMeshes_ == int(OpenMeshes::capped)) frame.capHoles(device_);
    if (wedges) {
        WedgeRaster::countAsBlockers(frame);
    } else {
        layers_.prepare(frame, effort_);
    }
    edgeCount_ = 0;
    for (const SilhouetteSource& source : frame.sources) edgeCount_ += edgesOf(*source.mesh).edgeCount();
    binding_.fill(inputs.view, frame);
    if (isDrawn) {
        alphaMaskWarning_.check(inputs.casters);
        const auto pass = timers_.pass("soft-volumes/drawn count");
        counter_.render(frame, binding_, Counting(counting_));
    } else {
        counter_.renderReceivers(frame, binding_);
    }
    if (!isSoft) {
        resolveHard(out);
        return;
    }
    if (pixelsPerTexel > 1) {
        vBuffer_.fit({.width_px = frame.constants.buffer_px.x,
                      .height_px = frame.constants.buffer_px.y,
                      .format = out.colored() ? gl::Format::rgba16f : gl::Format::r32f,
                      .label = "soft-volumes/V-buffer"});
    }
    const gl::TextureRef target = pixelsPerTexel > 1 ? vBuffer_.ref() : imageOf(out);
    if (wedges) {
        wedges_.render(frame, binding_, inputs.light, counter_,
                       {.marking = WedgeRaster::Marking(marking_),
                        .layerFormat = WedgeRaster::LayerFormat(layerFormat_),
                        .counting = Counting(counting_),
                        .wireframe = wireframe_},
                       target, timers_);
    } else {
        layers_.render(frame, binding_, inputs.light, counter_, target, timers_);
    }
    if (pixelsPerTexel > 1) upsample(out);
}

void SoftVolumes::inspect(InspectionVisitor& visitor) const {
    visitor.texture({.name = "counts", .texture = counter_.counts().name(), .white = 4});
    visitor.texture({.name = "receiver depth", .texture = counter_.depth().name()});
    wedges_.inspect(visitor);
    if (vBuffer_.name() != 0) visitor.texture({.name = "V-buffer", .texture = vBuffer_.name()});
    if (layers_.edgeCounts().name() != 0)
        visitor.texture({.name = "edges a pixel", .texture = layers_.edgeCounts().name(), .white = 32});
}

Statistics SoftVolumes::statistics() const {
    Statistics statistics{.counts = {{"edges", double(edgeCount_)},
                                     {"edge memory", double(layers_.size_bytes()) / (1 << 20), "MiB"}},
                          .passes = passTimes(timers_)};
    if (const std::size_t edges = layers_.edgesWithoutRoom(counter_); edges > 0)
        statistics.counts.push_back({"edges without room (shadows are hard)", double(edges)});
    return statistics;
}

}  // namespace penumbra::soft_shadow_volumes
