// SPDX-License-Identifier: Apache-2.0
// The library's techniques and the ray-traced reference under one roof, on any device.
#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "penumbra/penumbra.h"

namespace penumbra::studio {

/// All names that `makeAnyTechnique` knows: the library's catalog and "reference".
std::vector<TechniqueInfo> allTechniques();

/// The technique that is used where none is asked for: exact visibility, or hard where that was left out.
std::string_view defaultTechnique();

/// A technique of the catalog, or the ray-traced reference. Throws Error::Kind::unknownName listing them all.
std::unique_ptr<Technique> makeAnyTechnique(Device& device, std::string_view name);

/// Passes the device's messages on to the log of the process.
void logFromDevice(LogLevel level, std::string_view message);

}  // namespace penumbra::studio
