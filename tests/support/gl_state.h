// SPDX-License-Identifier: Apache-2.0
// The state of an OpenGL context as tests see it, and a host that leaves nothing at its default.
#pragma once

#include <epoxy/gl.h>

#include <map>
#include <string>
#include <vector>

namespace penumbra::test {

/// All that OpenGL 4.5 core tells about the current context's state (chapter 23 of its specification), by
/// name: far more than the library says that it touches.
using GlState = std::map<std::string, std::vector<double>>;
GlState captureState();

/// "NAME: 1 2 became 3 4", a line for each difference; empty where there is none.
std::string differences(const GlState& before, const GlState& after);

/// A renderer with habits of its own: every binding taken, every switch on, every value odd.
class NastyHost {
  public:
    /// Sets its state in the current context.
    NastyHost();
    NastyHost(const NastyHost&) = delete;
    NastyHost& operator=(const NastyHost&) = delete;
    /// Frees what it has bound, so that pixels can be read again; other state stays odd.
    ~NastyHost();

  private:
    void bindTextures();
    void bindBuffers();
    void setRaster() const;

    GLuint program_ = 0, vertexArray_ = 0, framebuffer_ = 0, renderbuffer_ = 0, sampler_ = 0, buffer_ = 0;
    GLuint transformFeedback_ = 0;
    std::vector<GLuint> textures_;
};

}  // namespace penumbra::test
