#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# llvmpipe of Mesa 22.3.6 (Debian 12): a depth texture of GL_DEPTH_COMPONENT32 reports 32 bits and stores them, but what a shader
# fetches from it comes in steps of 2^-23: far coarser than the buffer near 0, where reversed depths are, and coarser than
# depths of 24 bits, which are fetched whole. Who bounds a depth's error by GL_TEXTURE_DEPTH_SIZE is 512 times too sure.
#
# Seen: libgl1-mesa-dri 22.3.6-1+deb12u2 with LLVM 15. Needs Debian 12's apt, dpkg, gcc, libegl-dev, libgl-dev, libllvm15.
set -euo pipefail

version=22.3.6-1+deb12u2
expected='bits 32, stored 1025 of 2048, seen by a shader 5, least step 2^-23.00, error 0'

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
apt-get -qq -o APT::Sandbox::User=root download "libgl1-mesa-dri=$version"
dpkg-deb -x libgl1-mesa-dri_*.deb root

cat >depths.c <<'END'
#define GL_GLEXT_PROTOTYPES
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GL/gl.h>
#include <GL/glext.h>
#include <math.h>
#include <stdio.h>

static const char* triangle =
    "#version 450\nvoid main() { gl_Position = vec4(4 * (gl_VertexID & 1) - 1, 4 * (gl_VertexID >> 1) - 1, 0, 1); }";

static GLuint shader(GLenum stage, const char* source) {
    GLuint name = glCreateShader(stage);
    glShaderSource(name, 1, &source, 0);
    glCompileShader(name);
    return name;
}

int main(void) {
    PFNEGLGETPLATFORMDISPLAYEXTPROC displayOf =
        (PFNEGLGETPLATFORMDISPLAYEXTPROC)eglGetProcAddress("eglGetPlatformDisplayEXT");
    EGLDisplay display = displayOf(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, 0);
    eglInitialize(display, 0, 0);
    eglBindAPI(EGL_OPENGL_API);
    EGLint version[] = {EGL_CONTEXT_MAJOR_VERSION, 4, EGL_CONTEXT_MINOR_VERSION, 5, EGL_NONE};
    EGLContext context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, version);
    eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context);
    printf("%s, OpenGL %s\n", glGetString(GL_RENDERER), glGetString(GL_VERSION));

    enum { count = 2048 };
    GLuint texture, framebuffer, vertices, program = glCreateProgram();
    glGenTextures(1, &texture);
    glBindTexture(GL_TEXTURE_2D, texture);
    glTexStorage2D(GL_TEXTURE_2D, 1, GL_DEPTH_COMPONENT32, count, 1);
    GLint bits = 0;
    glGetTexLevelParameteriv(GL_TEXTURE_2D, 0, GL_TEXTURE_DEPTH_SIZE, &bits);
    glGenFramebuffers(1, &framebuffer);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, texture, 0);
    glGenVertexArrays(1, &vertices);
    glBindVertexArray(vertices);
    glAttachShader(program, shader(GL_VERTEX_SHADER, triangle));
    glAttachShader(program, shader(GL_FRAGMENT_SHADER,
        "#version 450\nvoid main() { gl_FragDepth = 0.001 + floor(gl_FragCoord.x) * exp2(-32.0); }"));
    glLinkProgram(program);
    glUseProgram(program);
    glViewport(0, 0, count, 1);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_ALWAYS);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    static GLuint stored[count];
    glReadPixels(0, 0, count, 1, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT, stored);

    GLuint seenTexture, seenFramebuffer, copy = glCreateProgram();
    glGenTextures(1, &seenTexture);
    glActiveTexture(GL_TEXTURE1);
    glBindTexture(GL_TEXTURE_2D, seenTexture);
    glTexStorage2D(GL_TEXTURE_2D, 1, GL_R32F, count, 1);
    glActiveTexture(GL_TEXTURE0);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glGenFramebuffers(1, &seenFramebuffer);
    glBindFramebuffer(GL_FRAMEBUFFER, seenFramebuffer);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, seenTexture, 0);
    glDisable(GL_DEPTH_TEST);
    glAttachShader(copy, shader(GL_VERTEX_SHADER, triangle));
    glAttachShader(copy, shader(GL_FRAGMENT_SHADER,
        "#version 450\nuniform sampler2D depths; out float seen;\n"
        "void main() { seen = texelFetch(depths, ivec2(gl_FragCoord.xy), 0).r; }"));
    glLinkProgram(copy);
    glUseProgram(copy);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    static float seen[count];
    glReadPixels(0, 0, count, 1, GL_RED, GL_FLOAT, seen);
    int kindsStored = 1, kindsSeen = 1;
    double leastStep = 1;
    for (int i = 1; i < count; ++i) {
        kindsStored += stored[i] != stored[i - 1];
        if (seen[i] == seen[i - 1]) continue;
        ++kindsSeen;
        double step = seen[i] - (double)seen[i - 1];
        if (step < leastStep) leastStep = step;
    }
    printf("bits %d, stored %d of %d, seen by a shader %d, least step 2^%.2f, error %u\n", bits, kindsStored,
           count, kindsSeen, log2(leastStep), (unsigned)glGetError());
    return 0;
}
END
gcc depths.c -o depths -lEGL -lGL -lm
export LIBGL_DRIVERS_PATH=$folder/root/usr/lib/x86_64-linux-gnu/dri LIBGL_ALWAYS_SOFTWARE=1
./depths | tee seen
tail -n 1 seen | grep -qxF "$expected" || { echo "changed: expected $expected" >&2; exit 1; }
