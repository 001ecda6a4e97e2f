// SPDX-License-Identifier: Apache-2.0
// --exposure EV|auto|lock=FILE
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "studio/image/image.h"

namespace penumbra::studio {

/// How bright pictures are, as asked for.
struct ExposureArgument {
    std::string text = "auto";

    void addTo(CLI::App& command);
    /// For FrameRenderer::setExposure. Throws UsageError, and InputError where the file of `lock` is no
    /// picture of ours.
    std::optional<float> value() const;
};

/// What a picture's metadata say of its exposure value.
void stateExposure(Metadata& metadata, float ev);

}  // namespace penumbra::studio
