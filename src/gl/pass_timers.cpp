// SPDX-License-Identifier: Apache-2.0
#include "src/gl/pass_timers.h"

#include <algorithm>

namespace penumbra::gl {
namespace {

GLuint createQuery() {
    GLuint name = 0;
    glCreateQueries(GL_TIMESTAMP, 1, &name);
    return name;
}

GLuint64 queryResult(GLuint query, GLenum what) {
    GLuint64 result = 0;
    glGetQueryObjectui64v(query, what, &result);
    return result;
}

}  // namespace

PassTimers::Scope::Scope(PassTimers& timers, std::string_view name) : group_(name) {
    Pass& pass = timers.find(name);
    collect(pass);
    // A pair still in flight after a whole turn of the ring is overwritten: its time is lost, nobody waits.
    Pair& pair = pass.ring[std::size_t(pass.next)];
    pass.next = (pass.next + 1) % framesInFlight;
    glQueryCounter(pair.begin.name(), GL_TIMESTAMP);
    pair.pending = true;
    end_ = pair.end.name();
}

PassTimers::Scope::~Scope() {
    glQueryCounter(end_, GL_TIMESTAMP);
}

std::vector<PassTimers::Result> PassTimers::latest() const {
    std::vector<Result> results;
    for (Pass& pass : passes_) {
        collect(pass);
        results.push_back({pass.name, pass.milliseconds});
    }
    return results;
}

void PassTimers::collect(Pass& pass) {
    for (int i = 0; i < framesInFlight; ++i) {
        Pair& pair = pass.ring[std::size_t((pass.next + i) % framesInFlight)];  // oldest first
        if (!pair.pending || queryResult(pair.end.name(), GL_QUERY_RESULT_AVAILABLE) == 0) continue;
        const GLuint64 begin_ns = queryResult(pair.begin.name(), GL_QUERY_RESULT);
        const GLuint64 end_ns = queryResult(pair.end.name(), GL_QUERY_RESULT);
        // llvmpipe may tell an end before the beginning.
        pass.milliseconds = end_ns > begin_ns ? double(end_ns - begin_ns) * 1e-6 : 0;
        pair.pending = false;
    }
}

PassTimers::Pass& PassTimers::find(std::string_view name) {
    const auto found = std::ranges::find(passes_, name, &Pass::name);
    if (found != passes_.end()) return *found;
    Pass& pass = passes_.emplace_back();
    pass.name = name;
    for (Pair& pair : pass.ring) {
        pair.begin = Handle<deleteQuery>(createQuery());
        pair.end = Handle<deleteQuery>(createQuery());
    }
    return pass;
}

}  // namespace penumbra::gl
