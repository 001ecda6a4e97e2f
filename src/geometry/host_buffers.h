// SPDX-License-Identifier: Apache-2.0
// Vertices and indices in buffers of the host's become our own, tightly packed, without leaving the device.
#pragma once

#include <string_view>

#include "penumbra/caster.h"
#include "src/device/device_internals.h"
#include "src/gl/buffer.h"

namespace penumbra {

/// Copies `count` vectors of `components` floats into `target`. Throws Error::Kind::badArgument, naming
/// `what`, where the host's buffer does not hold them. To be called in a HostScope.
void gatherVectors(Device::Internals& device, const HostVectors& source, std::size_t count,
                   unsigned components, const gl::Buffer& target, std::string_view what);

/// The same for the indices of `source`, which become 32 bits wide.
void gatherIndices(Device::Internals& device, const Mesh::HostSource& source, const gl::Buffer& target);

}  // namespace penumbra
