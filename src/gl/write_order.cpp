// SPDX-License-Identifier: Apache-2.0
#include "src/gl/write_order.h"

#include <bit>

namespace penumbra::gl {

GLbitfield WriteOrder::missing(Serial writer, GLbitfield uses, Serial reader) const {
    if (writer == 0 || writer == reader) return 0;
    GLbitfield result = 0;
    for (GLbitfield left = uses; left != 0; left &= left - 1) {
        if (writer > visible_[std::size_t(std::countr_zero(left))]) result |= left & -left;
    }
    return result;
}

void WriteOrder::makeVisible(GLbitfield uses, Serial reader) {
    glMemoryBarrier(uses);
    for (GLbitfield left = uses; left != 0; left &= left - 1) {
        visible_[std::size_t(std::countr_zero(left))] = reader - 1;
    }
}

void WriteOrder::makeAllVisible() {
    glMemoryBarrier(GL_ALL_BARRIER_BITS);
    visible_.fill(newest_);
}

void WriteRecord::makeVisible(GLbitfield uses) const {
    if (order == nullptr) return;
    const WriteOrder::Serial next = order->newest() + 1;
    if (order->missing(writer, uses, next) != 0) order->makeVisible(uses, next);
}

}  // namespace penumbra::gl
