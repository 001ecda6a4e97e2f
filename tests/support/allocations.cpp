// SPDX-License-Identifier: Apache-2.0
#include "tests/support/allocations.h"

#include <cstddef>
#include <cstdlib>
#include <new>

namespace {

thread_local bool counting = false;
thread_local int count = 0;

}  // namespace

void* operator new(std::size_t size) {
    if (counting) ++count;
    if (void* const place = std::malloc(size == 0 ? 1 : size)) return place;
    throw std::bad_alloc();
}
// Of what the standard library makes of the two above, sanitizers replace this one with their own.
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
    try {
        return operator new(size);
    } catch (const std::bad_alloc&) {
        return nullptr;
    }
}
void operator delete(void* place) noexcept {
    std::free(place);
}
void operator delete(void* place, std::size_t) noexcept {
    std::free(place);
}

namespace penumbra::test {

AllocationCount::AllocationCount() {
    count = 0;
    counting = true;
}
AllocationCount::~AllocationCount() {
    counting = false;
}
int AllocationCount::allocations() {
    return count;
}

}  // namespace penumbra::test
