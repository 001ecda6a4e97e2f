// SPDX-License-Identifier: Apache-2.0
#include "src/gl/gl.h"

#include <string>

#include "penumbra/device.h"

namespace penumbra::gl {
namespace {

std::shared_ptr<ObjectRegistry>& threadsRegistry() {
    thread_local std::shared_ptr<ObjectRegistry> registry;
    return registry;
}

}  // namespace

ObjectRegistryScope::ObjectRegistryScope(std::shared_ptr<ObjectRegistry> registry)
    : outer_(std::exchange(threadsRegistry(), std::move(registry))) {}

ObjectRegistryScope::~ObjectRegistryScope() {
    threadsRegistry() = std::move(outer_);
}

const std::shared_ptr<ObjectRegistry>& ObjectRegistryScope::current() {
    return threadsRegistry();
}

std::pmr::memory_resource* ObjectRegistryScope::frameMemory() {
    return current() ? &current()->frameMemory : std::pmr::get_default_resource();
}

void label(GLenum kind, GLuint name, std::string_view text) {
    if (!text.empty()) glObjectLabel(kind, name, GLsizei(text.size()), text.data());
}

void forgetErrors() {
    // A lost context may answer with errors for ever.
    for (int i = 0; i < 16 && glGetError() != GL_NO_ERROR; ++i) {
    }
}

void finish() {
    glFinish();
}

void checkAllocated(std::string_view what) {
    if (glGetError() == GL_OUT_OF_MEMORY) {
        throw Error(Error::Kind::outOfMemory,
                    "the OpenGL device has no room for " + std::string(what) + "; use smaller sizes");
    }
}

DebugGroup::DebugGroup(std::string_view name) {
    glPushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 0, GLsizei(name.size()), name.data());
}

DebugGroup::~DebugGroup() {
    glPopDebugGroup();
}

}  // namespace penumbra::gl
