#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# llvmpipe of Mesa 22.3.6 (Debian 12): a shader that reads a buffer texture (usamplerBuffer) is compiled anew after any program whose
# sampler in the same place has other filters, though a buffer texture has none: the sampler's state stays as the program before
# left it, and is part of what llvmpipe compiles for. With long compute shaders that is seconds in the second frame, and again at
# the next start, since what is found in the shader cache depends on who drew before. The same buffer as an image
# (uimageBuffer) is compiled once.
#
# Seen: libgl1-mesa-dri 22.3.6-1+deb12u2 with LLVM 15. Needs Debian 12's apt, dpkg, gcc, libegl-dev, libgl-dev, libllvm15.
set -euo pipefail

version=22.3.6-1+deb12u2
expected='entries more in the shader cache: by a second dispatch 0, by one after another program: sampler 1, image 0'

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
apt-get -qq -o APT::Sandbox::User=root download "libgl1-mesa-dri=$version"
dpkg-deb -x libgl1-mesa-dri_*.deb root

cat >dispatches.c <<'END'
// dispatches STEPS: s and i sum a buffer through a sampler or an image, t reads a texture with linear filters.
#define GL_GLEXT_PROTOTYPES
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GL/gl.h>
#include <GL/glext.h>
#include <stdio.h>

static GLuint program(const char* source) {
    GLuint shader = glCreateShader(GL_COMPUTE_SHADER), name = glCreateProgram();
    glShaderSource(shader, 1, &source, 0);
    glCompileShader(shader);
    glAttachShader(name, shader);
    glLinkProgram(name);
    return name;
}

int main(int count, char** steps) {
    PFNEGLGETPLATFORMDISPLAYEXTPROC displayOf =
        (PFNEGLGETPLATFORMDISPLAYEXTPROC)eglGetProcAddress("eglGetPlatformDisplayEXT");
    EGLDisplay display = displayOf(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, 0);
    eglInitialize(display, 0, 0);
    eglBindAPI(EGL_OPENGL_API);
    EGLint version[] = {EGL_CONTEXT_MAJOR_VERSION, 4, EGL_CONTEXT_MINOR_VERSION, 5, EGL_NONE};
    EGLContext context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, version);
    eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context);
    fprintf(stderr, "%s, OpenGL %s\n", glGetString(GL_RENDERER), glGetString(GL_VERSION));

    static const GLuint words[12] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};
    static const GLubyte texels[8] = {10, 20, 0, 0, 30, 40, 0, 0};  // rows of four bytes
    GLuint buffers[2], bufferTexture, texture;
    glGenBuffers(2, buffers);
    glBindBuffer(GL_TEXTURE_BUFFER, buffers[0]);
    glBufferData(GL_TEXTURE_BUFFER, sizeof words, words, GL_STATIC_DRAW);
    glBindBuffer(GL_SHADER_STORAGE_BUFFER, buffers[1]);
    glBufferData(GL_SHADER_STORAGE_BUFFER, 64, 0, GL_STATIC_DRAW);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, buffers[1]);
    glGenTextures(1, &bufferTexture);
    glBindTexture(GL_TEXTURE_BUFFER, bufferTexture);
    glTexBuffer(GL_TEXTURE_BUFFER, GL_RGBA32UI, buffers[0]);
    glBindImageTexture(0, bufferTexture, 0, GL_TRUE, 0, GL_READ_ONLY, GL_RGBA32UI);
    glGenTextures(1, &texture);
    glActiveTexture(GL_TEXTURE1);
    glBindTexture(GL_TEXTURE_2D, texture);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_R8, 2, 2, 0, GL_RED, GL_UNSIGNED_BYTE, texels);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);

    GLuint throughSampler = program(
        "#version 450\nlayout(local_size_x = 1) in; layout(binding = 0) uniform usamplerBuffer words;\n"
        "layout(std430, binding = 0) buffer Out { uint sum; };\n"
        "void main() { sum = 0; for (int i = 0; i < 3; ++i) sum += texelFetch(words, i).x; }");
    GLuint asImage = program(
        "#version 450\nlayout(local_size_x = 1) in; layout(rgba32ui, binding = 0) readonly uniform uimageBuffer words;\n"
        "layout(std430, binding = 0) buffer Out { uint sum; };\n"
        "void main() { sum = 0; for (int i = 0; i < 3; ++i) sum += imageLoad(words, i).x; }");
    GLuint other = program(
        "#version 450\nlayout(local_size_x = 1) in; layout(binding = 1) uniform sampler2D picture;\n"
        "layout(std430, binding = 0) buffer Out { uint sum; };\n"
        "void main() { sum = uint(255.0 * textureLod(picture, vec2(0.5), 0.0).r); }");
    for (const char* step = steps[1]; *step; ++step) {
        glUseProgram(*step == 's' ? throughSampler : *step == 'i' ? asImage : other);
        glDispatchCompute(1, 1, 1);
        glFinish();
        GLuint sum = 0;
        glGetBufferSubData(GL_SHADER_STORAGE_BUFFER, 0, sizeof sum, &sum);
        fprintf(stderr, "%c %u\n", *step, sum);
    }
    eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(display, context);
    eglTerminate(display);  // what the cache is to hold is written by now
    return 0;
}
END
gcc dispatches.c -o dispatches -lEGL -lGL
export LIBGL_DRIVERS_PATH=$folder/root/usr/lib/x86_64-linux-gnu/dri LIBGL_ALWAYS_SOFTWARE=1

# How many entries the shader cache holds after these dispatches.
entries() {
    rm -rf "$folder/cache"
    MESA_SHADER_CACHE_DIR=$folder/cache ./dispatches "$1"
    find "$folder/cache" -type f ! -name index | wc -l
}
once=$(entries st) twice=$(entries sst) after=$(entries sts) image=$(entries it) imageAfter=$(entries iti)
echo "entries more in the shader cache: by a second dispatch $((twice - once)), by one after another program:" \
    "sampler $((after - once)), image $((imageAfter - image))" | tee seen
grep -qxF "$expected" seen || { echo "changed: expected $expected" >&2; exit 1; }
