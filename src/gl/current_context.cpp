// SPDX-License-Identifier: Apache-2.0
#include "src/gl/current_context.h"

#include <dlfcn.h>

#include <utility>

namespace penumbra::gl {

// Of the platform libraries only those that the host has loaded are asked; none is loaded for the question's
// sake. A library whose context is current stays loaded, and with it the function that is kept.
ContextIdentity ContextIdentity::ofCurrent() {
    for (const auto& [library, function] :
         {std::pair{"libEGL.so.1", "eglGetCurrentContext"}, std::pair{"libGL.so.1", "glXGetCurrentContext"},
          std::pair{"libGLX.so.0", "glXGetCurrentContext"}}) {
        void* const loaded = dlopen(library, RTLD_LAZY | RTLD_NOLOAD);
        if (loaded == nullptr) continue;
        ContextIdentity found;
        found.getCurrent_ = reinterpret_cast<GetCurrentContext>(dlsym(loaded, function));
        if (found.getCurrent_ != nullptr) found.context_ = found.getCurrent_();
        dlclose(loaded);
        if (found.exists()) return found;
    }
    return {};
}

}  // namespace penumbra::gl
