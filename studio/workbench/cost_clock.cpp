// SPDX-License-Identifier: Apache-2.0
#include "studio/workbench/cost_clock.h"

#include <ctime>

namespace penumbra::studio {
namespace {

GLuint createTimestamp() {
    GLuint name = 0;
    glCreateQueries(GL_TIMESTAMP, 1, &name);
    return name;
}

double processCpu_ms() {
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return 1e3 * double(time.tv_sec) + 1e-6 * double(time.tv_nsec);
}

double timestamp_ms(GLuint query) {
    GLuint64 time_ns = 0;
    glGetQueryObjectui64v(query, GL_QUERY_RESULT, &time_ns);
    return 1e-6 * double(time_ns);
}

}  // namespace

CostClock::CostClock(const Device& device)
    : software_(device.isSoftware()), begin_(createTimestamp()), end_(createTimestamp()) {}

double CostClock::milliseconds(const std::function<void()>& work) const {
    glFinish();
    const double cpuBegin_ms = processCpu_ms();
    glQueryCounter(begin_.name(), GL_TIMESTAMP);
    work();
    glQueryCounter(end_.name(), GL_TIMESTAMP);
    glFinish();
    if (software_) return processCpu_ms() - cpuBegin_ms;
    return timestamp_ms(end_.name()) - timestamp_ms(begin_.name());
}

std::string_view CostClock::name() const {
    return software_ ? "process CPU time" : "GPU timer queries";
}

}  // namespace penumbra::studio
