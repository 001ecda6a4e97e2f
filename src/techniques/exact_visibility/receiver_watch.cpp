// SPDX-License-Identifier: Apache-2.0
#include "src/techniques/exact_visibility/receiver_watch.h"

#include "src/gl/pass.h"
#include "src/techniques/common/input_key.h"
#include "src/techniques/exact_visibility/exact_io.h"

namespace penumbra::exact_visibility {
namespace {

/// A depth, and what there may be of a normal, of a mask and of a point's place (receiver_watch.comp.glsl).
std::uint32_t wordsPerPixel(const View& view) {
    return 1u + (view.isOfPoints ? 3u : 0u) + (view.normalTexture != 0 ? 3u : 0u) +
           (view.receiverTexture != 0 ? 1u : 0u);
}

}  // namespace

ReceiverWatch::ReceiverWatch(gl::ShaderLibrary& shaders)
    : compare_(shaders, {"src/techniques/exact_visibility/receiver_watch.comp.glsl"}) {}

bool ReceiverWatch::follow(const View& view) {
    view_.clear();
    appendView(view_, view);
    appendBytes(view_, view.isOfPoints);
    appendBytes(view_, view.normalTexture != 0);
    appendBytes(view_, view.receiverTexture != 0);
    if (view_ == lastView_) return true;
    std::swap(view_, lastView_);
    const auto width_px = std::size_t(view.width_px), height_px = std::size_t(view.height_px);
    seen_.reserve(width_px * height_px * wordsPerPixel(view) * sizeof(std::uint32_t), "exact/receivers");
    tileRevisions_.reserve(((width_px + EXACT_TILE - 1) / EXACT_TILE) *
                               ((height_px + EXACT_TILE - 1) / EXACT_TILE) * sizeof(std::uint32_t),
                           "exact/revisions of tiles");
    tileRevisions_.clear();
    return false;
}

void ReceiverWatch::look(const View& view, const ViewBinding& binding, std::uint32_t serial) {
    gl::Pass(compare_)
        .constants(ExactLook{.serial = serial, .words = wordsPerPixel(view)})
        .bind(binding)
        .bind("SeenReceivers", seen_)
        .bind("TileRevisions", tileRevisions_)
        .dispatchPixels(view.width_px, view.height_px);
}

}  // namespace penumbra::exact_visibility
