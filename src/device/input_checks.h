// SPDX-License-Identifier: Apache-2.0
// The door: what a host may hand over wrong is told in words before anything is drawn. The list of it, for
// people to read, is docs/manual/misuse.md, which tests/host_misuse_test.cpp goes through row by row.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "penumbra/technique.h"

namespace penumbra {

/// Which argument a message is about: "View: viewFromWorld", or {"ShadowInputs: casters", 3, ".mesh"}. Put
/// together only where there is something to say, since frames allocate nothing.
struct Argument {
    // Not explicit: most have no index.
    Argument(const char* text) : name(text) {}
    Argument(const char* list, std::size_t place, const char* part)
        : name(list), index(place), member(part) {}
    std::string text() const { return index ? name + ("[" + std::to_string(*index) + "]") + member : name; }

    const char* name;
    std::optional<std::size_t> index;
    const char* member = "";
};

/// Throws Error::Kind::badArgument with `message` and its remedy.
[[noreturn]] void refuse(const Argument& argument, const std::string& message);

/// Finite, and the last row 0 0 0 1.
void requireAffine(const Mat4& matrix, const Argument& argument);

/// A texture that shaders sample: GL_TEXTURE_2D with colours in it that are no integers.
void requireColorTexture(std::uint32_t texture, const Argument& argument);

/// The view's part of what follows.
void checkView(const View& view);

/// Throws Error::Kind::badArgument where sizes, matrices, textures or numbers of the view, a light or its
/// buffer are outside their documented ranges or do not fit each other. To be called in a HostScope.
void checkFrame(const FrameInputs& frame, const Device::Internals& device);

/// Passes `visitor` on, and puts back what it leaves outside of a parameter's range, of which it throws
/// Error::Kind::badArgument.
void describeGuarded(Technique& technique, ParameterVisitor& visitor);

}  // namespace penumbra
