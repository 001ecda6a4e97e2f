// SPDX-License-Identifier: Apache-2.0
#include "tests/support/allocations.h"

#include <cstddef>
#include <cstdlib>
#include <new>

// Where this program's code lies, by the linker's own words.
extern "C" const char __executable_start, etext;

namespace {

thread_local bool counting = false;
thread_local int count = 0;
thread_local int untilFault = 0;
thread_local bool faultHappened = false;

bool isOurs(const void* caller) {
    return caller >= &__executable_start && caller < &etext;
}

void* allocate(std::size_t size, const void* caller) {
    if (counting) ++count;
    if (untilFault > 0 && isOurs(caller) && --untilFault == 0) {
        faultHappened = true;
        throw std::bad_alloc();
    }
    if (void* const place = std::malloc(size == 0 ? 1 : size)) return place;
    throw std::bad_alloc();
}

}  // namespace

void* operator new(std::size_t size) {
    return allocate(size, __builtin_return_address(0));
}
void* operator new[](std::size_t size) {
    return allocate(size, __builtin_return_address(0));
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
void operator delete[](void* place) noexcept {
    std::free(place);
}
void operator delete[](void* place, std::size_t) noexcept {
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

AllocationFault::AllocationFault(int n) {
    faultHappened = false;
    untilFault = n;
}
AllocationFault::~AllocationFault() {
    untilFault = 0;
}
bool AllocationFault::happened() {
    return faultHappened;
}

}  // namespace penumbra::test
