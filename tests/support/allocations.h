// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace penumbra::test {

/// Counts this thread's calls of operator new while it lives; programs that link this have an operator new
/// that counts. A driver's own threads are its own affair.
class AllocationCount {
  public:
    AllocationCount();
    AllocationCount(const AllocationCount&) = delete;
    AllocationCount& operator=(const AllocationCount&) = delete;
    ~AllocationCount();

    static int allocations();
};

}  // namespace penumbra::test
