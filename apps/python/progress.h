// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pybind11/pybind11.h>

#include <thread>

#include "studio/workbench/workbench.h"

namespace penumbra::studio::python {

/// Tells Python how far long work is, and ends the work with what Python raises: Ctrl-C, or the callback's
/// own. To be called without Python's lock, from any thread.
class Progress {
  public:
    /// `callback` may be None; both must outlive this.
    Progress(const pybind11::object& callback, const Workbench& workbench)
        : callback_(callback), workbench_(workbench) {}

    /// `fraction` of the work is done, 0 to 1.
    void operator()(double fraction) const {
        // A callback may use another renderer, whose context is then the current one.
        const CurrentAgain again{std::this_thread::get_id() == worker_ ? &workbench_ : nullptr};
        const pybind11::gil_scoped_acquire lock;
        if (PyErr_CheckSignals() != 0) throw pybind11::error_already_set();
        if (!callback_.is_none()) callback_(fraction);
    }

  private:
    struct CurrentAgain {
        const Workbench* workbench;
        ~CurrentAgain() {
            if (workbench != nullptr) workbench->makeCurrent();
        }
    };

    const pybind11::object& callback_;
    const Workbench& workbench_;
    std::thread::id worker_ = std::this_thread::get_id();
};

}  // namespace penumbra::studio::python
