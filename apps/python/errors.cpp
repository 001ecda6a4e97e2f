// SPDX-License-Identifier: Apache-2.0
#include "studio/errors.h"

#include <pybind11/pybind11.h>

#include <exception>

#include "apps/python/bindings.h"
#include "penumbra/device.h"
#include "studio/context/headless_context.h"

namespace penumbra::studio::python {
namespace {

namespace py = pybind11;

void raise(const char* name, const std::exception& error) {
    PyErr_SetString(py::module_::import("penumbra").attr(name).ptr(), error.what());
}

/// As the command's exit codes have them: 2 and 4.
const char* nameOf(Error::Kind kind) {
    switch (kind) {
        case Error::Kind::badArgument:
        case Error::Kind::unknownName:
            return "UsageError";
        case Error::Kind::noOpenGL:
        case Error::Kind::shader:
        case Error::Kind::outOfMemory:
        case Error::Kind::lostContext:
            return "DeviceError";
    }
    return "Error";
}

}  // namespace

void translateErrors() {
    py::register_exception_translator([](std::exception_ptr thrown) {
        try {
            std::rethrow_exception(thrown);
        } catch (const UsageError& error) {
            raise("UsageError", error);
        } catch (const InputError& error) {
            raise("InputError", error);
        } catch (const NoOpenGLError& error) {
            raise("DeviceError", error);
        } catch (const Error& error) {
            raise(nameOf(error.kind()), error);
        }
    });
}

}  // namespace penumbra::studio::python
