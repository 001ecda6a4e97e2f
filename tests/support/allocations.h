// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace penumbra::test {

/// Counts this thread's calls of operator new while it lives; programs that link this have an operator new
/// of its own. A driver's own threads are its own affair.
class AllocationCount {
  public:
    AllocationCount();
    AllocationCount(const AllocationCount&) = delete;
    AllocationCount& operator=(const AllocationCount&) = delete;
    ~AllocationCount();

    static int allocations();
};

/// Lets one of this thread's allocations fail while it lives: the `n`-th, from 1, that this program's own
/// code asks for. Drivers and the standard library's compiled parts get what they ask for, since drivers end
/// the process where they do not.
class AllocationFault {
  public:
    explicit AllocationFault(int n);
    AllocationFault(const AllocationFault&) = delete;
    AllocationFault& operator=(const AllocationFault&) = delete;
    ~AllocationFault();

    /// Whether so many were asked for.
    static bool happened();
};

}  // namespace penumbra::test
